// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/command/command.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/html.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/report/report_pictures.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/orientation.hpp"
#include "validation/sequence/sequence_picture.hpp"
#include "validation/sequence/sequence_report.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/shock_options.hpp"
#include "validation/shock/shock_run.hpp"
#include "validation/simulate/simulation_picture.hpp"
#include "validation/simulate/simulation_report.hpp"
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
};

// Pieces of parts.

constexpr const char* page_style =
    ":root{color-scheme:light dark;--ink:#1a1a1a;--soft:#444;--paper:#fff;--line:#ccc;--box:#f4f4f4;--body:#2a6f97}"
    "@media (prefers-color-scheme:dark){:root{--ink:#e8e8e8;--soft:#b8b8b8;--paper:#161616;--line:#444;--box:#242424;"
    "--body:#8ecae6}figure.plot svg{background:#fff;border-radius:4px}}"
    "body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:60rem;margin:0 auto;"
    "padding:1rem}"
    "h1{font-size:1.2rem;font-weight:normal;color:var(--soft);margin:0}h2{font-size:1.2rem;margin-top:1.5rem;"
    "border-bottom:1px solid var(--line)}.answer{font-size:1.4rem;line-height:1.35;margin:.4rem 0}"
    ".lines{color:var(--soft);margin-top:.3rem}.wide{overflow-x:auto}.beside{display:flex;flex-wrap:wrap;gap:0 1rem}"
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
    "table{font-size:7.5pt}th,td{padding:.1rem .25rem;white-space:normal}figure.plot svg{max-height:8.2cm}"
    ".answer{font-size:14pt}}@page{margin:14mm}";

/// Without the declarations that only a file of its own may have.
std::string svg_element(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) throw std::runtime_error("gnuplot drew nothing: " + svg.substr(0, 200));
  return svg.substr(begin);
}

/// The samples of contacts that `wanted` takes, over the time from `origin` on [s], a column for each probe in g.
template <class Wanted>
PicturePanel history_panel(const ShockRun& run, double origin, const Wanted& wanted) {
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
std::string handout_page(const std::string& title, const std::vector<std::string>& lines,
                         const std::vector<HandoutPart>& parts) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{0}</title><link rel=\"icon\" "
      "href=\"data:,\"><style>{1}</style></head><body>\n<h1>{0}</h1>\n<p class=\"lines\">",
      html_escaped(title), page_style);
  for (const std::string& line : lines) html += html_escaped(line) + "<br>\n";
  html += "</p>\n";
  for (const HandoutPart& part : parts)
    html += "<section>\n" + (part.title.empty() ? "" : fmt::format("<h2>{}</h2>\n", html_escaped(part.title))) +
            part.html + "</section>\n";
  return html + "</body></html>\n";
}

