// Options that several commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/cli/command.hpp"
#include "validation/output/report.hpp"
#include "validation/output/run_files.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {

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

/// What a run writes besides --output.  @throws as refuse_shared_files and require_writable.
void check_files(const OutputChoice& choice, std::vector<RunFile> written, const std::vector<RunFile>& read = {});

/// Writes a finished text whole.
void write_out(const OutputChoice& choice, const std::string& text);

/// Writes the report in the form that was asked for.
void write_report(const OutputChoice& choice, const Report& report);

/// From, to and step or count of a swept quantity.
struct SweepTexts {
  std::optional<std::string> from, to, step, count;
};
void add_sweep_options(Command& command, SweepTexts& texts, const std::string& what);

struct Sweep {
  double from = 0;
  double to = 0;
  long long count = 0;
  double step = 0;  ///< 0: equal parts of [from, to]
  bool logarithmic = false;
  /// Value i.  With a step, from + i·step is rounded to 15 digits, so that steps that are decimal
  /// fractions give clean decimals; with a count, the last value is `to` exactly.
  [[nodiscard]] double value(long long i) const;
};
struct SweepDefault {
  double from, to, step;
};
[[nodiscard]] Sweep read_sweep(const SweepTexts& texts, const SweepDefault& fallback, const Range& range);

}  // namespace clatter::validation
