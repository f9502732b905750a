// Impact sequences of any planar body by brute force, in long double: Eq. 8 by Cramer's rule, then
// a march along the height of every vertex.
//
// From a height h with velocity h′, and |h″| <= M = g + Ω²ρ with ρ the vertex's distance from the
// centre of mass, h cannot vanish before the zero Δ of h + h′Δ − MΔ²/2.  Steps of that size never
// pass a contact, however short or grazing, and close in on it quadratically.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace clatter::oracle {

struct MarchVertex {
  long double x = 0, z = 0;  ///< in the body frame, from the centre of mass [m]
};

struct MarchBody {
  long double gyration_radius = 0;  ///< √(I/m) [m]
  std::vector<MarchVertex> vertices;
};

struct MarchState {
  long double inclination = 0;  ///< α, dα/dt = −Ω [rad]
  long double normal = 0;       ///< of the centre of mass [m/s]
  long double tangential = 0;
  long double angular = 0;  ///< Ω [rad/s]
};

struct MarchLaw {
  long double restitution = 1;
  long double impulse_ratio = 0;
  long double gravity = 0;  ///< [m/s²]
};

struct MarchImpact {
  std::size_t vertex = 0;
  long double time = 0;     ///< since the first impact [s]
  long double impulse = 0;  ///< normal, per unit mass [m/s]
};

/// A contact, a passage or a tie so slight that rounding decides about it.
struct CloseCall {
  static constexpr long double depth = 1e-12L;  ///< of a graze or passage, relative to the reach
  static constexpr long double tie = 1e-12L;    ///< between two arrivals, relative to their time
};

struct MarchSequence {
  std::vector<MarchImpact> impacts;
  bool close_call = false;  ///< in any of the flights
};

/// One flight, from an impact at `touching`.
class MarchFlight {
 public:
  struct Arrival {
    std::size_t vertex = 0;
    long double time = 0;
  };

  MarchFlight(const MarchBody& body, const MarchState& state, long double gravity, std::size_t touching)
      : body_(body), state_(state), gravity_(gravity), touching_(touching) {
    centre_ = -offset(body.vertices[touching], state.inclination).normal;
  }

  struct Offset {
    long double tangential = 0, normal = 0;  ///< d of a vertex, world frame
  };
  static Offset offset(const MarchVertex& vertex, long double inclination) {
    const long double s = std::sin(inclination);
    const long double c = std::cos(inclination);
    return {vertex.x * c - vertex.z * s, vertex.x * s + vertex.z * c};
  }

  /// The earliest vertex to reach the ground.
  [[nodiscard]] std::optional<Arrival> run() {
    std::optional<Arrival> first;
    for (std::size_t i = 0; i < body_.vertices.size(); ++i) {
      const auto time = march(i, first ? first->time : infinity);
      if (!time) continue;
      if (first && !(std::abs(*time - first->time) > CloseCall::tie * *time)) close_call_ = true;
      if (!first || *time < first->time) first = Arrival{i, *time};
    }
    return first;
  }

  [[nodiscard]] bool close_call() const { return close_call_; }

 private:
  static constexpr long double infinity = std::numeric_limits<long double>::infinity();
  static constexpr long double resolution = 1e-17L;  ///< of a contact time, relative
  static constexpr int most_steps = 10'000'000;

  struct Height {
    long double value = 0, velocity = 0;
  };

  [[nodiscard]] Height height(const MarchVertex& vertex, long double t) const {
    const Offset d = offset(vertex, state_.inclination - state_.angular * t);
    return {centre_height(t) + d.normal, state_.normal - gravity_ * t - state_.angular * d.tangential};
  }
  [[nodiscard]] long double centre_height(long double t) const {
    return centre_ + t * (state_.normal - gravity_ * t / 2);
  }