/// The table of a report with its notes, without its head.
std::string handout_table(Report report) {
  report.title.clear();
  report.head.clear();
  return "<div class=\"wide\">\n" + html_table(report) + "</div>\n";
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

/// Size of the specific force at the probes over time: the first two impacts, then each of the first three in a panel
/// of its own, from its touch-down on; none without a contact.
std::optional<Picture> probe_history_picture(const ShockRun& run) {
  constexpr int most_impacts = 3, first_ones = 2;
  if (!run.continuous || run.continuous->rows.empty()) return std::nullopt;
  Picture picture{.what = "What an accelerometer reads at the probes", .scene = {}};
  picture.panels.push_back(
      history_panel(run, 0, [](const numeric::HistoryPiece& piece) { return piece.impact <= first_ones; }));
  picture.panels.back().plot.x_label = "impacts 1 and 2: time after touch-down [ms]";
  const int last = run.continuous->rows.back().impact;
  if (last == 1) picture.panels.clear();
  for (int impact = 1; impact <= std::min(last, most_impacts); ++impact) {
    const auto row = std::find_if(run.continuous->rows.begin(), run.continuous->rows.end(),
                                  [&](const ShockRow& one) { return one.impact == impact; });
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
  bool json = false;
  std::optional<int> drops, threads;
  std::optional<double> scatter;  ///< [°]
  std::string rank_by;            ///< column of the sweep
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
  if (input.part) words += fmt::format(" --part {}:{}", shortest((*input.part)[0]), shortest((*input.part)[1]));
  return words;
}

/// The sweep of a box's attitudes by the same scene, to digits enough for a statistic; flags of the drop's own attitude
/// stay out.
SweepRequest sweep_of(const ReportInput& input, const Attitudes& attitudes) {
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
                       .rank_by = input.rank_by};
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
  if (!request.rank_by.empty()) words += " --rank-by " + shell_word(request.rank_by);
  return words + fmt::format(" --random {} --scatter {} --no-errors --summary", *request.random, *request.scatter);
}

/// What the drops in all attitudes give.
struct AllAttitudes {
  std::vector<RankedDrop> drops;
  std::size_t worst = 0;
  Column column;        ///< by which they are ranked
  Scene scene;          ///< of the worst
  std::string name;     ///< of its attitude: "corner -x-y+z down, 3.2° off"
  Report report;        ///< percentiles, and in its fields the largest of each attitude
  std::string command;  ///< empty: no file that a command could name
};

/// "corner -x-y+z down, 3.2° off", of a box's attitude by number, from 0.
std::string name_of_drop(const Scene& scene, int number, const Vector3& down) {
  const std::array<int, 3> signs = orientation_signs(number + 1);
  const auto axes = std::ranges::count_if(signs, [](int sign) { return sign != 0; });
  const std::vector<double> q = orientation_attitude(number + 1, scene.body.size);
  const Vector3 level = down_of(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  const double off = std::atan2(down.cross(level).norm(), down.dot(level)) * 180 / std::numbers::pi;
  return fmt::format("{} {} down, {}° off",
                     axes == 1   ? "face"
                     : axes == 2 ? "edge"
                                 : "corner",
                     orientation_name(number + 1), significant(off, 2));
}

/// @throws BadInput as read_sweep_plan; nothing if it was interrupted, or no drop has a number to rank it by.
std::optional<AllAttitudes> all_attitudes(const ReportInput& input, const Attitudes& attitudes,
                                          const CooperativeInterrupt& interrupt) {
  const SweepRequest request = sweep_of(input, attitudes);
  SweepPlan plan = read_sweep_plan(request);
  plan.packed = true;
  const SweepBody body = plan.body_values.empty() ? make_sweep_body(plan, plan.scene) : SweepBody{};
  Summary summary(plan.layout, plan.points);
  const std::optional<std::size_t> ranking = summary.ranking();
  if (!ranking) return {};
  AllAttitudes all;
  all.column = sweep_columns(plan.layout)[*ranking];
  RangeQueue queue({0, plan.points.count()}, range_size(plan));
  SweepHooks hooks;
  Progress progress;
  std::vector<PackedCell> row(sweep_columns(plan.layout).size());
  std::vector<long long> points;
  std::vector<double> values;
  hooks.write = [&](const RangeRows& rows) {
    summary.add(rows.text);
    for (PackedRows packed(rows.text); packed.next(row);) {
      if (!std::isfinite(row[*ranking].number)) continue;
      points.push_back(static_cast<long long>(row.front().number));
      plan.points.at(points.back(), values);
      const Vector3 down = down_of(Eigen::Quaterniond(values[0], values[1], values[2], values[3]));
      const auto number = static_cast<int>(plan.points.attitude_of(points.back()));
      all.drops.push_back({down, row[*ranking].number,
                           fmt::format("{}: {} {}", name_of_drop(plan.scene, number, down),
                                       significant(row[*ranking].number, 4), all.column.unit)});
    }
    const auto done = static_cast<std::size_t>(queue.taken()), of = static_cast<std::size_t>(plan.points.count());
    progress.show(fmt::format("attitudes: {}{}", progress_bar(done, of), progress.time_left(done, of)));
  };
  hooks.tick = [] {};
  hooks.stop = [&] { return interrupt.requested(); };
  Ranks ranks;
  run_on_threads(queue, thread_count(input.threads, ranks), runners_of(plan, body), hooks);
  if (interrupt.requested() || all.drops.empty()) return {};
  all.worst = static_cast<std::size_t>(std::ranges::max_element(all.drops, {}, &RankedDrop::value) - all.drops.begin());
  all.scene = shock_scene(input);
  plan.points.at(points[all.worst], values);
  all.scene.orientation.reset();
  all.scene.tilt_deg = 0;
  all.scene.attitude.assign(values.begin(), values.end());
  all.scene.settle();
  all.name =
      name_of_drop(all.scene, static_cast<int>(plan.points.attitude_of(points[all.worst])), all.drops[all.worst].down);
  all.report = plan.report();
  all.report.grid.columns = Summary::columns();
  summary.fill(
      all.report, [&](long long index) { return plan.command_of(index); },
      [&](long long place) { return plan.attitude_name(place); });
  all.report.commands.clear();
  if (!request.file.empty()) all.command = sweep_command_of(request);
  return all;
}

/// The attitudes by the largest of their drops, as far as a reader asks; then how all the drops are distributed.
std::string attitudes_html(const AllAttitudes& all, const Attitudes& attitudes) {
  Report shown;
  shown.grid.columns = {word_column("attitude", "attitude", ""),
                        {"largest", fmt::format("largest {}", all.column.name), all.column.unit, ""}};
  std::vector<std::pair<double, std::string>> ranked;
  for (const Value& one : std::get<Value::List>(all.report.fields.at("attitudes").content())) {
    if (const Value* of = one.find(all.column.name))
      ranked.emplace_back(*of->at("largest").number(), one.at("attitude").text());
  }
  std::ranges::stable_sort(ranked, std::ranges::greater{}, &std::pair<double, std::string>::first);
  constexpr std::size_t most = 8;
  for (std::size_t i = 0; i < std::min(most, ranked.size()); ++i)
    shown.grid.rows.push_back({Cell(ranked[i].second), Cell(ranked[i].first, 4)});
  Report spread = all.report;
  spread.notes.clear();
  std::erase_if(spread.grid.rows, [&](const Row& row) {
    const std::string name = row.front().value.text();
    const bool is_asked = name.starts_with(peak_column) || name.starts_with(shock_column) ||
                          name == "largest_peak_force" || name == "hardest_impulse_normal" || name == all.column.name;
    return !is_asked || name.ends_with("_impact");
  });
  std::erase_if(spread.grid.columns, [](const Column& column) { return column.name == "count"; });
  for (Row& row : spread.grid.rows) row.erase(row.begin() + 2);
  return fmt::format(
      "<p>{} drops: each face, edge and corner of the box in its turn, turned about each axis by a "
      "normally distributed angle with a standard deviation of {}°.</p>\n<div class=\"beside\">{}{}</div>",
      attitudes.drops, attitudes.scatter, handout_table(shown), handout_table(spread));
}

/// A picture of the discrete model's sequence.  @throws as run_discrete
std::string sequence_picture_html(const Scene& scene) {
  const PreparedScene drop = prepared(scene);
  return handout_picture(sequence_picture(drop, run_discrete(drop), TimeWindow{}),
                         "Discrete model: heights over time, and the impulse of each impact.");
}

/// Pulses or changes of velocity at the probes, then pictures of them and of their spectra.
std::string shock_html(const ShockRun& run, ShockView view) {
  if (run.continuous) view.rows = ShockRows::pulses;
  std::string html = handout_table(shock_report(run, view));
  if (const auto picture = probe_history_picture(run))
    html += handout_picture(*picture, "Contacts alone, each impact apart: two blows are two.");
  Picture picture = shock_picture(run, view);
  picture.scene.clear();  // which the page has
  if (picture.panels.empty()) return html;
  return html + handout_picture(picture, view.part ? "Response spectra with and without the second blow, and the "
                                                     "damage boundary of the part."
                                                   : "Response spectra with and without the second blow.");
}

/// Three digits, as one says them: 39000, not 39027.
std::string said(double value) {
  const double unit = value > 0 ? std::pow(10.0, std::floor(std::log10(value)) - 2) : 1;
  return shortest(unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit);
}

/// What a drop does at its worst: to the probe and in the impact of the largest peak, or change of velocity.
struct Answer {
  std::string words{};
  Value fields{};
};

/// "camera: 2658 g in impact 1, 7.52 m/s within 0.47 ms"; with a part its margin.
Answer answer_of(const ShockRun& run, const std::optional<FragilePart>& part) {
  const bool has_peaks = run.continuous.has_value();
  const auto size = [&](const ShockRow& row) { return has_peaks ? row.value.peak_size : row.value.delta_v_size; };
  const auto worst = std::ranges::max_element(run.rows(), {}, size);
  if (worst == run.rows().end()) {
    if (!run.continuous) return {"no probe was named", Value(Value::Fields{})};
    const Estimated peak = totals(run_of(run.continuous->planned.run)).largest_peak;
    return {fmt::format("the largest force is {} N", said(peak.value)), Value::Fields{{"peak_force", peak.value}}};
  }
  const std::string& probe = run.probes[worst->probe].name;
  const double g = worst->value.peak_size / standard_gravity, velocity = worst->value.delta_v_size;
  Answer answer{.fields = Value::Fields{{"probe", probe}, {"impact", worst->impact}, {"delta_v", velocity}}};
  if (!has_peaks) {
    answer.words = fmt::format("{} is changed by {} m/s in impact {}", probe, said(velocity), worst->impact);
    return answer;
  }
  answer.fields["peak_g"] = g;
  answer.fields["width"] = worst->value.width;
  answer.words = fmt::format("{} takes {} g in impact {}, {} m/s within {} ms", probe, said(g), worst->impact,
                             said(velocity), said(1e3 * worst->value.width));
  if (!part) return answer;
  double least = std::numeric_limits<double>::infinity();
  for (const PulseShape shape : {PulseShape::half_sine, PulseShape::rectangle})
    least = std::fmin(least, margin(*part, shape, velocity, worst->value.peak_size));
  answer.fields["margin"] = least;
  const std::string bears =
      fmt::format("a part of {} Hz that bears {} g", said(part->frequency), said(part->fragility / standard_gravity));
  answer.words += least > 1 ? fmt::format("; {} holds, margin {}", bears, said(least))
                            : fmt::format("; {} fails, margin {}", bears, said(least));
  return answer;
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
        "(clatter ground finds them), and peaks depend on them");
  } else {
    items.emplace_back("an impact takes no time: changes of velocity are known, forces and peaks are not");
  }
  return items;
}

