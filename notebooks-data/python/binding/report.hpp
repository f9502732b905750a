// What a run came to, for Python: the program's own JSON, tables and records.
#pragma once

#include <pybind11/pybind11.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>

#include "validation/output/json.hpp"
#include "validation/output/table.hpp"

namespace clatter::python {

/// Made when they are asked for.
struct Report {
  std::function<validation::Json()> json;
  std::function<validation::Table()> table;    ///< that people read
  std::function<validation::Table()> records;  ///< of CSV
};

/// Objects as dict, arrays as list, null as None; numbers keep all their bits.
[[nodiscard]] pybind11::object to_python(const validation::Json& json);

/// Adds the class `Report` to the module.
void add_report_class(pybind11::module_& module);

}  // namespace clatter::python
