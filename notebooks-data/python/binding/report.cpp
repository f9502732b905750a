// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.hpp"

#include <pybind11/stl.h>

#include <type_traits>
#include <variant>

#include "validation/output/html.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::Format;
using validation::Value;

/// @throws BadInput for a format that there is not.
std::string text_of(const Report& report, const std::string& format, bool ascii) {
  static const std::vector<std::string> names{"table", "csv", "json", "markdown", "latex"};
  const auto chosen = static_cast<Format>(validation::read_name_option("format", format, names));
  const validation::TextStyle style{chosen, ascii};
  return report.text ? report.text(style) : validation::report_text(report.made(), style);
}

}  // namespace

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
  return std::visit(python, value.content());
}

void add_report_class(py::module_& module) {
  py::class_<Report>(module, "Report", "What a run came to.")
      .def(
          "data", [](const Report& report) { return to_python(report.made().fields); },
          "The program's JSON as Python objects.")
      .def(
          "rows", [](const Report& report) { return to_python(row_objects(report.made().grid)); },
          "The rows of its CSV as Python objects.")
      .def("text", &text_of, py::arg("format"), py::arg("ascii"), "What the program prints with --format.")
      .def(
          "html", [](const Report& report) { return validation::html_table(report.made()); },
          "The table as an element of an HTML page.");
}

}  // namespace clatter::python