const std::vector<std::string>& left_out() {
  static const std::vector<std::string> items{
      "whatever bends: housings, screens, boards and batteries that move make other peaks than a rigid body's, larger "
      "ones where they strike or resonate",
      "damage: a damage boundary and a spectrum say what a part goes through, not whether a crack grows",
      "floors that yield, crack or remember the last blow, and soft pads beyond their linear range",
      "the hand, cable or air that turns the body before it touches: the attitude at the touch is what is given here",
      "repeated drops: each one here is the first"};
  return items;
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
  const bool is_typed = is_given(input.scene, "--body");
  return (is_typed                   ? input.scene.texts.at("--body")
          : values.has("body.shape") ? values.text("body.shape")
                                     : "") == "box";
}

/// Keys of which a page about a drop of many says nothing: its attitude has a name there.
const KeyNames attitude_keys{"drop.attitude", "drop.angle_deg", "drop.orientation", "drop.tilt_deg"};

/// What a page is about.
struct Findings {
  std::optional<AllAttitudes> all;  ///< none: of the drop as given alone
  Scene scene;                      ///< of the worst drop of all, or as given
  ShockRun run;
  Answer answer;
  std::string lead;  ///< the answer in a sentence
  Report impacts;    ///< of the model, as its own command prints them
  std::vector<std::string> commands;
  Report report;  ///< for other programs
};

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
  } else {
    const PreparedScene drop = prepared(scene);
    found.impacts = sequence_report(drop, run_discrete(drop));
  }
  fields[is_continuous ? "simulation" : "sequence"] = found.impacts.fields;
  found.commands.push_back((is_continuous ? "clatter simulate" : "clatter sequence") + words);
  fields["commands"] = found.commands;
}

