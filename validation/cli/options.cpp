#include "validation/cli/options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation {

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

void check_files(const OutputChoice& choice, std::vector<RunFile> written, const std::vector<RunFile>& read) {
  const RunFile output{"--output", choice.path};
  written.insert(written.begin(), output);
  refuse_shared_files(written, read);
  require_writable(output);  // or a run would end in vain
}

void write_out(const OutputChoice& choice, const std::string& text) {
  Sink sink(choice.path);
  sink.write(text);
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

double Sweep::value(long long i) const {
  if (i == count - 1 && step == 0) return to;
  if (step > 0) return std::fmin(clean_step(from, step, i), to);
  const double part = static_cast<double>(i) / static_cast<double>(count - 1);
  if (logarithmic) return from * std::pow(to / from, part);
  return from + (to - from) * part;
}

Sweep read_sweep(const SweepTexts& texts, const SweepDefault& fallback, const Range& range) {
  Sweep sweep{.from = fallback.from, .to = fallback.to};
  if (texts.from) sweep.from = read_number_option("--from", *texts.from, range);
  if (texts.to) sweep.to = read_number_option("--to", *texts.to, range);
  if (!(sweep.from <= sweep.to)) {
    throw BadInput(
        fmt::format("--from {}: must not be greater than --to {}", shortest(sweep.from), shortest(sweep.to)));
  }
  if (texts.step && texts.count) {
    throw BadInput(fmt::format("--step {} and --count {}: give one of them, not both", *texts.step, *texts.count));
  }
  if (texts.count) {
    sweep.count = read_integer_option("--count", *texts.count, 1, 100000000);
    if (sweep.count == 1) sweep.to = sweep.from;
    return sweep;
  }
  sweep.step =
      texts.step ? read_number_option("--step", *texts.step, {0, 1e300, true, "greater than 0"}) : fallback.step;
  const double steps = (sweep.to - sweep.from) / sweep.step;
  if (!(steps < 1e8)) throw BadInput(fmt::format("--step {}: more than 100000000 values", sweep.step));
  // A step that fits the range but for rounding reaches its end.
  sweep.count = static_cast<long long>(std::floor(steps * (1 + 1e-12) + 1e-12)) + 1;
  return sweep;
}

}  // namespace clatter::validation
