// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/report_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "numeric/motion/free_flight.hpp"
#include "validation/output/html.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using numeric::Vector3;
using Point = std::array<double, 2>;

/// From an azimuth of 30° off the x–z plane and 15° above the floor; x to the right, y down as SVG has it.
class View {
 public:
  [[nodiscard]] Point at(const Vector3& p) const { return {right_.dot(p), -up_.dot(p)}; }
  [[nodiscard]] double depth(const Vector3& p) const { return towards_.dot(p); }
  [[nodiscard]] const Vector3& towards() const { return towards_; }

 private:
  Vector3 right_{std::cos(0.52), std::sin(0.52), 0};
  Vector3 towards_ = Vector3(std::sin(0.52) * std::cos(0.26), -std::cos(0.52) * std::cos(0.26), std::sin(0.26));
  Vector3 up_ = towards_.cross(right_);
};

std::string path_of(std::span<const Point> points) {
  std::string path;
  for (const Point& p : points) path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", p[0], p[1]);
  return path + "Z";
}

/// Light for the least, dark for the largest numbers; told apart without colours, too.
constexpr std::array colours{"#fde725", "#5ec962", "#21918c", "#3b528b", "#440154"};

}  // namespace

std::string body_picture(const numeric::Body& body, const Eigen::Quaterniond& attitude,
                         const std::vector<Probe>& probes, const Vector3& centre) {
  constexpr double width = 420, height = 300, room = 125;
  const View view;
  numeric::MotionState state;
  state.attitude = attitude;
  state = numeric::on_ground(body, state);
  const double scale = room / body.radius();
  const Point middle = view.at(state.centre);
  const auto place = [&](const Vector3& world) -> Point {
    const Point p = view.at(world);
    return {width / 2 + scale * (p[0] - middle[0]), height / 2 - 15 + scale * (p[1] - middle[1])};
  };
  const auto world = [&](const Vector3& u) -> Vector3 { return state.centre + attitude * u; };
  const double reach = 1.2 * body.radius();
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"the body over the floor\"><path class=\"floor\" d=\"{}\"/>",
      width, height,
      path_of(std::array{place({-reach, -reach, 0}), place({reach, -reach, 0}), place({reach, reach, 0}),
                         place({-reach, reach, 0})}));
  struct Face {
    double depth = 0, light = 0;
    std::vector<Point> points{};
  };
  std::vector<Face> faces;
  const numeric::Facets& facets = body.facets();
  for (std::size_t f = 0; f < facets.facets.size(); ++f) {
    const Vector3 normal = attitude * facets.facets[f].normal;
    if (!(view.towards().dot(normal) > 0)) continue;
    Face face{.light = 0.5 + 0.25 * normal.z() + 0.25 * normal.x()};
    facets.for_each_corner(static_cast<int>(f), [&](int vertex) {
      const Vector3 corner = world(facets.vertices[static_cast<std::size_t>(vertex)]);
      face.points.push_back(place(corner));
      face.depth += view.depth(corner);
    });
    face.depth /= static_cast<double>(face.points.size());
    faces.push_back(std::move(face));
  }
  std::ranges::sort(faces, {}, &Face::depth);
  // Seen is what lies on a face that is, or before all of those.
  const auto is_behind = [&](const Vector3& point) {
    const double slack = 1e-6 * body.radius();
    double before = -body.radius();
    for (std::size_t f = 0; f < facets.facets.size(); ++f) {
      const Vector3& normal = facets.facets[f].normal;
      if (!(view.towards().dot(attitude * normal) > 0)) continue;
      int corner = -1;
      facets.for_each_corner(static_cast<int>(f), [&](int vertex) { corner = vertex; });
      before = std::max(before, normal.dot(point - facets.vertices[static_cast<std::size_t>(corner)]));
    }
    return before < -slack;
  };
  for (const Face& face : faces) {
    svg += fmt::format("<path class=\"body\" fill-opacity=\"{:.2f}\" d=\"{}\"/>", 0.35 + 0.5 * (1 - face.light),
                       path_of(face.points));
  }
  for (const Probe& probe : probes) {
    const Point p = place(world(probe.place - centre));
    const bool is_hidden = is_behind(probe.place - centre);
    svg += fmt::format(
        "<circle class=\"{4}\" cx=\"{0:.2f}\" cy=\"{1:.2f}\" r=\"4\"/><text x=\"{2:.2f}\" y=\"{1:.2f}\">{3}</text>",
        p[0], p[1], p[0] + 7, html_escaped(probe.name), is_hidden ? "ring" : "probe");
  }
  return svg + "</svg>\n";
}

std::string attitude_map(const std::vector<RankedDrop>& drops, std::size_t worst, const std::string& what,
                         bool is_least_worst) {
  constexpr double width = 440, height = 260, radius = 84;
  const auto [low, high] = std::ranges::minmax(drops, {}, &RankedDrop::value);
  // By equal ratios, since peaks differ by orders.
  const double ratio = low.value > 0 ? std::pow(high.value / low.value, 1 / static_cast<double>(colours.size())) : 1;
  const auto level_of = [&](double value) {
    const double level = ratio > 1 ? std::log(value / low.value) / std::log(ratio) : 0;
    return std::min(static_cast<std::size_t>(level), colours.size() - 1);
  };
  const auto colour_of = [&](std::size_t level) {
    return colours[is_least_worst ? colours.size() - 1 - level : level];
  };
  const auto place = [&](const Vector3& down) -> Point {
    const double across = std::hypot(down.x(), down.y());
    const double out = across > 0 ? radius * std::sqrt(1 - std::fabs(down.z())) / across : 0;
    return {(down.z() < 0 ? 1 : 3) * width / 4 + out * down.x(), 105 - out * down.y()};
  };
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", width, height,
                                html_escaped(what + " by which way is down"));
  for (const int half : {1, 3}) {
    const double x = half * width / 4;
    svg += fmt::format(
        "<circle class=\"rim\" cx=\"{0}\" cy=\"105\" r=\"{1}\"/><text class=\"middle\" x=\"{0}\" y=\"{2}\">"
        "{3} side down</text><text x=\"{4}\" y=\"109\">+x</text><text class=\"end\" x=\"{5}\" "
        "y=\"109\">-x</text><text class=\"middle\" x=\"{0}\" y=\"12\">+y</text>",
        x, radius, 105 + radius + 16, half == 1 ? "-z" : "+z", x + radius + 2, x - radius - 2);
  }
  std::vector<std::size_t> order(drops.size());
  std::iota(order.begin(), order.end(), 0U);
  // The worst above the others.
  std::ranges::sort(order, {}, [&](std::size_t i) { return is_least_worst ? -drops[i].value : drops[i].value; });
  for (const std::size_t i : order) {
    const Point p = place(drops[i].down);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"><title>{}</title></circle>", p[0], p[1],
                       colour_of(level_of(drops[i].value)), html_escaped(drops[i].words));
  }
  const Point p = place(drops[worst].down);
  svg += fmt::format("<circle class=\"ring\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\"/>", p[0], p[1]);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double x = 8 + 82 * static_cast<double>(i);
    svg += fmt::format(
        "<rect x=\"{:.0f}\" y=\"225\" width=\"10\" height=\"10\" fill=\"{}\"/><text x=\"{:.0f}\" y=\"234\">"
        "to {}</text>",
        x, colour_of(i), x + 14, significant(low.value * std::pow(ratio, static_cast<double>(i + 1)), 3));
  }
  return svg + fmt::format("<text x=\"8\" y=\"252\">{}</text></svg>\n", html_escaped(what));
}

}  // namespace clatter::validation
