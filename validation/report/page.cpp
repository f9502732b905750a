// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "validation/output/gnuplot.hpp"
#include "validation/output/html.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/version.hpp"
#include "validation/report/report_pictures.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/sequence/sequence_picture.hpp"
#include "validation/shock/shock_history.hpp"

namespace clatter::validation {
namespace {

struct HandoutPart {
  std::string title;
  std::string html;
  const char* kind = "";  ///< of its heading: "case" begins those of a case, "brief" is one of several on a page
};

constexpr const char* page_style =
    ":root{color-scheme:light dark;--ink:#1a1a1a;--soft:#444;--paper:#fff;--line:#ccc;--box:#f4f4f4;--body:#2a6f97}"
    "@media (prefers-color-scheme:dark){:root{--ink:#e8e8e8;--soft:#b8b8b8;--paper:#161616;--line:#444;--box:#242424;"
    "--body:#8ecae6}figure.plot svg{background:#fff;border-radius:4px}}"
    "body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:60rem;margin:0 auto;"
    "padding:1rem}"
    "h1{font-size:1.2rem;font-weight:normal;color:var(--soft);margin:0}h1.given{font-size:1.6rem;color:var(--ink)}"
    "h2.case{font-size:1.5rem;margin-top:2.5rem;border-bottom:3px solid "
    "var(--body)}h2{font-size:1.2rem;margin-top:1.5rem;"
    "border-bottom:1px solid var(--line)}.answer{font-size:1.35rem;line-height:1.3;margin:.4rem "
    "0;max-width:none}.several{font-size:1.15rem}"
    ".brief>*{flex:1 1 20rem}"
    ".notes ul{margin:.4rem 0;padding-left:1.2rem}.notes li{font-size:.9rem;line-height:1.35;max-width:none}"
    ".lines{font-size:.9rem;line-height:1.35;max-width:none;color:var(--soft);margin-top:.3rem}.wide{overflow-x:auto}"
    ".beside,.brief{display:flex;flex-wrap:wrap;gap:0 1rem}"
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
    "@media "
    "print{:root{color-scheme:light;--ink:#1a1a1a;--soft:#444;--paper:#fff;--line:#ccc;--box:#f4f4f4;--body:#2a6f97}*{"
    "print-color-adjust:exact;-webkit-print-color-adjust:exact}body{font-size:8.5pt;max-width:none;padding:0}"
    "h2{break-after:avoid;break-inside:avoid;font-size:10.5pt;margin:.7rem 0 "
    ".2rem}h2.case{font-size:12pt;margin-top:1.2rem}"
    "figure,tr,pre{break-inside:avoid}.wide{overflow:visible}table{font-size:7.5pt}th,td{padding:.02rem "
    ".25rem;white-space:normal}"
    "p,ul,pre,figure,.beside figure{margin:.2rem 0}ul{padding-left:1.2rem}p,li{max-width:none;line-height:1.25}"
    "figure.plot{display:inline-block;width:49%;vertical-align:top}figure.plot "
    "svg{max-height:14cm}.beside{break-inside:avoid;flex-wrap:nowrap}.beside svg{max-height:5cm}"
    ".notes li,.lines,.wide p,figcaption,pre{font-size:7.5pt;line-height:1.2}"
    ".brief{break-inside:avoid;flex-wrap:nowrap}.brief>:first-child{flex:5}.brief>.beside{flex:3;display:block}.brief "
    "p,.brief li,.brief figcaption{font-size:7.5pt;line-height:1.2}.brief figure,.brief ul{margin:.1rem 0}.brief "
    "figure svg{max-height:2.2cm}h2.brief{font-size:10pt;margin:.4rem 0 .2rem}"
    ".answer{font-size:12pt}.several{font-size:10.5pt}}@page{size:A4;margin:12mm}";

/// Without the declarations that only a file of its own may have.
std::string svg_element(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) throw std::runtime_error("gnuplot drew nothing: " + svg.substr(0, 200));
  return svg.substr(begin);
}

/// The samples of contacts that `wanted` takes, over the time from `origin` on [s], a column for each probe in g.
PicturePanel history_panel(const ShockRun& run, double origin, const auto& wanted) {
  PicturePanel panel{.columns = {{"time", "s", "time"}}};
  panel.plot.x_factor = 1e3;
  panel.plot.x_label = "time after touch-down [ms]";
  panel.plot.y_label = "specific force [g]";
  for (const Probe& probe : run.probes) {
    const std::string name = fmt::format("a{}", panel.columns.size());
    panel.columns.push_back({name, "g", probe.name});
    panel.plot.curves.push_back({.x = "time", .y = name, .legend = probe.name});
  }
  panel.rows = felt_history(run, wanted);
  for (std::vector<double>& row : panel.rows) row.front() -= origin;
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
    html +=
        "<section>\n" +
        (part.title.empty() ? ""
                            : fmt::format("<h2{}>{}</h2>\n", *part.kind ? fmt::format(" class=\"{}\"", part.kind) : "",
                                          html_escaped(part.title))) +
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
/// @param of_part  the probe of the part, whose spectra alone are drawn; none: those of each
std::string shock_html(const ShockRun& run, ShockView view, int impact, std::optional<std::size_t> of_part) {
  if (run.continuous) view.rows = ShockRows::pulses;
  const Report report = shock_report(run, view);
  std::string html = handout_table(report) + legend_html(report.table());
  if (const auto picture = probe_history_picture(run, impact)) {
    html +=
        handout_picture(*picture,
                        "What an accelerometer reads at the probes, from each touch-down on. Two humps in one impact "
                        "are two touches of which one begins before the other has ended.");
  }
  for (std::size_t probe = of_part.value_or(0); probe < (of_part ? *of_part + 1 : run.probes.size()); ++probe) {
    Picture picture = shock_picture(run, view, probe);
    picture.scene.clear();  // which the page has
    if (picture.panels.empty()) continue;
    html += handout_picture(
        picture, fmt::format("Response spectra of {} with and without the second blow{}", run.probes[probe].name,
                             of_part && view.parts.front().has_limit()
                                 ? ", and all blows beside the damage boundary of the part."
                                 : "."));
  }
  return html;
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
      fmt::format("the drop is followed to {} digits (--digits); those that are not known are not printed, and ? "
                  "marks rows that a start "
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

/// How the body touches in an impact.
Eigen::Quaterniond attitude_in(const ShockRun& run, int impact) {
  const Run impacts = run.leading_run();
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

std::string notes_html(const std::vector<std::string>& notes) {
  return notes.empty() ? "" : "<div class=\"notes\">" + handout_list(notes) + "</div>\n";
}

std::vector<std::string> summary_of(const ReportCase& one) {
  return one.found.scene.summary(model_of(one.input), one.found.all ? attitude_keys : KeyNames{});
}

/// The sentences that all of some cases have.
/// @param sentences  of a case
std::vector<std::string> shared_by(const std::vector<const ReportCase*>& cases, auto&& sentences) {
  std::vector<std::string> shared = sentences(*cases.front());
  for (const ReportCase* one : cases) {
    const std::vector<std::string> own = sentences(*one);
    std::erase_if(shared, [&](const std::string& words) { return std::ranges::find(own, words) == own.end(); });
  }
  return shared;
}

/// @param shared   what a page of several cases has said already; null: it has one
std::vector<HandoutPart> parts_of(const ReportCase& one, const Attitudes& attitudes, bool is_short,
                                  const std::vector<std::string>* shared) {
  const Findings& found = one.found;
  const Scene& scene = found.scene;
  const Model model = model_of(one.input);
  const std::string heading = shared ? one.heading() : "";
  const auto& all = found.all;
  const numeric::Body body = scene.make_body();
  const Vector3 centre = body_properties(scene, Model::continuous).centre;
  const int impact = found.answer.blow ? found.answer.blow->impact : 1;
  const bool is_brief = is_short && shared;  // one of several that are to stand on one page
  std::string pictures = fmt::format(
      "<div class=\"beside\"><figure>{}<figcaption>The body as it touches in impact {}{}</figcaption></figure>\n",
      body_picture(body, attitude_in(found.run, impact), found.run.probes, centre), impact,
      found.run.probes.empty() ? "." : "; hollow: inside or behind.");
  if (all) {
    pictures += fmt::format(
        "<figure>{}<figcaption>All drops by what is down in the body{}; ring: the worst.</figcaption></figure>",
        attitude_map(dots_of(*all), all->worst, ranked_words(all->column), all->is_least_worst()),
        scene.is_released() ? " at the release" : "");
  }
  const auto own = [&](std::vector<std::string> sentences) {
    if (shared)
      std::erase_if(sentences, [&](const auto& words) { return std::ranges::find(*shared, words) != shared->end(); });
    return sentences;
  };
  std::string answer = fmt::format("<p{}>{}.</p>\n", is_brief ? "" : " class=\"answer\"", html_escaped(found.lead)) +
                       notes_html(own(found.notes));
  const KeyNames unsettled = all ? attitude_keys : KeyNames{};
  if (shared) {
    answer += "<p class=\"lines\">";
    for (const std::string& line : own(summary_of(one))) answer += html_escaped(line) + "<br>\n";
    answer += "</p>\n";
  }
  pictures += "</div>\n";
  std::vector<HandoutPart> parts{
      is_brief ? HandoutPart{heading, "<div class=\"brief\"><div>" + answer + "</div>" + pictures + "</div>\n", "brief"}
               : HandoutPart{heading, answer + pictures, shared ? "case" : ""}};
  if (is_short) return parts;
  if (all) parts.push_back({"Attitudes", attitudes_html(*all, attitudes)});
  parts.push_back({"Shock at points of the body",
                   found.run.probes.empty()
                       ? "<p>No probe was named: give --probe NAME:X,Y,Z, or [[probe]] in the "
                         "scene file.</p>\n"
                       : shock_html(found.run, one.view, impact,
                                    found.ranking.part ? std::optional(found.ranking.probe) : std::nullopt)});
  parts.push_back({fmt::format("The impacts, {} model", name_of(model)),
                   handout_table(found.impacts) + legend_html(found.impacts.table()) +
                       (found.run.continuous ? "" : sequence_picture_html(scene))});
  parts.push_back({"Accuracy", accuracy_html(scene, found.run)});
  parts.push_back({"Assumptions", handout_list(assumptions(scene, model, unsettled))});
  parts.push_back({"What the model leaves out", handout_list(left_out(scene))});
  parts.push_back({"Commands that give these numbers again", handout_commands(found.commands)});
  return parts;
}

}  // namespace

std::string page_of(const ReportCase& first, const std::vector<const ReportCase*>& order, const Report& report,
                    const Attitudes& attitudes, bool is_short, const std::string& lack) {
  const ReportInput& input = first.input;
  std::vector<std::string> lines;
  if (!input.title.empty()) {
    lines.push_back(std::string("clatter ") + version);
    if (!input.date.empty()) lines.front().insert(0, input.date + ", ");
  }
  std::vector<HandoutPart> parts;
  if (order.size() == 1) {
    for (const std::string& line : summary_of(first)) lines.push_back(line);
    parts = parts_of(first, attitudes, is_short, nullptr);
  } else {
    Report table;
    table.grid = report.grid;
    std::vector<std::string> shared = shared_by(order, [](const ReportCase& one) { return one.found.notes; });
    std::vector<std::string> notes(report.notes.begin() + 2,
                                   report.notes.end());  // after the answer and the worst case
    notes.insert(notes.end(), shared.begin(), shared.end());
    for (const std::string& line : shared_by(order, summary_of)) {
      lines.push_back(line);
      shared.push_back(line);
    }
    std::string answers;
    const std::vector<std::string> of_parts = part_answers(order);
    for (const std::string& words : of_parts)
      answers +=
          fmt::format("<p class=\"answer{}\">{}.</p>\n", of_parts.size() > 1 ? " several" : "", html_escaped(words));
    parts = {{"", answers + notes_html(notes) + handout_table(table) + legend_html(table.grid)}};
    std::set<std::string> said;  // what is said of one case is left out of the next
    for (const ReportCase* one : worst_cases(order)) {
      for (HandoutPart& part : parts_of(*one, attitudes, is_short, &shared)) {
        if (said.insert(part.title + part.html).second) parts.push_back(std::move(part));
      }
    }
  }
  if (!lack.empty()) parts.insert(parts.begin(), {"", "<p class=\"answer\"><b>" + html_escaped(lack) + ".</b></p>\n"});
  return handout_page(input.title.empty() ? first.found.report.title : input.title, !input.title.empty(), lines, parts);
}

}  // namespace clatter::validation
