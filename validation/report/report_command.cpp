// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "validation/command/command.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/html.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/output/version.hpp"
#include "validation/report/report_pictures.hpp"
#include "validation/report/verdict.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/orientation.hpp"
#include "validation/sequence/sequence_picture.hpp"
#include "validation/sequence/sequence_report.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/shock_options.hpp"
#include "validation/shock/shock_run.hpp"
#include "validation/simulate/simulation_picture.hpp"
#include "validation/simulate/simulation_report.hpp"
#include "validation/sweep/points.hpp"
#include "validation/sweep/rows.hpp"
#include "validation/sweep/summary.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::validation {
namespace {

using numeric::Vector3;

/// Which way is down in the axes of a body of this attitude.
Vector3 down_of(const Eigen::Quaterniond& attitude) { return -(attitude.conjugate() * Vector3::UnitZ()); }

struct HandoutPart {
  std::string title;
  std::string html;
  bool is_floor = false;  ///< whether a floor's parts begin here
};

// Pieces of parts.

constexpr const char* page_style =
    ":root{color-scheme:light dark;--ink:#1a1a1a;--soft:#444;--paper:#fff;--line:#ccc;--box:#f4f4f4;--body:#2a6f97}"
    "@media (prefers-color-scheme:dark){:root{--ink:#e8e8e8;--soft:#b8b8b8;--paper:#161616;--line:#444;--box:#242424;"
    "--body:#8ecae6}figure.plot svg{background:#fff;border-radius:4px}}"
    "body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:60rem;margin:0 auto;"
    "padding:1rem}"
    "h1{font-size:1.2rem;font-weight:normal;color:var(--soft);margin:0}h1.given{font-size:1.6rem;color:var(--ink)}"
    "h2.floor{font-size:1.5rem;margin-top:2.5rem;border-bottom:3px solid "
    "var(--body)}h2{font-size:1.2rem;margin-top:1.5rem;"
    "border-bottom:1px solid var(--line)}.answer{font-size:1.35rem;line-height:1.3;margin:.4rem 0;max-width:none}"
    ".notes ul{margin:.4rem 0;padding-left:1.2rem}.notes li{font-size:.9rem;line-height:1.35;max-width:none}"
    ".lines{font-size:.9rem;line-height:1.35;max-width:none;color:var(--soft);margin-top:.3rem}.wide{overflow-x:auto}"
    ".beside{display:flex;flex-wrap:wrap;gap:0 1rem}"
    ".beside figure{flex:1 1 20rem;margin:.5rem 0;align-self:flex-start}"
    "table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}"
    "th,td{padding:.15rem .6rem;border-bottom:1px solid var(--line);vertical-align:bottom;white-space:nowrap}"
    "p,li{max-width:46rem}.wide p{font-size:.85rem;color:var(--soft)}"
    "figure{margin:1rem 0}figure svg{max-width:100%;height:auto;display:block}figcaption{font-size:.85rem;"
    "color:var(--soft)}svg text{font:12px system-ui,sans-serif}.beside svg text{fill:var(--ink)}"
    ".floor{fill:var(--box);stroke:var(--line)}.body{fill:var(--body);stroke:var(--ink);stroke-linejoin:round}"
    ".probe{fill:#d62828;stroke:var(--paper)}.rim{fill:none;stroke:var(--line)}.ring{fill:none;stroke:#d62828;"
    "stroke-width:2}.middle{text-anchor:middle}.end{text-anchor:end}"
    "pre{background:var(--box);padding:.6rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.8rem}"
    "@media print{:root{color-scheme:light;--ink:#1a1a1a;--soft:#444;--paper:#fff;--line:#ccc;--box:#f4f4f4;"
    "--body:#2a6f97}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}body{font-size:9.5pt;max-width:none;"
    "padding:0}h2{break-after:avoid;margin-top:.8rem}figure,tr,pre{break-inside:avoid}.wide{overflow:visible}"
    "table{font-size:7.5pt}th,td{padding:.05rem .25rem;white-space:normal}figure.plot svg{max-height:9.6cm}"
    "h2.floor{break-before:page;margin-top:0}p,ul,pre,figure{margin:.25rem "
    "0}ul{padding-left:1.2rem}p,li{max-width:none;line-height:1.3}"
    ".lines,.wide p,figcaption,pre{font-size:7.5pt;line-height:1.25}.beside figure{flex-basis:16rem}"
    ".answer{font-size:13pt}}@page{margin:14mm}";

/// Without the declarations that only a file of its own may have.
std::string svg_element(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) throw std::runtime_error("gnuplot drew nothing: " + svg.substr(0, 200));
  return svg.substr(begin);
}

/// The samples of contacts that `wanted` takes, over the time from `origin` on [s], a column for each probe in g.
PicturePanel history_panel(const ShockRun& run, double origin, const auto& wanted) {
  const BodyProperties body = body_properties(run.scene, Model::continuous);
  PicturePanel panel{.columns = {{"time", "s", "time"}}};
  panel.plot.x_factor = 1e3;
  panel.plot.x_label = "time after touch-down [ms]";
  panel.plot.y_label = "specific force [g]";
  for (const Probe& probe : run.probes) {
    const std::string name = fmt::format("a{}", panel.columns.size());
    panel.columns.push_back({name, "g", probe.name});
    panel.plot.curves.push_back({.x = "time", .y = name, .legend = probe.name});
  }
  for (const MotionPiece& piece : run.continuous->motion.pieces()) {
    if (!wanted(piece.piece)) continue;
    for (std::size_t j = 0; j < piece.samples.size(); ++j) {
      std::vector<double> row{piece.begin() - origin + numeric::piece_point(static_cast<int>(j)) * piece.piece.length};
      for (const Probe& probe : run.probes)
        row.push_back(specific_force(piece.samples[j], probe.place - body.centre, body.mass).norm() / standard_gravity);
      panel.rows.push_back(std::move(row));
    }
  }
  return panel;
}

/// A page with all that it shows in itself: it asks for nothing from anywhere, and prints.
/// @param given  whether somebody gave the title, which stands out then
std::string handout_page(const std::string& title, bool given, const std::vector<std::string>& lines,
                         const std::vector<HandoutPart>& parts) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{0}</title><link rel=\"icon\" "
      "href=\"data:,\"><style>{1}</style></head><body>\n<h1{2}>{0}</h1>\n<p class=\"lines\">",
      html_escaped(title), page_style, given ? " class=\"given\"" : "");
  for (const std::string& line : lines) html += html_escaped(line) + "<br>\n";
  html += "</p>\n";
  for (const HandoutPart& part : parts)
    html += "<section>\n" +
            (part.title.empty()
                 ? ""
                 : fmt::format("<h2{}>{}</h2>\n", part.is_floor ? " class=\"floor\"" : "", html_escaped(part.title))) +
            part.html + "</section>\n";
  return html + "</body></html>\n";
}

/// The table of a report with its notes, without its head.
std::string handout_table(Report report) {
  report.title.clear();
  report.head.clear();
  // Who has no pointer scrolls a wide one by keys.
  return "<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"Table\">\n" + html_table(report) + "</div>\n";
}

std::string handout_list(const std::vector<std::string>& items) {
  std::string html = "<ul>\n";
  for (const std::string& item : items) html += "<li>" + html_escaped(item) + "</li>\n";
  return html + "</ul>\n";
}

/// Commands, each on a line of its own.
std::string handout_commands(const std::vector<std::string>& commands) {
  std::string html = "<pre>";
  for (const std::string& command : commands) html += html_escaped(command) + "\n";
  return html + "</pre>\n";
}

/// Drawn by gnuplot, as SVG in the page.  @throws as run_gnuplot
std::string handout_picture(const Picture& picture, const std::string& caption) {
  return fmt::format("<figure class=\"plot\">\n{}<figcaption>{}</figcaption>\n</figure>\n",
                     svg_element(run_gnuplot(picture_script(picture, PictureFormat::svg, ""))), html_escaped(caption));
}

