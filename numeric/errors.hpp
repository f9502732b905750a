// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the simulator.
#pragma once

#include "numeric/base/errors.hpp"
