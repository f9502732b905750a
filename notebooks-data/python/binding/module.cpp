// SPDX-License-Identifier: GPL-3.0-or-later
// The compiled part of the Python module: clatter._clatter.  What users see is in clatter/*.py.
#include <pybind11/pybind11.h>

#include "report.hpp"
#include "runs.hpp"
#include "validation/output/version.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;

/// The classes are Python's own, so that they can have bases and docstrings there.
void raise(const char* name, const std::string& message) {
  const py::object type = py::module_::import("clatter.errors").attr(name);
  PyErr_SetString(type.ptr(), message.c_str());
}

void translate(std::exception_ptr pointer) {
  using validation::FailureKind;
  if (!pointer) return;
  try {
    std::rethrow_exception(pointer);
  } catch (const py::builtin_exception&) {  // pybind11's own
    throw;
  } catch (const py::error_already_set&) {
    throw;
  } catch (...) {
    const validation::Failure failure = validation::current_failure();
    switch (failure.kind) {
      case FailureKind::bad_input: return raise("BadInput", failure.message);
      case FailureKind::not_computed: return raise("NotComputed", failure.message);
      case FailureKind::outside_model: return raise("OutsideModel", failure.message);
      case FailureKind::defect: return PyErr_SetString(PyExc_RuntimeError, failure.message.c_str());
    }
  }
}

}  // namespace

PYBIND11_MODULE(_clatter, module) {
  module.doc() = "Compiled part of clatter.";
  module.attr("version") = validation::version;
  py::register_exception_translator(&translate);
  add_report_class(module);
  add_discrete_functions(module);
  add_scene_functions(module);
  add_study_functions(module);
  add_evidence_functions(module);
  add_verify_function(module);
}

}  // namespace clatter::python
