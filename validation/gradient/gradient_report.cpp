// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/gradient/gradient_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "analytic/plane/body_motion.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/sequence/gradient.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;

constexpr std::array numbers_in_plane{
    GradientNumber{"start", "t", "s", "time since the first touch", true, "t"},
    GradientNumber{"inclination", "α", "rad", "inclination at the impact, a lower: positive", true, nullptr},
    GradientNumber{"velocity_after_z", "Vₙ", "m/s", "velocity of the centre of mass after it, up", true, "V"},
    GradientNumber{"velocity_after_x", "Vₜ", "m/s", "velocity of the centre of mass after it, to the right", false,
                   nullptr},
    GradientNumber{"angular_velocity_after_y", "Ω", "rad/s", "spin after it, positive clockwise on the page", true,
                   "Omega"},
    GradientNumber{"impulse_normal", "Pₙ", "N·s", "normal impulse", true, "Pn"},
    GradientNumber{"impulse_tangential", "Pₜ", "N·s", "tangential impulse, to the right", false, "Pt"}};
constexpr std::array numbers_in_space{
    GradientNumber{"start", "t", "s", "time since the first touch", true, "t"},
    GradientNumber{"turn_x", "θx", "rad", "attitude at the impact, as a small turn about the world's x", false,
                   nullptr},
    GradientNumber{"turn_y", "θy", "rad", "that about y", false, nullptr},
    GradientNumber{"turn_z", "θz", "rad", "that about z", false, nullptr},
    GradientNumber{"velocity_after_x", "Vx", "m/s", "velocity of the centre of mass after it, x", true, "Vx"},
    GradientNumber{"velocity_after_y", "Vy", "m/s", "velocity of the centre of mass after it, y", true, "Vy"},
    GradientNumber{"velocity_after_z", "Vz", "m/s", "velocity of the centre of mass after it, up", true, "Vz"},
    GradientNumber{"angular_velocity_after_x", "ωx", "rad/s", "angular velocity after it, world x", true, "Wx"},
    GradientNumber{"angular_velocity_after_y", "ωy", "rad/s", "angular velocity after it, world y", true, "Wy"},
    GradientNumber{"angular_velocity_after_z", "ωz", "rad/s", "angular velocity after it, world z", true, "Wz"},
    GradientNumber{"impulse_x", "Px", "N·s", "impulse, x", true, "Px"},
    GradientNumber{"impulse_y", "Py", "N·s", "impulse, y", true, "Py"},
    GradientNumber{"impulse_z", "Pz", "N·s", "impulse, up", true, "Pz"}};

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

DropGradient listed(std::vector<std::string> names, auto gradient) {
  DropGradient all{.parameters = {}, .rows = gradient.rows.size(), .sequence = std::move(gradient.sequence)};
  for (std::size_t i = 0; i < names.size(); ++i) {
    ParameterGradient& one = all.parameters.emplace_back();
    one.name = std::move(names[i]);
    one.refused = gradient.refused[i];
    for (const auto& row : gradient.rows) one.impacts.push_back(listed(row.of[i], row.error[i]));
  }
  return all;
}

double arm_of(const analytic::Drop& drop, std::size_t) {
  const analytic::BodyMotion motion(drop.body, drop.inclination, drop.velocity, drop.gravity, drop.gravity_along);
  return motion.contact_point(std::countr_zero(motion.lowest_vertices())).tangential;
}
double arm_of(const space::Drop& drop, std::size_t turn) {
  const space::Vector3 axis = turn_of(drop, static_cast<space::SpaceParameter>(turn));
  double lowest = std::numeric_limits<double>::infinity();
  space::Vector3 arm = space::Vector3::Zero();
  for (int i = 0; i < drop.body.points(); ++i) {
    const space::Vector3 one = drop.attitude * space::touching_place(drop.body, drop.attitude, i);
    if (one.z() < lowest) lowest = one.z(), arm = one;
  }
  return axis.cross(arm).z();
}

/// A number of the drop: its name in rows, and the unit that derivatives are taken per.
struct Parameter {
  std::string name, unit;
};