/// Size of the specific force at the probes over time: the first two impacts together where they follow each other at
/// once, then each of the first three, and the one that is asked for, in a panel of its own from its touch-down on;
/// none without a contact.
std::optional<Picture> probe_history_picture(const ShockRun& run, int asked_impact) {
  constexpr int most_impacts = 3;
  constexpr double most_apart = 4;  // contact times, beyond which two blows are lines in an empty panel
  if (!run.continuous || run.continuous->rows.empty()) return std::nullopt;
  Picture picture{.what = "What an accelerometer reads at the probes", .scene = {}};
  const std::vector<ShockRow>& rows = run.continuous->rows;
  const auto row_of = [&](int impact) { return std::ranges::find(rows, impact, &ShockRow::impact); };
  const int last = rows.back().impact;
  if (last > 1 && row_of(2)->start < most_apart * row_of(1)->duration) {
    picture.panels.push_back(
        history_panel(run, 0, [](const numeric::HistoryPiece& piece) { return piece.impact <= 2; }));
    picture.panels.back().plot.x_label = "impacts 1 and 2: time after touch-down [ms]";
  }
  for (int impact = 1; impact <= last; ++impact) {
    if (impact > most_impacts && impact != asked_impact) continue;
    const auto row = row_of(impact);
    if (row == rows.end()) continue;
    picture.panels.push_back(history_panel(run, row->start, [&](const numeric::HistoryPiece& piece) {
      return piece.impact == impact && piece.in_contact;
    }));
    picture.panels.back().plot.x_label =
        fmt::format("impact {}: time after its touch-down at {:.4g} ms [ms]", impact, 1e3 * row->start);
  }
  return picture;
}

struct ReportInput : ShockInput {
  std::string output;
  enum class Form { html, table, csv, json, markdown } form = Form::html;
  std::optional<int> drops, threads;
  std::optional<double> scatter;    ///< [°]
  std::string rank_by;              ///< column of the sweep
  std::vector<std::string> scenes;  ///< SCENE, of which there may be several
  std::string title, date;

  /// The part of one case, which has no more than one.
  [[nodiscard]] std::optional<FragilePart> part() const {
    return parts.empty() ? std::nullopt : std::optional(parts.front());
  }
};

/// The drops of the sweep over attitudes.
struct Attitudes {
  int drops = 260;
  double scatter = 3;  ///< [°]
};

/// Whether the key turns the body, in place of or beside its Euler parameters.
bool turns_body(const std::string& key) { return key == "drop.attitude" || are_alternatives(key, "drop.attitude"); }

/// What was typed, with which every command begins: the scene and its flags.
/// @param attitude  Euler parameters in place of the scene's own; empty: those
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

/// The sweep of a box's attitudes by the same scene, to digits enough for a statistic; flags of the drop's own attitude
/// stay out.
/// @param rank_by  column; empty: as the sweep has it
SweepRequest sweep_of(const ReportInput& input, const Attitudes& attitudes, const std::string& rank_by) {
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
                       .part = input.part(),
                       .rank_by = rank_by};
  if (request.file.empty()) request.text = "";
  for (const SceneOverride& given : overrides_of(input.scene)) {
    if (!turns_body(given.key) && given.key != "run.errors" && given.key != "run.digits")
      request.sets.push_back(given.key + "=" + given.text);
  }
  return request;
}

std::string sweep_command_of(const SweepRequest& request) {
  std::string words = "clatter sweep " + shell_word(request.file) + " --model " + name_of(*request.model);
  for (const std::string& set : request.sets) words += " --set " + shell_word(set);
  for (const std::string& probe : request.probes) words += " --probe " + shell_word(probe);
  if (request.part) words += " --part " + shell_word(part_text(*request.part));
  if (!request.rank_by.empty()) words += " --rank-by " + shell_word(request.rank_by);
  return words + fmt::format(" --random {} --scatter {} --no-errors --summary", *request.random, *request.scatter);
}

/// One of the drops in all attitudes.
struct SweptDrop {
  long long point = 0;
  int attitude = 0;  ///< of a box, by number, from 0
  Vector3 down = Vector3::Zero();
  double value = 0;         ///< that it is ranked by
  double beyond_value = 0;  ///< the same with the impacts that the ranking leaves out, or NaN
  int beyond_impact = 0;
  double curve_depth = 0;  ///< depth over that of the pad's last point, or NaN
  double peak_g = 0;       ///< the largest specific force at the first probe in any of its blows, or NaN
};

/// What the drops in all attitudes give.
struct AllAttitudes {
  std::vector<SweptDrop> drops;
  std::size_t worst = 0;
  Column column;                           ///< by which they are ranked
  std::vector<std::size_t> worst_of;       ///< of each attitude that has a drop: its worst one
  std::vector<std::optional<Blow>> blows;  ///< of those: the worst of each
  Scene scene;                             ///< of the worst
  std::string name;                        ///< of its attitude: "corner -x-y+z down, 3.2° off"
  Report report;                           ///< percentiles, and in its fields the largest of each attitude
  std::string command;                     ///< empty: no file that a command could name

  [[nodiscard]] bool is_least_worst() const { return is_worst_least(column.name); }
  [[nodiscard]] bool is_ranked_by_peak() const { return column.name.starts_with(peak_column); }
  [[nodiscard]] bool is_worse(double one, double other) const { return is_least_worst() ? one < other : one > other; }
  [[nodiscard]] std::ptrdiff_t count(auto&& wanted) const { return std::ranges::count_if(drops, wanted); }
};

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

/// "corner -x-y+z down, 3.2° off", of a box's attitude by number, from 0.
std::string name_of_drop(const Scene& scene, int number, const Vector3& down) {
  return fmt::format("{} {} down, {}° off", part_names[axes_of_attitude(number)], orientation_name(number + 1),
                     significant(degrees_off(scene, number, down), 2));
}

/// What the ranking of a sweep's column says of blows: of the probe that the column names, else of the first.
Ranking ranking_of(std::string_view column, const std::vector<Probe>& probes, const ReportInput& input) {
  Ranking ranking{.part = input.part(), .has_peaks = model_of(input) == Model::continuous};
  ranking.landing_alone = column.starts_with(of_landing);
  if (ranking.landing_alone) column.remove_prefix(of_landing.size());
  const bool is_velocity = column.starts_with(shock_column) || !ranking.has_peaks;
  ranking.by = column.starts_with(peak_column)    ? Ranking::By::peak
               : column.starts_with(shock_column) ? Ranking::By::velocity
               : ranking.part                     ? Ranking::By::margin
               : is_velocity                      ? Ranking::By::velocity
                                                  : Ranking::By::peak;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (column.ends_with("_" + probes[i].name)) ranking.probe = i;
  }
  return ranking;
}

