// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of the Python module's compiled part.
#pragma once

#include <pybind11/pybind11.h>

namespace clatter::python {

/// sequence, explain, regimes, angles.
void add_discrete_functions(pybind11::module_& module);
/// simulate, compare; scenes.
void add_scene_functions(pybind11::module_& module);
/// plan, tradeoff, sweep.
void add_study_functions(pybind11::module_& module);
/// measured, benchmark_*, compare_against, extremes, figure.
void add_evidence_functions(pybind11::module_& module);
/// verify.
void add_verify_function(pybind11::module_& module);

}  // namespace clatter::python