  /// First contact of one vertex, if not clearly later than `until`.
  [[nodiscard]] std::optional<long double> march(std::size_t index, long double until) {
    const MarchVertex& vertex = body_.vertices[index];
    const long double reach = std::hypot(vertex.x, vertex.z);
    const long double bend = gravity_ + state_.angular * state_.angular * reach;
    long double t = index == touching_ ? height(vertex, 0).velocity / bend : 0;
    bool falling = false;
    for (int step = 0; step < most_steps; ++step) {
      if (t > until * (1 + 2 * CloseCall::tie)) return std::nullopt;
      const Height h = height(vertex, t);
      const bool turned = falling && h.velocity >= 0;
      falling = h.velocity < 0;
      if (turned && h.value < CloseCall::depth * reach) close_call_ = true;
      const long double stride = h.value > 0 ? safe_step(h, bend) : 0;
      if (stride <= resolution * t) {
        if (h.velocity * h.velocity < 2 * bend * CloseCall::depth * reach) close_call_ = true;
        return t;
      }
      t = std::max(t + stride, back_in_reach(t, reach));
      if (t == infinity) return std::nullopt;
    }
    throw std::runtime_error("the march does not end");
  }

  /// The positive zero of h + h′Δ − MΔ²/2, without cancellation.
  static long double safe_step(const Height& h, long double bend) {
    const long double root = std::sqrt(h.velocity * h.velocity + 2 * bend * h.value);
    return h.velocity < 0 ? 2 * h.value / (root - h.velocity) : (h.velocity + root) / bend;
  }

  /// While the centre of mass is higher than a vertex reaches, it cannot touch: the time at which
  /// that ends, infinite if it never does, 0 if the centre is not that high.
  [[nodiscard]] long double back_in_reach(long double t, long double reach) const {
    if (!(centre_height(t) > reach)) return 0;
    const long double v = state_.normal;
    if (gravity_ == 0) return v >= 0 ? infinity : (centre_ - reach) / -v;
    return (v + std::sqrt(v * v + 2 * gravity_ * (centre_ - reach))) / gravity_;
  }

  MarchBody body_;
  MarchState state_;
  long double gravity_;
  std::size_t touching_;
  long double centre_ = 0;  ///< height of the centre of mass at t = 0
  bool close_call_ = false;
};

/// Eq. 8 for unit mass: P_n and P_t = μ_i P_n eliminated, Cramer's rule for V_n and Ω of
///     k²(Ω − ω) = (μ_i d_n − d_t)(V_n − v_n),    V_n − d_t Ω = −e (v_n − d_t ω).
/// Changes `state` and returns the normal impulse.
inline long double march_strike(const MarchBody& body, std::size_t vertex, const MarchLaw& law, MarchState& state) {
  const auto d = MarchFlight::offset(body.vertices[vertex], state.inclination);
  const long double k2 = body.gyration_radius * body.gyration_radius;
  const long double arm = law.impulse_ratio * d.normal - d.tangential;
  const long double spin = k2 * state.angular - arm * state.normal;
  const long double leave = -law.restitution * (state.normal - d.tangential * state.angular);
  const long double determinant = arm * d.tangential - k2;  // of rows (−arm, k²), (1, −d_t)
  const long double normal = (-spin * d.tangential - k2 * leave) / determinant;
  const long double angular = (-arm * leave - spin) / determinant;
  const long double impulse = normal - state.normal;
  state.normal = normal;
  state.tangential += law.impulse_ratio * impulse;
  state.angular = angular;
  return impulse;
}

/// The first impacts of a body that touches the ground with `first` in the given state.
inline MarchSequence march_sequence(const MarchBody& body, MarchState state, std::size_t first, const MarchLaw& law,
                                    std::size_t impacts) {
  MarchSequence sequence;
  MarchImpact impact{first, 0, 0};
  for (;;) {
    impact.impulse = march_strike(body, impact.vertex, law, state);
    sequence.impacts.push_back(impact);
    if (sequence.impacts.size() == impacts) return sequence;
    MarchFlight flight(body, state, law.gravity, impact.vertex);
    const auto arrival = flight.run();
    sequence.close_call = sequence.close_call || flight.close_call();
    if (!arrival) return sequence;
    impact.vertex = arrival->vertex;
    impact.time += arrival->time;
    state.inclination -= state.angular * arrival->time;
    state.normal -= law.gravity * arrival->time;
  }
}

}  // namespace clatter::oracle
