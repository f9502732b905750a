// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/probes.hpp"
#include "validation/sweep/map_picture.hpp"
#include "validation/sweep/sweep_file.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {
namespace {

struct MapInput {
  MapRequest request;
  std::string output;
  std::optional<int> threads;
  bool restart = false;
};

enum class MapFile { png, npy, csv };

MapFile file_kind(const std::string& path) {
  const std::vector<std::string> endings{".png", ".npy", ".csv"};
  for (std::size_t i = 0; i < endings.size(); ++i) {
    if (path.ends_with(endings[i])) return static_cast<MapFile>(i);
  }
  throw BadInput(fmt::format("--output {}: must end in .png, .npy or .csv", path));
}

/// Tells whether all pixels of a map have one value: then its keys, its class or run.impacts hide what it should show;
/// and whether some have none.
class PixelValues {
 public:
  void add(const std::string& value) {
    if (count_++ == 0) value_ = value;
    is_one_ = is_one_ && value == value_;
    if (value == end_words(analytic::BatchEnd::not_computed)) ++not_computed_;
  }
  /// Empty where they differ.
  /// @param all  the value of pixels all of whose samples are of the class
  [[nodiscard]] std::string words(const MapPlan& plan, const std::string& all) const {
    if (!is_one_ || count_ < 2) return "";
    const std::string wanted = fmt::format("{}={}", plan.quantity->name, plan.wanted);
    if (plan.counts() && value_ == "0") return "no drop of any pixel has " + wanted;
    if (plan.counts() && value_ == all) return "each drop of every pixel has " + wanted;
    return plan.counts() ? "" : fmt::format("all pixels have the same {}: {}", plan.quantity->name, value_);
  }

  [[nodiscard]] long long count() const { return count_; }
  /// The exit status: 3 if a pixel that is one drop could not be computed, which is said, else 0.
  [[nodiscard]] int status() const {
    if (not_computed_ == 0) return 0;
    say(fmt::format("{} of {} pixels could not be computed", not_computed_, count_));
    return exit_status(FailureKind::not_computed);
  }

 private:
  std::string value_;
  long long count_ = 0, not_computed_ = 0;
  bool is_one_ = true;
};

/// The file of a map, whose rows are kept in FILE.part until all are there.
class MapOutput {
 public:
  MapOutput(const MapInput& input, const MapPlan& plan)
      : plan_(plan), path_(input.output), kind_(file_kind(path_)),
        file_(path_, {csv_head(plan.report(), false), plan.rows}, input.restart) {
    file_.with_rows([this](std::string_view rows) { keep_all(rows); });
  }

  [[nodiscard]] bool is_csv() const { return kind_ == MapFile::csv; }
  [[nodiscard]] long long first() const { return file_.scenes(); }

  void write(const RangeRows& rows) {
    file_.write(rows.text, rows.scenes);
    keep_all(rows.text);
  }

  [[nodiscard]] int status() const { return values_.status(); }

  /// Whether FILE is there already, of this very map and whole, and none is being made anew.
  /// @throws BadInput if another file is there; a picture or an array does not say of which map it is
  [[nodiscard]] bool is_done() {
    std::error_code error;
    if (const auto size = std::filesystem::file_size(file_.path(), error); error || size == 0) return false;
    if (!is_csv()) {
      throw BadInput("--output {}: is there already, and does not say of which map; --restart overwrites it", path_);
    }
    std::ifstream file(file_.path(), std::ios::binary);
    if (!is_own_file(path_, file, csv_head(plan_.report(), false)) || first() > 0) return false;
    PixelValues found;
    for (std::string row; std::getline(file, row) && !file.eof();) found.add(read_map_row(row).at(2).value);
    if (found.count() != plan_.columns * plan_.rows) {
      say(fmt::format("{} is not whole after {} pixels, and is computed anew", path_, found.count()));
      return false;
    }
    values_ = found;
    return true;
  }

  /// The part goes last: a picture that fails to be drawn or written needs it again.
  void commit() {
    if (const std::string words = values_.words(plan_, is_csv() ? "1" : std::to_string(plan_.samples)); !words.empty())
      say(words);
    if (is_csv()) return file_.commit();
    const std::string made = kind_ == MapFile::png ? map_picture(plan_, image_) : map_array(plan_, image_);
    const long long open = image_.open();
    const long long pixels = plan_.columns * plan_.rows, without = image_.without_drop();
    if (open > 0) say(fmt::format("{} of {} pixels are left open by rounding or a fold", open, pixels));
    if (without > 0)
      say(fmt::format("{} of {} pixels have no drop: refused, outside the model or not computed", without, pixels));
    Sink sink(path_);
    sink.write(made);
    sink.commit();
    file_.discard();
  }

  void leave() { file_.flush(); }

 private:
  void keep_all(std::string_view rows) {
    for (; !rows.empty(); rows.remove_prefix(rows.find('\n') + 1)) {
      const std::vector<MapPixel> row = read_map_row(std::string(rows.substr(0, rows.find('\n') + 1)));
      if (is_csv()) {
        values_.add(row[2].value);  // after the two keys
        continue;
      }
      for (const MapPixel& pixel : row) values_.add(pixel.value);
      image_.rows.push_back(row);
    }
  }