/// Nothing where it was interrupted.
std::optional<Findings> findings_of(ReportInput& input, const Attitudes& attitudes, const ShockView& view,
                                    const CooperativeInterrupt& interrupt) {
  const bool is_turned = gives_attitude(input), looks_at_all = is_of_box(input) && input.drops != 0;
  if (!is_turned && looks_at_all) input.scene.texts["--orientation"] = "1";  // some one: the sweep has its own
  const Scene given = shock_scene(input);
  const std::vector<Probe> probes = probes_of(input);
  require_worst_attitudes(input, given);
  Findings found;
  if (looks_at_all) found.all = all_attitudes(input, attitudes, interrupt);
  if (interrupt.requested()) return {};
  found.scene = found.all ? found.all->scene : given;
  const Scene& scene = found.scene;
  const auto watch = [&](int, long) { return !interrupt.requested(); };
  found.run = run_shock(scene, probes, request_of(input), {.progress = watch});
  if (interrupt.requested()) return {};

  found.report = begun_report("report", input.scene.source.empty() ? "a drop" : input.scene.source);
  Value& fields = found.report.fields;
  fields["model"] = name_of(model_of(input));
  fields["scene"] = scene_value(scene, model_of(input));
  found.answer = answer_of(found.run, view.part);
  fields["answer"] = found.answer.fields;
  found.lead = found.answer.words;
  if (const auto& all = found.all) {
    const RankedDrop& worst = all->drops[all->worst];
    fields["answer"]["attitude"] = all->name;
    fields["answer"]["ranked_by"] = all->column.name;
    fields["answer"]["largest"] = worst.value;
    if (probes.empty())
      found.lead = fmt::format("its {} is {} {}", all->column.name, said(worst.value), all->column.unit);
    found.lead = fmt::format("Worst of {} drops: {}: {}", attitudes.drops, all->name, found.lead);
    if (is_turned && !probes.empty()) {
      ShockRequest plain = request_of(input);
      plain.sensitivity = false;
      const Answer own = answer_of(run_shock(given, probes, plain, {.progress = watch}), {});
      const char* const number = found.run.continuous ? "peak_g" : "delta_v";
      const Value *of_own = own.fields.find(number), *of_worst = found.answer.fields.find(number);
      const bool is_worse = of_own && of_worst && *of_own->number() > *of_worst->number();
      found.lead += fmt::format(". The drop as given{}: {}", is_worse ? " is worse" : "", own.words);
      fields["as_given"] = own.fields;
    }
  }
  if (const std::string overlap = overlap_words(scene, found.run); !overlap.empty()) {
    found.lead += "; " + overlap;
    fields["overlap"] = overlap;
  }
  add_fields(input, view, found);
  return found;
}

