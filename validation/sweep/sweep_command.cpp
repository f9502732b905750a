// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/command/progress.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/csv_line.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/json.hpp"
#include "validation/output/sink.hpp"
#include "validation/sweep/column_file.hpp"
#include "validation/sweep/processes.hpp"
#include "validation/sweep/rows.hpp"
#include "validation/sweep/summary.hpp"
#include "validation/sweep/sweep_file.hpp"
#include "validation/sweep/sweep_plan.hpp"
#include "validation/sweep/sweep_rows_picture.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {
namespace {

using Clock = std::chrono::steady_clock;

struct SweepInput {
  SweepRequest request;
  std::string output;  ///< empty: stdout
  std::optional<int> threads;
  bool restart = false;
  std::optional<Format> format;
  bool ascii = false, bare = false;
  PlotChoice plot;
};

/// What is computed, by whom, and what ends it.
struct SweepWork {
  const SweepPlan& plan;
  const SweepBody& body;
  int threads;
  const CooperativeInterrupt& interrupt;
};

/// How far the sweep is, five times a second.
class SweepProgress {
 public:
  SweepProgress(long long first, long long scenes) : first_(first), scenes_(scenes), done_(first) {}

  void add(long long scenes) { done_ += scenes; }

  void tick() {
    const Clock::time_point now = Clock::now();
    if (now - shown_ < std::chrono::milliseconds(200)) return;
    shown_ = now;
    std::string text = progress_bar(static_cast<std::size_t>(done_), static_cast<std::size_t>(scenes_));
    if (done_ > first_) {
      const double per_scene =
          std::chrono::duration<double>(now - begin_).count() / static_cast<double>(done_ - first_);
      text += ", " + time_left(per_scene * static_cast<double>(scenes_ - done_));
    }
    progress_.show(text);
  }

 private:
  long long first_, scenes_, done_;
  Clock::time_point begin_ = Clock::now(), shown_ = begin_;
  Progress progress_;
};

bool is_hdf5(const SweepInput& input) { return input.output.ends_with(".h5") || input.output.ends_with(".hdf5"); }

/// The rows are CSV unless another form is named, a summary a table.
TextStyle style_of(const SweepInput& input) {
  const Format without = input.request.summary ? Format::table : Format::csv;
  return {.format = input.format.value_or(without), .ascii = input.ascii, .bare = input.bare};
}

/// Whether the rows go to a file that can be taken up again.
bool writes_file(const SweepInput& input) {
  return !input.output.empty() && !input.request.summary && style_of(input).format == Format::csv &&
         !destination_of({"--output", input.output}).is_stream;
}

/// Where the rows go: a file that can be taken up again, or stdout or a device; forms other than CSV are written when
/// all rows are there, and a summary keeps none.
class SweepOutput {
 public:
  SweepOutput(const SweepInput& input, const SweepPlan& plan)
      : plan_(plan), style_(style_of(input)), hdf5_(is_hdf5(input)), plot_(input.plot),
        random_(input.request.random.has_value()), shortfalls_(plan.layout, plan.packed) {
    report_ = plan.report();
    const std::string head = csv_head(report_, style_.bare);
    if (input.request.summary) summary_.emplace(plan.layout, plan.points);
    if (writes_file(input)) {
      file_.emplace(input.output, SweepFileForm{head, plan.points.count()}, input.restart);
      file_->with_rows([this](std::string_view rows) {
        shortfalls_.add(rows);
        if (plot_.is_wanted()) collected_ += rows;
      });
    } else {
      stream_.emplace(input.output);
      if (is_csv()) stream_->write(head);
    }
  }

  [[nodiscard]] long long first() const { return file_ ? file_->scenes() : 0; }
  [[nodiscard]] const Shortfalls& shortfalls() const { return shortfalls_.found(); }
  void write(const RangeRows& rows) {
    shortfalls_.add(rows.text);
    if (plot_.is_wanted() && (file_ || is_csv())) collected_ += rows.text;
    if (file_) file_->write(rows.text, rows.scenes);
    else if (summary_) summary_->add(rows.text);
    else if (is_csv()) stream_->write(rows.text);
    else collected_ += rows.text;
  }

  void commit() {
    write_rows();
    if (plot_.is_wanted()) write_picture();
  }

  /// @param words how far it came; a part says that by itself
  void leave(const std::string& words) {
    plot_.leave_out("interrupted");
    if (file_) return file_->flush();
    if (is_csv()) stream_->write(fmt::format("# {}\n", words));
    else report_.notes.push_back(words);
    write_rows();
  }

