// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the discrete model.
#pragma once

#include "analytic/detail/errors.hpp"
