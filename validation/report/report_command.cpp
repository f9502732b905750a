// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/command/command.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/html.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/number.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/failure.hpp"
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

struct HandoutPart {
  std::string title;
  std::string html;
};

// Pieces of parts.

constexpr const char* page_style =
    "body{font:16px/1.5 system-ui,sans-serif;color:#1a1a1a;background:#fff;max-width:60rem;margin:0 auto;padding:1rem}"
    "h1{font-size:1.6rem;margin-bottom:0}h2{font-size:1.2rem;margin-top:2rem;border-bottom:1px solid #bbb}"
    ".lines{color:#444;margin-top:.3rem}.wide{overflow-x:auto}"
    "table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}"
    "th,td{padding:.15rem .6rem;border-bottom:1px solid #ddd;vertical-align:bottom;white-space:nowrap}"
    "p,li{max-width:46rem}.wide p{font-size:.85rem;color:#444}"
    "figure{margin:1rem 0}figure svg{max-width:100%;height:auto;display:block}figcaption{font-size:.85rem;color:#444}"
    "pre{background:#f4f4f4;padding:.6rem;white-space:pre-wrap;overflow-wrap:anywhere;font-size:.8rem}"
    "@media print{body{font-size:10pt;max-width:none;padding:0}h2{break-after:avoid}figure,tr,pre{break-inside:avoid}"
    ".wide{overflow:visible}table{font-size:7.5pt}th,td{padding:.1rem .25rem;white-space:normal}"
    "figure svg{max-height:23cm}}@page{margin:16mm}";

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
    html += fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", html_escaped(part.title), part.html);
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
  return fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n",
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
  std::optional<int> drops, threads;
  std::optional<double> scatter;  ///< [°]
  std::string rank_by;            ///< column of the sweep
};

/// The drops of the sweep over attitudes.
struct Attitudes {
  int drops = 260;
  double scatter = 3;  ///< [°]
};

