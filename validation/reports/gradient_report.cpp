// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/gradient_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "analytic/base/errors.hpp"
#include "analytic/plane/body_motion.hpp"
#include "analytic/plane/gradient.hpp"
#include "validation/output/number.hpp"
#include "validation/record/names.hpp"
#include "validation/scene/scene_value.hpp"

namespace clatter::validation::inline reports {
namespace {

using analytic::DropParameter;
using analytic::ImpactGradient;

/// A number of an impact, and its derivative's column.
struct GradientNumber {
  const char *name, *heading, *unit, *meaning;
  double ImpactGradient::*number;
  bool shown;
};
constexpr std::array gradient_numbers{
    GradientNumber{"start", "t", "s", "time since the first touch", &ImpactGradient::time, true},
    GradientNumber{"inclination", "α", "rad", "inclination at the impact, a lower: positive",
                   &ImpactGradient::inclination, true},
    GradientNumber{"velocity_after_z", "Vₙ", "m/s", "of the centre of mass after it, up", &ImpactGradient::normal,
                   true},
    GradientNumber{"velocity_after_x", "Vₜ", "m/s", "of the centre of mass after it, to the right",
                   &ImpactGradient::tangential, false},
    GradientNumber{"angular_velocity_after_y", "Ω", "rad/s", "after it, positive clockwise on the page",
                   &ImpactGradient::angular, true},
    GradientNumber{"impulse_normal", "Pₙ", "N·s", "normal impulse", &ImpactGradient::normal_impulse, true},
    GradientNumber{"impulse_tangential", "Pₜ", "N·s", "tangential impulse, to the right",
                   &ImpactGradient::tangential_impulse, false}};

/// A number of the drop: its name in rows, and the unit that derivatives are taken per.
struct Parameter {
  DropParameter index;
  std::string name, unit;
};

std::vector<Parameter> parameters_of(const Scene& scene) {
  const Parameter fall = scene.height      ? Parameter{DropParameter::speed, "height", "m"}
                         : scene.clearance ? Parameter{DropParameter::speed, "clearance", "m"}
                                           : Parameter{DropParameter::speed, "speed", "m/s"};
  const bool is_ratio = scene.impact.impulse_ratio.has_value();
  return {{DropParameter::angle, "angle", "rad"},
          fall,
          {DropParameter::restitution, "restitution", "1"},
          {DropParameter::friction, is_ratio ? "impulse ratio" : "friction", "1"}};
}

ImpactGradient combined(const ImpactGradient& a, double of_a, const ImpactGradient& b, double of_b) {
  ImpactGradient sum;
  for (const GradientNumber& one : gradient_numbers) sum.*one.number = of_a * (a.*one.number) + of_b * (b.*one.number);
  return sum;
}

/// By the height h above the ground, v = √(2 g (h − z)), z = −d_n the centre's height at the touch: ∂v/∂h = g/v, and at
/// a fixed h  ∂v/∂α = g d_t/v  of the point that touches.
void take_height(const Scene& scene, const analytic::Drop& drop, analytic::SequenceGradient& gradient) {
  const double per_height = drop.gravity / -drop.velocity.normal;
  const analytic::BodyMotion motion(drop.body, drop.inclination, drop.velocity, drop.gravity, drop.gravity_along);
  const double arm = motion.contact_point(std::countr_zero(motion.lowest_vertices())).tangential;
  const double per_angle = scene.height ? per_height * arm : 0;
  for (analytic::GradientRow& row : gradient.rows) {
    auto& [of_angle, of_speed, of_e, of_mu] = row.of;
    auto& [angle_error, speed_error, e_error, mu_error] = row.error;
    of_angle = combined(of_angle, 1, of_speed, per_angle);
    angle_error = combined(angle_error, 1, speed_error, std::fabs(per_angle));
    of_speed = combined(of_speed, per_height, {}, 0);
    speed_error = combined(speed_error, per_height, {}, 0);
  }
  auto& [of_angle, of_speed, of_e, of_mu] = gradient.refused;
  if (scene.height && of_speed.from < of_angle.from) of_angle = of_speed;  // whose speed the angle changes
}

Row row_of(std::size_t n, const std::string& end, const Parameter& parameter, const analytic::GradientRow& row) {
  const auto i = static_cast<std::size_t>(parameter.index);
  Row cells{Cell(static_cast<long long>(n + 1)), Cell(end), Cell(parameter.name), Cell(parameter.unit)};
  for (const GradientNumber& one : gradient_numbers) {
    const double value = row.of[i].*one.number, error = row.error[i].*one.number;
    cells.emplace_back(value, value == 0 ? 1 : std::min(6, known_digits(value, error)));
  }
  for (const GradientNumber& one : gradient_numbers) cells.emplace_back(rounded_up(row.error[i].*one.number));
  return cells;
}

/// "angle: none from impact 2 on: ..."
std::string refusal_words(const Parameter& parameter, const analytic::GradientRefusal& refusal) {
  const std::string from = refusal.from == 0 ? "none" : fmt::format("none from impact {} on", refusal.from + 1);
  return fmt::format("{}: {}: {}", parameter.name, from, refusal.reason);
}

/// Impacts whose sequence errors leave open: folds, and what comes after them.
std::string open_words(const analytic::SequenceGradient& gradient) {
  if (gradient.sequence.rows.size() == gradient.rows.size()) return "";
  return fmt::format(
      "no derivatives from impact {} on: it grazes or another may come first, within the drop's rounding",
      gradient.rows.size() + 1);
}

void add_rows(const std::vector<Parameter>& parameters, const analytic::SequenceGradient& gradient, Report& report) {
  for (std::size_t n = 0; n < gradient.rows.size(); ++n) {
    const std::string end = analytic::PlanarBody::vertex_set_name(gradient.rows[n].vertices);
    for (const Parameter& one : parameters) {
      if (n >= gradient.refused[static_cast<std::size_t>(one.index)].from) continue;
      report.grid.rows.push_back(row_of(n, end, one, gradient.rows[n]));
    }
  }
  report.fields["gradients"] = report.grid.rows.empty() ? Value{Value::List{}} : row_objects(report.grid);
}

/// @returns the first that is a shortfall: not that of a restitution which the ground's damping gives
std::string add_refusals(const std::vector<Parameter>& parameters, const analytic::SequenceGradient& gradient,
                         Report& report) {
  const std::string open = open_words(gradient);
  std::string shortfall = open;
  Value refused{Value::List{}};
  for (const Parameter& one : parameters) {
    const analytic::GradientRefusal& refusal = gradient.refused[static_cast<std::size_t>(one.index)];
    if (refusal.reason.empty()) continue;
    report.notes.push_back(refusal_words(one, refusal));
    refused.push_back(Value::Fields{{"parameter", one.name},
                                    {"from_impact", static_cast<long long>(refusal.from + 1)},
                                    {"reason", refusal.reason}});
    const bool is_of_ground = one.index == DropParameter::restitution && refusal.from == 0;
    if (shortfall.empty() && !is_of_ground) shortfall = report.notes.back();
  }
  if (!open.empty()) report.notes.push_back(open);
  report.fields["refused"] = std::move(refused);
  return shortfall;
}

}  // namespace

std::vector<Column> gradient_columns() {
  std::vector<Column> columns{{"n", "n", "", "number of the impact"},
                              word_column("end", "end", "what strikes"),
                              word_column("parameter", "∂/∂", "number of the drop that derivatives are taken of"),
                              word_column("parameter_unit", "per", "unit of that number; angles in radians")};
  for (const GradientNumber& one : gradient_numbers) {
    columns.push_back({one.name, std::string("∂") + one.heading, one.unit,
                       std::string("derivative of the ") + one.meaning + "; its unit over that of the parameter",
                       one.shown});
  }
  for (std::size_t k = 0; k < gradient_numbers.size(); ++k) columns.push_back(error_column(columns[4 + k]));
  return columns;
}

GradientReport gradient_report(const PreparedScene& prepared) {
  const auto* const drop = std::get_if<analytic::Drop>(&prepared.drop);
  if (drop == nullptr) throw analytic::OutsideModelError("gradient: the drop leaves its plane, where alone it has one");
  const Scene& scene = prepared.scene;
  analytic::SequenceGradient gradient = sequence_gradient(*drop, scene.most_impacts());
  if (scene.falls()) take_height(scene, *drop, gradient);
  const double approach = first_approach_speed(prepared.drop);
  GradientReport made{.report = begun_report("gradient", "derivatives of the impact sequence"), .shortfall = {}};
  Report& report = made.report;
  report.head = scene_head(scene, Model::discrete, approach);
  report.fields["model"] = "discrete";
  report.fields["scene"] = scene_value(scene, Model::discrete, approach);
  report.grid.columns = gradient_columns();
  report.grid.leading = 3;
  for (Column& column : report.grid.columns) {
    const bool is_of_friction = column.name == "velocity_after_x" || column.name == "impulse_tangential";
    if (is_of_friction && drop->law.friction != analytic::FrictionKind::none) column.shown = true;
  }
  add_rows(parameters_of(scene), gradient, report);
  made.shortfall = add_refusals(parameters_of(scene), gradient, report);
  report.fields["outcome"] = outcome_name(gradient.sequence.outcome);
  report.fields["shortfall"] = text_or_nothing(made.shortfall);
  return made;
}

}  // namespace clatter::validation::inline reports
