// Errors of the discrete model.
#pragma once

#include "analytic/detail/errors.hpp"
