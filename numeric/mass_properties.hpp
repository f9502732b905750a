// Mass, centre of mass and inertia of a body.
#pragma once

#include "numeric/body/mass_properties.hpp"
