// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/facet_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

/// The error of an impact, as a part of its numbers.
std::string facet_part(double inside, const numeric::ImpactRecord& row) {
  const double part = inside / row.value.indentation;
  return part < 1 ? shortest(rounded_up(100 * part)) + " %" : "all";
}

constexpr double thin_part = 0.01;  ///< of the length: the radius of the rod that a thin one is given

/// How much a small error of the motion grows from one impact's end to the next one's.
double growth(double before, double after) {
  if (std::isnan(before + after)) return std::numeric_limits<double>::infinity();
  return std::max(after / before, 1.0);
}

/// The sizes that relative errors of an impact are of.
struct ImpactSizes {
  double speed, spin, energy;

  ImpactSizes(const numeric::ImpactRecord& row, const numeric::Vector3& spin_before, const BodyScene& body)
      : speed(row.value.impulse.norm() / body.mass), spin(spin_before.norm() + row.value.angular_velocity_after.norm() +
                                                          speed / std::hypot(body.length / 2, body.radius)),
        energy(std::max(std::fabs(row.value.energy_before), body.mass * speed * speed / 2)) {}
};

/// @param before  relative error with which the impact begins
/// @param part  that of its facets
void add_to(numeric::ImpactRecord& row, const ImpactSizes& sizes, double before, double part) {
  using Record = numeric::ImpactNumbers;
  const double after = before + part;
  const Record& value = row.value;
  Record& error = row.error;
  error.start += before * value.start;
  for (double* angle : {&error.inclination, &error.contact_angle}) *angle += before;
  error.approach_speed += before * value.approach_speed;
  for (const auto member : {&Record::duration, &Record::peak_force, &Record::indentation})
    error.*member += after * value.*member;
  error.restitution += after * (1 + std::fabs(value.restitution));
  error.peak_time += after * value.duration;
  const std::pair<numeric::Vector3 Record::*, double> vectors[] = {{&Record::impulse, value.impulse.norm()},
                                                                   {&Record::velocity_after, sizes.speed},
                                                                   {&Record::angular_velocity_after, sizes.spin}};
  for (const auto& [member, size] : vectors) {
    for (int i = 0; i < 3; ++i) {  // what symmetry makes 0 stays so
      if ((value.*member)[i] != 0) (error.*member)[i] += after * size + before * (value.*member).norm();
    }
  }
  error.energy_before += before * sizes.energy;
  for (const auto member : {&Record::energy_after, &Record::energy_loss, &Record::work_damping, &Record::work_friction,
                            &Record::work_released}) {
    if (value.*member != 0) error.*member += after * sizes.energy;
  }
}

/// @param since  the touch-down of the last impact [s], from which the state goes away by the error of its velocity
void add_to(numeric::StateRecord& state, const ImpactSizes& sizes, double relative, double since) {
  state.error.position += relative * sizes.speed * since;
  state.error.angle += relative * sizes.spin * since;
  state.error.velocity += relative * sizes.speed;
  state.error.angular_velocity += relative * sizes.spin;
  state.error.energy += relative * sizes.energy;
}

/// How far the facets of a mesh that stands for a round body lie inside its surface, at most [m]; 0: none stands for
/// one. R (1 − cos(π/n)) beside a rod's axis; a sphere's facet spans a cap in which one meridian's cosine is added as a
/// factor. What maps a unit ball to an ellipsoid stretches no distance by more than its longest semiaxis.
double facet_depth(const BodyScene& body) {
  if (!body.traits().has_sectors || body.is_smooth()) return 0;
  const double around = std::cos(std::numbers::pi / body.meshed_sectors());
  if (body.shape == BodyScene::Shape::rod) return body.meshed_radius() * (1 - around);
  const double along = std::cos(std::numbers::pi / (4 * body.meshed_rings()));
  const double radius = body.has_size() ? body.size.maxCoeff() / 2 : body.meshed_radius();
  return radius * (1 - around * along);
}

}  // namespace

void add_facet_errors(const Scene& scene, numeric::Simulation& run) {
  const BodyScene& body = scene.body;
  const bool is_chosen = body.shape == BodyScene::Shape::rod && body.meshed_sectors() == body.own_sectors();
  if (!is_chosen || !(body.radius > thin_part * body.length)) return;
  const double inside = facet_depth(body);
  double error = 0, amplification = 1;
  numeric::Vector3 spin = scene.touch_angular_velocity();
  int row_number = 0;
  for (numeric::ImpactRecord& row : run.impacts) {
    ++row_number;
    const double before = error > 0 ? error * growth(amplification, row.amplification) : 0;
    const double part = std::min(inside / row.value.indentation, 1.0);
    add_to(row, {row, spin, body}, before, part);
    error = before + part;
    for (numeric::StateRecord& state : run.states) {
      if (state.impacts == row_number) add_to(state, {row, spin, body}, error, state.time - row.value.start);
    }
    amplification = row.amplification;
    spin = row.value.angular_velocity_after;
  }
}

std::string facet_words(const Scene& scene, const numeric::Simulation& run) {
  const double inside = facet_depth(scene.body);
  if (!(inside > 0)) return "";
  std::string words = fmt::format("facets: up to {} m inside the round surface", shortest(rounded_up(inside)));
  if (run.impacts.empty()) return words;
  const auto shallowest =
      std::ranges::min_element(run.impacts, {}, [](const numeric::ImpactRecord& row) { return row.value.indentation; });
  words += fmt::format("; the round body's depth and contact time may differ by {} in impact 1",
                       facet_part(inside, run.impacts.front()));
  const auto impact = shallowest - run.impacts.begin() + 1;
  if (impact > 1) words += fmt::format(", {} in impact {}", facet_part(inside, *shallowest), impact);
  return words + ", its peak force by half of that, its change of velocity by an eighth (as seen)";
}

}  // namespace clatter::validation
