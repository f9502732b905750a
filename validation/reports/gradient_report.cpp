// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/gradient_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <variant>

#include "analytic/plane/body_motion.hpp"
#include "analytic/plane/gradient.hpp"
#include "analytic/space/gradient.hpp"
#include "analytic/space/point_height.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/scene_value.hpp"

namespace clatter::validation::inline reports {
namespace {

namespace space = analytic::space;

/// A number of an impact whose derivatives are told: a column.
struct GradientNumber {
  const char *name, *heading, *unit, *meaning;
  bool shown;
};
constexpr std::array numbers_in_plane{
    GradientNumber{"start", "t", "s", "time since the first touch", true},
    GradientNumber{"inclination", "α", "rad", "inclination at the impact, a lower: positive", true},
    GradientNumber{"velocity_after_z", "Vₙ", "m/s", "velocity of the centre of mass after it, up", true},
    GradientNumber{"velocity_after_x", "Vₜ", "m/s", "velocity of the centre of mass after it, to the right", false},
    GradientNumber{"angular_velocity_after_y", "Ω", "rad/s", "spin after it, positive clockwise on the page", true},
    GradientNumber{"impulse_normal", "Pₙ", "N·s", "normal impulse", true},
    GradientNumber{"impulse_tangential", "Pₜ", "N·s", "tangential impulse, to the right", false}};
constexpr std::array numbers_in_space{
    GradientNumber{"start", "t", "s", "time since the first touch", true},
    GradientNumber{"turn_x", "θx", "rad", "attitude at the impact, as a small turn about the world's x", false},
    GradientNumber{"turn_y", "θy", "rad", "the same about y", false},
    GradientNumber{"turn_z", "θz", "rad", "the same about z", false},
    GradientNumber{"velocity_after_x", "Vx", "m/s", "velocity of the centre of mass after it, x", true},
    GradientNumber{"velocity_after_y", "Vy", "m/s", "velocity of the centre of mass after it, y", true},
    GradientNumber{"velocity_after_z", "Vz", "m/s", "velocity of the centre of mass after it, up", true},
    GradientNumber{"angular_velocity_after_x", "ωx", "rad/s", "angular velocity after it, world x", true},
    GradientNumber{"angular_velocity_after_y", "ωy", "rad/s", "angular velocity after it, world y", true},
    GradientNumber{"angular_velocity_after_z", "ωz", "rad/s", "angular velocity after it, world z", true},
    GradientNumber{"impulse_x", "Px", "N·s", "impulse, x", true},
    GradientNumber{"impulse_y", "Py", "N·s", "impulse, y", true},
    GradientNumber{"impulse_z", "Pz", "N·s", "impulse, up", true}};

std::span<const GradientNumber> numbers_of(bool in_space) {
  if (in_space) return numbers_in_space;
  return numbers_in_plane;
}

/// Derivatives of an impact's numbers with respect to one of the drop, in the columns' order, with bounds on errors.
struct Derivatives {
  std::vector<double> value, error;

