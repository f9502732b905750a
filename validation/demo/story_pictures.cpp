// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/story_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "validation/output/html.hpp"

namespace clatter::validation::inline demo {
namespace {

// Colours of the page: of the discrete model, of its blows, of lines.
constexpr const char *body_colour = "#0072b2", *blow_colour = "#0a3d62", *line = "#b9c3cd";
constexpr double width = 300, height = 160;

std::string picture(const std::string& words, const std::string& content) {
  return fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{}">{}</svg>)", width, height,
                     html_escaped(words), content);
}

std::string text(double x, double y, const char* anchor, const std::string& words) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor, html_escaped(words));
}

std::string stroke(double x1, double y1, double x2, double y2, const char* colour, double thickness) {
  return fmt::format(
      R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="{}" stroke-linecap="round"/>)",
      x1, y1, x2, y2, colour, thickness);
}

/// Upward from a point; the head included.
std::string arrow(double x, double y, double length) {
  const double head = 10, tip = y - length;
  return stroke(x, y, x, tip + head, blow_colour, 4) +
         fmt::format(R"(<path d="M{:.1f},{:.1f}l-6,{}h12z" fill="{}"/>)", x, tip, head, blow_colour);
}

}  // namespace

std::string rod_picture(const RodBlow& blow) {
  constexpr double floor = 138, longest = 78, rod = 210, left = 45;
  const double foot = blow.is_left ? left : left + rod, side = blow.is_left ? 1 : -1;
  std::string content = stroke(8, floor, width - 8, floor, line, 2);
  content += stroke(foot, floor, foot + side * rod * blow.angle.cosine, floor - rod * blow.angle.sine, body_colour, 6);
  const double length = longest * blow.impulse / blow.strongest;
  content += arrow(foot, floor - 4, length);
  content += text(foot, floor - length - 12, "middle", fmt::format("{:.3f} N·s", blow.impulse));
  content += text(foot + side * 64, floor + 17, "middle", fmt::format("{:.2f}°", blow.angle.degrees));
  return picture(blow.words, content);
}

std::string curve_picture(const CurvePicture& given) {
  constexpr double x0 = 36, x1 = 278, y0 = 126, y1 = 28;
  const auto x = [&](double value) { return x0 + (x1 - x0) * value / given.x_end; };
  const auto y = [&](double value) { return y0 + (y1 - y0) * value / given.y_end; };
  std::string content = stroke(x0, y0, x1, y0, line, 1.5) + stroke(x0, y0, x0, y1, line, 1.5);
  for (int i = 0; i <= 2; ++i) {
    const double part = i / 2.0;
    content += text(x(part * given.x_end), y0 + 16, "middle", fmt::format("{:g}", part * given.x_end));
    content += text(x0 - 6, y(part * given.y_end) + 4, "end", fmt::format("{:g}", part * given.y_end));
  }
  content += text(x1 + 10, y0 + 31, "end", given.axes[0]) + text(4, 13, "start", given.axes[1]);
  for (const Curve& curve : given.curves) {
    std::string points;
    for (const CurvePoint& point : curve.points) points += fmt::format("{:.1f},{:.1f} ", x(point.x), y(point.y));
    content += fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="2.5"{}/>)", points,
                           curve.colour, curve.is_dashed ? R"( stroke-dasharray="6 4")" : "");
    const CurvePoint& last = curve.points.back();
    if (curve.is_fold)
      content += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4.5" fill="#fff" stroke="{}" stroke-width="2"/>)",
                             x(last.x), y(last.y), curve.colour);
    content += text(x(last.x) + 9, y(last.y) + 4, "start", curve.name);
  }
  return picture(given.words, content);
}

std::string bar_picture(const std::vector<Bar>& bars, const std::string& words) {
  constexpr double floor = 132, tallest = 100, wide = 56;
  double most = 0;
  for (const Bar& bar : bars) most = std::max(most, bar.value);
  std::string content = stroke(8, floor, width - 8, floor, line, 2);
  const double step = width / static_cast<double>(bars.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double x = (static_cast<double>(i) + 0.5) * step, tall = tallest * bars[i].value / most;
    content += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{}" height="{:.1f}" fill="#d55e00"/>)", x - wide / 2,
                           floor - tall, wide, tall);
    content += text(x, floor - tall - 7, "middle", fmt::format("{:.0f} N", bars[i].value));
    content += text(x, floor + 17, "middle", bars[i].name);
  }
  return picture(words, content);
}

}  // namespace clatter::validation::inline demo
