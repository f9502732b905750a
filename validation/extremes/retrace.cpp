// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/extremes/retrace.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "validation/extremes/cell.hpp"

namespace clatter::validation::inline extremes {
namespace {

using analytic::Drop;
using analytic::FrictionKind;
using analytic::ImpactMode;
using analytic::ImpactRow;
using analytic::RestitutionLaw;
using analytic::Sequence;
using Real = long double;

/// The largest residual so far.  A vanishing size belongs to a residual that vanishes too.
class Worst {
 public:
  void operator()(const char* law, std::size_t row, Real off, Real size) {
    double part = off == 0 ? 0 : static_cast<double>(std::fabs(off) / size);
    if (!std::isfinite(part)) part = infinite;
    if (!(part > value)) return;
    value = part;
    name = fmt::format("{}, impact {}", law, row + 1);
  }
  double value = 0;
  std::string name;
};

struct Place {
  Real along, across;
};

class Walk {
 public:
  Walk(const Drop& drop, const Sequence& sequence) : drop_(drop), rows_(sequence.rows) {}

  Retrace run() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (i > 0) flight(i);
      place(i);
      impact(i);
      energy(i);
      momentum(i);
    }
    out_.residual = worst_.value;
    out_.worst = worst_.name;
    return out_;
  }

 private:
  /// Inclination at the impact, whole turns of the flight included.
  [[nodiscard]] Real inclination(std::size_t i) const {
    return i == 0 ? rows_[0].inclination : rows_[i].flight.arrival.inclination;
  }

  [[nodiscard]] Place place_of(int vertex, std::size_t i) const {
    const analytic::Vertex& v = drop_.body.vertices[static_cast<std::size_t>(vertex)];
    // An inclination that came in degrees has its own sine and cosine, exact at 90°.
    const Real sine = i == 0 ? Real(drop_.inclination.sine) : std::sin(inclination(i));
    const Real cosine = i == 0 ? Real(drop_.inclination.cosine) : std::cos(inclination(i));
    return {v.x * cosine - v.z * sine, v.x * sine + v.z * cosine};
  }

  void flight(std::size_t i) {
    const ImpactRow &last = rows_[i - 1], &row = rows_[i];
    const Real t = row.flight.arrival.time, g = drop_.gravity;
    const analytic::PlanarVelocity &from = last.impact.after, &to = row.before;
    worst_("start", i, row.start - last.start - t, Real(row.start) + last.start);
    worst_("fall", i, to.normal - (from.normal - g * t), std::fabs(from.normal) + g * t);
    worst_("tangential flight", i, Real(to.tangential) - from.tangential, speed(last));
    worst_("turning", i, Real(to.angular) - from.angular, speed(last) / drop_.body.reach());
    rise_ = std::fabs(from.normal) * t + g * t * t / 2 + last.centre_height;
    turn_ = std::fabs(from.angular * t) + std::fabs(Real(last.inclination));
    worst_("turn", i, inclination(i) - (last.inclination - from.angular * t), turn_);
    worst_("parabola", i, row.centre_height - (last.centre_height + from.normal * t - g * t * t / 2), rise_);
  }

  void place(std::size_t i) {
    for (int v = 0; v < drop_.body.vertex_count; ++v) {
      const Place d = place_of(v, i);
      const Real height = rows_[i].centre_height + d.across;
      const Real size = (i > 0 ? rise_ + turn_ * std::fabs(d.along) : Real(0)) + std::fabs(d.across);
      const bool arrives = rows_[i].vertices >> v & 1;
      if (!arrives && height >= 0) continue;
      worst_(arrives ? "arriving vertex" : "vertex below the ground", i, height, size);
      const double off = static_cast<double>(std::fabs(height) / drop_.body.reach());
      if (!(off <= out_.placement)) out_.placement = off;
    }
  }

  [[nodiscard]] Real speed(const ImpactRow& row) const {
    const Real reach = drop_.body.reach();
    return std::fabs(Real(row.impact.after.normal)) + std::fabs(Real(row.impact.after.tangential)) +
           std::fabs(reach * row.impact.after.angular) + std::fabs(Real(row.before.normal)) +
           std::fabs(Real(row.before.tangential)) + std::fabs(reach * row.before.angular);
  }

