#include "report.hpp"

#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include "validation/output/html.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::Format;
using validation::Json;

/// @throws BadInput for a format that there is not.
std::string text_of(const Report& report, const std::string& format, bool ascii) {
  static const std::vector<std::string> names{"table", "csv", "json", "markdown", "latex"};
  const auto chosen = static_cast<Format>(validation::read_name_option("format", format, names));
  if (chosen == Format::json) return validation::json_text(report.json());
  return validation::table_text(chosen == Format::csv ? report.records() : report.table(), {chosen, ascii});
}

}  // namespace

py::object to_python(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean: return py::bool_(json.get<bool>());
    case Json::value_t::number_integer: return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_unsigned: return py::int_(json.get<std::uint64_t>());
    case Json::value_t::number_float: return py::float_(json.get<double>());
    case Json::value_t::string: return py::str(json.get_ref<const std::string&>());
    case Json::value_t::array: {
      py::list list;
      for (const Json& item : json) list.append(to_python(item));
      return list;
    }
    case Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[py::str(key)] = to_python(value);
      return dict;
    }
    default: return py::none();
  }
}

void add_report_class(py::module_& module) {
  py::class_<Report>(module, "Report", "What a run came to.")
      .def(
          "data", [](const Report& report) { return to_python(report.json()); },
          "The program's JSON as Python objects.")
      .def("text", &text_of, py::arg("format"), py::arg("ascii"), "What the program prints with --format.")
      .def(
          "html", [](const Report& report) { return validation::html_table(report.table()); },
          "The table as an element of an HTML page.");
}

}  // namespace clatter::python
