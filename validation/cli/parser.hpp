// The command line, read with CLI11, which only this parser knows.
#pragma once

#include <string>
#include <vector>

#include "validation/cli/command.hpp"

namespace clatter::validation {

/// What the arguments ask for: a command whose targets are set, or a text to print (help, version).
struct ParsedLine {
  const Command* command = nullptr;
  std::string text{};
};

/// @throws BadInput with one line.
[[nodiscard]] ParsedLine parse_line(const std::vector<Command>& commands, const std::vector<std::string>& arguments);

}  // namespace clatter::validation
