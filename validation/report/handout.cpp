// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/handout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "validation/output/gnuplot.hpp"
#include "validation/output/html.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/shock/damage_boundary.hpp"

namespace clatter::validation {
namespace {

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
  PicturePanel panel{.columns = {{"time", "s", "time"}}, .rows = {}, .plot = {}};
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
      for (const Probe& probe : run.probes) {
        row.push_back(specific_force(piece.samples[j], probe.place - body.centre, body.mass).norm() / standard_gravity);
      }
      panel.rows.push_back(std::move(row));
    }
  }
  return panel;
}

}  // namespace

std::string handout_page(const std::string& title, const std::vector<std::string>& lines,
                         const std::vector<HandoutPart>& parts) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{0}</title><link rel=\"icon\" "
      "href=\"data:,\"><style>{1}</style></head><body>\n<h1>{0}</h1>\n<p class=\"lines\">",
      html_escaped(title), page_style);
  for (const std::string& line : lines) html += html_escaped(line) + "<br>\n";
  html += "</p>\n";
  for (const HandoutPart& part : parts) {
    html += fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", html_escaped(part.title), part.html);
  }
  return html + "</body></html>\n";
}

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

std::string handout_commands(const std::vector<std::string>& commands) {
  std::string html = "<pre>";
  for (const std::string& command : commands) html += html_escaped(command) + "\n";
  return html + "</pre>\n";
}

std::string handout_picture(const Picture& picture, const std::string& caption) {
  return fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n",
                     svg_element(run_gnuplot(picture_script(picture, PictureFormat::svg, ""))), html_escaped(caption));
}

std::optional<Picture> probe_history_picture(const ShockRun& run) {
  constexpr int most_impacts = 3, first_ones = 2;
  if (!run.continuous || run.continuous->rows.empty()) return std::nullopt;
  Picture picture{.what = "What an accelerometer reads at the probes", .scene = {}, .panels = {}};
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

}  // namespace clatter::validation
