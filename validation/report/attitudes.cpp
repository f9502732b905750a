// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/attitudes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <thread>

#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/orientation.hpp"
#include "validation/shock/shock_run.hpp"
#include "validation/sweep/points.hpp"
#include "validation/sweep/summary.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {
namespace {

/// Which way is down in the axes of a body of this attitude.
Vector3 down_of(const Eigen::Quaterniond& attitude) { return -(attitude.conjugate() * Vector3::UnitZ()); }

/// The sweep of a box's attitudes by the same scene, to digits enough for a statistic; flags of the drop's own attitude
/// stay out.
SweepRequest request_of(const ReportInput& input, const Attitudes& attitudes, const std::vector<FragilePart>& parts) {
  SweepRequest request{.file = input.scene.source,
                       .text = {},
                       .sets = {"drop.attitude=26", "run.digits=3"},
                       .probes = input.probes,
                       .random = attitudes.drops,
                       .seed = {},
                       .scatter = attitudes.scatter,
                       .model = model_of(input),
                       .rows = {},
                       .columns = {},
                       .no_errors = true,
                       .summary = true,
                       .parts = parts,
                       .rank_by = input.rank_by};
  for (const SceneOverride& given : overrides_of(input.scene)) {
    if (!turns_body(given.key) && given.key != "run.errors" && given.key != "run.digits")
      request.sets.push_back(given.key + "=" + given.text);
  }
  return request;
}

std::string command_of(const SweepRequest& request, const std::string& rank_by) {
  std::string words = "clatter sweep" + (request.file.empty() ? "" : " " + shell_word(request.file)) + " --model " +
                      name_of(*request.model);
  for (const std::string& set : request.sets) words += " --set " + shell_word(set);
  for (const std::string& probe : request.probes) words += " --probe " + shell_word(probe);
  for (const FragilePart& part : request.parts) words += " --part " + shell_word(part_text(part));
  if (!rank_by.empty()) words += " --rank-by " + shell_word(rank_by);
  return words + fmt::format(" --random {} --scatter {} --no-errors --summary", *request.random, *request.scatter);
}

/// How far off an attitude of a box, by number from 0, a direction is [°].
double degrees_off(const Scene& scene, int number, const Vector3& down) {
  const std::vector<double> q = orientation_attitude(number + 1, scene.body.size);
  const Vector3 level = down_of(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  return std::atan2(down.cross(level).norm(), down.dot(level)) * 180 / std::numbers::pi;
}

/// "face", "edge" or "corner": those of 1 to 3 axes.
std::size_t axes_of_attitude(int number) {
  const std::array<int, 3> signs = orientation_signs(number + 1);
  return static_cast<std::size_t>(std::ranges::count_if(signs, [](int sign) { return sign != 0; }));
}
constexpr const char* part_names[] = {"", "face", "edge", "corner"};

/// The worst blow of a drop of the sweep, with the errors that the sweep leaves out; without a probe that of the
/// largest force.
std::optional<Blow> blow_of(const SweepPlan& plan, const SweepBody& body, long long point, const Ranking& ranking) {
  Scene scene = plan.scene;
  std::vector<double> values;
  plan.points.at(point, values);
  plan.put_point(values, scene);
  scene.request.error_estimates = true;
  const std::vector<Probe>& probes = plan.layout.probes;
  if (!ranking.has_peaks) {
    const ShockRun run = run_shock(scene, probes, {.continuous = false, .sensitivity = false, .count = 2});
    return worst_blow(run.discrete, *run.discrete_run, scene, ranking);
  }
  if (!probes.empty()) {
    const ContinuousShock shock =
        continuous_shock(scene, *body.solid, places_from(body_properties(scene, Model::continuous).centre, probes),
                         {.parts = plan.layout.parts()});
    return worst_blow(shock.rows, run_of(shock.planned.run), scene, ranking);
  }
  const Run run = run_of(run_to_digits(scene, *body.solid).run);
  if (run.impacts.empty()) return std::nullopt;
  const auto hardest =
      std::ranges::max_element(run.impacts, {}, [](const Impact& one) { return one.value.peak_force; });
  return Blow{.impact = hardest->n, .value = hardest->value.peak_force, .depth = hardest->value.indentation};
}

/// The worst blows of the worst drop of each attitude.
void find_blows(const SweepPlan& plan, const SweepBody& body, int threads, const Ranking& ranking, AllAttitudes& all) {
  std::vector<std::optional<std::size_t>> worst(orientation_count);
  for (std::size_t i = 0; i < all.drops.size(); ++i) {
    std::optional<std::size_t>& so_far = worst[static_cast<std::size_t>(all.drops[i].attitude)];
    if (!so_far || all.is_worse(all.drops[i].value, all.drops[*so_far].value)) so_far = i;
  }
  for (const auto& one : worst) {
    if (one) all.worst_of.push_back(*one);
  }
  all.blows.resize(all.worst_of.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < all.blows.size(); i = next++) {
      // A drop that has a number in the sweep has no failure here.
      static_cast<void>(
          failure_of_scene([&] { all.blows[i] = blow_of(plan, body, all.drops[all.worst_of[i]].point, ranking); }));
    }
  };
  std::vector<std::jthread> crew;
  for (int i = 1; i < threads; ++i) crew.emplace_back(work);
  work();
}

}  // namespace