 private:
  void write_rows() {
    if (file_ && hdf5_) return file_->commit([this](const std::string& path) { write_hdf5(path); });
    if (file_) return file_->commit();
    if (!is_csv()) write_report();
    stream_->commit();
  }

  [[nodiscard]] bool is_csv() const { return style_.format == Format::csv && !summary_; }

  void write_report() {
    if (summary_) {
      report_.grid.columns = Summary::columns();
      summary_->fill(
          report_, [this](long long index) { return plan_.command_of(index); },
          [this](long long place) { return plan_.attitude_name(place); });
    } else {
      report_.grid.rows = read_csv_rows(collected_);
    }
    report_.fields["rows"] = row_objects(report_.grid);
    stream_->write(report_text(report_, style_));
  }

  void write_hdf5(const std::string& path) {
    ColumnFileHead head{report_.grid.columns, {{"title", report_.title}}};
    for (const char* name : {"scene", "body"}) {
      const Value* const value = report_.fields.find(name);
      if (value != nullptr) head.attributes.emplace_back(name, compact_json(*value));
    }
    head.attributes.emplace_back("sweep", fmt::format("{}", fmt::join(plan_.words, "\n")));
    const std::unique_ptr<ColumnFile> columns = open_hdf5(path, head);
    std::vector<PackedCell> row(head.columns.size());
    file_->with_rows([&](std::string_view rows) {
      for (PackedRows packed(rows); packed.next(row);) columns->add(row);
    });
    columns->close();
  }

  /// The picture shows the columns asked for, or else those that tell most of a drop.
  void write_picture() {
    Report rows = plan_.report();
    rows.grid.rows = read_csv_rows(collected_);
    SweepRowsView view{.swept = plan_.layout.swept.size(), .random = random_, .quantities = {}};
    for (const ImpactColumn& asked : plan_.layout.asked) {
      if (!holds_texts(rows.grid, asked.column.name) && view.quantities.size() < most_panels)
        view.quantities.push_back(asked.column.name);
    }
    std::vector<std::string> others = plan_.layout.named;
    for (const Probe& probe : plan_.layout.probes) {
      const std::string name = ranking_column(plan_.layout, probe);
      if (std::ranges::find(others, name) == others.end()) others.push_back(name);
    }
    for (const std::string& name : others) {
      if (!holds_texts(rows.grid, name) && view.quantities.size() < most_panels) view.quantities.push_back(name);
    }
    if (view.quantities.empty()) view.quantities = {"impacts", "total_normal_impulse", "energy_loss"};
    plot_.write(sweep_rows_picture(rows, view), {rows.title});
  }