/// The worst blow of a drop of the sweep, as the sweep itself computes it; without a probe that of the largest force.
std::optional<Blow> blow_of(const SweepPlan& plan, const SweepBody& body, long long point, const Ranking& ranking) {
  Scene scene = plan.scene;
  std::vector<double> values;
  plan.points.at(point, values);
  plan.put_point(values, scene);
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

/// @param given  the drop whose attitude they change
/// @param rank_by  column; empty: as the sweep has it
/// @throws BadInput as read_sweep_plan; nothing if it was interrupted, or no drop has a number to rank it by.
std::optional<AllAttitudes> all_attitudes(const ReportInput& input, const Scene& given, const Attitudes& attitudes,
                                          const std::string& rank_by, const CooperativeInterrupt& interrupt) {
  const SweepRequest request = sweep_of(input, attitudes, rank_by);
  SweepPlan plan = read_sweep_plan(request);
  plan.packed = true;
  const SweepBody body = plan.body_values.empty() ? make_sweep_body(plan, plan.scene) : SweepBody{};
  Summary summary(plan.layout, plan.points);
  const std::optional<std::size_t> ranking = summary.ranking();
  if (!ranking) return {};
  AllAttitudes all;
  const std::vector<Column> columns = sweep_columns(plan.layout);
  all.column = columns[*ranking];
  const auto place_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(columns, name, &Column::name) - columns.begin());
  };
  const std::string& by = all.column.name;
  const std::string beyond = by.starts_with(of_landing) ? by.substr(of_landing.size()) : "";
  const std::size_t curve = place_of("curve_depth"), beyond_value = place_of(beyond),
                    beyond_impact = place_of(beyond + "_impact"),
                    peak = plan.layout.probes.empty()
                               ? columns.size()
                               : place_of(std::string(peak_column) + plan.layout.probes.front().name);
  RangeQueue queue({0, plan.points.count()}, range_size(plan));
  SweepHooks hooks;
  Progress progress;
  std::vector<PackedCell> row(columns.size());
  std::vector<double> values;
  const auto number = [&](std::size_t place) { return place < row.size() ? row[place].number : std::nan(""); };
  hooks.write = [&](const RangeRows& rows) {
    summary.add(rows.text);
    for (PackedRows packed(rows.text); packed.next(row);) {
      if (!std::isfinite(row[*ranking].number)) continue;
      SweptDrop drop{.point = static_cast<long long>(row.front().number), .value = row[*ranking].number};
      plan.points.at(drop.point, values);
      drop.down = down_of(Eigen::Quaterniond(values[0], values[1], values[2], values[3]));
      drop.attitude = static_cast<int>(plan.points.attitude_of(drop.point));
      drop.curve_depth = number(curve);
      drop.peak_g = number(peak);
      drop.beyond_value = number(beyond_value);
      drop.beyond_impact = std::isfinite(number(beyond_impact)) ? static_cast<int>(number(beyond_impact)) : 0;
      all.drops.push_back(drop);
    }
    const auto done = static_cast<std::size_t>(queue.taken()), of = static_cast<std::size_t>(plan.points.count());
    progress.show(fmt::format("attitudes: {}{}", progress_bar(done, of), progress.time_left(done, of)));
  };
  hooks.tick = [] {};
  hooks.stop = [&] { return interrupt.requested(); };
  Ranks ranks;
  const int threads = thread_count(input.threads, ranks);
  run_on_threads(queue, threads, runners_of(plan, body), hooks);
  if (interrupt.requested() || all.drops.empty()) return {};
  find_blows(plan, body, threads, ranking_of(by, plan.layout.probes, input), all);
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
      all.report, [&](long long index) { return plan.command_of(index); },
      [&](long long place) { return plan.attitude_name(place); });
  all.report.commands.clear();
  if (!request.file.empty()) all.command = sweep_command_of(request);
  return all;
}

/// "margin of camera, first landing [g]": what drops are ranked by, for a reader.
std::string ranked_words(const Column& ranking) {
  std::string_view name = ranking.name;
  const bool is_landing = name.starts_with(of_landing);
  if (is_landing) name.remove_prefix(of_landing.size());
  std::string words(name);
  for (const auto& [column, its_words] :
       {std::pair{margin_column, "margin of"}, {peak_column, "peak at"}, {shock_column, "|ΔV| of"}}) {
    if (name.starts_with(column)) words = fmt::format("{} {}", its_words, name.substr(column.size()));
  }
  return words + (is_landing ? ", first landing" : "") + (ranking.unit.empty() ? "" : " [" + ranking.unit + "]");
}

/// The columns of the table of faces, edges and corners, whatever a report has of them.
std::vector<Column> attitude_columns() {
  return {word_column("attitude", "down", "part of the box that points down"),
          {"off_deg", "off", "°", "how far its worst drop is off that"},
          {"impact", "impact", "", "whose blow is the worst of that drop"},
          {"peak_g", "peak", "g", "largest specific force at the probe in that blow"},
          {"delta_v", "|ΔV|", "m/s", "change of the probe's velocity in it"},
          {"margin", "margin", "", "of the part in it: at 1 and below it fails"},
          {"depth_mm", "depth", "mm", "of the body's deepest point in it"},
          {"depth_percent", "of pad", "%", "the same in parts of the pad's thickness"},
          {"worst", "worst", "", "what the drops are ranked by, of that drop"},
          {"mildest", "mildest", "", "the same of the mildest of its drops"},
          {"largest_peak_g", "any peak", "g", "largest specific force at the first probe in any blow of any of them"},
          {"drops", "drops", "", "of this attitude"}};
}

/// The columns of a table of several cases.
std::vector<Column> case_columns() {
  return {word_column("floor", "scene", "file whose drop it is"),
          {"restitution", "e", "", "that was given"},
          word_column("part", "part", "what bears it, as --part takes it"),
          {"margin", "margin", "", "the least of all drops: at 1 and below the part fails"},
          word_column("attitude", "down", "how the body is turned in that drop"),
          word_column("probe", "probe", "name of the point"),
          {"impact", "impact", "", "whose blow has it"},
          {"peak_g", "peak", "g", "largest specific force at the probe in that blow"},
          {"delta_v", "|ΔV|", "m/s", "change of the probe's velocity in it"},
          word_column("decided_by", "by", "what decides the margin: change of velocity, peak, or the blow's history"),
          {"failing", "failing", "", "drops that the part does not survive"},
          {"drops", "drops", "", "of the case"}};
}

/// Each face, edge and corner by the worst blow of its worst drop, the worst kind first and in it the worst attitude.
Grid attitudes_grid(const AllAttitudes& all) {
  const bool has_peaks = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->peak_g > 0; });
  const bool has_margin = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->margin; });
  const bool has_velocity = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->velocity > 0; });
  const bool has_depth = std::ranges::any_of(all.blows, [](const auto& blow) { return blow && blow->depth; });
  // Whether the blow's own numbers have what is ranked by.
  const bool is_of_blow = std::ranges::all_of(all.worst_of, [&, i = std::size_t{0}](std::size_t drop) mutable {
    const std::optional<Blow>& blow = all.blows[i++];
    return !blow || blow->value == all.drops[drop].value;
  });
  const auto& pad = all.scene.pad.thickness;
  const bool has_share = has_depth && all.scene.world.ground.is_pad() && pad;
  Grid grid{attitude_columns(), {}, 1};
  for (Column& column : grid.columns) {
    if (column.name == "worst" || column.name == "mildest") {
      column.unit = all.column.unit;
      column.meaning =
          ranked_words(all.column) + (column.name == "worst" ? " of that drop" : " of the mildest of them");
    }
    column.shown = column.name == "peak_g"           ? has_peaks
                   : column.name == "delta_v"        ? has_velocity
                   : column.name == "margin"         ? has_margin
                   : column.name == "depth_mm"       ? has_depth
                   : column.name == "depth_percent"  ? has_share
                   : column.name == "worst"          ? !is_of_blow
                   : column.name == "largest_peak_g" ? has_peaks && !all.is_ranked_by_peak()
                                                     : true;
  }
  std::vector<std::size_t> order(all.worst_of.size());
  std::iota(order.begin(), order.end(), 0U);
  std::array<double, 4> worst_of_kind;
  worst_of_kind.fill(std::nan(""));
  const auto drop = [&](std::size_t i) -> const SweptDrop& { return all.drops[all.worst_of[i]]; };
  for (const std::size_t i : order) {
    double& so_far = worst_of_kind[axes_of_attitude(drop(i).attitude)];
    if (!std::isfinite(so_far) || all.is_worse(drop(i).value, so_far)) so_far = drop(i).value;
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const std::size_t one = axes_of_attitude(drop(a).attitude), other = axes_of_attitude(drop(b).attitude);
    if (one != other && worst_of_kind[one] != worst_of_kind[other])
      return all.is_worse(worst_of_kind[one], worst_of_kind[other]);
    return one != other ? one < other : all.is_worse(drop(a).value, drop(b).value);
  });
  for (const std::size_t i : order) {
    const std::optional<Blow>& blow = all.blows[i];
    const SweptDrop& worst = drop(i);
    double mildest = worst.value, largest_peak = std::nan("");
    const auto drops = all.count([&](const SweptDrop& one) { return one.attitude == worst.attitude; });
    for (const SweptDrop& one : all.drops) {
      if (one.attitude != worst.attitude) continue;
      if (all.is_worse(mildest, one.value)) mildest = one.value;
      largest_peak = std::fmax(largest_peak, one.peak_g);
    }
    const auto cell = [&](bool there, double value) { return there ? Cell(value, 3) : Cell(); };
    const bool is_deep = blow && blow->depth;
    grid.rows.push_back(
        {Cell(fmt::format("{} {}", part_names[axes_of_attitude(worst.attitude)], orientation_name(worst.attitude + 1))),
         Cell(degrees_off(all.scene, worst.attitude, worst.down), 2), blow ? Cell(blow->impact) : Cell(),
         cell(blow && has_peaks, blow ? three_digits(blow->peak_g) : 0),
         cell(blow && has_velocity, blow ? blow->velocity : 0),
         cell(blow && blow->margin, blow && blow->margin ? blow->margin->value : 0),
         cell(is_deep, is_deep ? 1e3 * *blow->depth : 0),
         cell(is_deep && has_share, is_deep && has_share ? 100 * *blow->depth / *pad : 0), Cell(worst.value, 3),
         Cell(mildest, 3), cell(std::isfinite(largest_peak), three_digits(largest_peak)),
         Cell(static_cast<int>(drops))});
  }
  return grid;
}

