// A rigid body ready to be dropped.
#pragma once

#include "numeric/body/body.hpp"