bool turns_body(const std::string& key) { return key == "drop.attitude" || are_alternatives(key, "drop.attitude"); }

std::string scene_words(const ReportInput& input, const std::vector<double>& attitude) {
  std::vector<SceneOverride> flags = overrides_of(input.scene);
  if (!attitude.empty()) std::erase_if(flags, [](const SceneOverride& flag) { return turns_body(flag.key); });
  return (input.scene.source.empty() ? "" : " " + shell_word(input.scene.source)) + flag_words(flags) +
         (attitude.empty() ? "" : fmt::format(" --attitude={}", fmt::join(attitude, ",")));
}

std::string probe_words(const ReportInput& input) {
  std::string words;
  for (const std::string& probe : input.probes) words += " --probe " + shell_word(probe);
  for (const FragilePart& part : input.parts) words += " --part " + shell_word(part_text(part));
  return words;
}

std::string name_of_drop(const Scene& scene, int number, const Vector3& down) {
  return fmt::format("{} {} down, {}° off", part_names[axes_of_attitude(number)], orientation_name(number + 1),
                     significant(degrees_off(scene, number, down), 2));
}

Ranking ranking_of(std::string_view column, const std::vector<Probe>& probes, const ReportInput& input) {
  Ranking ranking{.has_peaks = model_of(input) == Model::continuous};
  ranking.probe = probe_of(column, probes).value_or(0);
  if (!probes.empty() && input.part() && input.part()->is_at(probes[ranking.probe].name)) ranking.part = input.part();
  ranking.landing_alone = column.starts_with(of_landing);
  if (ranking.landing_alone) column.remove_prefix(of_landing.size());
  const bool is_velocity = column.starts_with(shock_column) || !ranking.has_peaks;
  ranking.by = column.starts_with(peak_column)    ? Ranking::By::peak
               : column.starts_with(shock_column) ? Ranking::By::velocity
               : ranking.part ? (ranking.part->has_limit() ? Ranking::By::margin : Ranking::By::response)
               : is_velocity  ? Ranking::By::velocity
                              : Ranking::By::peak;
  return ranking;
}

