// SPDX-License-Identifier: GPL-3.0-or-later
// Options that several commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/cli/command.hpp"
#include "validation/output/report.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/option_values.hpp"
#include "validation/scene/swept_range.hpp"

namespace clatter::validation::inline cli {

/// Texts of the output options.
struct OutputTexts {
  std::optional<std::string> format, output;
  bool ascii = false, bare = false;
};

/// Where and how to write.
struct OutputChoice {
  TextStyle style;
  std::string path;
};

void add_output_options(Command& command, OutputTexts& texts);

[[nodiscard]] OutputChoice read_output(const OutputTexts& texts);

/// Makes sure before a run that what it writes, besides --output, is no input and that the output can be written.
/// @throws as note_written and require_writable.
void check_files(const OutputChoice& choice, const std::vector<RunFile>& written = {});

/// Writes a finished text whole, foreign characters printable.
void write_out(const OutputChoice& choice, const std::string& text);

/// Writes the report in the form that was asked for.
void write_report(const OutputChoice& choice, const Report& report);

void add_sweep_options(Command& command, SweepTexts& texts, const std::string& what);

}  // namespace clatter::validation::inline cli
