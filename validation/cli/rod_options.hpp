// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the commands that deal with the thin rod's contact angles.
#pragma once

#include "validation/cli/command.hpp"
#include "validation/scene/rod_parameters.hpp"

namespace clatter::validation::inline cli {

void add_rod_options(Command& command, RodTexts& texts);

}  // namespace clatter::validation::inline cli
