// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/gradient/drop_gradient.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "analytic/plane/body_motion.hpp"
#include "analytic/space/gradient.hpp"
#include "analytic/space/point_height.hpp"

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

template <class Gradient>
DropGradient listed(std::vector<std::string> names, Gradient gradient) {
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
  if (const auto* const in_space = std::get_if<space::Drop>(&drop)) {
    return listed({"angle", "tilt", "speed", "restitution", "friction"}, space::sequence_gradient(*in_space, impacts));
  }
  return listed({"angle", "speed", "restitution", "friction"},
                analytic::sequence_gradient(std::get<analytic::Drop>(drop), impacts));
}

double arm_of_turn(const DiscreteDrop& drop, std::size_t turn) {
  return std::visit([&](const auto& one) { return arm_of(one, turn); }, drop);
}

}  // namespace clatter::validation
