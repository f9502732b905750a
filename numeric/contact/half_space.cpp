// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/half_space.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/contact/pad_contact.hpp"
#include "numeric/contact/smooth_contact.hpp"

namespace clatter::numeric {
namespace {

constexpr double part_of_change = 1e-5;  ///< of the time in which the load changes: half the central difference

Ground springs_of(const Ground& ground) {
  Ground springs = ground;
  springs.modulus = 0;
  springs.area = AreaMeasure::projected;
  return springs;
}

}  // namespace

struct HalfSpaceContact::Evaluation {
  ContactLoad load;
  HalfSpacePressure elastic;
  double rubbing = 0;  ///< stiffness of the springs that rub [N/m³]
};

HalfSpaceContact::HalfSpaceContact(const Body& body, const Ground& ground)
    : modulus_(ground.modulus), dissipation_(ground.dissipation), springs_(springs_of(ground)) {
  for (Bed* const bed : {&bed_, &beside_}) bed->surface = contact_surface(body, springs_, &bed->footprint);
}

HalfSpaceContact::Evaluation HalfSpaceContact::evaluate(Bed& bed, const GroundView& view, LoadRates* rates,
                                                        std::vector<int>* submerged) {
  springs_.stiffness = 1;
  springs_.damping = dissipation_;
  bed.footprint.begin(view.normal());
  const ContactLoad springs = bed.surface->load(view, rates, submerged);
  Evaluation found;
  found.load.deepest = springs.deepest;
  found.load.deepest_rate = springs.deepest_rate;
  const HalfSpacePressure p = found.elastic = bed.footprint.pressure(modulus_);
  if (!(p.energy > 0)) return found;
  ContactLoad& load = found.load;
  load.energy = p.energy;
  const Vector3 rate_slope = view.normal().cross(view.angular_velocity);
  const auto power = [&](double force, const Vector3& moment) {  // of the motion δ̇, against it
    return -(view.vertical_speed * force + rate_slope.dot(moment));
  };
  const double elastic = p.force(), stored = power(elastic, p.first_moment());
  if (!(elastic > 0)) {
    load.release_power = -stored;
    return found;
  }
  const double factor = springs.force / p.volume;
  load.force = factor * elastic;
  load.first_moment = p.stiffness * springs.first_moment + factor * p.rest_moment;
  const double by_springs = springs.damping_power + springs.release_power;
  double dissipated = p.stiffness * by_springs + (factor - 1) * power(p.rest, p.rest_moment);
  if (dissipated < 0) {
    const double rate = stored / elastic, of_resultant = std::max(1 + dissipation_ * rate, 0.0);
    const double instead = (of_resultant - 1) * stored, part = dissipated / (dissipated - instead);
    load.force += part * (of_resultant - factor) * elastic;
    load.first_moment += part * (of_resultant * p.first_moment() - load.first_moment);
    dissipated = 0;
  }
  const double share = by_springs > 0 ? dissipated / by_springs : 0;
  load.damping_power = share * springs.damping_power;
  load.release_power = share * springs.release_power;
  found.rubbing = springs.force > 0 ? load.force / springs.force : 0;
  return found;
}

ContactLoad HalfSpaceContact::load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) {
  const Evaluation here = evaluate(bed_, view, rates, submerged);
  if (rates) add_rates(view, here, *rates);
  springs_.stiffness = here.rubbing;
  springs_.damping = here.rubbing * dissipation_;
  return here.load;
}

/// ContactSystem's rates are those of springs, δ̈ = −(V̇_z + h·u): by accelerations they are right with the dampers' c
/// and what R adds to it, and what h has without them belongs to the difference.
void HalfSpaceContact::add_rates(const GroundView& view, const Evaluation& here, LoadRates& rates) {
  const Vector3 normal = view.normal(), &omega = view.angular_velocity, rate_slope = normal.cross(omega);
  const HalfSpacePressure& p = here.elastic;
  const RateIntegrals patch = rates.rates;
  rates.rates = {.depth_position_squared = patch.depth_position_squared};
  rates.stiffness = rates.damping = rates.force_by_area = 0;
  rates.first_moment_by_area.setZero();
  if (!(here.load.force > 0)) return;
  rates.damping = p.stiffness * dissipation_;
  rates.rest = p.rest / (p.stiffness * p.volume);
  rates.rest_moment = p.rest_moment / (p.stiffness * p.volume);
  const Vector3 turning = normal.dot(omega) * omega - omega.squaredNorm() * normal;
  rates.rates.rate_squared = turning.dot(rates.load.depth_position);
  rates.rates.rate_squared_position = patch.depth_position_squared * turning;

  const double fastest = std::fabs(here.load.deepest_rate) + 2 * rate_slope.norm() * p.extent;
  if (!(fastest > 0)) return;
  const double h = part_of_change * here.load.deepest / fastest;
  const auto at = [&](double time) {
    GroundView moved = view;
    moved.turn += time * rate_slope;
    moved.sink += time * view.vertical_speed;
    return evaluate(beside_, moved, nullptr, nullptr).load;
  };
  const ContactLoad before = at(-h), after = at(h);
  rates.force_by_area = (after.force - before.force) / (2 * h);
  rates.first_moment_by_area = (after.first_moment - before.first_moment) / (2 * h);
}

SlipLoad HalfSpaceContact::slip_load(const GroundView& view, const SlipField& field) {
  return bed_.surface->slip_load(view, field);
}

SlipRange HalfSpaceContact::slip_range(const GroundView& view, const SlipField& field) const {
  return bed_.surface->slip_range(view, field);
}

std::unique_ptr<ContactSurface> contact_on(const Body& body, const Ground& ground) {
  if (ground.is_half_space()) return std::make_unique<HalfSpaceContact>(body, ground);
  if (ground.is_pad()) return std::make_unique<PadContact>(body, ground);
  return contact_surface(body, ground, nullptr);
}

}  // namespace clatter::numeric
