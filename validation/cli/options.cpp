// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/cli/options.hpp"

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/sink.hpp"
#include "validation/output/symbols.hpp"

namespace clatter::validation::inline cli {

void add_output_options(Command& command, OutputTexts& t) {
  command.add_text("--format", t.format, "table|csv|json|markdown|latex", "form of the output (table)", "Output");
  command.add_text("--output", t.output, "FILE", "write there, whole or not at all; -: stdout", "Output");
  command.add_flag("--ascii", t.ascii, "plain ASCII in tables", "Output");
  command.add_flag("--bare", t.bare, "CSV without comments", "Output");
}

OutputChoice read_output(const OutputTexts& texts) {
  OutputChoice choice;
  choice.style.ascii = texts.ascii;
  choice.style.bare = texts.bare;
  choice.path = texts.output.value_or("");
  if (texts.format) {
    choice.style.format =
        static_cast<Format>(read_name_option("--format", *texts.format, {"table", "csv", "json", "markdown", "latex"}));
  }
  return choice;
}

void check_files(const OutputChoice& choice, const std::vector<RunFile>& written) {
  const RunFile output{"--output", choice.path};
  note_written(output);
  for (const RunFile& file : written) note_written(file);
  require_writable(output);  // or a run would end in vain
}

void write_out(const OutputChoice& choice, const std::string& text) {
  Sink sink(choice.path);
  sink.write(printable(text, Lines::kept));
  sink.commit();
}

void write_report(const OutputChoice& choice, const Report& report) {
  write_out(choice, report_text(report, choice.style));
}

void add_sweep_options(Command& command, SweepTexts& t, const std::string& what) {
  command.add_text("--from", t.from, "X", "first " + what, "Range");
  command.add_text("--to", t.to, "X", "last " + what, "Range");
  command.add_text("--step", t.step, "X", "step from one to the next", "Range");
  command.add_text("--count", t.count, "N", "or the number of values, both ends included", "Range");
}

}  // namespace clatter::validation::inline cli
