// SPDX-License-Identifier: GPL-3.0-or-later
// What a run came to, for Python: the program's own report.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>

#include "validation/output/report.hpp"

namespace clatter::python {

struct Report {
  std::function<validation::Report()> made;  ///< when something of it is asked for
  /// The text where the program prints another one than the report's.
  std::function<std::string(const validation::TextStyle&)> text = nullptr;
};

/// Fields as dict, lists as list, nothing as None; numbers keep all their bits.
[[nodiscard]] pybind11::object to_python(const validation::Value& value);

/// Adds the class `Report` to the module.
void add_report_class(pybind11::module_& module);

}  // namespace clatter::python