/// What the headings of a table mean, as far as their columns say it.
std::string legend_html(const Grid& grid) {
  std::string html;
  for (const Column& column : grid.columns) {
    if (!column.shown || column.meaning.empty()) continue;
    html +=
        fmt::format("{}<b>{}</b> {}", html.empty() ? "" : "; ",
                    html_escaped(column.heading.empty() ? column.name : column.heading), html_escaped(column.meaning));
  }
  return "<p class=\"lines\">" + html + ".</p>\n";
}

std::string attitudes_html(const AllAttitudes& all, const Attitudes& attitudes) {
  Report shown;
  shown.grid = attitudes_grid(all);
  return fmt::format(
             "<p>{} drops: each face, edge and corner of the box in its turn, turned about each axis by a "
             "normally distributed angle with a standard deviation of {}°; numbers to three digits. Worst and mildest "
             "of "
             "few drops are a sample's, so that attitudes alike by symmetry differ: --drops takes more.</p>\n",
             attitudes.drops, attitudes.scatter) +
         handout_table(shown) + legend_html(shown.grid);
}

/// A picture of the discrete model's sequence.  @throws as run_discrete
std::string sequence_picture_html(const Scene& scene) {
  const PreparedScene drop = prepared(scene);
  return handout_picture(sequence_picture(drop, run_discrete(drop), TimeWindow{}),
                         "Discrete model: heights over time, and the impulse of each impact.");
}

/// Pulses or changes of velocity at the probes, then pictures of them and of their spectra.
std::string shock_html(const ShockRun& run, ShockView view, int impact) {
  if (run.continuous) view.rows = ShockRows::pulses;
  const Report report = shock_report(run, view);
  std::string html = handout_table(report) + legend_html(report.table());
  if (const auto picture = probe_history_picture(run, impact)) {
    html +=
        handout_picture(*picture,
                        "What an accelerometer reads at the probes, from each touch-down on. Two humps in one impact "
                        "are two touches of which one begins before the other has ended.");
  }
  Picture picture = shock_picture(run, view);
  picture.scene.clear();  // which the page has
  if (picture.panels.empty()) return html;
  return html +
         handout_picture(picture, view.parts.empty()
                                      ? "Response spectra with and without the second blow."
                                      : "Response spectra with and without the second blow, and all blows beside the "
                                        "damage boundary of the part.");
}

std::vector<std::string> assumptions(const Scene& scene, Model model, const KeyNames& unsettled) {
  std::vector<std::string> items = scene_head(scene, model, {}, unsettled);
  items.emplace_back("the body is rigid, the ground level; air is left out");
  if (model == Model::continuous && scene.world.ground.modulus > 0) {
    items.emplace_back(
        "the ground is an elastic half-space under one patch, whose pressure has the energy of the patch's volume and "
        "shape: faces, edges and corners are told apart, waves in ground and body are not; peaks depend on its "
        "modulus");
  } else if (model == Model::continuous && scene.world.ground.is_pad()) {
    items.emplace_back(
        "the ground is a pad whose pressure follows its curve, each place on its own: it carries no shear and recovers "
        "at "
        "once");
  } else if (model == Model::continuous) {
    items.emplace_back(
        "the ground is a bed of springs and dampers, each on its own: k_G and c_G are numbers of the floor "
        "(clatter shock --ground finds them), and peaks depend on them");
  } else {
    items.emplace_back("an impact takes no time: changes of velocity are known, forces and peaks are not");
  }
  return items;
}

std::vector<std::string> left_out(const Scene& scene) {
  return {
      "whatever bends: housings, screens, boards and batteries that move make other peaks than a rigid body's, larger "
      "ones where they strike or resonate",
      "damage: a damage boundary and a spectrum say what a part goes through, not whether a crack grows",
      "what yields, cracks or remembers the last blow, floor and body alike: under a corner on a hard floor the "
      "pressure "
      "is far above what plastics bear, and the peak less than it says here",
      "soft packages: a carton or cushion is no rigid body on a floor, but a pad under one (--curve)",
      fmt::format(
          "the hand, cable or air that turns the body before it touches: the attitude at the {} is what is given "
          "here",
          scene.is_released() ? "release" : "touch"),
      "repeated drops: each one here is the first"};
}

/// How many of the first impacts a start known to 16 digits determines.
std::string trust_words(const ShockRun& run) {
  const auto words = [](const auto& impacts) {
    const auto lost = std::ranges::find_if(impacts, [](const auto& impact) { return !impact.predictable; });
    const auto known = lost - impacts.begin();
    if (lost == impacts.end()) return fmt::format("all {} impacts listed can be predicted", known);
    return known == 0
               ? std::string("no impact can be predicted: they depend on digits that nobody has")
               : fmt::format("impacts 1 to {} can be predicted; later ones depend on digits that nobody has", known);
  };
  return run.continuous ? words(run.continuous->planned.run.impacts) : words(run.discrete_run->impacts);
}

std::string accuracy_html(const Scene& scene, const ShockRun& run) {
  std::vector<std::string> items{
      fmt::format("{} digits were asked for; digits that are not known are not printed, and ? marks rows that a start "
                  "known to 16 digits does not determine",
                  scene.accuracy.digits)};
  double closure = 0;
  for (const ShockRow& row : run.rows()) {
    if (row.predictable) closure = std::max(closure, row.closure);
  }
  items.push_back(trust_words(run));
  if (run.continuous && !run.probes.empty()) {
    items.push_back(
        fmt::format("the integral of the acceleration over each impact is the change of velocity to within "
                    "a part in {:.0e}",
                    1 / std::max(closure, 1e-16)));
  }
  items.emplace_back("each number has an error of its own in the JSON of the commands below (error_estimate)");
  return handout_list(items);
}

