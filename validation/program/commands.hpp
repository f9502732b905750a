// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the program.
#pragma once

#include <vector>

#include "validation/command/command.hpp"

namespace clatter::validation {

/// All of them, in the order of the help.
[[nodiscard]] const std::vector<Command>& all_commands();

/// Gives way to clatter-mpi where mpirun started the program (become_mpi_program()).
void hand_over(char** words);

}  // namespace clatter::validation
