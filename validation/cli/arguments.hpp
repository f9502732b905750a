// SPDX-License-Identifier: GPL-3.0-or-later
// The command line before it is parsed: unknown, repeated and incomplete options found with a clear word.
#pragma once

#include <string>
#include <vector>

#include "validation/cli/command.hpp"

namespace clatter::validation::inline cli {

/// Checks the arguments against the commands and joins each option with its value as "--name=value", so that a value
/// may begin with a minus sign.
/// @throws BadInput with one line.
[[nodiscard]] std::vector<std::string> checked_arguments(const std::vector<Command>& commands,
                                                         const std::vector<std::string>& arguments);

}  // namespace clatter::validation::inline cli