/// The parameters of a DropGradient, by name and unit.
std::vector<Parameter> parameters_of(const Scene& scene, bool in_space) {
  const Parameter fall = scene.height      ? Parameter{"height", "m"}
                         : scene.clearance ? Parameter{"clearance", "m"}
                                           : Parameter{"speed", "m/s"};
  std::vector<Parameter> all{{"angle", "rad"}};
  if (in_space) all.push_back({"tilt", "rad"});
  all.insert(all.end(), {fall, {"restitution", "1"}, {scene.impact.impulse_ratio ? "impulse ratio" : "friction", "1"}});
  return all;
}

/// By the height h above the ground, v = √(2 g (h − z)), z the centre's height at the touch: ∂v/∂h = g/v, and at a
/// fixed h  ∂v/∂α = g/v × arm_of_turn().
void take_height(const PreparedScene& prepared, DropGradient& gradient) {
  const auto* const drop = std::get_if<analytic::Drop>(&prepared.drop);
  const auto* const in_space = std::get_if<analytic::space::Drop>(&prepared.drop);
  const double per_height =
      drop != nullptr ? drop->gravity / -drop->velocity.normal : in_space->gravity / -in_space->velocity.z();
  const std::size_t speed = gradient.parameters.size() - 3;
  ParameterGradient& fall = gradient.parameters[speed];
  for (std::size_t turn = 0; prepared.scene.height && turn < speed; ++turn) {
    ParameterGradient& one = gradient.parameters[turn];
    const double per_turn = per_height * arm_of_turn(prepared.drop, turn);
    for (std::size_t n = 0; n < gradient.rows; ++n) one.impacts[n].add(fall.impacts[n], per_turn);
    if (fall.refused.from < one.refused.from) one.refused = fall.refused;  // whose speed the turn changes
  }
  for (Derivatives& one : fall.impacts) one.scale(per_height);
}

Row row_of(std::size_t n, const std::string& end, const Parameter& parameter, const Derivatives& of) {
  Row cells{Cell(static_cast<long long>(n + 1)), Cell(end), Cell(parameter.name), Cell(parameter.unit)};
  for (std::size_t k = 0; k < of.value.size(); ++k)
    cells.emplace_back(of.value[k], of.value[k] == 0 ? 1 : std::min(6, known_digits(of.value[k], of.error[k])));
  for (const double error : of.error) cells.emplace_back(rounded_up(error));
  return cells;
}

/// "angle: none from impact 2 on: ..."
std::string refusal_words(const Parameter& parameter, const analytic::GradientRefusal& refusal) {
  const std::string from = refusal.from == 0 ? "none" : fmt::format("none from impact {} on", refusal.from + 1);
  return fmt::format("{}: {}: {}", parameter.name, from, refusal.reason);
}

/// Impacts whose sequence errors leave open: folds, and what comes after them.
std::string open_words(std::size_t derived, std::size_t impacts) {
  if (impacts == derived) return "";
  return fmt::format(
      "no derivatives from impact {} on: it grazes or another may come first, within the drop's rounding", derived + 1);
}

void add_rows(const std::vector<Parameter>& parameters, const DropGradient& gradient, const Run& run, Report& report) {
  for (std::size_t n = 0; n < gradient.rows; ++n) {
    const Impact& impact = run.impacts[n];
    const std::string& end = impact.corners.empty() ? impact.end : impact.corners;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const Derivatives* const of = gradient.parameters[i].of(n);
      if (of != nullptr) report.grid.rows.push_back(row_of(n, end, parameters[i], *of));
    }
  }
  report.fields["gradients"] = report.grid.rows.empty() ? Value{Value::List{}} : row_objects(report.grid);
}

/// @returns the first that is a shortfall: not that of a restitution which the ground's damping gives
std::string add_refusals(const std::vector<Parameter>& parameters, const DropGradient& gradient, std::size_t impacts,
                         Report& report) {
  const std::string open = open_words(gradient.rows, impacts);
  std::string shortfall = open;
  Value refused{Value::List{}};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const analytic::GradientRefusal& refusal = gradient.parameters[i].refused;
    if (refusal.reason.empty()) continue;
    report.notes.push_back(refusal_words(parameters[i], refusal));
    refused.push_back(Value::Fields{{"parameter", parameters[i].name},
                                    {"from_impact", static_cast<long long>(refusal.from + 1)},
                                    {"reason", refusal.reason}});
    const bool is_of_ground = parameters[i].name == "restitution" && refusal.from == 0;
    if (shortfall.empty() && !is_of_ground) shortfall = report.notes.back();
  }
  if (!open.empty()) report.notes.push_back(open);
  report.fields["refused"] = std::move(refused);
  return shortfall;
}