std::optional<AttitudeSweep> sweep_attitudes(const ReportInput& input, const Attitudes& attitudes,
                                             const std::vector<FragilePart>& parts, RunProgress& progress,
                                             long long before, const CooperativeInterrupt& interrupt) {
  AttitudeSweep sweep;
  sweep.request = request_of(input, attitudes, parts);
  sweep.plan = read_sweep_plan(sweep.request);
  sweep.plan.packed = true;
  if (sweep.plan.body_values.empty()) sweep.body = make_sweep_body(sweep.plan, sweep.plan.scene);
  RangeQueue queue({0, sweep.plan.points.count()}, range_size(sweep.plan));
  SweepHooks hooks;
  hooks.write = [&](const RangeRows& rows) {
    sweep.rows += rows.text;
    progress.tick(before + queue.taken());
  };
  hooks.tick = [] {};
  hooks.stop = [&] { return interrupt.requested(); };
  Ranks processes;
  sweep.threads = thread_count(input.threads, processes);
  run_on_threads(queue, sweep.threads, runners_of(sweep.plan, sweep.body), hooks);
  if (interrupt.requested()) return std::nullopt;
  return sweep;
}

double AllAttitudes::worst_of_other_half() const {
  const auto half_of = [](const SweptDrop& drop) { return drop.point / orientation_count % 2; };
  double found = std::nan("");
  for (const SweptDrop& one : drops) {
    if (half_of(one) == half_of(drops[worst])) continue;
    if (!std::isfinite(found) || is_worse(one.value, found)) found = one.value;
  }
  return found;
}

std::string AllAttitudes::drops_words() const {
  return fmt::format("{} drops on faces, edges and corners{}", drops.size(),
                     is_sample ? fmt::format(", each ±{}°", shortest(scatter)) : "");
}

double AllAttitudes::spread() const {
  const double apart = is_sample ? std::fabs(std::log(drops[worst].value / worst_of_other_half())) : 0;
  return std::isfinite(apart) ? apart : 0;
}

std::optional<AllAttitudes> all_attitudes(const ReportInput& input, const Scene& given, const AttitudeSweep& sweep,
                                          const std::string& rank_by) {
  const SweepPlan& plan = sweep.plan;
  RowLayout layout = plan.layout;
  layout.rank_by = rank_by;
  Summary summary(layout, plan.points);
  const std::optional<std::size_t> ranking = summary.ranking();
  if (!ranking) return std::nullopt;
  AllAttitudes all;
  const std::vector<Column> columns = sweep_columns(layout);
  all.column = columns[*ranking];
  const auto place_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(columns, name, &Column::name) - columns.begin());
  };
  const std::string& by = all.column.name;
  const Ranking ranks = ranking_of(by, layout.probes, input);
  const std::string beyond = by.starts_with(of_landing) ? by.substr(of_landing.size()) : "";
  all.is_of_blow =
      layout.probes.empty() ||
      std::ranges::any_of(std::array{peak_column, shock_column, margin_column},
                          [&](std::string_view name) { return (beyond.empty() ? by : beyond).starts_with(name); });
  const std::size_t curve = place_of("curve_depth"), beyond_value = place_of(beyond), impact = place_of(by + "_impact"),
                    beyond_impact = place_of(beyond + "_impact"),
                    peak = layout.probes.empty() ? columns.size()
                                                 : place_of(std::string(peak_column) + layout.probes[ranks.probe].name);
  std::vector<PackedCell> row(columns.size());
  std::vector<double> values;
  const auto number = [&](std::size_t place) { return place < row.size() ? row[place].number : std::nan(""); };
  const auto whole = [&](std::size_t place) {
    return std::isfinite(number(place)) ? static_cast<int>(number(place)) : 0;
  };
  if (ranks.by == Ranking::By::response) {
    all.column.name.replace(all.column.name.find(margin_column), margin_column.size(), response_column);
    all.column.unit = "g";
  }
  const auto ranked_number = [&](std::size_t place) {
    return ranks.by == Ranking::By::response ? response_in_g(*ranks.part, number(place)) : number(place);
  };
  summary.add(sweep.rows);
  for (PackedRows packed(sweep.rows); packed.next(row);) {
    if (!std::isfinite(row[*ranking].number)) continue;
    SweptDrop drop{.point = static_cast<long long>(row.front().number), .value = ranked_number(*ranking)};
    plan.points.at(drop.point, values);
    std::copy_n(values.begin(), 4, drop.parameters.begin());
    drop.down = down_of(Eigen::Quaterniond(values[0], values[1], values[2], values[3]));
    drop.attitude = static_cast<int>(plan.points.attitude_of(drop.point));
    drop.curve_depth = number(curve);
    drop.peak_g = number(peak);
    drop.beyond_value = ranked_number(beyond_value);
    drop.impact = whole(impact);
    drop.beyond_impact = whole(beyond_impact);
    all.drops.push_back(drop);
  }
  if (all.drops.empty()) return std::nullopt;
  find_blows(plan, sweep.body, sweep.threads, ranks, all);
  all.worst = *std::ranges::min_element(all.worst_of, [&](std::size_t one, std::size_t other) {
    return all.is_worse(all.drops[one].value, all.drops[other].value);
  });
  const SweptDrop& worst = all.drops[all.worst];
  all.scene = given;
  plan.points.at(worst.point, values);
  all.scene.orientation.reset();
  all.scene.tilt_deg = 0;
  all.scene.attitude.assign(values.begin(), values.end());
  all.scene.settle();
  all.scene.settle_restitution();
  all.name = name_of_drop(all.scene, worst.attitude, worst.down);
  all.report = plan.report();
  summary.fill(
      all.report, [&](long long index, const std::string& column) { return plan.command_of(index, column); },
      [&](long long place) { return plan.attitude_name(place); });
  all.report.commands.clear();
  all.scatter = sweep.request.scatter.value_or(0);
  all.is_sample = all.scatter > 0;
  all.command = command_of(sweep.request, rank_by);
  return all;
}