std::string page_of(const ReportInput& input, const Findings& found, const Attitudes& attitudes,
                    const ShockView& view) {
  const Scene& scene = found.scene;
  const Model model = model_of(input);
  const auto& all = found.all;
  const numeric::Body body = scene.make_body();
  const Vector3 centre = body_properties(scene, Model::continuous).centre;
  std::string pictures =
      fmt::format("<div class=\"beside\"><figure>{}<figcaption>{}</figcaption></figure>\n",
                  body_picture(body, scene.touch_attitude(), found.run.probes, centre), "The body as it touches.");
  if (all) {
    pictures += fmt::format(
        "<figure>{}<figcaption>All drops by the direction that is down in the body; the ring is the "
        "worst.</figcaption></figure>",
        attitude_map(all->drops, all->worst, all->column.name + " [" + all->column.unit + "]"));
  }
  std::vector<HandoutPart> parts{
      {"", fmt::format("<p class=\"answer\">{}.</p>\n{}</div>\n", html_escaped(found.lead), pictures)}};
  if (all) parts.push_back({"Attitudes", attitudes_html(*all, attitudes)});
  parts.push_back({"Shock at points of the body",
                   found.run.probes.empty() ? "<p>No probe was named: give --probe NAME:X,Y,Z, or [[probe]] in the "
                                              "scene file.</p>\n"
                                            : shock_html(found.run, view)});
  parts.push_back({fmt::format("The impacts, {} model", name_of(model)),
                   handout_table(found.impacts) + (found.run.continuous ? "" : sequence_picture_html(scene))});
  const KeyNames unsettled = all ? attitude_keys : KeyNames{};
  parts.push_back({"Accuracy", accuracy_html(scene, found.run)});
  parts.push_back({"Assumptions", handout_list(assumptions(scene, model, unsettled))});
  parts.push_back({"What the model leaves out", handout_list(left_out())});
  parts.push_back({"Commands that give these numbers again", handout_commands(found.commands)});
  return handout_page(found.report.title, scene.summary(model, unsettled), parts);
}