struct GradientInput {
  SceneFlags scene;
  OutputChoice output;
};

int run_gradient(const GradientInput& input) {
  const PreparedScene prepared = read_discrete_flags(input.scene);
  check_files(input.output);
  const GradientReport made = gradient_report(prepared);
  write_report(input.output, made.report);
  if (!made.shortfall.empty()) say(made.shortfall);
  return made.status;
}

}  // namespace

std::span<const GradientNumber> gradient_numbers(bool in_space) {
  if (in_space) return numbers_in_space;
  return numbers_in_plane;
}

void Derivatives::add(const Derivatives& other, double factor) {
  for (std::size_t k = 0; k < value.size(); ++k) {
    value[k] += factor * other.value[k];
    error[k] += std::fabs(factor) * other.error[k];
  }
}

void Derivatives::scale(double factor) {
  for (double& one : value) one *= factor;
  for (double& one : error) one *= std::fabs(factor);
}

DropGradient drop_gradient(const DiscreteDrop& drop, int impacts) {
  if (const auto* const in_space = std::get_if<space::Drop>(&drop))
    return listed({"angle", "tilt", "speed", "restitution", "friction"}, space::sequence_gradient(*in_space, impacts));
  return listed({"angle", "speed", "restitution", "friction"},
                analytic::sequence_gradient(std::get<analytic::Drop>(drop), impacts));
}

double arm_of_turn(const DiscreteDrop& drop, std::size_t turn) {
  return std::visit([&](const auto& one) { return arm_of(one, turn); }, drop);
}

std::vector<Column> gradient_columns(bool in_space) {
  std::vector<Column> columns{{"n", "n", "", "number of the impact"},
                              word_column("end", "end", "what strikes"),
                              word_column("parameter", "∂/∂", "number of the drop that derivatives are taken of"),
                              word_column("parameter_unit", "per", "unit of that number; angles in radians")};
  const auto numbers = gradient_numbers(in_space);
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
  const bool in_space = std::holds_alternative<analytic::space::Drop>(prepared.drop);
  if (scene.is_released())
    throw BadInput("drop.release: must be left out for clatter gradient, whose numbers are those of the touch");
  const std::vector<Parameter> parameters = parameters_of(scene, in_space);
  DropGradient gradient = drop_gradient(prepared.drop, scene.most_impacts());
  if (scene.falls()) take_height(prepared, gradient);
  const Run run = named_run(scene, gradient.sequence, prepared.centre);
  const double approach = first_approach_speed(prepared.drop);
  GradientReport made{
      .report = begun_report("gradient", "derivatives of the impact sequence"), .shortfall = {}, .status = 0};
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
  add_rows(parameters, gradient, run, report);
  const std::string refused = add_refusals(parameters, gradient, run.impacts.size(), report);
  made.shortfall = run.is_cut_short ? shortfall(scene, run) : refused;
  if (!made.shortfall.empty()) made.status = shortfall_status(run);
  report.fields["outcome"] = run.outcome;
  report.fields["shortfall"] = text_or_nothing(made.shortfall);
  return made;
}

/// `clatter gradient SCENE`
Command gradient_command() {
  return command_of<GradientInput>(run_gradient, [](Command& command, GradientInput& input) {
    add_scene_flags(command, input.scene, Model::discrete);
    add_output_options(command, input.output);
    command.footer =
        "Example: clatter gradient --angle 10 --gravity 9.81 --restitution 0.8 --impacts 3\n"
        "With respect to the angle and in space the tilt (per radian), the speed or height, restitution and\n"
        "friction. None at a fold, where an impact grazes, and where drops on both sides have other impacts:\n"
        "exit status 3.";
    command.columns = {{"gradient", [] { return with_more(gradient_columns(false), gradient_columns(true)); }}};
  });
}

}  // namespace clatter::validation
