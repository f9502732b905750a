// Impact sequences of a planar body to many digits, by brute force: Routh's path in impulse space
// segment by segment, and flights by steps that provably pass no contact.
//
// Written from the physics alone.  Positions and velocities are those of the centre of mass; what
// cancels is left to the digits of Real.
//   Impact.  Per unit mass, an impulse dP along the normal with r dP along the ground changes the
//   velocity (u, s) of the contact point by du = (A − B r) dP, ds = (C r − B) dP, A = 1 + (d_t/k)²,
//   B = d_t d_n/k², C = 1 + (d_n/k)². Flight.  With |h″| <= M = g + Ω²ρ, a vertex at height h with
//   velocity h′ cannot reach the ground before the positive zero of h + h′Δ − MΔ²/2.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "validation/verify/impulse_path.hpp"

namespace clatter::oracle {

template <class Real>
struct EventVertex {
  Real x, z;  ///< in the body frame, from the centre of mass [m]
};

template <class Real>
struct EventBody {
  Real mass, gyration_square;
  std::vector<EventVertex<Real>> vertices;
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
struct EventState {
  Real inclination, normal, tangential, angular;  ///< α with dα/dt = −Ω; V_n, V_t, Ω
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
};

template <class Real>
class EventSimulation {
 public:
  EventSimulation(const EventBody<Real>& body, const EventState<Real>& start, const EventLaw<Real>& law)
      : body_(body), state_(start), law_(law) {
    for (const auto& v : body.vertices) {
      using std::sqrt;
      reaches_.push_back(sqrt(v.x * v.x + v.z * v.z));
      if (reaches_.back() > reach_) reach_ = reaches_.back();
    }
  }

  /// @param smallest share of the first approach speed below which an accumulation counts as ended.
  EventSequence<Real> run(std::size_t most, const Real& smallest) {
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

 private:
  static constexpr std::size_t settled = 12;
  static constexpr long most_steps = 20'000'000;

  struct Offset {
    Real tangential, normal;
  };
  [[nodiscard]] Offset offset(std::size_t i, const Real& s, const Real& c) const {
    const auto& v = body_.vertices[i];
    return {v.x * c - v.z * s, v.x * s + v.z * c};
  }
  [[nodiscard]] Offset offset(std::size_t i) const {
    using std::cos, std::sin;
    return offset(i, sin(state_.inclination), cos(state_.inclination));
  }

  [[nodiscard]] std::size_t lowest() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < body_.vertices.size(); ++i) {
      if (offset(i).normal < offset(best).normal) best = i;
    }
    return best;
  }

  /// Of the last `small` impacts: one vertex alone bounced, and the others need far longer to the
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
    const Offset from = offset(last.vertex);
    for (std::size_t i = 0; i < body_.vertices.size(); ++i) {
      if (i == last.vertex) continue;
      const Offset d = offset(i);
      const Real bend = law_.gravity + state_.angular * state_.angular * reaches_[i];
      const Real velocity = state_.normal - state_.angular * d.tangential;
      if (safe_step(d.normal - from.normal, velocity, bend) < 10 * left) return EventEnd::limit;
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

  void follow(Path& path) const {
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
    const Offset d = offset(vertex);
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
    follow(path);
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

  // ---- flight ----

  static Real safe_step(const Real& h, const Real& velocity, const Real& bend) {
    using std::sqrt;
    const Real root = sqrt(velocity * velocity + 2 * bend * h);
    return velocity < 0 ? 2 * h / (root - velocity) : (velocity + root) / bend;
  }

  /// The vertex that arrives first; the state is then that of its touch.
  std::optional<std::size_t> fly(std::size_t from) {
    using std::cos, std::sin, std::sqrt;
    const Real start = -offset(from).normal, V = state_.normal, g = law_.gravity, spin = state_.angular;
    Real t = 0;
    for (long step = 0; step < most_steps; ++step) {
      const Real centre = start + t * (V - g * t / 2), speed = V - g * t;
      if (centre > reach_) {
        if (g == 0 && speed >= 0) return std::nullopt;
        const Real back =
            g == 0 ? t + (centre - reach_) / -speed : t + (speed + sqrt(speed * speed + 2 * g * (centre - reach_))) / g;
        if (back > t * (1 + Real(1e-30))) {
          t = back;
          continue;
        }
      }
      const Real angle = state_.inclination - spin * t, s = sin(angle), c = cos(angle);
      Real stride = -1;
      std::size_t nearest = 0;
      for (std::size_t i = 0; i < body_.vertices.size(); ++i) {
        const Offset d = offset(i, s, c);
        const Real bend = g + spin * spin * reaches_[i], h = centre + d.normal, velocity = speed - spin * d.tangential;
        Real own;
        if (t == 0 && i == from) own = velocity / bend;  // it rises; until twice this time for certain
        else own = h > 0 ? safe_step(h, velocity, bend) : Real(0);
        if (stride < 0 || own < stride) stride = own, nearest = i;
      }
      if (stride <= Real(1e-32) * t) {
        time_ += t;
        state_.inclination = angle;
        state_.normal = speed;
        return nearest;
      }
      t += stride;
    }
    throw std::runtime_error("the flight does not end");
  }

  EventBody<Real> body_;
  EventState<Real> state_;
  EventLaw<Real> law_;
  std::vector<Real> reaches_;
  Real reach_ = 0;
  Real time_ = 0;
};

}  // namespace clatter::oracle
