// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors and matrices of the simulator.
#pragma once

#include "numeric/base/linear_algebra.hpp"
