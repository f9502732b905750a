// SPDX-License-Identifier: GPL-3.0-or-later
// Impact sequences of a planar body to many digits, by brute force: Routh's path in impulse space
// segment by segment, and flights by steps that provably pass no contact.
//
// Written from the physics alone.  Positions and velocities are those of the centre of mass; what
// cancels is left to the digits of Real.
//   Impact.  Per unit mass, an impulse dP along the normal with r dP along the ground changes the
//   velocity (u, s) of the contact point by du = (A − B r) dP, ds = (C r − B) dP, A = 1 + (d_t/k)²,
//   B = d_t d_n/k², C = 1 + (d_n/k)².
//   Flight.  With |h″| <= M = g + Ω²ρ, ρ the vertex's distance from the centre of mass, a vertex at height h with
//   velocity h′ cannot reach the ground before the positive zero Δ of h + h′Δ − MΔ²/2.  Steps of that size never pass a
//   contact, however short or grazing, and close in on it quadratically.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "validation/oracles/impulse_path.hpp"

namespace clatter::oracle {

template <class Real>
struct EventOffset {
  Real tangential, normal;  ///< from the centre of mass, world frame
};

template <class Real>
struct EventVertex {
  Real x, z;  ///< in the body frame, from the centre of mass [m]

  [[nodiscard]] EventOffset<Real> offset(const Real& sine, const Real& cosine) const {
    return {x * cosine - z * sine, x * sine + z * cosine};
  }
  [[nodiscard]] Real reach() const {
    using std::sqrt;
    return sqrt(x * x + z * z);
  }
};

template <class Real>
struct EventBody {
  Real mass, gyration_square;
  std::vector<EventVertex<Real>> vertices;
};

template <class Real>
struct EventState {
  Real inclination, normal, tangential, angular;  ///< α with dα/dt = −Ω; V_n, V_t, Ω
};

/// A contact, a passage or a tie so slight that rounding to doubles, or to long doubles, decides about it.
struct CloseCall {
  static constexpr double depth = 1e-12;  ///< of a graze or passage, relative to the vertex's reach
  static constexpr double tie = 1e-12;    ///< between two arrivals, relative to their time
};

/// Time in which a height cannot vanish, |h″| <= `bend`.
template <class Real>
Real sure_flight(const Real& height, const Real& velocity, const Real& bend) {
  using std::sqrt;
  const Real root = sqrt(velocity * velocity + 2 * bend * height);
  return velocity < 0 ? 2 * height / (root - velocity) : (velocity + root) / bend;
}

template <class Real>
class EventFlight {
 public:
  EventFlight(const EventBody<Real>& body, const EventState<Real>& state, const Real& gravity)
      : body_(body), state_(state), gravity_(gravity), heights_(body.vertices.size()) {
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      Height& h = heights_[i];
      h.reach = body.vertices[i].reach();
      h.bend = gravity + state.angular * state.angular * h.reach;
      if (h.reach > reach_) reach_ = h.reach;
    }
  }

  struct Arrival {
    std::size_t vertex = 0;
    Real time = 0;
  };

  /// The earliest contact after one of vertex `from`; nothing: none ever.
  [[nodiscard]] std::optional<Arrival> run(std::size_t from) {
    using std::cos, std::sin;
    start_ = -body_.vertices[from].offset(sin(state_.inclination), cos(state_.inclination)).normal;
    Real t = 0;
    for (long step = 0; step < most_steps; ++step) {
      const std::optional<Real> low = back_in_reach(t);
      if (!low) return std::nullopt;
      if (*low > t * (1 + Real(1e-30))) {
        t = *low;
        continue;
      }
      look(t);
      // The vertex that has just struck rises; until twice this time for certain.
      if (t == 0) heights_[from].stride = heights_[from].velocity / heights_[from].bend;
      const auto nearest = std::min_element(heights_.begin(), heights_.end(),
                                            [](const Height& a, const Height& b) { return a.stride < b.stride; });
      if (nearest->stride <= resolution() * t) {
        judge(*nearest, t);
        return Arrival{static_cast<std::size_t>(nearest - heights_.begin()), t};
      }
      t += nearest->stride;
    }
    throw std::runtime_error("the flight does not end");
  }

  /// Whether `run` met one.
  [[nodiscard]] bool close_call() const { return close_call_; }

 private:
  static constexpr long most_steps = 20'000'000;

  struct Height {
    Real reach, bend;
    Real value{}, velocity{}, stride{};
    bool falls = false;
  };

  /// The relative resolution of a contact time.
  static Real resolution() { return std::max(Real(1e-32), Real(92 * std::numeric_limits<Real>::epsilon())); }