  static constexpr std::size_t most_panels = 4;
  const SweepPlan& plan_;
  Report report_;
  TextStyle style_;
  bool hdf5_;
  PlotFile plot_;
  bool random_;
  std::string collected_;
  std::optional<Sink> stream_;
  std::optional<SweepFile> file_;
  std::optional<Summary> summary_;
  ShortfallCount shortfalls_;
};

void check_output(const SweepInput& input) {
  if (is_hdf5(input)) {
    if (input.request.summary) throw BadInput(fmt::format("--output {}: a summary has no rows for HDF5", input.output));
    if (input.format) throw BadInput(fmt::format("--format: must be left out, --output {} is HDF5", input.output));
    require_hdf5();
  }
  for (const RunFile& file : plot_files(input.plot)) note_written(file);
  if (!input.plot.path.empty() && (input.request.summary || is_hdf5(input) || input.request.rows == RowKind::impact)) {
    throw BadInput("--plot: draws rows of scenes, which --summary, HDF5 and --rows impact have not");
  }
  if (writes_file(input)) {
    note_written({"--output", input.output});
    for (const RunFile& file : SweepFile::files_beside(input.output)) note_written(file);
  } else if (input.restart) {
    throw BadInput("--restart: needs a file as --output, there is nothing to go on with");
  }
}

/// Computes what the output lacks, as far as it comes.
void fill(SweepOutput& output, RangeQueue& queue, const SweepWork& what, Ranks& ranks) {
  SweepProgress progress(queue.taken(), what.plan.points.count());
  SweepHooks hooks;
  hooks.write = [&](const RangeRows& rows) {
    output.write(rows);
    progress.add(rows.scenes);
  };
  hooks.tick = [&] {
    output.write({});
    progress.tick();
  };
  hooks.stop = [&] { return what.interrupt.requested(); };
  compute_ranges(queue, what.threads, runners_of(what.plan, what.body), hooks, ranks);
}

/// The part of the process that writes.
int run_sweep(const SweepInput& input, const SweepPlan& plan, const SweepBody& body, int threads, Ranks& ranks) {
  const CooperativeInterrupt interrupt;
  SweepOutput output(input, plan);
  const long long scenes = plan.points.count();
  RangeQueue queue({output.first(), scenes - output.first()}, range_size(plan));
  fill(output, queue, {plan, body, threads, interrupt}, ranks);
  if (queue.is_complete()) {
    output.commit();
    return output.shortfalls().status(scenes, "scenes");
  }
  const std::string words = fmt::format("interrupted after {} of {} scenes", queue.taken(), scenes);
  output.leave(words);
  if (writes_file(input)) say(words + "; the same command goes on");
  return interrupted_status;
}

int run_command(const SweepInput& input, Ranks& ranks) {
  SweepPlan plan = read_sweep_plan(input.request);
  plan.packed = input.request.summary || is_hdf5(input);
  const int threads = thread_count(input.threads, ranks);
  check_output(input);
  // A body that cannot be made is bad input, but a row's where it is swept.
  const SweepBody body = plan.body_values.empty() ? make_sweep_body(plan, plan.scene) : SweepBody{};
  return ranks.writes() ? run_sweep(input, plan, body, threads, ranks) : serve_ranges(runners_of(plan, body), ranks);
}

constexpr const char* sweep_footer =
    "Example: clatter sweep phone-damped --set drop.angle_deg=5:85:5 "
    "--set ground.damping=0:2e7:1e6 --set run.impacts=2 --output phone.csv\n"
    "Example: clatter sweep phone-corner --set drop.attitude=uniform --random 1000 "
    "--columns hardest,hardest_corners,impulse_normal_1,impulse_normal_2\n"
    "Example: clatter sweep phone-damped --set drop.attitude=26 --random 2600 --scatter 3 --set run.impacts=2 "
    "--summary\n"
    "drop.attitude=26 has a box fall on each face, edge and corner (clatter keys numbers them); @FILE is a CSV file\n"
    "with columns q0, q1, q2, q3. Columns asked for are quantities that rows of impacts have; the hardest impact "
    "has\n"
    "the largest normal impulse.\n"
    "An interrupted sweep goes on when the same command is given again. The discrete model takes the impact.* keys.\n"
    "Continuous scenes are planned for run.digits. Each number has a column with its error, empty where that is not "
    "known.\n"
    "A scene that is refused or fails is a row with its outcome, refused, outside-model or not-computed, and "
    "reason.\n"
    "Exit status 3 if a number could not be computed, a limit left fewer impacts than asked for, or required digits\n"
    "are not known, in any scene; its row says why.";

/// Which scenes, and what their rows hold.
void add_request_options(Command& command, SweepRequest& request) {
  add_scene_argument(command, request.file, true);
  command.add({.name = "--set",
               .target = &request.sets,
               .type = "KEY=VALUE|A,B,...|FROM:TO:STEP|FROM:TO:log:COUNT",
               .help =
                   "values of a key of the scene file; may be repeated, the last varies fastest; drop.attitude takes "
                   "uniform (with --random), 26 or [Q0,Q1,Q2,Q3],[...] or @FILE",
               .repeats = true});
  command.add(sweep_arguments(request));
  command.add({.name = "--probe",
               .target = &request.probes,
               .type = "NAME:X,Y,Z",
               .help =
                   "columns for the largest change of velocity of this point of the body [m], and its impact; in the "
                   "continuous model also for its peak acceleration, the width of that and its impact, for two more "
                   "runs of each scene (with --no-errors one); may be repeated (else [[probe]] in the scene file)",
               .repeats = true});
}

}  // namespace

Command sweep_command() {
  auto input = std::make_shared<SweepInput>();
  Command command;
  SweepRequest& request = input->request;
  add_request_options(command, request);
  command.add_text("--output", input->output, "FILE",
                   "write there; until it is complete the rows are in FILE.part; FILE.h5 is HDF5, columns with units");
  command.add_flag("--summary", request.summary,
                   "no rows: counts, percentiles, and extremes with the command that shows each");
  command.add(format_argument(input->format,
                              "form of the output (csv); others are written at the end, and not taken up again"));
  command.add_flag("--ascii", input->ascii, "plain ASCII in tables");
  command.add_flag("--bare", input->bare, "CSV without comments");
  command.add_flag("--no-errors", request.no_errors, "neither errors nor whether rows can be predicted; half the cost");
  command.add_flag("--require-digits", request.require_digits, "a scene of which fewer digits are known falls short");
  add_plot_options(command, input->plot);
  add_process_options(command, input->restart, input->threads);
  command.footer = sweep_footer;
  command.run = [input] { return run_in_processes([&](Ranks& ranks) { return run_command(*input, ranks); }); };
  return command;
}

}  // namespace clatter::validation