/// That the discrete model's hardest blow and the one beside it overlap on the scene's ground, whose first contact
/// lasts longer than the time between them; empty: they do not, or there is no ground.
std::string overlap_words(const Scene& scene, const ShockRun& run) {
  if (run.continuous || !scene.has_ground() || run.discrete_run->impacts.size() < 2) return "";
  const std::vector<Impact>& impacts = run.discrete_run->impacts;
  const auto hardest = std::ranges::max_element(run.rows(), {}, [](const ShockRow& r) { return r.value.delta_v_size; });
  const int second = hardest == run.rows().end() ? 2 : std::max(hardest->impact, 2);
  const auto start = [&](int impact) { return impacts[static_cast<std::size_t>(impact - 1)].value.start; };
  const double apart = start(second) - start(second - 1);
  const numeric::Body body = scene.make_body();
  const numeric::Simulation first =
      numeric::simulate(body, scene.world, scene.start(body),
                        {.impacts = 1, .error_estimates = false, .amplification = false}, {.digits = 3});
  if (first.impacts.empty() || !(first.impacts.front().value.duration > apart)) return "";
  return fmt::format(
      "impacts {} and {} are {} ms apart, but the first contact with this floor lasts {} ms: there they overlap",
      second - 1, second, said(1e3 * apart), said(1e3 * first.impacts.front().value.duration));
}

/// Refuses options of the worst attitudes where the page has none.
void require_worst_attitudes(const ReportInput& input, const Scene& scene) {
  const bool is_box = scene.body.shape == BodyScene::Shape::box, has_none = input.drops == 0;
  const auto refuse = [&](const char* name, const auto& given, bool is_count) {
    if (!given) return;
    if (!is_box) throw BadInput(fmt::format("{} {}: is for a box, whose worst attitudes are looked for", name, *given));
    if (has_none && !is_count) throw BadInput(fmt::format("{} {}: changes nothing with --drops 0", name, *given));
  };
  refuse("--drops", input.drops, true);
  refuse("--scatter", input.scatter, false);
  refuse("--threads", input.threads, false);
  refuse("--rank-by", input.rank_by.empty() ? std::nullopt : std::optional(input.rank_by), false);
}

/// Whether file or flags say how the body is turned.
bool gives_attitude(const ReportInput& input) {
  const SceneValues values = scene_values(input.scene.source);
  return std::ranges::any_of(all_keys(), [&](const Key& key) {
    return turns_body(key.name) && (values.has(key.name) || (*key.flag != '\0' && is_given(input.scene, key.flag)));
  });
}

bool is_of_box(const ReportInput& input) {
  const SceneValues values = scene_values(input.scene.source);
  if (is_given(input.scene, "--mesh")) return false;
  const bool is_typed = is_given(input.scene, "--body");
  return (is_typed                   ? input.scene.texts.at("--body")
          : values.has("body.shape") ? values.text("body.shape")
                                     : "") == "box";
}

/// Keys of which a page about a drop of many says nothing: its attitude has a name there.
const KeyNames attitude_keys{"drop.attitude", "drop.angle_deg", "drop.orientation", "drop.tilt_deg"};

/// What a drop does at its worst.
struct Answer {
  std::optional<Blow> blow;  ///< none: nothing struck a probe
  std::string words;
  Value fields = Value(Value::Fields{});
};

Answer answer_of(const ShockRun& run, const Ranking& ranking) {
  Answer answer;
  const Run impacts = run.continuous ? run_of(run.continuous->planned.run) : *run.discrete_run;
  if (run.probes.empty()) {
    if (!run.continuous) return {.blow = {}, .words = "no probe was named"};
    const double peak = totals(impacts).largest_peak.value;
    answer.words = fmt::format("the largest force is {} N", said(peak));
    answer.fields["peak_force"] = peak;
    return answer;
  }
  answer.blow = worst_blow(run.rows(), impacts, run.scene, ranking);
  if (!answer.blow) return {.blow = {}, .words = "nothing strikes"};
  const Blow& blow = *answer.blow;
  const std::string& probe = run.probes[ranking.probe].name;
  answer.words = blow_words(blow, probe, ranking);
  answer.fields = Value::Fields{{"probe", probe}, {"impact", blow.impact}, {"delta_v", blow.velocity}};
  if (ranking.has_peaks) {
    answer.fields["peak_g"] = blow.peak_g;
    answer.fields["width"] = blow.width;
    answer.fields["pulse_duration"] = equivalent_pulse(blow.velocity, blow.peak_g * standard_gravity).duration;
    answer.fields["depth"] = *blow.depth;
    if (const std::string deep = depth_words(run.scene, *blow.depth); !deep.empty()) answer.words += "; " + deep;
  }
  if (!blow.margin) return answer;
  answer.fields["verdict"] = blow.margin->value > 1 ? "survives" : "fails";
  answer.fields["margin"] = blow.margin->value;
  answer.fields["decided_by"] = std::array{"delta_v", "peak", "history"}[static_cast<std::size_t>(blow.margin->by)];
  if (ranking.part->kind == FragilePart::Kind::oscillator)
    answer.fields["response_g"] = ranking.part->fragility / standard_gravity / blow.margin->value;
  return answer;
}

/// What a page is about.
struct Findings {
  std::optional<AllAttitudes> all;  ///< none: of the drop as given alone
  Scene scene;                      ///< of the worst drop of all, or as given
  ShockRun run;
  Ranking ranking;
  Answer answer;
  std::string lead;                ///< the answer in a sentence
  std::vector<std::string> notes;  ///< what it depends on
  Report impacts;                  ///< of the model, as its own command prints them
  std::vector<std::string> commands;
  Report report;  ///< for other programs
};

/// "In 257 of 260 drops the pad bottoms out"; empty without a pad.
std::string bottoming_words(const AllAttitudes& all, const Ranking& ranking) {
  if (!all.scene.world.ground.is_pad() || !ranking.has_peaks) return "";
  const auto bottoming = all.count([](const SweptDrop& drop) { return drop.curve_depth > 1; });
  const double deepest = std::ranges::max(all.drops, {}, &SweptDrop::curve_depth).curve_depth;
  const Scene& scene = all.scene;
  return fmt::format("The pad bottoms out in {} of {} drops{}", bottoming, all.drops.size(),
                     bottoming == 0
                         ? ""
                         : fmt::format(", going to {} times its curve's depth, {}", said(deepest),
                                       scene.half_space.floor
                                           ? "onto the floor, of E*/h of what is left of it, which is rather too hard"
                                       : scene.pad.under ? "onto the stiffness of --under"
                                                         : "where its last slope goes on, which is too soft: "
                                                           "--floor NAME or --under PA/M says what is below"));
}

/// The worst of all drops in a sentence: with a part in how many it survives, and the least margin of all.
std::string worst_words(const AllAttitudes& all, const Answer& answer, const Ranking& ranking) {
  const std::size_t drops = all.drops.size();
  if (!answer.blow || !answer.blow->margin || ranking.by != Ranking::By::margin) {
    const std::string words = answer.blow ? answer.words
                                          : fmt::format("its {} is {} {}", all.column.name,
                                                        said(all.drops[all.worst].value), all.column.unit);
    return fmt::format("Worst of {} drops: {}: {}", drops, all.name, words);
  }
  return fmt::format("{} survives in {} of {} drops; least margin {}: {}, where {}",
                     answer.fields.find("probe")->text(),
                     all.count([](const SweptDrop& drop) { return drop.value > 1; }), drops,
                     said(answer.blow->margin->value), all.name, answer.words);
}

/// Three digits with the unit of what is ranked by.
std::string in_unit(const AllAttitudes& all, double value) {
  return said(value) + (all.column.unit.empty() ? "" : " " + all.column.unit);
}

