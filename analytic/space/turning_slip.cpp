// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/turning_slip.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "analytic/detail/limits.hpp"
#include "analytic/errors.hpp"

namespace clatter::analytic::space {

using detail::epsilon;

namespace {

constexpr int order = 15;
/// y beyond which the direction is the attracting one to rounding.
constexpr double last_y = 37;
constexpr double longest_panel = 8;
/// Neglected Legendre coefficients of an integrand stay below this part of the integral.
constexpr double resolution = 1e-14;

using Nodes = Eigen::Array<double, order, 1>;

/// Gauss–Legendre rule on [−1, 1] with integrals from −1 to each node and the last two Legendre coefficients.
struct Rule {
  Nodes nodes, weights, last, before_last;
  Eigen::Matrix<double, order, order> integral;

  Rule() {
    using Gauss = boost::math::quadrature::gauss<double, order>;
    constexpr int half = order / 2;
    for (int i = 0; i <= half; ++i) {
      const auto k = static_cast<std::size_t>(i);
      nodes[half + i] = Gauss::abscissa()[k], weights[half + i] = Gauss::weights()[k];
      nodes[half - i] = -nodes[half + i], weights[half - i] = weights[half + i];
    }
    Eigen::Array<double, order, order + 1> legendre;  // P_k at the nodes
    legendre.col(0) = 1, legendre.col(1) = nodes;
    for (int k = 1; k < order; ++k) {
      legendre.col(k + 1) = ((2 * k + 1) * nodes * legendre.col(k) - k * legendre.col(k - 1)) / (k + 1);
    }
    for (int i = 0; i < order; ++i) {
      for (int j = 0; j < order; ++j) {
        double sum = nodes[i] + 1;
        for (int k = 1; k < order; ++k) sum += legendre(j, k) * (legendre(i, k + 1) - legendre(i, k - 1));
        integral(i, j) = weights[j] / 2 * sum;
      }
    }
    last = (order - 0.5) * weights * legendre.col(order - 1);
    before_last = (order - 1.5) * weights * legendre.col(order - 2);
  }
  [[nodiscard]] Nodes to_nodes(const Nodes& f) const { return (integral * f.matrix()).array(); }
  [[nodiscard]] double total(const Nodes& f) const { return (weights * f).sum(); }
  [[nodiscard]] double tail(const Nodes& f) const {
    return std::fabs((last * f).sum()) + std::fabs((before_last * f).sum());
  }
};

const Rule& rule() {
  static const Rule the_rule;
  return the_rule;
}

/// g about one of its zeros: g(φ₀ + ξ) = 2 sin(ξ/2) [−γ sin(3ξ/2) + cos(ξ/2) (β + 2δ cos ξ)], exact near ξ = 0.
class NearZero {
 public:
  NearZero(const SlipField& field, const Direction& zero)
      : zero_(zero), sine_rate_(-field.b1() * zero.cosine - field.b2() * zero.sine),
        cosine2_(field.anisotropy() * zero.sine * zero.cosine),
        sine2_(field.anisotropy() / 2 * (zero.cosine - zero.sine) * (zero.cosine + zero.sine)) {}

  struct Turn {
    Direction direction;
    double per_offset;  ///< g/ξ
  };
  [[nodiscard]] Turn at(double offset) const {
    const double s = std::sin(offset / 2), c = std::cos(offset / 2);
    const double cosine = 1 - 2 * s * s, sine = 2 * s * c;
    const double bracket = -cosine2_ * s * (4 * c * c - 1) + c * (sine_rate_ + 2 * sine2_ * cosine);
    return {
        {zero_.angle + offset, zero_.cosine * cosine - zero_.sine * sine, zero_.sine * cosine + zero_.cosine * sine},
        (offset == 0 ? 1 : 2 * s / offset) * bracket};
  }

 private:
  Direction zero_;
  double sine_rate_, cosine2_, sine2_;
};

struct Point {
  double y = 0;
  double log_slip = 0;
};

/// Integrands at the nodes of a panel, and the integrals to its nodes and end.
struct Panel {
  double from, length;
  Nodes slip_growth, impulse_rate, normal_rate, storing;
  Nodes log_slip, impulse, normal_velocity, store;
  double end_log_slip;
  double noise = 0;  ///< relative rounding error of the integrands, large where slip hardly turns
  Measure end;
  Vector2 friction;  ///< gained in the panel
};

class TurningPath {
 public:
  TurningPath(const SlipField& field, const SlipArc& arc, PathProgress& progress)
      : field_(field), attracting_(arc.attracting), width_(std::fabs(arc.attracting.angle - arc.repelling.angle)),
        sense_(arc.attracting.angle > arc.repelling.angle ? 1 : -1), from_repelling_(field, arc.repelling),
        from_attracting_(field, arc.attracting), final_rate_(field.slip_rate(arc.attracting)),
        progress_(progress), point_{std::log(std::fabs(arc.angle - arc.repelling.angle) /
                                             std::fabs(arc.attracting.angle - arc.angle)),
                                    std::log(progress.slip)} {}