std::string ranked_words(const Column& ranking) {
  std::string_view name = ranking.name;
  const bool is_landing = name.starts_with(of_landing);
  if (is_landing) name.remove_prefix(of_landing.size());
  std::string words(name);
  for (const auto& [column, its_words] : {std::pair{margin_column, "margin of"},
                                          {response_column, "response of"},
                                          {peak_column, "peak at"},
                                          {shock_column, "|ΔV| of"}}) {
    if (name.starts_with(column)) words = fmt::format("{} {}", its_words, name.substr(column.size()));
  }
  return words + (is_landing ? ", first landing" : "") + (ranking.unit.empty() ? "" : " [" + ranking.unit + "]");
}

std::vector<Column> attitude_columns() {
  return {word_column("attitude", "down", "part of the box that points down"),
          {"off_deg", "off", "°", "how far its worst drop is off that"},
          {"impact", "impact", "", "whose blow is the worst of that drop"},
          {"peak_g", "peak", "g", "largest specific force at the probe in that blow"},
          {"delta_v", "|ΔV|", "m/s", "change of the probe's velocity in it"},
          pulse_column(),
          word_column("verdict", "", "whether the part survives it or fails"),
          {"margin", "margin", "", "of the part in it: at 1 and below it fails"},
          {"response_g", "answer", "g", "of a part without a limit: its largest acceleration in it"},
          word_column("decided_by", "by", "what decides the margin: |ΔV|, peak, or the humps of its history"),
          {"depth_mm", "depth", "mm", "of the body's deepest point in it"},
          {"depth_percent", "of pad", "%", "the same in parts of the pad's thickness"},
          {"worst", "worst", "", "what the drops are ranked by, of that drop"},
          {"mildest", "mildest", "", "the same of the mildest of its drops"},
          {"largest_peak_g", "any peak", "g", "largest specific force at the probe in any blow of any of them"},
          {"drops", "drops", "", "of this attitude"},
          {"attitude_q0", "q0", "", "Euler parameters of its worst drop at the touch-down, for --attitude", false},
          {"attitude_q1", "q1", "", "the same", false},
          {"attitude_q2", "q2", "", "the same", false},
          {"attitude_q3", "q3", "", "the same", false}};
}