  /// While the centre of mass is higher than any vertex reaches, none can touch: when that ends; t if it is not so.
  [[nodiscard]] std::optional<Real> back_in_reach(const Real& t) const {
    using std::sqrt;
    const Real& g = gravity_;
    const Real centre = start_ + t * (state_.normal - g * t / 2), speed = state_.normal - g * t;
    if (!(centre > reach_)) return t;
    if (g == 0 && speed >= 0) return std::nullopt;
    if (g == 0) return Real(t + (centre - reach_) / -speed);
    return Real(t + (speed + sqrt(speed * speed + 2 * g * (centre - reach_))) / g);
  }

  /// All heights at time t.
  void look(const Real& t) {
    using std::cos, std::sin;
    const Real angle = state_.inclination - state_.angular * t, s = sin(angle), c = cos(angle);
    const Real centre = start_ + t * (state_.normal - gravity_ * t / 2), speed = state_.normal - gravity_ * t;
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      Height& h = heights_[i];
      const EventOffset<Real> d = body_.vertices[i].offset(s, c);
      h.value = centre + d.normal;
      h.velocity = speed - state_.angular * d.tangential;
      if (h.falls && h.velocity >= 0 && h.value < CloseCall::depth * h.reach) close_call_ = true;
      h.falls = h.velocity < 0;
      h.stride = h.value > 0 ? sure_flight(h.value, h.velocity, h.bend) : Real(0);
    }
  }

  /// Whether an arrival is a graze or has a rival.
  void judge(const Height& arrives, const Real& t) {
    if (arrives.velocity * arrives.velocity < 2 * arrives.bend * CloseCall::depth * arrives.reach) close_call_ = true;
    for (const Height& h : heights_) {
      if (&h != &arrives && h.falls && !(h.value > -h.velocity * CloseCall::tie * t)) close_call_ = true;
    }
  }

  const EventBody<Real>& body_;
  EventState<Real> state_;
  Real gravity_;
  std::vector<Height> heights_;
  Real reach_ = 0, start_ = 0;
  bool close_call_ = false;
};

enum class EventRestitution { newton, poisson, stronge, viscoelastic };
enum class EventFriction { none, ratio, coulomb };

template <class Real>
struct EventLaw {
  Real restitution = 1;  ///< not of a viscoelastic ground
  EventRestitution kind = EventRestitution::newton;
  EventFriction friction = EventFriction::none;
  Real friction_value = 0;
  Real gravity = 0;
  Real damping = 0;  ///< c_G/k_G of a viscoelastic ground [s/m]
};

template <class Real>
struct EventImpact {
  std::size_t vertex = 0;
  Real time = 0;
  EventState<Real> before{}, after{};
  Real approach = 0, separation = 0;
  Real normal_impulse = 0, tangential_impulse = 0;
  Real energy_before = 0, energy_after = 0;
};

enum class EventEnd { no_further, limit, one_vertex_rests, face_rests, out_of_digits };

template <class Real>
struct EventSequence {
  std::vector<EventImpact<Real>> impacts;
  EventEnd end = EventEnd::limit;
  bool close_call = false;  ///< in any of the flights
};

template <class Real>
class EventSimulation {
 public:
  EventSimulation(const EventBody<Real>& body, const EventState<Real>& start, const EventLaw<Real>& law)
      : body_(body), state_(start), law_(law) {}

  /// @param smallest share of the first approach speed below which an accumulation counts as ended.
  EventSequence<Real> run(std::size_t most, const Real& smallest) {
    EventSequence<Real> sequence = follow(most, smallest);
    sequence.close_call = close_call_;
    return sequence;
  }

 private:
  EventSequence<Real> follow(std::size_t most, const Real& smallest) {
    EventSequence<Real> sequence;
    std::size_t vertex = lowest();
    std::size_t small = 0;
    for (;;) {
      const std::optional<EventImpact<Real>> struck = strike(vertex);
      if (!struck) {
        sequence.end = EventEnd::out_of_digits;
        return sequence;
      }
      sequence.impacts.push_back(*struck);
      const EventImpact<Real>& impact = sequence.impacts.back();
      const Real share = impact.approach / sequence.impacts.front().approach;
      small = share < smallest ? small + 1 : 0;
      if (small >= settled || share < smallest * Real(1e-8)) {
        sequence.end = accumulation_end(sequence.impacts, small);
        if (sequence.end != EventEnd::limit) return sequence;
      }
      if (sequence.impacts.size() == most) return sequence;
      const std::optional<std::size_t> next = fly(vertex);
      if (!next) {
        sequence.end = EventEnd::no_further;
        return sequence;
      }
      vertex = *next;
    }
  }

  static constexpr std::size_t settled = 12;

  [[nodiscard]] EventOffset<Real> offset(std::size_t i) const {
    using std::cos, std::sin;
    return body_.vertices[i].offset(sin(state_.inclination), cos(state_.inclination));
  }