  /// Adds `other` × a factor.
  void add(const Derivatives& other, double factor) {
    for (std::size_t k = 0; k < value.size(); ++k) {
      value[k] += factor * other.value[k];
      error[k] += std::fabs(factor) * other.error[k];
    }
  }
  void scale(double factor) {
    for (double& one : value) one *= factor;
    for (double& one : error) one *= std::fabs(factor);
  }
};

/// A number of the drop: its name in rows, the unit that derivatives are taken per, its derivatives of each impact.
struct Parameter {
  std::string name, unit;
  std::vector<Derivatives> impacts{};
  analytic::GradientRefusal refused{};
};

/// The derivatives of either model's drop.
struct Found {
  std::vector<Parameter> parameters;  ///< angle, in space tilt, speed, restitution, friction
  std::size_t rows = 0;               ///< that have derivatives
  DiscreteSequence sequence;
};

std::vector<Parameter> parameters_of(const Scene& scene, bool in_space) {
  const Parameter fall = scene.height      ? Parameter{"height", "m"}
                         : scene.clearance ? Parameter{"clearance", "m"}
                                           : Parameter{"speed", "m/s"};
  std::vector<Parameter> all{{"angle", "rad"}};
  if (in_space) all.push_back({"tilt", "rad"});
  all.insert(all.end(), {fall, {"restitution", "1"}, {scene.impact.impulse_ratio ? "impulse ratio" : "friction", "1"}});
  return all;
}

Derivatives listed(const analytic::ImpactGradient& g, const analytic::ImpactGradient& error) {
  const auto list = [](const analytic::ImpactGradient& one) {
    return std::vector{one.time,           one.inclination,       one.normal, one.tangential, one.angular,
                       one.normal_impulse, one.tangential_impulse};
  };
  return {list(g), list(error)};
}

Derivatives listed(const space::SpaceImpactGradient& g, const space::SpaceGradientError& error) {
  Derivatives d{{g.time}, {error.time}};
  const auto add = [&](const space::Vector3& vector, double bar) {
    d.value.insert(d.value.end(), vector.begin(), vector.end());
    d.error.insert(d.error.end(), 3, bar);
  };
  add(g.attitude, error.attitude);
  add(g.velocity, error.velocity);
  add(g.angular_velocity, error.angular_velocity);
  add(g.impulse, error.impulse);
  return d;
}

template <class Gradient>
Found found(const Scene& scene, bool in_space, Gradient gradient) {
  Found all{parameters_of(scene, in_space), gradient.rows.size(), std::move(gradient.sequence)};
  for (std::size_t i = 0; i < all.parameters.size(); ++i) {
    all.parameters[i].refused = gradient.refused[i];
    for (const auto& row : gradient.rows) all.parameters[i].impacts.push_back(listed(row.of[i], row.error[i]));
  }
  return all;
}

/// How a turn moves the point that touches, along the ground: by it the centre's height at the touch sinks.
double arm_of_turn(const analytic::Drop& drop, std::size_t) {
  const analytic::BodyMotion motion(drop.body, drop.inclination, drop.velocity, drop.gravity, drop.gravity_along);
  return motion.contact_point(std::countr_zero(motion.lowest_vertices())).tangential;
}
double arm_of_turn(const space::Drop& drop, std::size_t turn) {
  const space::Vector3 axis = turn_of(drop, static_cast<space::SpaceParameter>(turn));
  double lowest = std::numeric_limits<double>::infinity();
  space::Vector3 arm = space::Vector3::Zero();
  for (int i = 0; i < drop.body.points(); ++i) {
    const space::Vector3 one = drop.attitude * space::touching_place(drop.body, drop.attitude, i);
    if (one.z() < lowest) lowest = one.z(), arm = one;
  }
  return axis.cross(arm).z();
}

/// By the height h above the ground, v = √(2 g (h − z)), z the centre's height at the touch: ∂v/∂h = g/v, and at a
/// fixed h  ∂v/∂α = g/v × (the turn × the arm of the point that touches)_z.
template <class Drop>
void take_height(const Scene& scene, const Drop& drop, double fall_speed, Found& all) {
  const double per_height = drop.gravity / fall_speed;
  const std::size_t speed = all.parameters.size() - 3;
  Parameter& fall = all.parameters[speed];
  for (std::size_t turn = 0; scene.height && turn < speed; ++turn) {
    Parameter& one = all.parameters[turn];
    const double per_turn = per_height * arm_of_turn(drop, turn);
    for (std::size_t n = 0; n < all.rows; ++n) one.impacts[n].add(fall.impacts[n], per_turn);
    if (fall.refused.from < one.refused.from) one.refused = fall.refused;  // whose speed the turn changes
  }
  for (Derivatives& one : fall.impacts) one.scale(per_height);
}

Found found_of(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  const int most = scene.most_impacts();
  if (const auto* const drop = std::get_if<space::Drop>(&prepared.drop)) {
    Found all = found(scene, true, space::sequence_gradient(*drop, most));
    if (scene.falls()) take_height(scene, *drop, -drop->velocity.z(), all);
    return all;
  }
  const auto& drop = std::get<analytic::Drop>(prepared.drop);
  Found all = found(scene, false, analytic::sequence_gradient(drop, most));
  if (scene.falls()) take_height(scene, drop, -drop.velocity.normal, all);
  return all;
}

Row row_of(std::size_t n, const std::string& end, const Parameter& parameter) {
  const Derivatives& of = parameter.impacts[n];
  Row cells{Cell(static_cast<long long>(n + 1)), Cell(end), Cell(parameter.name), Cell(parameter.unit)};
  for (std::size_t k = 0; k < of.value.size(); ++k) {
    cells.emplace_back(of.value[k], of.value[k] == 0 ? 1 : std::min(6, known_digits(of.value[k], of.error[k])));
  }
  for (const double error : of.error) cells.emplace_back(rounded_up(error));
  return cells;
}

/// "angle: none from impact 2 on: ..."
std::string refusal_words(const Parameter& parameter) {
  const analytic::GradientRefusal& refusal = parameter.refused;
  const std::string from = refusal.from == 0 ? "none" : fmt::format("none from impact {} on", refusal.from + 1);
  return fmt::format("{}: {}: {}", parameter.name, from, refusal.reason);
}

/// Impacts whose sequence errors leave open: folds, and what comes after them.
std::string open_words(std::size_t derived, std::size_t impacts) {
  if (impacts == derived) return "";
  return fmt::format(
      "no derivatives from impact {} on: it grazes or another may come first, within the drop's rounding", derived + 1);
}

void add_rows(const Found& all, const Run& run, Report& report) {
  for (std::size_t n = 0; n < all.rows; ++n) {
    const Impact& impact = run.impacts[n];
    const std::string& end = impact.corners.empty() ? impact.end : impact.corners;
    for (const Parameter& one : all.parameters) {
      if (n < one.refused.from) report.grid.rows.push_back(row_of(n, end, one));
    }
  }
  report.fields["gradients"] = report.grid.rows.empty() ? Value{Value::List{}} : row_objects(report.grid);
}

/// @returns the first that is a shortfall: not that of a restitution which the ground's damping gives
std::string add_refusals(const Found& all, std::size_t impacts, Report& report) {
  const std::string open = open_words(all.rows, impacts);
  std::string shortfall = open;
  Value refused{Value::List{}};
  for (const Parameter& one : all.parameters) {
    if (one.refused.reason.empty()) continue;
    report.notes.push_back(refusal_words(one));
    refused.push_back(Value::Fields{{"parameter", one.name},
                                    {"from_impact", static_cast<long long>(one.refused.from + 1)},
                                    {"reason", one.refused.reason}});
    const bool is_of_ground = one.name == "restitution" && one.refused.from == 0;
    if (shortfall.empty() && !is_of_ground) shortfall = report.notes.back();
  }
  if (!open.empty()) report.notes.push_back(open);
  report.fields["refused"] = std::move(refused);
  return shortfall;
}

}  // namespace

std::vector<Column> gradient_columns(bool in_space) {
  std::vector<Column> columns{{"n", "n", "", "number of the impact"},
                              word_column("end", "end", "what strikes"),
                              word_column("parameter", "∂/∂", "number of the drop that derivatives are taken of"),
                              word_column("parameter_unit", "per", "unit of that number; angles in radians")};
  const auto numbers = numbers_of(in_space);
  for (const GradientNumber& one : numbers) {
    columns.push_back({one.name, std::string("∂") + one.heading, one.unit,
                       std::string("derivative of the ") + one.meaning + "; its unit over that of the parameter",
                       one.shown});
  }
  for (std::size_t k = 0; k < numbers.size(); ++k) columns.push_back(error_column(columns[4 + k]));
  return columns;
}

GradientReport gradient_report(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  const bool in_space = std::holds_alternative<space::Drop>(prepared.drop);
  const Found all = found_of(prepared);
  const Run run = named_run(scene, all.sequence, prepared.centre);
  const double approach = first_approach_speed(prepared.drop);
  GradientReport made{.report = begun_report("gradient", "derivatives of the impact sequence"), .shortfall = {}};
  Report& report = made.report;
  report.head = scene_head(scene, Model::discrete, approach);
  report.fields["model"] = "discrete";
  report.fields["scene"] = scene_value(scene, Model::discrete, approach);
  report.grid.columns = gradient_columns(in_space);
  report.grid.leading = 3;
  for (Column& column : report.grid.columns) {
    const bool is_of_friction = column.name == "velocity_after_x" || column.name == "impulse_tangential";
    if (is_of_friction && law_of(prepared.drop).friction != analytic::FrictionKind::none) column.shown = true;
  }
  add_rows(all, run, report);
  made.shortfall = add_refusals(all, run.impacts.size(), report);
  report.fields["outcome"] = run.outcome;
  report.fields["shortfall"] = text_or_nothing(made.shortfall);
  return made;
}

}  // namespace clatter::validation::inline reports
