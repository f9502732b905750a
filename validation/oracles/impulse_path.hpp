// SPDX-License-Identifier: GPL-3.0-or-later
// The velocity of a contact point along an impact with Coulomb friction, segment by segment (event_oracle.hpp), and
// the restitution of a ground of springs and dampers.
#pragma once

#include <cmath>
#include <stdexcept>

namespace clatter::oracle {

/// G(u) = ∫ u/(1 − τu) du from 0, and the u > 0 where G has a value.
template <class Real>
struct DampedGround {
  Real damping;  ///< τ

  [[nodiscard]] Real G(const Real& u) const {
    using std::log;
    if (damping == 0) return u * u / 2;
    return (-damping * u - log(1 - damping * u)) / (damping * damping);
  }
  /// With z = −ln(1 − τu), z − 1 + exp(−z) = τ² G is convex: Newton's steps from beyond its root
  /// come down to it until rounding ends them.
  [[nodiscard]] Real speed_at(const Real& value) const {
    using std::exp, std::sqrt;
    if (damping == 0) return sqrt(2 * value);
    const Real target = damping * damping * value;
    Real z = 1;
    while (z - 1 + exp(-z) < target) z *= 2;
    for (;;) {
      const Real fraction = 1 - exp(-z), next = z - (z - fraction - target) / fraction;
      if (!(next < z)) return fraction / damping;
      z = next;
    }
  }
};

/// e of the flat landing on a ground that pushes with K (1 − τu), s = τ v >= 0: the ground gives back all it stored,
/// G(e v) = G(−v).  Below s = 1e-15 the first two terms of its series serve, to s².
template <class Real>
Real exact_restitution(const Real& s) {
  if (s < Real(1e-15)) return 1 - 2 * s / 3;
  const DampedGround<Real> ground{1};
  return ground.speed_at(ground.G(-s)) / s;
}

/// e of a mass that meets the ground force (1 + τ δ̇) δ with the approach speed u: δ̈ = −(1 + τ δ̇) δ from δ = 0, δ̇ = u
/// until δ = 0 again, by Runge and Kutta's method; the time of the end by Newton's.  Error: below 1e-10 for τ u <= 2.
inline double integrated_restitution(double damping_per_stiffness, double approach_speed) {
  struct Motion {
    double depth, speed;
  };
  const auto rate = [&](const Motion& m) { return Motion{m.speed, -(1 + damping_per_stiffness * m.speed) * m.depth}; };
  const auto stepped = [&](const Motion& m, double h) {
    const auto at = [&](const Motion& k, double part) {
      return rate({m.depth + part * k.depth, m.speed + part * k.speed});
    };
    const Motion a = rate(m), b = at(a, h / 2), c = at(b, h / 2), d = at(c, h);
    return Motion{m.depth + h / 6 * (a.depth + 2 * b.depth + 2 * c.depth + d.depth),
                  m.speed + h / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed)};
  };
  constexpr double step = 1e-3;
  Motion now = stepped({0, approach_speed}, step);
  while (now.depth > 0) now = stepped(now, step);
  for (int i = 0; i < 4; ++i) now = stepped(now, -now.depth / now.speed);
  return -now.speed / approach_speed;
}

/// (u, s) after the impulses so far: du = (A − B r) dP, ds = (C r − B) dP, r the ratio that
/// friction allows.
template <class Real>
struct ImpulsePath {
  Real A, B, C, friction, u, s;
  Real normal = 0, tangential = 0;

  [[nodiscard]] Real ratio() const {
    if (s > 0) return -friction;
    if (s < 0) return friction;
    const Real stick = B / C;
    if (stick > friction) return friction;
    if (stick < -friction) return -friction;
    return stick;
  }
  /// Impulse until slip stops; negative: not on this segment.
  [[nodiscard]] Real until_slip_stops(const Real& r) const {
    const Real rate = C * r - B;
    if (s == 0 || rate == 0) return -1;
    const Real left = -s / rate;
    return left > 0 ? left : Real(-1);
  }
  void go(const Real& r, const Real& impulse, bool stops) {
    normal += impulse;
    tangential += r * impulse;
    u += (A - B * r) * impulse;
    s = stops ? Real(0) : s + (C * r - B) * impulse;
  }
  /// On until u has reached `target` from below.
  void rise_to(const Real& target) {
    for (int segment = 0; segment < 4; ++segment) {
      const Real r = ratio(), slope = A - B * r, stop = until_slip_stops(r);
      const Real need = slope > 0 ? (target - u) / slope : Real(-1);
      if (slope > 0 && (stop < 0 || need <= stop)) return go(r, need, false);
      if (stop < 0) throw std::runtime_error("the contact jams");
      go(r, stop, true);
    }
  }
  /// On for this much impulse.
  void push(Real impulse) {
    while (impulse > 0) {
      const Real r = ratio(), stop = until_slip_stops(r);
      if (stop < 0 || impulse <= stop) return go(r, impulse, false);
      go(r, stop, true);
      impulse -= stop;
    }
  }
  /// On from u = 0 until ∫ u dP = work.
  void give_back(Real work) {
    using std::sqrt;
    for (int segment = 0; segment < 4; ++segment) {
      const Real r = ratio(), slope = A - B * r, stop = until_slip_stops(r);
      const Real need = (sqrt(u * u + 2 * slope * work) - u) / slope;
      if (stop < 0 || need <= stop) return go(r, need, false);
      work -= u * stop + slope * stop * stop / 2;
      go(r, stop, true);
    }
  }
  /// On until a ground that pushes with K (1 − τu), τ = `damping`, K growing with depth in any way,
  /// has given back all it stored.  Its energy changes by K dδ = −u dP/(1 − τu), which along a
  /// segment with du = slope dP is −[G(u_after) − G(u)]/slope, G′ = u/(1 − τu).
  void push_off(const Real& damping) {
    const DampedGround<Real> ground{damping};
    Real stored = 0;
    for (int segment = 0; segment < 4; ++segment) {
      const Real r = ratio(), slope = A - B * r, stop = until_slip_stops(r);
      if (slope > 0) {
        const Real need = (ground.speed_at(ground.G(u) + slope * stored) - u) / slope;
        if (stop < 0 || need <= stop) return go(r, need, false);
      } else if (stop < 0) {
        throw std::runtime_error("the contact jams");
      }
      const Real after = u + slope * stop;
      stored -= slope == 0 ? Real(u / (1 - damping * u) * stop) : Real((ground.G(after) - ground.G(u)) / slope);
      go(r, stop, true);
    }
  }
  /// −∫ u dP to the end of compression, as a copy of this path goes there.
  [[nodiscard]] Real compression_work() const {
    ImpulsePath path = *this;
    Real work = 0;
    while (path.u < 0) {
      const Real r = path.ratio(), slope = path.A - path.B * r, stop = path.until_slip_stops(r);
      const Real need = slope > 0 ? -path.u / slope : Real(-1);
      const bool ends = slope > 0 && (stop < 0 || need <= stop);
      const Real step = ends ? need : stop;
      work -= path.u * step + slope * step * step / 2;
      if (ends) return work;
      path.go(r, step, true);
    }
    return work;
  }
};

}  // namespace clatter::oracle