  [[nodiscard]] std::size_t lowest() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < body_.vertices.size(); ++i) {
      if (offset(i).normal < offset(best).normal) best = i;
    }
    return best;
  }

  /// What the last `small` impacts tell: one vertex alone bounced, and the others need far longer to the
  /// ground than its bounces last all together; or several have bounced; or neither can be said yet
  /// (limit).
  [[nodiscard]] EventEnd accumulation_end(const std::vector<EventImpact<Real>>& impacts, std::size_t small) const {
    using std::sqrt;
    const EventImpact<Real>& last = impacts.back();
    for (std::size_t i = impacts.size() - std::max<std::size_t>(small, 2); i < impacts.size(); ++i) {
      if (impacts[i].vertex != last.vertex) return EventEnd::face_rests;
    }
    const std::size_t n = impacts.size();
    const Real bounce = last.time - impacts[n - 2].time;
    const Real shrinks = n < 3 ? law_.restitution : Real(bounce / (impacts[n - 2].time - impacts[n - 3].time));
    if (!(shrinks < 1)) return EventEnd::limit;
    const Real left = bounce * shrinks / (1 - shrinks);
    const EventOffset<Real> from = offset(last.vertex);
    for (std::size_t i = 0; i < body_.vertices.size(); ++i) {
      if (i == last.vertex) continue;
      const EventOffset<Real> d = offset(i);
      const Real bend = law_.gravity + state_.angular * state_.angular * body_.vertices[i].reach();
      const Real velocity = state_.normal - state_.angular * d.tangential;
      if (sure_flight(d.normal - from.normal, velocity, bend) < 10 * left) return EventEnd::limit;
    }
    return EventEnd::one_vertex_rests;
  }

  [[nodiscard]] Real energy(const Real& height) const {
    const auto& v = state_;
    return body_.mass *
           ((v.normal * v.normal + v.tangential * v.tangential + body_.gyration_square * v.angular * v.angular) / 2 +
            law_.gravity * height);
  }

  // ---- impact ----

  using Path = ImpulsePath<Real>;

  /// Along one segment the ground has stored as much as it gives back: G is the same at both ends.
  [[nodiscard]] Real damped_rebound(const Real& fast) const {
    const DampedGround<Real> ground{law_.damping};
    return ground.speed_at(ground.G(-fast));
  }

  void go_along(Path& path) const {
    const Real& e = law_.restitution;
    const Real fast = -path.u;
    if (law_.friction != EventFriction::coulomb) {
      const Real ratio = law_.friction == EventFriction::ratio ? law_.friction_value : Real(0);
      const Real slope = path.A - path.B * ratio;
      if (!(slope > 0)) throw std::runtime_error("the contact jams");
      const Real rebound = law_.kind == EventRestitution::viscoelastic ? damped_rebound(fast) : Real(e * fast);
      return path.go(ratio, (fast + rebound) / slope, false);
    }
    if (law_.kind == EventRestitution::viscoelastic) return path.push_off(law_.damping);
    if (law_.kind == EventRestitution::newton) return path.rise_to(e * fast);
    const Real work = path.compression_work();
    path.rise_to(Real(0));
    if (law_.kind == EventRestitution::poisson) return path.push(e * path.normal);
    path.u = 0;
    path.give_back(e * e * work);
  }

  /// Nothing if the vertex recedes: errors have grown beyond the digits of Real.
  std::optional<EventImpact<Real>> strike(std::size_t vertex) {
    const EventOffset<Real> d = offset(vertex);
    const Real& k2 = body_.gyration_square;
    EventImpact<Real> impact;
    impact.vertex = vertex;
    impact.time = time_;
    impact.before = state_;
    impact.energy_before = energy(-d.normal);
    Path path{1 + d.tangential * d.tangential / k2,
              d.tangential * d.normal / k2,
              1 + d.normal * d.normal / k2,
              law_.friction_value,
              state_.normal - state_.angular * d.tangential,
              state_.tangential + state_.angular * d.normal};
    if (!(path.u < 0)) return std::nullopt;
    impact.approach = -path.u;
    go_along(path);
    impact.separation = path.u;
    state_.normal += path.normal;
    state_.tangential += path.tangential;
    state_.angular += (path.tangential * d.normal - path.normal * d.tangential) / k2;
    impact.normal_impulse = body_.mass * path.normal;
    impact.tangential_impulse = body_.mass * path.tangential;
    impact.after = state_;
    impact.energy_after = energy(-d.normal);
    return impact;
  }

  /// The vertex that arrives first; the state is then that of its touch.
  std::optional<std::size_t> fly(std::size_t from) {
    EventFlight<Real> flight(body_, state_, law_.gravity);
    const auto arrival = flight.run(from);
    close_call_ = close_call_ || flight.close_call();
    if (!arrival) return std::nullopt;
    time_ += arrival->time;
    state_.inclination -= state_.angular * arrival->time;
    state_.normal -= law_.gravity * arrival->time;
    return arrival->vertex;
  }

  EventBody<Real> body_;
  EventState<Real> state_;
  EventLaw<Real> law_;
  Real time_ = 0;
  bool close_call_ = false;
};

}  // namespace clatter::oracle
