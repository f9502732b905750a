// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_load.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "numeric/contact/footprint.hpp"

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

/// The load of a pad (Ground::kinks) on any surface: the sum of those of beds of springs that begin at the depths d of
/// the kinks,
///     f_n = Σ s (1 + τδ̇)₊ (δ − d)₊,   s = k_G of the first bed, at d = 0, and k_G change of the others, of either
///     sign.
/// A bed's load is that of the body over a ground sunk by d, with the integrals, friction and energy of springs, exact
/// as those are; all beds press where 1 + τδ̇ > 0, and their sum never pulls.  A pad of one piece has the bits of
/// springs of c_G = τ k_G.  An evaluation takes the time of as many beds as the deepest point has reached.
class PadContact final : public ContactSurface {
 public:
  PadContact(const Body& body, const Ground& ground) {
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

  using ContactSurface::load;

  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override {
    ContactLoad sum = beds_.front().surface->load(view, rates, submerged);
    for (reached_ = 1; reached_ < beds_.size() && sum.deepest > beds_[reached_].depth; ++reached_) {
      const Bed& bed = beds_[reached_];
      LoadRates of_bed;
      add_part(bed.surface->load(over_sunk_ground(view, bed.depth), rates ? &of_bed : nullptr, nullptr), bed.sign, sum);
      if (rates) add_part(of_bed, bed.sign, *rates);
    }
    return sum;
  }

  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override {
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

  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override {
    return beds_.front().surface->slip_range(view, field);
  }

 private:
  struct Bed {
    double depth = 0;  ///< where it begins [m]
    double sign = 1;   ///< of its springs' stiffness
    std::unique_ptr<const Ground> springs;
    std::unique_ptr<ContactSurface> surface;
  };

  std::vector<Bed> beds_;
  std::size_t reached_ = 1;  ///< beds of the last load
};

constexpr double part_of_change = 1e-5;  ///< of the time in which the load changes: half the central difference

Ground springs_of(const Ground& ground) {
  Ground springs = ground;
  springs.modulus = 0;
  springs.area = AreaMeasure::projected;
  return springs;
}

/// The load of a half-space (Ground::modulus) on any surface.  Elastic pressure p = k δ + R and energy U are those of
/// the patch, Footprint; with τ = Ground::dissipation
///     f = k δ (1 + τδ̇)₊ + w R,   w = ∫δ (1 + τδ̇)₊ dA/S₁,                                             (1)
/// so that F = w ∫p dA: Hunt and Crossley's factor, 1 + τ v for a body that sinks at the speed v, and never a pull. The
/// power ∫(f − p) δ̇ dA that it dissipates is τ F_e v² there; where (1) would give power back, which is far from any
/// patch that sinks as one, a part θ of f is w_s p, w_s = (1 + τ ∫pδ̇/∫p)₊, just large enough.  Where ∫p is not
/// positive, as where a wide part begins to touch round a deep narrow one, which a single patch does not stand for,
/// nothing presses.  Friction rubs over the patch with k δ (1 + τδ̇)₊ scaled to F, about the pressure centre of f.
/// Rates: what an acceleration does through w is exact where θ = 0; all else is a central difference of the load along
/// the motion, right to some 1e-9 of the rate.
class HalfSpaceContact final : public ContactSurface {
 public:
  HalfSpaceContact(const Body& body, const Ground& ground)
      : modulus_(ground.modulus), dissipation_(ground.dissipation), springs_(springs_of(ground)) {
    for (Bed* const bed : {&bed_, &beside_}) bed->surface = contact_surface(body, springs_, &bed->footprint);
  }

  using ContactSurface::load;

  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override {
    const Evaluation here = evaluate(bed_, view, rates, submerged);
    if (rates) add_rates(view, here, *rates);
    springs_.stiffness = here.rubbing;
    springs_.damping = here.rubbing * dissipation_;
    return here.load;
  }

  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override {
    return bed_.surface->slip_load(view, field);
  }

  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override {
    return bed_.surface->slip_range(view, field);
  }

 private:
  /// A bed of springs under the surface, whose evaluation tells the patch.
  struct Bed {
    Footprint footprint;
    std::unique_ptr<ContactSurface> surface;
  };
  struct Evaluation {
    ContactLoad load;
    HalfSpacePressure elastic;
    double rubbing = 0;  ///< stiffness of the springs that rub [N/m³]
  };

  [[nodiscard]] Evaluation evaluate(Bed& bed, const GroundView& view, LoadRates* rates, std::vector<int>* submerged) {
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

  /// ContactSystem's rates are those of springs, δ̈ = −(V̇_z + h·u): by accelerations they are right with the dampers' c
  /// and what R adds to it, and what h has without them belongs to the difference.
  void add_rates(const GroundView& view, const Evaluation& here, LoadRates& rates) {
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

  double modulus_, dissipation_;
  Ground springs_;  ///< of both beds: of stiffness 1 while the load is summed, then those that rub
  Bed bed_, beside_;
};

}  // namespace

std::unique_ptr<ContactSurface> contact_on(const Body& body, const Ground& ground) {
  if (ground.is_half_space()) return std::make_unique<HalfSpaceContact>(body, ground);
  if (ground.is_pad()) return std::make_unique<PadContact>(body, ground);
  return contact_surface(body, ground, nullptr);
}

}  // namespace clatter::numeric
