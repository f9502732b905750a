// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/cause.hpp"

#include <cmath>

#include "validation/output/number.hpp"

namespace clatter::validation {

std::string three_digits(double value) { return significant(value, 3); }

std::string misfit_words(double misfit) { return "to " + significant(std::fmax(misfit, 1e-16), 1); }

}  // namespace clatter::validation
