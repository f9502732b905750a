// Fig. 8: where the thin rod is between its first two impacts, below, at and above the fold of β.
#include <cmath>

#include "analytic/contact_angles.hpp"
#include "validation/figures/figures.hpp"

namespace clatter::validation {
namespace {

using analytic::Angle;
using analytic::ContactAngles;
using analytic::degrees_per_radian;

constexpr int instants = 9;                                 // in each panel, both ends of the flight included
constexpr double turned_beyond_upright = analytic::pi / 6;  // at the last instant of a rod that takes off

struct Panel {
  std::string title;
  Angle theta;
};

/// Two cases of the paper's (a): the centre still moves down after impact 1 below 54.7356°, and up above it (E7).
std::vector<Panel> panels() {
  const Angle fold = Angle::from_radians(regime_boundary(analytic::ImpactNumber::second, {}).theta);
  return {{"(a1) 45°: two impacts, the centre moves down in between", Angle::from_degrees(45)},
          {"(a2) 56.5°: two impacts, the centre moves up in between", Angle::from_degrees(56.5)},
          {"(b) 58.488°: end b touches with no speed", fold},
          {"(c) 65°: one impact, the rod takes off", Angle::from_degrees(65)}};
}

/// What a row says besides panel and θ.
struct Position {
  int impacts;  ///< so far
  double time, inclination, height, velocity, angular;
};

void add_row(Figure& figure, double panel, double theta, const Position& p) {
  const double x = std::cos(p.inclination) / 2, z = std::sin(p.inclination) / 2;
  figure.rows.push_back({panel, theta * degrees_per_radian, static_cast<double>(p.impacts), p.time,
                         p.inclination * degrees_per_radian, -x, p.height - z, 0, p.height, x, p.height + z, p.velocity,
                         p.angular, p.velocity + p.angular * x, p.velocity - p.angular * x});
}

/// The flight after impact 1 at even instants; at its end, if there is an impact 2, the rod before and after it.
void add_rows(Figure& figure, double panel, const Angle& theta) {
  const ContactAngles angles = contact_angles(theta, {});
  const bool strikes = angles.impacts() > 1;
  const double velocity = angles.velocity[0], angular = angles.angular[0], start = theta.radians;
  const double last = strikes ? -angles.beta.angle : -analytic::pi / 2 - turned_beyond_upright;
  const double duration = strikes ? angles.beta.time : (start - last) / angular;
  for (int i = 0; i < instants; ++i) {
    const double time = duration * i / (instants - 1);
    const double inclination = i + 1 == instants ? last : start - angular * time;
    add_row(figure, panel, start, {1, time, inclination, theta.sine / 2 + velocity * time, velocity, angular});
  }
  if (!strikes) return;
  add_row(figure, panel, start,
          {2, duration, last, theta.sine / 2 + velocity * duration, angles.velocity[1], angles.angular[1]});
}

}  // namespace

Figure figure_rod_positions() {
  Figure figure{.number = 8,
                .title = "positions of the rod from the first impact to the second, below, at and above the fold",
                .scene = "thin rod, m = L = |v_n| = 1, omega = 0, e = 1, no friction, no gravity; discrete model",
                .columns = {{"panel", "1", "1: (a1), 2: (a2), 3: (b), 4: (c)"},
                            {"theta", "deg", "contact angle of the first impact"},
                            {"impacts", "1", "impacts so far; 2: just after the second one"},
                            {"time", "L/|v_n|", "since the first impact"},
                            {"inclination", "deg", "of the rod; positive: end a is the lower one"},
                            {"x_a", "L", "of end a, which strikes first"},
                            {"z_a", "L", "height of end a"},
                            {"x_centre", "L", "of the mass centre"},
                            {"z_centre", "L", "height of the mass centre"},
                            {"x_b", "L", "of end b"},
                            {"z_b", "L", "height of end b"},
                            {"V_centre", "|v_n|", "normal velocity of the mass centre"},
                            {"Omega", "|v_n|/L", "angular velocity; positive: clockwise"},
                            {"V_a", "|v_n|", "normal velocity of end a"},
                            {"V_b", "|v_n|", "normal velocity of end b"}},
                .rows = {},
                .plots = {}};
  double number = 1;
  for (const auto& [title, theta] : panels()) {
    add_rows(figure, number, theta);
    FigurePlot plot{
        .title = title, .x_label = "x [L]", .y_label = "z [L]", .curves = {}, .x = {-0.8, 0.8}, .y = {0, 1.3}};
    plot.equal_scales = true;
    const RowFilter panel{{"panel", number}};
    plot.curves.push_back({.x = "x_a",
                           .y = "z_a",
                           .legend = "rod",
                           .style = FigureCurve::Style::segments,
                           .where = panel,
                           .x_end = "x_b",
                           .y_end = "z_b"});
    for (const auto& [end, legend] : {std::pair{"a", "end a"}, {"b", "end b"}, {"centre", "centre"}}) {
      plot.curves.push_back({.x = std::string("x_") + end,
                             .y = std::string("z_") + end,
                             .legend = legend,
                             .style = FigureCurve::Style::points,
                             .where = panel});
    }
    figure.plots.push_back(plot);
    ++number;
  }
  return figure;
}

}  // namespace clatter::validation