  Direction follow();

 private:
  /// Direction, dτ/dy, relative rounding error of that, and the distance from the attracting direction, at y.
  struct Place {
    Direction direction;
    double time_rate;
    double noise;
    double distance;
  };
  [[nodiscard]] Place place(double y) const;
  [[nodiscard]] Panel panel(double length) const;
  [[nodiscard]] bool is_resolved(const Panel& panel) const;
  [[nodiscard]] bool is_straight_from_here() const;
  /// First node with an excess that is not negative; `order` for the end, order + 1 for none.
  [[nodiscard]] int first_reached(const Panel& panel) const;
  [[nodiscard]] Measure measure(const Panel& panel, int node) const;
  [[nodiscard]] double node_y(const Panel& panel, int node) const;
  void end_stage_in(const Panel& panel, int node);
  void accept(const Panel& panel);

  const SlipField& field_;
  Direction attracting_;
  double width_, sense_;
  NearZero from_repelling_, from_attracting_;
  double final_rate_;
  PathProgress& progress_;
  Point point_;
};

TurningPath::Place TurningPath::place(double y) const {
  const double ratio = std::exp(-std::fabs(y));
  const double near = width_ * ratio / (1 + ratio), far = width_ / (1 + ratio);
  const bool starts = y < 0;
  const NearZero::Turn turn = starts ? from_repelling_.at(sense_ * near) : from_attracting_.at(-sense_ * near);
  const double slowness = 1 / std::fabs(turn.per_offset);
  return {turn.direction, far / width_ * slowness, epsilon * field_.turning_bound() * slowness, starts ? far : near};
}

Panel TurningPath::panel(double length) const {
  const Rule& r = rule();
  const double half = length / 2, friction = field_.friction();
  Panel p;
  p.from = point_.y, p.length = length;
  Nodes time_rate, cosine, sine, rise;
  for (int i = 0; i < order; ++i) {
    const Place at = place(point_.y + half * (1 + r.nodes[i]));
    time_rate[i] = at.time_rate * half;
    p.slip_growth[i] = field_.slip_rate(at.direction) * time_rate[i];
    rise[i] = field_.normal_rate(at.direction);
    p.noise = std::fmax(p.noise, at.noise);
    cosine[i] = at.direction.cosine, sine[i] = at.direction.sine;
  }
  p.log_slip = point_.log_slip + r.to_nodes(p.slip_growth);
  p.end_log_slip = point_.log_slip + r.total(p.slip_growth);
  p.impulse_rate = p.log_slip.exp() * time_rate;
  p.normal_rate = rise * p.impulse_rate;
  p.impulse = progress_.at.impulse + r.to_nodes(p.impulse_rate);
  p.normal_velocity = progress_.at.normal_velocity + r.to_nodes(p.normal_rate);
  p.end = {.impulse = progress_.at.impulse + r.total(p.impulse_rate),
           .normal_velocity = progress_.at.normal_velocity + r.total(p.normal_rate)};
  p.friction = {-friction * r.total(cosine * p.impulse_rate), -friction * r.total(sine * p.impulse_rate)};
  if (progress_.is_energetic()) {
    p.storing = -p.normal_velocity / (1 - progress_.damping() * p.normal_velocity) * p.impulse_rate;
    p.store = progress_.at.store + r.to_nodes(p.storing);
    p.end.store = progress_.at.store + r.total(p.storing);
  }
  return p;
}

bool TurningPath::is_resolved(const Panel& p) const {
  const Rule& r = rule();
  const double noise = order * p.noise;
  const double growth = p.slip_growth.abs().maxCoeff();
  if (!(r.tail(p.slip_growth) <= resolution * (1 + growth) + noise * growth)) return false;
  if (!(r.tail(p.impulse_rate) <= resolution * p.end.impulse + noise * p.impulse_rate.maxCoeff())) return false;
  if (!progress_.is_energetic()) return true;
  const double damping = progress_.damping();
  const double fastest = std::fmax(p.normal_velocity.maxCoeff(), p.end.normal_velocity);
  if (!(1 - damping * fastest > (1 - damping * progress_.at.normal_velocity) / 4)) return false;
  // Rounding of u, which is that of p and of the approach speed 1, over what is left of 1 − τu.
  const double of_speed = order * epsilon * damping * (1 + p.end.impulse) / (1 - damping * fastest);
  const double stored = progress_.at.store + p.storing.abs().sum();
  return r.tail(p.storing) <= resolution * stored + (noise + of_speed) * p.storing.abs().maxCoeff();
}

bool TurningPath::is_straight_from_here() const {
  if (point_.y >= last_y) return true;
  if (!(final_rate_ < 0)) return false;
  const double distance = place(point_.y).distance;
  const double bend = distance * 2 * field_.turning_bound() / -final_rate_;
  return bend < 0.5 && progress_.slip / -final_rate_ * bend <= epsilon / 8 * progress_.at.impulse;
}

Measure TurningPath::measure(const Panel& p, int node) const {
  if (node < 0) return progress_.at;
  if (node >= order) return p.end;
  return {p.impulse[node], p.normal_velocity[node], progress_.is_energetic() ? p.store[node] : 0};
}

double TurningPath::node_y(const Panel& p, int node) const {
  if (node < 0) return 0;
  return node >= order ? p.length : p.length / 2 * (1 + rule().nodes[node]);
}

int TurningPath::first_reached(const Panel& p) const {
  int node = 0;
  while (node <= order && !(progress_.excess(measure(p, node)) >= 0)) ++node;
  return node;
}

void TurningPath::accept(const Panel& p) {
  point_ = {p.from + p.length, p.end_log_slip};
  progress_.at = p.end;
  progress_.friction += p.friction;
  progress_.slip = std::exp(p.end_log_slip);
  progress_.least_slip = std::fmin(std::fmin(progress_.least_slip, progress_.slip), std::exp(p.log_slip.minCoeff()));
}

/// Newton's method for the length of the panel at whose end the stage ends, in the bracket that two nodes give.
void TurningPath::end_stage_in(const Panel& coarse, int node) {
  double low = node_y(coarse, node - 1), high = node_y(coarse, node);
  const double below = progress_.excess(measure(coarse, node - 1)), above = progress_.excess(measure(coarse, node));
  if (!(below < 0)) return progress_.end_stage();
  double length = low - (high - low) * below / (above - below);
  for (int i = 0; i < 100; ++i) {
    const Panel trial = panel(length);
    const double excess = progress_.excess(trial.end);
    (excess < 0 ? low : high) = length;
    const Place end = place(point_.y + length);
    const double rate = progress_.excess_rate(trial.end, field_.normal_rate(end.direction)) *
                        std::exp(trial.end_log_slip) * end.time_rate;
    const double next = length - excess / rate;
    // Convergence is quadratic: behind a step this short lies one of rounding's size.
    if (std::fabs(next - length) <= 1e-8 * coarse.length || high - low <= 2 * epsilon * coarse.length) {
      accept(panel(std::fmax(next, 0.0)));
      return progress_.end_stage();
    }
    length = next > low && next < high ? next : low + (high - low) / 2;
  }
  throw NumericalError("the end of an impact's stage could not be located along its turning slip");
}

Direction TurningPath::follow() {
  constexpr int budget = 4000;
  const Place start = place(point_.y);
  const double growth = std::fabs(field_.slip_rate(start.direction)) * start.time_rate;
  // A slip much faster than the approach hardly turns before the impact ends: the first panel must see that end.
  const double pushing = progress_.slip * start.time_rate;
  double length = std::fmin(longest_panel / 2, 4 / std::fmax(growth, pushing));
  for (int i = 0; i < budget; ++i) {
    if (progress_.is_at_limit_speed()) progress_.end_stage();
    if (progress_.is_done()) return place(point_.y).direction;
    if (is_straight_from_here()) return attracting_;
    const Panel p = panel(length);
    if (!is_resolved(p)) {
      length /= 2;
      continue;
    }
    const int reached = first_reached(p);
    if (reached <= order) end_stage_in(p, reached);
    else {
      accept(p);
      length = std::fmin(2 * length, longest_panel);
    }
  }
  throw NumericalError("the turning slip of an impact could not be resolved");
}

}  // namespace

Direction follow_turning_slip(const SlipField& field, const SlipArc& arc, PathProgress& progress) {
  return TurningPath(field, arc, progress).follow();
}

}  // namespace clatter::analytic::space
