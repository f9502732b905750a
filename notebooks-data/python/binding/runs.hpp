// The functions of the Python module's compiled part.
#pragma once

#include <pybind11/pybind11.h>

namespace clatter::python {

/// sequence, angles.
void add_discrete_functions(pybind11::module_& module);
/// simulate, compare; scenes.
void add_scene_functions(pybind11::module_& module);
/// verify.
void add_verify_function(pybind11::module_& module);

}  // namespace clatter::python