/// What the answer leaves out of all drops, and how far it is known.
std::vector<std::string> notes_of_all(const AllAttitudes& all, const Answer& answer, const Ranking& ranking) {
  std::vector<std::string> notes;
  const SweptDrop& worst = all.drops[all.worst];
  const auto beyond = std::ranges::max_element(all.drops, [&](const SweptDrop& one, const SweptDrop& other) {
    return all.is_worse(other.beyond_value, one.beyond_value);
  });
  if (ranking.landing_alone && all.is_worse(beyond->beyond_value, worst.value)) {
    notes.push_back(fmt::format(
        "Impacts after the first landing follow bounces without loss and are left out; with them the {} is {} ({}, "
        "impact {})",
        all.is_least_worst() ? "least margin" : "largest", in_unit(all, beyond->beyond_value),
        name_of_drop(all.scene, beyond->attitude, beyond->down), beyond->beyond_impact));
  }
  constexpr double close = 0.02;  // of numbers to three digits whose errors were not looked for
  const auto place = std::ranges::find(all.worst_of, all.worst) - all.worst_of.begin();
  const std::optional<Blow>& swept = all.blows[static_cast<std::size_t>(place)];
  const bool is_ranked_by = swept && swept->value == worst.value;  // else by what blows do not have
  if (answer.blow && is_ranked_by && !(std::fabs(answer.blow->value / worst.value - 1) <= close)) {
    notes.push_back(fmt::format("To three digits this drop has {} in place of {}: {}", in_unit(all, worst.value),
                                in_unit(all, answer.blow->value),
                                answer.blow->predictable
                                    ? "small differences of the start decide which blows follow"
                                    : fmt::format("impact {} depends on digits that nobody has", answer.blow->impact)));
  }
  return notes;
}

/// Shows how deep each impact goes, and in a pad of known thickness which part of that it is.
void show_depths(const Scene& scene, const numeric::Simulation& run, Grid& grid) {
  for (Column& column : grid.columns) {
    if (column.name == "indentation") column.shown = true;
  }
  const auto& pad = scene.pad.thickness;
  if (!scene.world.ground.is_pad() || !pad || run.impacts.size() != grid.rows.size()) return;
  grid.columns.push_back({"depth_percent", "of pad", "%", "depth in parts of the pad's thickness"});
  for (std::size_t i = 0; i < grid.rows.size(); ++i)
    grid.rows[i].emplace_back(100 * run.impacts[i].value.indentation / *pad, 3);
}

/// What --format json has, by the names of the commands that give it.
void add_fields(const ReportInput& input, const ShockView& view, Findings& found) {
  const Scene& scene = found.scene;
  Value& fields = found.report.fields;
  if (found.all) {
    fields["attitudes"] = found.all->report.fields.at("attitudes");
    fields["summary"] = row_objects(found.all->report.grid);
  }
  const std::string words = scene_words(input, found.all ? scene.attitude : std::vector<double>{});
  if (found.all && !found.all->command.empty()) found.commands.push_back(found.all->command);
  if (!found.run.probes.empty()) {
    found.commands.push_back("clatter shock" + words + probe_words(input));
    fields["shock"] = shock_report(found.run, view).fields;
  }
  const bool is_continuous = found.run.continuous.has_value();
  if (is_continuous) {
    found.impacts = simulation_report(scene, found.run.continuous->planned);
    show_depths(scene, found.run.continuous->planned.run, found.impacts.grid);
  } else {
    const PreparedScene drop = prepared(scene);
    found.impacts = sequence_report(drop, run_discrete(drop));
  }
  fields[is_continuous ? "simulation" : "sequence"] = found.impacts.fields;
  found.commands.push_back((is_continuous ? "clatter simulate" : "clatter sequence") + words);
  fields["commands"] = found.commands;
  found.report.head = {scene.summary(model_of(input))};
  found.report.grid = found.all ? attitudes_grid(*found.all) : found.impacts.grid;
  found.report.notes = {found.lead};
  found.report.notes.insert(found.report.notes.end(), found.notes.begin(), found.notes.end());
}

/// Whether the drops are those of all attitudes.
bool looks_at_all(const ReportInput& input) { return is_of_box(input) && input.drops != 0; }

/// Nothing where it was interrupted.
/// @param given  the scene
/// @param is_turned  whether the input says how the body is turned
std::optional<Findings> findings_of(const ReportInput& input, const Scene& given, bool is_turned,
                                    const Attitudes& attitudes, const ShockView& view,
                                    const CooperativeInterrupt& interrupt) {
  const std::vector<Probe> probes = probes_of(input);
  const Model model = model_of(input);
  const std::string rank_by =
      !input.rank_by.empty() || probes.empty()
          ? input.rank_by
          : ranking_column({.model = model, .part = input.part()}, probes.front(), is_lossless(given, model));
  Findings found;
  found.ranking = ranking_of(rank_by, probes, input);
  const Ranking& ranking = found.ranking;
  if (looks_at_all(input)) found.all = all_attitudes(input, given, attitudes, rank_by, interrupt);
  if (interrupt.requested()) return {};
  found.scene = found.all ? found.all->scene : given;
  const Scene& scene = found.scene;
  const auto watch = [&](int, long) { return !interrupt.requested(); };
  found.run = run_shock(scene, probes, request_of(input), {.progress = watch});
  if (interrupt.requested()) return {};

  found.report = begun_report("report", fmt::format("{}{}{}",
                                                    !input.title.empty()         ? input.title
                                                    : input.scene.source.empty() ? "a drop"
                                                                                 : input.scene.source,
                                                    input.date.empty() ? "" : ", ", input.date));
  Value& fields = found.report.fields;
  fields["model"] = name_of(model);
  fields["scene"] = scene_value(scene, model);
  found.answer = answer_of(found.run, ranking);
  fields["answer"] = found.answer.fields;
  found.lead = found.answer.words;
  say_doubts(scene, model, probes);
  found.notes = doubts_of(scene, model, probes);
  if (const auto& all = found.all) {
    const SweptDrop& worst = all->drops[all->worst];
    Value& answer = fields["answer"];
    answer["attitude"] = all->name;
    answer["ranked_by"] = all->column.name;
    answer[all->is_least_worst() ? "least" : "largest"] = worst.value;
    answer["drops"] = static_cast<long long>(all->drops.size());
    if (all->is_least_worst())
      answer["failing"] = static_cast<long long>(all->count([](const SweptDrop& drop) { return !(drop.value > 1); }));
    if (scene.world.ground.is_pad() && ranking.has_peaks)
      answer["bottoming"] =
          static_cast<long long>(all->count([](const SweptDrop& drop) { return drop.curve_depth > 1; }));
    found.lead = worst_words(*all, found.answer, ranking);
    if (const std::string bottoming = bottoming_words(*all, ranking); !bottoming.empty())
      found.lead += ". " + bottoming;
    for (const std::string& note : notes_of_all(*all, found.answer, ranking)) found.notes.push_back(note);
    if (is_turned && !probes.empty()) {
      ShockRequest plain = request_of(input);
      plain.sensitivity = false;
      const Answer own = answer_of(run_shock(given, probes, plain, {.progress = watch}), ranking);
      const bool is_worse =
          own.blow && found.answer.blow && ranking.is_worse(own.blow->value, found.answer.blow->value);
      found.lead += fmt::format(". The drop as given{}: {}", is_worse ? " is worse" : "", own.words);
      fields["as_given"] = own.fields;
    }
  } else if (found.answer.blow && found.answer.blow->margin) {
    const double margin = found.answer.blow->margin->value;
    found.lead = fmt::format("{} {}, margin {}: {}", probes[ranking.probe].name, margin > 1 ? "survives" : "fails",
                             said(margin), found.answer.words);
  }
  if (const std::string overlap = overlap_words(scene, found.run); !overlap.empty()) {
    found.lead += "; " + overlap;
    fields["overlap"] = overlap;
  }
  for (const std::string& note : assumed_words(scene, model, found.answer.blow.value_or(Blow{.impact = 1})))
    found.notes.push_back(note);
  fields["answer"]["notes"] = found.notes;
  fields["message"] = found.lead;
  add_fields(input, view, found);
  return found;
}

