// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/pad_contact.hpp"

#include <cmath>

#include "numeric/contact/smooth_contact.hpp"

namespace clatter::numeric {
namespace {

/// The body as a ground sees it that lies deeper.
GroundView over_sunk_ground(GroundView view, double depth) {
  view.sink += depth;
  return view;
}

void add_part(const ContactLoad& part, double sign, ContactLoad& sum) {
  sum.force += sign * part.force;
  sum.first_moment += sign * part.first_moment;
  sum.energy += sign * part.energy;
  sum.damping_power += sign * part.damping_power;
  sum.release_power += sign * part.release_power;
}

/// The sum's stiffness and damping stay those of its first bed.
void add_part(const LoadRates& part, double sign, LoadRates& sum) {
  const double weight = sign * part.stiffness / sum.stiffness;
  sum.load.add(part.load, weight);
  sum.rates.add(part.rates, weight);
  sum.force_by_area += sign * part.force_by_area;
  sum.first_moment_by_area += sign * part.first_moment_by_area;
}

}  // namespace

PadContact::PadContact(const Body& body, const Ground& ground) {
  const auto add_bed = [&](double depth, double stiffness) {
    if (stiffness == 0) return;
    Ground springs = ground;
    springs.kinks.clear();
    springs.stiffness = std::fabs(stiffness);
    springs.damping = ground.dissipation * springs.stiffness;
    Bed bed{depth, std::copysign(1.0, stiffness), std::make_unique<const Ground>(std::move(springs)), nullptr};
    bed.surface = contact_surface(body, *bed.springs);
    beds_.push_back(std::move(bed));
  };
  add_bed(0, ground.stiffness);
  for (const Kink& kink : ground.kinks) add_bed(kink.depth, kink.change * ground.stiffness);
}

ContactLoad PadContact::load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) {
  ContactLoad sum = beds_.front().surface->load(view, rates, submerged);
  for (reached_ = 1; reached_ < beds_.size() && sum.deepest > beds_[reached_].depth; ++reached_) {
    const Bed& bed = beds_[reached_];
    LoadRates of_bed;
    add_part(bed.surface->load(over_sunk_ground(view, bed.depth), rates ? &of_bed : nullptr, nullptr), bed.sign, sum);
    if (rates) add_part(of_bed, bed.sign, *rates);
  }
  return sum;
}

SlipLoad PadContact::slip_load(const GroundView& view, const SlipField& field) {
  SlipLoad sum = beds_.front().surface->slip_load(view, field);
  for (std::size_t i = 1; i < reached_; ++i) {
    const Bed& bed = beds_[i];
    const SlipLoad part = bed.surface->slip_load(over_sunk_ground(view, bed.depth), field);
    sum.east += bed.sign * part.east;
    sum.north += bed.sign * part.north;
    sum.moment += bed.sign * part.moment;
  }
  return sum;
}

SlipRange PadContact::slip_range(const GroundView& view, const SlipField& field) const {
  return beds_.front().surface->slip_range(view, field);
}

}  // namespace clatter::numeric