/// What was typed, with which every command begins: the scene and its flags.
std::string scene_words(const ReportInput& input) {
  return (input.scene.source.empty() ? "" : " " + shell_word(input.scene.source)) +
         flag_words(overrides_of(input.scene));
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
    const bool is_attitude = given.key == "drop.attitude" || are_alternatives(given.key, "drop.attitude");
    if (!is_attitude && given.key != "run.errors" && given.key != "run.digits")
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

std::string worst_html(const ReportInput& input, const Attitudes& attitudes, const CooperativeInterrupt& interrupt,
                       std::vector<std::string>& commands) {
  const SweepRequest request = sweep_of(input, attitudes);
  SweepPlan plan = read_sweep_plan(request);
  plan.packed = true;
  const SweepBody body = plan.body_values.empty() ? make_sweep_body(plan, plan.scene) : SweepBody{};
  Summary summary(plan.layout, plan.points);
  RangeQueue queue({0, plan.points.count()}, range_size(plan));
  SweepHooks hooks;
  hooks.write = [&](const RangeRows& rows) { summary.add(rows.text); };
  hooks.tick = [] {};
  hooks.stop = [&] { return interrupt.requested(); };
  Ranks ranks;
  run_on_threads(queue, thread_count(input.threads, ranks), runners_of(plan, body), hooks);
  Report report = plan.report();
  report.grid.columns = Summary::columns();
  summary.fill(
      report, [&](long long index) { return plan.command_of(index); },
      [&](long long place) { return plan.attitude_name(place); });
  // The hardest impacts alone keep their commands; without a file no command could name the scene.
  std::vector<std::string> hardest{"largest hardest_impulse_normal"};
  for (const Probe& probe : plan.layout.probes) hardest.push_back("largest " + ranking_column(plan.layout, probe));
  std::erase_if(report.commands, [&](const NamedCommand& one) {
    return request.file.empty() || std::ranges::find(hardest, one.what) == hardest.end();
  });
  if (!request.file.empty()) commands.push_back(sweep_command_of(request));
  return fmt::format(
             "<p>{} drops: each face, edge and corner of the box in its turn, turned about each axis by a "
             "normally distributed angle with a standard deviation of {}°.</p>\n",
             attitudes.drops, attitudes.scatter) +
         handout_table(report);
}

/// The discrete model's sequence, or why there is none.
std::string discrete_html(const ReportInput& input) {
  SceneFlags flags = input.scene;
  flags.model = Model::discrete;
  std::string html;
  const auto failure = failure_of_scene([&] {
    const PreparedScene prepared = read_discrete_flags(flags);
    const DiscreteRun found = run_discrete(prepared);
    html = handout_table(sequence_report(prepared, found));
    html += handout_picture(sequence_picture(prepared, found, TimeWindow{}),
                            "Discrete model: heights over time, and the impulse of each impact.");
  });
  return failure ? fmt::format("<p>The discrete model does not take this drop: {}</p>\n", failure->message) : html;
}

std::string continuous_html(const Scene& scene, const ShockRun& run) {
  const numeric::Body body = scene.make_body();
  PictureHistory history(body);
  const PlannedRun planned = run_to_digits(scene, body, {.history = &history});
  std::string html = handout_table(simulation_report(scene, run.continuous->planned));
  if (!planned.run.impacts.empty()) {
    html += handout_picture(simulation_picture(scene, history, TimeWindow{}),
                            "Continuous model: heights, contact force and energies over time.");
  }
  return html;
}

std::string shock_html(const ShockRun& run, ShockView view) {
  std::string html = handout_table(shock_report(run, view));
  if (const auto picture = probe_history_picture(run))
    html += handout_picture(*picture, "Contacts alone, each impact apart: two blows are two.");
  if (run.continuous) {
    view.rows = ShockRows::pulses;
    html += "<h3>Each impact as a test pulse</h3>\n" + handout_table(shock_report(run, view));
  }
  const Picture picture = shock_picture(run, view);
  if (picture.panels.empty()) return html;
  return html + handout_picture(picture, view.part ? "Response spectra with and without the second blow, and the "
                                                     "damage boundary of the part."
                                                   : "Response spectra with and without the second blow.");
}

std::vector<std::string> assumptions(const Scene& scene, Model model) {
  std::vector<std::string> items = scene_head(scene, model);
  items.emplace_back("the body is rigid, the ground level; air is left out");
  if (model == Model::continuous && scene.world.ground.modulus > 0) {
    items.emplace_back(
        "the ground is an elastic half-space under one patch, whose pressure has the energy of the patch's volume and "
        "shape: faces, edges and corners are told apart, waves in ground and body are not; peaks depend on its "
        "modulus");
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

/// The page, and the exit status of the run that it is about.
struct ReportPage {
  std::string html;
  int status = 0;
};

ReportPage page_of(const ReportInput& input, const CooperativeInterrupt& interrupt) {
  const Scene scene = shock_scene(input);
  const Model model = model_of(input);
  const std::vector<Probe> probes = probes_of(input);
  Attitudes attitudes;
  require_worst_attitudes(input, scene);
  attitudes.drops = input.drops.value_or(attitudes.drops);
  attitudes.scatter = input.scatter.value_or(attitudes.scatter);
  const ShockView view = view_of(input);
  const ShockRun run =
      run_shock(scene, probes, request_of(input), {.progress = [&](int, long) { return !interrupt.requested(); }});
  const std::string words = scene_words(input);
  std::vector<std::string> commands{"clatter sequence" + words};
  std::vector<HandoutPart> parts{{"Assumptions", handout_list(assumptions(scene, model))}};
  if (model == Model::continuous && !interrupt.requested()) {
    commands.push_back("clatter simulate" + words);
    parts.push_back({"What happens: the continuous model", continuous_html(scene, run)});
  }
  parts.push_back({"What happens: the discrete model", discrete_html(input)});
  if (probes.empty()) {
    parts.push_back({"Shock at points of the body",
                     "<p>No probe was named: give --probe NAME:X,Y,Z, or [[probe]] in the "
                     "scene file.</p>\n"});
  } else {
    commands.push_back("clatter shock" + words + probe_words(input));
    parts.push_back({"Shock at points of the body", shock_html(run, view)});
  }
  if (scene.body.shape == BodyScene::Shape::box && attitudes.drops > 0 && !interrupt.requested())
    parts.push_back({"Worst attitudes", worst_html(input, attitudes, interrupt, commands)});
  parts.push_back({"Accuracy", accuracy_html(scene, run)});
  parts.push_back({"What the model leaves out", handout_list(left_out())});
  parts.push_back({"Commands that give these numbers again", handout_commands(commands)});
  return {handout_page(headline("report", input.scene.source.empty() ? "a drop" : input.scene.source),
                       scene.summary(model), parts),
          interrupt.requested() ? interrupted_status : status_of(scene, run)};
}

int run_report(const ReportInput& input) {
  if (input.output.empty()) throw BadInput("--output: required, the page's file");
  if (!input.output.ends_with(".html")) throw BadInput(fmt::format("--output '{}': must end in .html", input.output));
  require_gnuplot("report");
  Sink sink(input.output);
  const CooperativeInterrupt interrupt;
  const ReportPage page = page_of(input, interrupt);
  if (interrupt.requested()) return interrupted_status;
  sink.write(page.html);
  sink.commit();
  return page.status;
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
    command.add({.name = "--output", .target = &input.output, .type = "FILE", .help = "the page", .group = "Output"});
    command.footer =
        "Example: clatter report phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --part 300:500 --output "
        "phone.html\n"
        "The page has all in itself, asks for nothing from anywhere and prints.  Needs gnuplot.";
  });
}

}  // namespace clatter::validation