/// @throws BadInput for what is no date
void require_date(const std::string& text) {
  int year = 0, month = 0, day = 0, length = 0;
  const bool is_read = std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &length) == 3;
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                                         std::chrono::day{static_cast<unsigned>(day)}};
  if (!text.empty() && !(is_read && text.size() == 10 && length == 10 && date.ok()))
    throw BadInput(fmt::format("--date '{}': must be a date, YYYY-MM-DD", text));
}

/// How the body touches in an impact.
Eigen::Quaterniond attitude_in(const ShockRun& run, int impact) {
  const Run impacts = run.continuous ? run_of(run.continuous->planned.run) : *run.discrete_run;
  const auto place = static_cast<std::size_t>(impact - 1);
  if (place >= impacts.impacts.size()) return run.scene.touch_attitude();
  const EntryParameters& q = impacts.impacts[place].value.attitude;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

std::vector<RankedDrop> dots_of(const AllAttitudes& all) {
  std::vector<RankedDrop> dots;
  for (const SweptDrop& drop : all.drops)
    dots.push_back({drop.down, drop.value,
                    fmt::format("{}: {} {}", name_of_drop(all.scene, drop.attitude, drop.down),
                                significant(drop.value, 4), all.column.unit)});
  return dots;
}

/// @param floor  that the parts are of, where a page has several; empty: it has one
std::vector<HandoutPart> parts_of(const ReportInput& input, const Findings& found, const Attitudes& attitudes,
                                  const ShockView& view, const std::string& floor) {
  const Scene& scene = found.scene;
  const Model model = model_of(input);
  const auto& all = found.all;
  const numeric::Body body = scene.make_body();
  const Vector3 centre = body_properties(scene, Model::continuous).centre;
  const int impact = found.answer.blow ? found.answer.blow->impact : 1;
  std::string pictures = fmt::format(
      "<div class=\"beside\"><figure>{}<figcaption>The body as it touches in impact {}{}</figcaption></figure>\n",
      body_picture(body, attitude_in(found.run, impact), found.run.probes, centre), impact,
      found.run.probes.empty() ? "." : "; a hollow dot lies inside or behind.");
  if (all) {
    pictures += fmt::format(
        "<figure>{}<figcaption>All drops by the direction that is down in the body{}; the ring is the "
        "worst.</figcaption></figure>",
        attitude_map(dots_of(*all), all->worst, ranked_words(all->column), all->is_least_worst()),
        scene.is_released() ? " at the release" : "");
  }
  std::string answer = fmt::format("<p class=\"answer\">{}.</p>\n", html_escaped(found.lead));
  if (!found.notes.empty()) answer += "<div class=\"notes\">" + handout_list(found.notes) + "</div>\n";
  const KeyNames unsettled = all ? attitude_keys : KeyNames{};
  if (!floor.empty()) {
    answer += "<p class=\"lines\">";
    for (const std::string& line : scene.summary(model, unsettled)) answer += html_escaped(line) + "<br>\n";
    answer += "</p>\n";
  }
  std::vector<HandoutPart> parts{{floor, answer + pictures + "</div>\n", !floor.empty()}};
  if (all) parts.push_back({"Attitudes", attitudes_html(*all, attitudes)});
  parts.push_back({"Shock at points of the body",
                   found.run.probes.empty() ? "<p>No probe was named: give --probe NAME:X,Y,Z, or [[probe]] in the "
                                              "scene file.</p>\n"
                                            : shock_html(found.run, view, impact)});
  parts.push_back({fmt::format("The impacts, {} model", name_of(model)),
                   handout_table(found.impacts) + legend_html(found.impacts.table()) +
                       (found.run.continuous ? "" : sequence_picture_html(scene))});
  parts.push_back({"Accuracy", accuracy_html(scene, found.run)});
  parts.push_back({"Assumptions", handout_list(assumptions(scene, model, unsettled))});
  parts.push_back({"What the model leaves out", handout_list(left_out(scene))});
  parts.push_back({"Commands that give these numbers again", handout_commands(found.commands)});
  return parts;
}

// A page of several floors, restitutions and parts: a case for each, and the worst of each floor in full.

struct ReportCase {
  ReportInput input;
  std::string restitution;  ///< empty: not ranged over
  ShockView view;
  bool is_turned = false;  ///< whether the input says how the body is turned
  Scene given{};
  Findings found{};

  [[nodiscard]] std::string floor() const {
    const std::string& source = input.scene.source;
    return source.empty() ? "the drop" : source.substr(0, source.size() - (source.ends_with(".toml") ? 5 : 0));
  }
  /// "pad, e = 0.3, 500:300".
  [[nodiscard]] std::string name() const {
    const auto part = input.part();
    return floor() + (restitution.empty() ? "" : ", e = " + restitution) + (part ? ", " + part_text(*part) : "");
  }
  [[nodiscard]] double value() const {
    return found.answer.blow ? found.answer.blow->value : std::numeric_limits<double>::quiet_NaN();
  }
};

/// The flags whose texts may be several values of e, as those of a sweep: 0.3:0.7:0.1, or 0.3,0.5.
constexpr const char* ranged_flags[] = {"--restitution", "--floor-restitution"};

std::vector<ReportCase> cases_of(const ReportInput& given) {
  std::vector<ReportInput> inputs{given};
  const auto multiply = [&](std::size_t count, auto&& set) {
    std::vector<ReportInput> more;
    for (const ReportInput& input : inputs) {
      for (std::size_t i = 0; i < count; ++i) set(i, more.emplace_back(input));
    }
    if (count > 0) inputs = std::move(more);
  };
  multiply(given.scenes.size(), [&](std::size_t i, ReportInput& input) { input.scene.source = given.scenes[i]; });
  const char* ranged = nullptr;
  for (const char* const flag : ranged_flags) {
    const std::string& text = given.scene.texts.at(flag);
    if (text.find_first_of(":,") == std::string::npos) continue;
    if (ranged) throw BadInput(fmt::format("{} {}: {} has several values already", flag, text, ranged));
    ranged = flag;
    const SweepAxis axis = read_grid_axis(flag, text, false);
    if (axis.count > 100) throw BadInput(fmt::format("{} {}: more than 100 values", flag, text));
    multiply(static_cast<std::size_t>(axis.count), [&](std::size_t i, ReportInput& input) {
      input.scene.texts[flag] = shortest(axis.at(static_cast<long long>(i)));
    });
  }
  multiply(given.parts.size(), [&](std::size_t i, ReportInput& input) { input.parts = {given.parts[i]}; });
  std::vector<ReportCase> cases;
  for (ReportInput& input : inputs) {
    const bool is_turned = gives_attitude(input);
    if (!is_turned && looks_at_all(input)) input.scene.texts["--orientation"] = "1";  // some one: the sweep has its own
    const Scene scene = shock_scene(input);
    require_worst_attitudes(input, scene);
    if (!input.parts.empty() && probes_of(input).empty())
      throw BadInput("--part: needs --probe NAME:X,Y,Z, or [[probe]], where the part is");
    cases.push_back({input, ranged ? input.scene.texts.at(ranged) : "", view_of(input), is_turned, scene});
  }
  return cases;
}

/// A row for each case, the worst first: by the least margin, or what else all are ranked by.
Grid cases_grid(const std::vector<const ReportCase*>& cases) {
  const auto differ = [&](auto&& value) {
    return std::ranges::any_of(cases, [&](const ReportCase* one) { return value(*one) != value(*cases.front()); });
  };
  Grid grid{case_columns(), {}, 3};
  for (Column& column : grid.columns) {
    if (column.name == "floor") column.shown = differ([](const ReportCase& one) { return one.floor(); });
    if (column.name == "restitution") column.shown = !cases.front()->restitution.empty();
    if (column.name == "probe") column.shown = cases.front()->found.run.probes.size() > 1;
    if (column.name == "part") column.shown = !cases.front()->input.parts.empty();
  }
  for (const ReportCase* one : cases) {
    const Value& answer = *one->found.report.fields.find("answer");
    const auto of = [&](const char* name) {
      const Value* const value = answer.find(name);
      const double* const number = value ? value->number() : nullptr;
      return !value ? Cell() : number ? Cell(*number, 3) : Cell(*value);
    };
    const auto part = one->input.part();
    double e = 0;
    grid.rows.push_back({Cell(one->floor()), read_number(one->restitution, e) ? Cell(e, one->restitution) : Cell(),
                         part ? Cell(part_text(*part)) : Cell(), of("margin"), of("attitude"), of("probe"),
                         of("impact"), of("peak_g"), of("delta_v"), of("decided_by"), of("failing"), of("drops")});
  }
  return grid;
}

/// The cases by how hard they are, the worst first, where one thing ranks all of them.
std::vector<const ReportCase*> ranked(const std::vector<ReportCase>& cases) {
  std::vector<const ReportCase*> order;
  for (const ReportCase& one : cases) order.push_back(&one);
  const auto is_worse = [](const ReportCase* one, const ReportCase* other) {
    return one->found.ranking.is_worse(one->value(), other->value());
  };
  if (std::ranges::all_of(cases, [&](const ReportCase& one) {
        return one.found.ranking.by == cases.front().found.ranking.by && std::isfinite(one.value());
      }))
    std::ranges::stable_sort(order, is_worse);
  return order;
}

/// The worst case of each floor, in the order of the cases.
std::vector<const ReportCase*> worst_of_floors(const std::vector<const ReportCase*>& order) {
  std::vector<const ReportCase*> worst;
  for (const ReportCase* one : order) {
    if (std::ranges::none_of(worst, [&](const ReportCase* other) { return other->floor() == one->floor(); }))
      worst.push_back(one);
  }
  return worst;
}

/// One report of several cases: the fields of the worst, and all in a table.
Report joined_report(const std::vector<const ReportCase*>& order) {
  const Findings& worst = order.front()->found;
  Report report = worst.report;
  report.grid = cases_grid(order);
  std::string words;
  for (const ReportCase* one : worst_of_floors(order)) {
    words += fmt::format("{}{}: ", words.empty() ? "" : "; ", one->name());
    if (!one->found.answer.blow) words += one->found.answer.words;
    else if (one->input.parts.empty()) words += one->found.lead;
    else words += "least margin " + said(one->value());
  }
  report.notes = {fmt::format("Worst of {} cases: {}", order.size(), words), worst.lead};
  report.fields["message"] = report.notes.front();
  report.fields["cases"] = row_objects(report.grid);
  return report;
}

std::string page_of(const std::vector<ReportCase>& cases, const Attitudes& attitudes) {
  const ReportCase& first = cases.front();
  const ReportInput& input = first.input;
  std::vector<std::string> lines;
  if (!input.title.empty()) {
    lines.push_back(std::string("clatter ") + version);
    if (!input.date.empty()) lines.front().insert(0, input.date + ", ");
  }
  std::vector<HandoutPart> parts;
  if (cases.size() == 1) {
    for (const std::string& line :
         first.found.scene.summary(model_of(input), first.found.all ? attitude_keys : KeyNames{}))
      lines.push_back(line);
    parts = parts_of(input, first.found, attitudes, first.view, "");
  } else {
    const std::vector<const ReportCase*> order = ranked(cases);
    const Report joined = joined_report(order);
    Report table;
    table.grid = joined.grid;
    parts = {{"", fmt::format("<p class=\"answer\">{}.</p>\n", html_escaped(joined.notes.front())) +
                      handout_table(table) + legend_html(table.grid)}};
    std::set<std::string> said;  // what is said of one floor is left out of the next
    for (const ReportCase* one : worst_of_floors(order)) {
      for (HandoutPart& part : parts_of(one->input, one->found, attitudes, one->view, one->name())) {
        if (said.insert(part.title + part.html).second) parts.push_back(std::move(part));
      }
    }
  }
  return handout_page(input.title.empty() ? first.found.report.title : input.title, !input.title.empty(), lines, parts);
}

int run_report(const ReportInput& input) {
  const bool is_page = input.form == ReportInput::Form::html;
  if (is_page) {
    if (input.output.empty()) throw BadInput("--output: required, the page's file");
    if (!input.output.ends_with(".html")) throw BadInput(fmt::format("--output '{}': must end in .html", input.output));
    require_gnuplot("report");
  }
  require_date(input.date);
  constexpr Format formats[]{Format::json, Format::table, Format::csv, Format::json, Format::markdown};
  const OutputChoice choice{.style = {.format = formats[static_cast<std::size_t>(input.form)]}, .path = input.output};
  if (!is_page) check_files(choice);
  std::optional<Sink> sink;
  if (is_page) sink.emplace(input.output);
  const CooperativeInterrupt interrupt;
  Attitudes attitudes;
  attitudes.drops = input.drops.value_or(attitudes.drops);
  attitudes.scatter = input.scatter.value_or(attitudes.scatter);
  std::vector<ReportCase> cases = cases_of(input);
  int status = 0;
  for (ReportCase& one : cases) {
    auto found = findings_of(one.input, one.given, one.is_turned, attitudes, one.view, interrupt);
    if (!found) return interrupted_status;
    one.found = std::move(*found);
    status = std::max(status, status_of(one.found.scene, one.found.run));
  }
  if (!is_page) {
    write_report(choice, cases.size() == 1 ? cases.front().found.report : joined_report(ranked(cases)));
  } else {
    sink->write(page_of(cases, attitudes));
    sink->commit();
  }
  return status;
}

}  // namespace

