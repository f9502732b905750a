// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid body ready to be dropped.
#pragma once

#include "numeric/body/body.hpp"
