// SPDX-License-Identifier: GPL-3.0-or-later
// The compiled part of the Python module: clatter._clatter.  What users see is in clatter/*.py.
#include <pthread.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "binding.hpp"
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

void leave_alone(std::thread& thread) {
  const sched_param idle{};
  pthread_setschedparam(thread.native_handle(), SCHED_IDLE, &idle);
  thread.detach();
}

void end_before_destructors() {
  if (WorkingThread::number() == 0) return;
  const auto end = [](int status, void*) {
    std::fflush(nullptr);
    _exit(status);
  };
  on_exit(end, nullptr);
}

PYBIND11_MODULE(_clatter, module) {
  module.doc() = "Compiled part of clatter.";
  module.attr("version") = validation::version;
  py::register_exception_translator(&translate);
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_before_destructors));
  add_reports(module);
  add_discrete_functions(module);
  add_scene_functions(module);
  add_evidence_functions(module);
  add_commands(module);
}

}  // namespace clatter::python
