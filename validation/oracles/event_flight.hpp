// SPDX-License-Identifier: GPL-3.0-or-later
// The free flight of a planar body to its next contact, by steps that provably pass none.
//
// With |h″| <= M = g + Ω²ρ, ρ the vertex's distance from the centre of mass, a vertex at height h with velocity h′
// cannot reach the ground before the positive zero Δ of h + h′Δ − MΔ²/2.  Steps of that size never pass a contact,
// however short or grazing, and close in on it quadratically.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

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

  /// Of a contact time, relative.
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

}  // namespace clatter::oracle