Command report_command() {
  return command_of<ReportInput>(run_report, [](Command& command, ReportInput& input) {
    add_shock_options(command, input);
    Argument& scenes = *std::ranges::find(command.arguments, "SCENE", &Argument::name);
    scenes.target = &input.scenes;
    scenes.help += "; of several, floors say, a part for each";
    constexpr const char* group = "Worst attitudes";
    command.add(whole_argument("--drops", input.drops, 0, 1'000'000, "N",
                               "of a box, over its faces, edges and corners (260); 0: none", group));
    command.add(number_argument("--scatter", input.scatter, {0, 180, false, "from 0 to 180 degrees"}, "DEG",
                                "standard deviation of their turns about each axis (3)", group));
    command.add_text(
        "--rank-by", input.rank_by, "COLUMN",
        "of clatter sweep's rows, by which they are ranked (the first probe's margin, else peak or change of velocity; "
        "without loss that of the first landing)",
        group);
    command.add(threads_argument(input.threads, "for them (all cores)", group));
    command.add_text("--title", input.title, "TEXT", "of the page", "Output");
    command.add_text("--date", input.date, "YYYY-MM-DD", "that it bears (none)", "Output");
    command.add({.name = "--output",
                 .target = &input.output,
                 .type = "FILE",
                 .help = "the page, or its rows or JSON (stdout)",
                 .group = "Output"});
    command.add(choice_argument("--format", input.form, {"html", "table", "csv", "json", "markdown"},
                                "the page (html), its table of faces, edges and corners, or all of it as JSON",
                                "Output"));
    command.columns = {{"report", attitude_columns}, {"report-cases", case_columns}};
    command.footer =
        "Example: clatter report phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --part 300:500 --output "
        "phone.html\n"
        "The page has all in itself, asks for nothing from anywhere and prints.  Needs gnuplot.";
  });
}

}  // namespace clatter::validation
