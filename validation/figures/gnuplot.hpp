// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot, as a program that this one starts.
#pragma once

#include <string>

namespace clatter::validation::inline figures {

/// Runs a script with gnuplot's default settings; returns what it writes to its standard output.
/// @throws BadInput if gnuplot is not there; std::runtime_error with its first line of complaint if it fails, or if no
/// temporary file can be made.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

/// @param purpose what needs it, such as "--plot FILE", for the message
/// @param terminal that gnuplot must have
/// @throws as run_gnuplot.
void require_gnuplot(const std::string& purpose, const std::string& terminal = "svg");

/// A text as gnuplot's string constant, in which nothing is replaced.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

}  // namespace clatter::validation::inline figures