  const MapPlan& plan_;
  std::string path_;
  MapFile kind_;
  PixelValues values_;
  MapImage image_;
  SweepFile file_;
};

void check_map_output(const MapInput& input) {
  if (input.output.empty()) throw BadInput("--output: must be given, FILE.png, FILE.npy or FILE.csv");
  if (file_kind(input.output) == MapFile::png) require_gnuplot("--output " + input.output, "pngcairo");
  if (destination_of({"--output", input.output}).is_stream)
    throw BadInput(fmt::format("--output {}: must be a file, which a map is written to as it grows", input.output));
  note_written({"--output", input.output});
  for (const RunFile& file : SweepFile::files_beside(input.output)) note_written(file);
}

/// The part of the process that writes.
int write_map(const MapInput& input, const MapPlan& plan, int threads, const MakeCompute& make, Ranks& ranks) {
  const CooperativeInterrupt interrupt;
  MapOutput output(input, plan);
  if (!input.restart && output.is_done()) {
    say(fmt::format("{} is complete, nothing is left to do; --restart computes it anew", input.output));
    return output.status();
  }
  RangeQueue queue({output.first(), plan.rows - output.first()}, map_range(plan));
  if (output.first() > 0) say(fmt::format("goes on after {} of {} rows", output.first(), plan.rows));
  RunProgress progress(output.first(), plan.rows, "rows");
  SweepHooks hooks;
  hooks.write = [&](const RangeRows& rows) { output.write(rows); };
  hooks.tick = [&] {
    output.write({});
    progress.tick(queue.taken());
  };
  hooks.stop = [&] { return interrupt.requested(); };
  compute_ranges(queue, threads, make, hooks, ranks);
  if (queue.is_complete()) {
    output.commit();
    return output.status();
  }
  output.leave();
  say(fmt::format("interrupted after {} of {} rows; the same command goes on", queue.taken(), plan.rows));
  return interrupted_status;
}

int run_map(const MapInput& input, Ranks& ranks) {
  const MapPlan plan = read_map_plan(input.request);
  const int threads = thread_count(input.threads, ranks);
  check_map_output(input);
  if (ranks.writes()) say_doubts(plan.sweep.scene, Model::discrete);
  const SweepBody body = plan.sweep.body_values.empty() ? make_sweep_body(plan.sweep, plan.sweep.scene) : SweepBody{};
  const bool is_csv = file_kind(input.output) == MapFile::csv;
  const MakeCompute make = map_runners(plan, body, is_csv ? MapForm::csv : MapForm::compact);
  return ranks.writes() ? write_map(input, plan, threads, make, ranks) : serve_ranges(make, ranks);
}

constexpr const char* map_footer =
    "Example: clatter map --over drop.angle_deg=0:60 --over impact.restitution=0:1 --quantity impacts --output "
    "map.png\n"
    "Example: clatter map phone-corner --over drop.height=0.5:2 --over impact.restitution=0.2:0.9 "
    "--set drop.attitude=uniform --samples 50 --quantity hardest=1 --size 40x30 --output phone.png\n"
    "Without SCENE a thin rod drops. Each pixel is the drop at its middle, by the discrete model; curves are the folds "
    "of clatter angles --regimes,\n"
    "computed as such. Planar drops without friction, or with an impulse ratio, take the batch: a core does millions\n"
    "in a second without gravity, thousands with it. Drops in space and with friction are run one by one.\n"
    "Up to 100 impacts are followed unless run.impacts is given, of a class of counts as many as tell it. A pixel\n"
    "that rounding or a fold leaves open is marked and counted, in NPY nan; infinitely many impacts are inf there.\n"
    "With --samples N each pixel is the part of N drops that are of the class, random in what --set KEY=LOW:HIGH "
    "leaves open; CSV and\n"
    "NPY have Wilson's interval beside it. An interrupted map goes on when the same command is given again.\n"
    "Any other FILE that is not empty is refused without --restart; so is a whole picture or array, which does not\n"
    "say of which map it is.";

}  // namespace

Command map_command() {
  return command_of<MapInput>(
      [](const MapInput& input) { return run_in_processes([&](Ranks& ranks) { return run_map(input, ranks); }); },
      [](Command& command, MapInput& input) {
        MapRequest& request = input.request;
        add_scene_argument(command, request.file, false);
        command.add({.name = "--over",
                     .target = &request.over,
                     .type = "KEY=LOW:HIGH[:log]",
                     .help = "range of a key of the scene file; given twice, across and upward",
                     .repeats = true});
        command.add({.name = "--set",
                     .target = &request.sets,
                     .type = "KEY=VALUE|LOW:HIGH",
                     .help = "value of another key; with --samples a range, too, or drop.attitude=uniform",
                     .repeats = true});
        command.add(map_arguments(request));
        command.add_text("--output", input.output, "FILE", ".png (needs gnuplot), .npy or .csv");
        add_process_options(command, input.restart, input.threads);
        command.footer = map_footer;
        command.columns = {{"map", map_columns}};
      });
}

}  // namespace clatter::validation
