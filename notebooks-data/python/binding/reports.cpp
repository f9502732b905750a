// SPDX-License-Identifier: GPL-3.0-or-later
// Reports and the language of scenes as Python objects.
#include <pybind11/stl.h>

#include <algorithm>
#include <type_traits>
#include <variant>

#include "binding.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/html.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::Format;
using validation::Key;
using validation::Value;

/// Lets Ctrl-C end what goes through very many values.
void look_for_signals() {
  constexpr unsigned values_a_look = 1024;
  static unsigned seen = 0;  // under Python's lock
  if (++seen % values_a_look == 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Fields as dict, lists as list, nothing as None; numbers keep all their bits.
py::object to_python(const Value& value) {
  const auto python = [](const auto& content) -> py::object {
    using Content = std::decay_t<decltype(content)>;
    if constexpr (std::is_same_v<Content, std::nullptr_t>) {
      return py::none();
    } else if constexpr (std::is_same_v<Content, Value::List>) {
      py::list list;
      for (const Value& item : content) list.append(to_python(item));
      return list;
    } else if constexpr (std::is_same_v<Content, Value::Fields>) {
      py::dict dict;
      for (const validation::Field& field : content) dict[py::str(field.name)] = to_python(field.value);
      return dict;
    } else {
      return py::cast(content);
    }
  };
  look_for_signals();
  return std::visit(python, value.content());
}

py::object data_of(Report& report) { return to_python(report.whole().fields); }

py::object rows_of(Report& report) { return to_python(row_objects(report.whole().grid)); }

py::object cell_of(const validation::Row& row, std::size_t k) {
  return k < row.size() ? to_python(row[k].value) : py::none();
}

py::list column_at(const validation::Grid& grid, std::size_t k) {
  py::list values;
  for (const validation::Row& row : grid.rows) values.append(cell_of(row, k));
  return values;
}

/// The cells of CSV by their columns, in its order.
py::dict columns_of(Report& report) {
  const validation::Grid& grid = report.whole().grid;
  py::dict columns;
  for (std::size_t k = 0; k < grid.columns.size(); ++k) columns[py::str(grid.columns[k].name)] = column_at(grid, k);
  return columns;
}

// Parts of it, each for much less than all.

py::object column_of(Report& report, const std::string& name) {
  const validation::Grid& grid = report.whole().grid;
  const auto found = std::ranges::find(grid.columns, name, &validation::Column::name);
  return found == grid.columns.end() ? py::object(py::none())
                                     : column_at(grid, static_cast<std::size_t>(found - grid.columns.begin()));
}

py::dict row_of(Report& report, std::size_t i) {
  const validation::Grid& grid = report.whole().grid;
  const validation::Row& row = grid.rows.at(i);
  py::dict cells;
  for (std::size_t k = 0; k < grid.columns.size(); ++k) cells[py::str(grid.columns[k].name)] = cell_of(row, k);
  return cells;
}

/// The same as JSON has it, in the list of that name or, without a name, as an object of the cells.
py::object object_of(Report& report, const std::string& list, std::size_t i) {
  const validation::Report& whole = report.whole();
  if (list.empty()) return to_python(row_object(whole.grid.columns, whole.grid.rows.at(i)));
  return to_python(std::get<Value::List>(whole.fields.find(list)->content()).at(i));
}

std::string html_of(Report& report) {
  report.whole();
  return run_interruptible([known = report.known](const Watch&) { return validation::html_table(*known); });
}

/// @throws BadInput for a format that there is not.
std::string text_of(Report& report, const std::string& format, bool ascii) {
  static const std::vector<std::string> names{"table", "csv", "json", "markdown", "latex"};
  const auto chosen = static_cast<Format>(validation::read_name_option("format", format, names));
  const validation::TextStyle style{chosen, ascii};
  if (report.text) return run_interruptible([text = report.text, style](const Watch&) { return text(style); });
  report.whole();
  return run_interruptible([known = report.known, style](const Watch&) { return report_text(*known, style); });
}

/// "number", "whole", "truth", "text", "name", "list" or "curve".
const char* kind_of(const Key& key) {
  static const char* const kinds[]{"number", "whole", "truth", "text", "name", "list", "curve"};
  return key.allowed().starts_with("a whole number") ? "whole" : kinds[static_cast<std::size_t>(key.value.kind)];
}

/// The rows of the table of keys that are arguments here, in the order of the table.
py::list keys() {
  py::list rows;
  for (const Key& key : validation::all_keys()) {
    if (key.is_file()) continue;
    py::dict row;
    row["argument"] = key.argument();
    row["key"] = key.name;
    row["kind"] = kind_of(key);
    row["names"] = key.value.names;
    row["flag"] = key.flag;
    row["unit"] = key.unit;
    row["allowed"] = key.allowed();
    row["meaning"] = key.help;
    row["is_discrete"] = key.is_for(validation::Model::discrete);
    row["is_continuous"] = key.is_for(validation::Model::continuous);
    rows.append(row);
  }
  return rows;
}

}  // namespace

void add_reports(py::module_& module) {
  py::class_<Report>(module, "Report", "What a run came to.")
      .def("data", &data_of, "The program's JSON as Python objects.")
      .def("rows", &rows_of, "The rows of its CSV as Python objects.")
      .def("columns", &columns_of, "The cells of its CSV by their columns.")
      .def(
          "length", [](Report& report) { return report.whole().grid.rows.size(); }, "How many rows CSV has.")
      .def("column", &column_of, py::arg("name"), "The cells of one column; None: there is none of that name.")
      .def("row", &row_of, py::arg("index"), "The cells of one row by their columns.")
      .def("object", &object_of, py::arg("list"), py::arg("index"), "One row as JSON has it in that list.")
      .def("text", &text_of, py::arg("format"), py::arg("ascii"), "What the program prints with --format.")
      .def("html", &html_of, "The table as an element of an HTML page.");
  module.def(
      "suggestion",
      [](const std::string& name, const std::vector<std::string>& names) {
        return validation::suggestion(name, names, true);
      },
      py::arg("name"), py::arg("names"), "What is said of a name that there is not, by those that there are.");
  module.def("keys", &keys, "The keys of scenes that are arguments: their names, kinds, units, what is allowed.");
}

}  // namespace clatter::python