  void impact(std::size_t i) {
    const ImpactRow& row = rows_[i];
    const analytic::Impact& hit = row.impact;
    const Real m = drop_.body.mass, total = speed(row);
    worst_("normal momentum", i, Real(hit.normal_impulse) / m - (Real(hit.after.normal) - row.before.normal), total);
    worst_("tangential momentum", i,
           Real(hit.tangential_impulse) / m - (Real(hit.after.tangential) - row.before.tangential), total);
    if (!(hit.normal_impulse >= 0)) worst_("pulling impulse", i, 1, 0);
    if (std::popcount(row.vertices) != 1) return;
    const Place d = place_of(std::countr_zero(row.vertices), i);
    const Real k = drop_.body.gyration_square, reach = drop_.body.reach();
    const Real twist = (hit.tangential_impulse * d.across - hit.normal_impulse * d.along) / m / k;
    worst_("angular momentum", i, reach * (twist - (Real(hit.after.angular) - row.before.angular)), total);
    worst_("approach", i, hit.approach_speed + (row.before.normal - row.before.angular * d.along), total);
    worst_("separation", i, hit.separation_speed - (hit.after.normal - hit.after.angular * d.along), total);
    if (drop_.law.law == RestitutionLaw::newton) {
      worst_("restitution", i, hit.separation_speed - Real(drop_.law.restitution) * hit.approach_speed, total);
    }
    friction(i, d);
  }

  void friction(std::size_t i, const Place& d) {
    const ImpactRow& row = rows_[i];
    const analytic::Impact& hit = row.impact;
    // Products below the smallest double are rounded to a multiple of it.
    const Real least = 4 * std::numeric_limits<double>::denorm_min();
    const Real value = drop_.law.friction_value, normal = hit.normal_impulse, along = hit.tangential_impulse;
    const Real slip = hit.after.tangential + hit.after.angular * d.across;
    if (drop_.law.friction == FrictionKind::none) worst_("friction", i, along, normal);
    if (drop_.law.friction == FrictionKind::impulse_ratio)
      worst_("impulse ratio", i, along - value * normal, std::fabs(value * normal));
    if (drop_.law.friction != FrictionKind::coulomb) return;
    const Real beyond = std::fabs(along) - value * normal;
    if (std::fabs(beyond) <= least) return;
    if (beyond > 0) worst_("Coulomb's bound", i, beyond, value * normal);
    if (hit.mode == ImpactMode::stick || hit.mode == ImpactMode::slip_stick) worst_("sticking", i, slip, speed(row));
    if (hit.mode == ImpactMode::slip) worst_("slipping", i, beyond, value * normal);
  }

  void energy(std::size_t i) {
    const ImpactRow& row = rows_[i];
    const Real first = rows_[0].energy_before;
    const Real m = drop_.body.mass, v = row.before.normal;
    if (m * v * v / 2 > std::numeric_limits<double>::max()) return;  // no energy to check: it is no double
    const Real size = Real(row.energy_before) + row.energy_after;
    worst_("energy lost", i, Real(row.energy_before) - row.energy_after - row.impact.energy_loss, size);
    const bool gains = drop_.law.friction == FrictionKind::impulse_ratio;
    if (!gains && row.impact.energy_loss < 0) worst_("energy gained", i, row.impact.energy_loss, size);
    lost_ += row.impact.energy_loss;
    const double drift = static_cast<double>(std::fabs(row.energy_after - (first - lost_)) / first);
    if (!(drift <= out_.energy_drift)) out_.energy_drift = std::isfinite(drift) ? drift : infinite;
  }

  void momentum(std::size_t i) {
    const ImpactRow& row = rows_[i];
    impulse_ += row.impact.normal_impulse;
    const Real change = Real(row.impact.after.normal) - rows_[0].before.normal + Real(drop_.gravity) * row.start;
    out_.momentum_drift = static_cast<double>(std::fabs(impulse_ - drop_.body.mass * change) / impulse_);
  }

  const Drop& drop_;
  const std::vector<ImpactRow>& rows_;
  Worst worst_;
  Retrace out_;
  Real rise_ = 0, turn_ = 0;  ///< sizes of the terms of the last flight
  Real lost_ = 0, impulse_ = 0;
};

}  // namespace

Retrace retrace(const analytic::Drop& drop, const analytic::Sequence& sequence) { return Walk(drop, sequence).run(); }

}  // namespace clatter::validation::inline extremes
