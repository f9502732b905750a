// Vectors and matrices of the simulator.
#pragma once

#include "numeric/base/linear_algebra.hpp"