Grid attitudes_grid(const AllAttitudes& all) {
  const bool has_peaks = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->peak_g > 0; });
  const bool has_margin = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->margin; });
  const bool has_response = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->response_g; });
  const bool has_velocity = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->velocity > 0; });
  const bool has_depth = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->depth; });
  const auto& pad = all.scene.pad.thickness;
  const bool has_share = has_depth && pad;
  Grid grid{attitude_columns(), {}, 1};
  for (Column& column : grid.columns) {
    if (column.name == "worst" || column.name == "mildest") {
      column.unit = all.column.unit;
      column.meaning =
          ranked_words(all.column) + (column.name == "worst" ? " of that drop" : " of the mildest of them");
    }
    column.shown = column.name == "peak_g"                                  ? has_peaks
                   : column.name == pulse_column().name                     ? has_peaks && has_velocity
                   : column.name == "delta_v"                               ? has_velocity
                   : column.name == "margin" || column.name == "decided_by" ? has_margin
                   : column.name == "response_g"                            ? has_response
                   : column.name == "depth_mm"                              ? has_depth
                   : column.name == "depth_percent"                         ? has_share
                   : column.name == "worst"                                 ? !all.is_of_blow
                   : column.name == "verdict"                               ? false  // which margins say
                   : column.name == "largest_peak_g"                        ? has_peaks && !all.is_ranked_by_peak()
                                                                            : column.shown;
  }
  std::vector<std::size_t> order(all.worst_of.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return all.is_worse(all.drops[all.worst_of[a]].value, all.drops[all.worst_of[b]].value);
  });
  for (const std::size_t i : order) {
    const std::optional<Blow>& blow = all.blows[i];
    const SweptDrop& worst = all.drops[all.worst_of[i]];
    double mildest = worst.value, largest_peak = std::nan("");
    const auto drops = all.count([&](const SweptDrop& one) { return one.attitude == worst.attitude; });
    for (const SweptDrop& one : all.drops) {
      if (one.attitude != worst.attitude) continue;
      if (all.is_worse(mildest, one.value)) mildest = one.value;
      largest_peak = std::fmax(largest_peak, one.peak_g);
    }
    const auto cell = [&](bool there, double value, double error = 0) {
      return there ? said_cell(value, error) : Cell();
    };
    const Blow none, &of = blow ? *blow : none;
    const bool has_pulse = of.peak_g > 0 && of.velocity > 0;
    const double pulse_ms = has_pulse ? 1e3 * equivalent_pulse(of.velocity, of.peak_g * standard_gravity).duration : 0;
    grid.rows.push_back(
        {Cell(fmt::format("{} {}", part_names[axes_of_attitude(worst.attitude)], orientation_name(worst.attitude + 1))),
         Cell(degrees_off(all.scene, worst.attitude, worst.down), 2),
         blow ? Cell(blow->impact) : Cell(),
         cell(blow && has_peaks, of.peak_g, of.peak_g_error),
         cell(blow && has_velocity, of.velocity, of.velocity_error),
         has_pulse ? said_cell(pulse_ms, pulse_ms * (of.peak_g_error / of.peak_g + of.velocity_error / of.velocity))
                   : Cell(),
         of.margin ? Cell(of.margin->verdict()) : Cell(),
         of.margin ? said_cell(of.margin->value, of.margin_error) : Cell(),
         of.response_g ? said_cell(*of.response_g, of.margin_error) : Cell(),
         of.margin ? deciding_cell(of.margin->by) : Cell(),
         of.depth ? said_cell(1e3 * *of.depth) : Cell(),
         of.depth && has_share ? said_cell(100 * *of.depth / *pad) : Cell(),
         said_cell(worst.value),
         said_cell(mildest),
         cell(std::isfinite(largest_peak), largest_peak),
         Cell(static_cast<int>(drops)),
         Cell(worst.parameters[0]),
         Cell(worst.parameters[1]),
         Cell(worst.parameters[2]),
         Cell(worst.parameters[3])});
  }
  return grid;
}

}  // namespace clatter::validation
