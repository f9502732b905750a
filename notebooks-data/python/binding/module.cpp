// The compiled part of the Python module: clatter._clatter.  What users see is in clatter/*.py.
#include <pybind11/pybind11.h>

#include "analytic/errors.hpp"
#include "numeric/errors.hpp"
#include "report.hpp"
#include "runs.hpp"
#include "validation/cli/version.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;

/// The classes are Python's own, so that they can have bases and docstrings there.
void raise(const char* name, const std::exception& error) {
  const py::object type = py::module_::import("clatter.errors").attr(name);
  PyErr_SetString(type.ptr(), error.what());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const validation::BadInput& error) {
    raise("BadInput", error);
  } catch (const numeric::MeshError& error) {
    raise("BadInput", error);
  } catch (const analytic::NumericalError& error) {
    raise("NotComputed", error);
  } catch (const analytic::OutsideModelError& error) {
    raise("OutsideModel", error);
  } catch (const std::logic_error& error) {  // a scene that the library refuses
    raise("BadInput", error);
  } catch (const py::builtin_exception&) {  // pybind11's own
    throw;
  } catch (const std::runtime_error& error) {
    raise("NotComputed", error);
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
  add_verify_function(module);
}

}  // namespace clatter::python