int run_report(const ReportInput& given) {
  ReportInput input = given;
  if (!input.json) {
    if (input.output.empty()) throw BadInput("--output: required, the page's file");
    if (!input.output.ends_with(".html")) throw BadInput(fmt::format("--output '{}': must end in .html", input.output));
    require_gnuplot("report");
  }
  const OutputChoice choice{.style = {.format = Format::json}, .path = input.output};
  if (input.json) check_files(choice);
  std::optional<Sink> sink;
  if (!input.json) sink.emplace(input.output);
  const CooperativeInterrupt interrupt;
  Attitudes attitudes;
  attitudes.drops = input.drops.value_or(attitudes.drops);
  attitudes.scatter = input.scatter.value_or(attitudes.scatter);
  const ShockView view = view_of(input);
  const auto found = findings_of(input, attitudes, view, interrupt);
  if (!found) return interrupted_status;
  if (input.json) {
    write_report(choice, found->report);
  } else {
    sink->write(page_of(input, *found, attitudes, view));
    sink->commit();
  }
  return status_of(found->scene, found->run);
}

}  // namespace

Command report_command() {
  return command_of<ReportInput>(run_report, [](Command& command, ReportInput& input) {
    add_shock_options(command, input);
    constexpr const char* group = "Worst attitudes";
    command.add(whole_argument("--drops", input.drops, 0, 1'000'000, "N",
                               "of a box, over its faces, edges and corners (260); 0: none", group));
    command.add(number_argument("--scatter", input.scatter, {0, 180, false, "from 0 to 180 degrees"}, "DEG",
                                "standard deviation of their turns about each axis (3)", group));
    command.add_text("--rank-by", input.rank_by, "COLUMN",
                     "of clatter sweep's rows, by which they are ranked (the first probe's peak or change of velocity)",
                     group);
    command.add(threads_argument(input.threads, "for them (all cores)", group));
    command.add({.name = "--output",
                 .target = &input.output,
                 .type = "FILE",
                 .help = "the page, or its JSON (stdout)",
                 .group = "Output"});
    command.add(choice_argument("--format", input.json, {"html", "json"}, "(html)", "Output"));
    command.footer =
        "Example: clatter report phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --part 300:500 --output "
        "phone.html\n"
        "The page has all in itself, asks for nothing from anywhere and prints.  Needs gnuplot.";
  });
}

}  // namespace clatter::validation
