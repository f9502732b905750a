// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/command/command.hpp"

namespace clatter::validation {

std::vector<std::string> Command::option_names() const {
  std::vector<std::string> names{"--help"};
  for (const Argument& argument : arguments) {
    if (argument.is_option()) names.push_back(argument.name);
  }
  return names;
}

}  // namespace clatter::validation
