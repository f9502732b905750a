// SPDX-License-Identifier: GPL-3.0-or-later
// Mass, centre of mass and inertia of a body.
#pragma once

#include "numeric/body/mass_properties.hpp"
