// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid body ready to be dropped, with its mass properties, mesh and surface.
#pragma once

#include "numeric/body/body.hpp"
