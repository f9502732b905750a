// Errors of the simulator.
#pragma once

#include "numeric/base/errors.hpp"
