// The command line before it is parsed: unknown, repeated and incomplete options found with a clear word.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace clatter::validation {

/// Checks the arguments against the commands of `app` and joins each option with its value as
/// "--name=value", so that a value may begin with a minus sign.
/// @throws BadInput with one line.
[[nodiscard]] std::vector<std::string> checked_arguments(const CLI::App& app,
                                                         const std::vector<std::string>& arguments);

}  // namespace clatter::validation
