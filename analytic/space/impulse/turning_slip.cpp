// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse/turning_slip.hpp"

#include <cmath>
#include <type_traits>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/space/flight/gauss_rule.hpp"

namespace clatter::analytic::space {

using detail::epsilon;
using detail::value_of;

namespace {

constexpr int node_count = 15;
/// y beyond which the direction is the attracting one to rounding.
constexpr double last_y = 37;
constexpr double longest_panel = 8;
/// Neglected Legendre coefficients of an integrand stay below this part of the integral.
constexpr double resolution = 1e-14;

using Nodes = GaussRule<node_count>::Array;

/// Gauss–Legendre rule on [−1, 1] with integrals from −1 to each node and the last two Legendre coefficients.
struct PanelRule : GaussRule<node_count> {
  Nodes last, before_last;
  Eigen::Array<double, node_count, node_count> integral;

  PanelRule() {
    Eigen::Array<double, node_count, node_count + 1> legendre;  // P_k at the nodes
    legendre.col(0) = 1, legendre.col(1) = nodes;
    for (int k = 1; k < node_count; ++k) {
      legendre.col(k + 1) = ((2 * k + 1) * nodes * legendre.col(k) - k * legendre.col(k - 1)) / (k + 1);
    }
    for (int i = 0; i < node_count; ++i) {
      for (int j = 0; j < node_count; ++j) {
        double sum = nodes[i] + 1;
        for (int k = 1; k < node_count; ++k) sum += legendre(j, k) * (legendre(i, k + 1) - legendre(i, k - 1));
        integral(i, j) = weights[j] / 2 * sum;
      }
    }
    last = (node_count - 0.5) * weights * legendre.col(node_count - 1);
    before_last = (node_count - 1.5) * weights * legendre.col(node_count - 2);
  }
  [[nodiscard]] Nodes to_nodes(const Nodes& f) const {
    Nodes sum = f[0] * integral.col(0);
    for (int j = 1; j < node_count; ++j) sum += f[j] * integral.col(j);
    return sum;
  }
  [[nodiscard]] double total(const Nodes& f) const { return (weights * f).sum(); }
  [[nodiscard]] double tail(const Nodes& f) const {
    return std::fabs((last * f).sum()) + std::fabs((before_last * f).sum());
  }
};

const PanelRule& panel_rule() {
  static const PanelRule the_rule;
  return the_rule;
}

struct Point {
  double y = 0;
  double log_slip = 0;
};

/// Direction and the factor of (1) and (3) at the nodes of a panel or at one place.
template <class Values>
struct ArcPlaces {
  Values cosine, sine;  ///< of φ
  Values pace;          ///< dξ/dy
  Values of_width;      ///< ∂ξ/∂w at a fixed y
  Values factor;        ///< E
};

/// (1) and (2).
class ArcMap {
 public:
  ArcMap(const SlipField& field, const SlipArc& arc)
      : from_(arc.repelling), sense_(arc.attracting.angle > arc.repelling.angle ? 1 : -1),
        middle_(direction_at((arc.attracting.angle + arc.repelling.angle) / 2)) {
    const double width = std::fabs(arc.attracting.angle - arc.repelling.angle);
    cosine_ = std::cos(width / 2), sine_ = std::sin(width / 2);
    anisotropy_ = field.anisotropy();
    constant_ = field.b2() * middle_.cosine - field.b1() * middle_.sine +
                anisotropy_ * cosine_ * 2 * middle_.sine * middle_.cosine;
  }

  /// @param ratio  ρ
  template <class Values>
  [[nodiscard]] ArcPlaces<Values> at(const Values& ratio) const {
    const Values weight = 1 / (1 + ratio * (2 * cosine_ + ratio));
    const Values pace = 2 * sine_ * ratio * weight;
    const Values cosine = 1 - sine_ * ratio * pace, sine = sense_ * (1 + cosine_ * ratio) * pace;
    ArcPlaces<Values> p{.cosine = from_.cosine * cosine - from_.sine * sine,
                        .sine = from_.sine * cosine + from_.cosine * sine,
                        .pace = pace,
                        .of_width = ratio * (ratio + cosine_) * weight,
                        .factor = pace};
    p.factor = constant_ + anisotropy_ * (p.sine * middle_.cosine + p.cosine * middle_.sine);
    return p;
  }
  /// dτ/dy for E.
  template <class Values>
  [[nodiscard]] Values time_rate(const Values& factor) const {
    return sense_ / sine_ / factor;
  }
  [[nodiscard]] double sense() const { return sense_; }
  /// Cosine and sine of m.
  [[nodiscard]] const Direction& middle() const { return middle_; }
  /// κ and sin(w/2).
  [[nodiscard]] double half_cosine() const { return cosine_; }
  [[nodiscard]] double half_sine() const { return sine_; }

 private:
  Direction from_;
  double sense_;
  Direction middle_;
  double cosine_, sine_, anisotropy_, constant_;
};

/// Integrands at the nodes of a panel, and the integrals to its nodes and end.
struct Panel {
  double from, length;
  ArcPlaces<Nodes> places;
  Nodes time_rate, slip_rate, rise;  ///< dτ/dy × half the length, f, h
  Nodes slip_growth, impulse_rate, normal_rate, storing;
  Nodes log_slip, impulse, normal_velocity, store;
  double end_log_slip;
  double noise = 0;  ///< relative rounding error of the integrands, large where slip hardly turns
  Measure<> end;
  Vector2 friction;  ///< gained in the panel
};

/// How the path to the end of a panel changes, y counted from the start of the path, by the variables of PathDual.
struct TurningSlopes {
  std::array<double, 5> y{}, log_slip{};
};

/// Assigns a value and leaves the derivatives.
void set_value(double& number, double value) { number = value; }
void set_value(PathDual& number, double value) { number.value = value; }

template <class Number>
class TurningPath {
 public:
  TurningPath(const SlipField& field, const SlipArc& arc, const SlipArcSlopes* slopes, PathProgress<Number>& progress)
      : field_(field), attracting_(arc.attracting), map_(field, arc), final_rate_(field.slip_rate(arc.attracting)),
        slopes_(slopes), progress_(progress),
        at_(values(progress.at)), point_{std::log(std::sin(std::fabs(arc.angle - arc.repelling.angle) / 2) /
                                                  std::sin(std::fabs(arc.attracting.angle - arc.angle) / 2)),
                                         std::log(value_of(progress.slip))} {
    if constexpr (follows_slopes) start_slopes();
  }

  Direction follow() {
    constexpr int budget = 4000;
    const Place start = place(point_.y);
    const double growth = std::fabs(field_.slip_rate(start.direction)) * start.time_rate;
    // A slip much faster than the approach hardly turns before the impact ends: the first panel must see that end.
    const double pushing = value_of(progress_.slip) * start.time_rate;
    double length = std::fmin(longest_panel / 2, 4 / std::fmax(growth, pushing));
    for (int i = 0; i < budget; ++i) {
      if (progress_.is_at_limit_speed()) end_stage();
      if (progress_.is_done()) return place(point_.y).direction;
      if (is_straight_from_here()) return attracting_;
      const Panel p = panel(length);
      if (!is_resolved(p)) {
        length /= 2;
        continue;
      }
      const int reached = first_reached(p);
      if (reached <= node_count) end_stage_in(p, reached);
      else {
        accept(p);
        length = std::fmin(2 * length, longest_panel);
      }
    }
    throw NumericalError("the turning slip of an impact could not be resolved");
  }

 private:
  static constexpr bool follows_slopes = !std::is_same_v<Number, double>;
  static Measure<> values(const Measure<Number>& m) {
    return {value_of(m.impulse), value_of(m.normal_velocity), value_of(m.store)};
  }
  /// Direction, dτ/dy, and the distance from the attracting direction, at y.
  struct Place {
    Direction direction;
    double time_rate;
    double distance;
  };

  [[nodiscard]] Place place(double y) const {
    const ArcPlaces<double> at = map_.at(std::exp(y));
    const double left = std::exp(-y);
    return {{std::atan2(at.sine, at.cosine), at.cosine, at.sine},
            map_.time_rate(at.factor),
            2 * std::atan2(left * map_.half_sine(), 1 + left * map_.half_cosine())};
  }

  [[nodiscard]] Panel panel(double length) const {
    const PanelRule& r = panel_rule();
    const double half = length / 2, friction = field_.friction();
    Panel p;
    p.from = point_.y, p.length = length;
    p.places = map_.at<Nodes>((point_.y + half * (1 + r.nodes)).exp());
    const auto& [cosine, sine, pace, of_width, factor] = p.places;
    p.time_rate = half * map_.time_rate(factor);
    p.noise = epsilon * field_.turning_bound() / (map_.half_sine() * factor.abs().minCoeff());
    const Nodes push = field_.b1() * cosine + field_.b2() * sine;
    p.slip_rate = push - friction * (field_.a1() * cosine * cosine + field_.a2() * sine * sine);
    p.rise = 1 - field_.normal_coupling() * friction * push;
    p.slip_growth = p.slip_rate * p.time_rate;
    p.log_slip = point_.log_slip + r.to_nodes(p.slip_growth);
    p.end_log_slip = point_.log_slip + r.total(p.slip_growth);
    p.impulse_rate = p.log_slip.exp() * p.time_rate;
    p.normal_rate = p.rise * p.impulse_rate;
    p.impulse = at_.impulse + r.to_nodes(p.impulse_rate);
    p.normal_velocity = at_.normal_velocity + r.to_nodes(p.normal_rate);
    p.end = {.impulse = at_.impulse + r.total(p.impulse_rate),
             .normal_velocity = at_.normal_velocity + r.total(p.normal_rate)};
    p.friction = {-friction * r.total(cosine * p.impulse_rate), -friction * r.total(sine * p.impulse_rate)};
    if (progress_.is_energetic()) {
      p.storing = -p.normal_velocity / (1 - progress_.damping() * p.normal_velocity) * p.impulse_rate;
      p.store = at_.store + r.to_nodes(p.storing);
      p.end.store = at_.store + r.total(p.storing);
    }
    return p;
  }

  [[nodiscard]] bool is_resolved(const Panel& p) const {
    const PanelRule& r = panel_rule();
    const double noise = node_count * p.noise;
    const double growth = p.slip_growth.abs().maxCoeff();
    if (!(r.tail(p.slip_growth) <= resolution * (1 + growth) + noise * growth)) return false;
    if (!(r.tail(p.impulse_rate) <= resolution * p.end.impulse + noise * p.impulse_rate.maxCoeff())) return false;
    if (!progress_.is_energetic()) return true;
    const double damping = progress_.damping();
    const double fastest = std::fmax(p.normal_velocity.maxCoeff(), p.end.normal_velocity);
    if (!(1 - damping * fastest > (1 - damping * at_.normal_velocity) / 4)) return false;
    // Rounding of u, which is that of p and of the approach speed 1, over what is left of 1 − τu.
    const double of_speed = node_count * epsilon * damping * (1 + p.end.impulse) / (1 - damping * fastest);
    const double stored = at_.store + p.storing.abs().sum();
    return r.tail(p.storing) <= resolution * stored + (noise + of_speed) * p.storing.abs().maxCoeff();
  }

  [[nodiscard]] bool is_straight_from_here() const {
    if (point_.y >= last_y) return true;
    if (!(final_rate_ < 0)) return false;
    const double distance = place(point_.y).distance;
    const double bend = distance * 2 * field_.turning_bound() / -final_rate_;
    return bend < 0.5 && value_of(progress_.slip) / -final_rate_ * bend <= epsilon / 8 * at_.impulse;
  }

  /// First node with an excess that is not negative; `node_count` for the end, node_count + 1 for none.
  [[nodiscard]] int first_reached(const Panel& p) const {
    int node = 0;
    while (node <= node_count && !(progress_.excess(measure(p, node)) >= 0)) ++node;
    return node;
  }

  [[nodiscard]] Measure<> measure(const Panel& p, int node) const {
    if (node < 0) return at_;
    if (node >= node_count) return p.end;
    return {p.impulse[node], p.normal_velocity[node], progress_.is_energetic() ? p.store[node] : 0};
  }

  [[nodiscard]] double node_y(const Panel& p, int node) const {
    if (node < 0) return 0;
    return node >= node_count ? p.length : p.length / 2 * (1 + panel_rule().nodes[node]);
  }

  /// Newton's method for the length of the panel at whose end the stage ends, in the bracket that two nodes give.
  void end_stage_in(const Panel& coarse, int node) {
    double low = node_y(coarse, node - 1), high = node_y(coarse, node);
    const double below = progress_.excess(measure(coarse, node - 1)), above = progress_.excess(measure(coarse, node));
    if (!(below < 0)) return end_stage();
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
        return end_stage();
      }
      length = next > low && next < high ? next : low + (high - low) / 2;
    }
    throw NumericalError("the end of an impact's stage could not be located along its turning slip");
  }

  void accept(const Panel& p) {
    if constexpr (follows_slopes) {
      for (std::size_t k = 0; k < turned_.y.size(); ++k) add_slopes(p, k);
    }
    point_ = {p.from + p.length, p.end_log_slip};
    at_ = p.end;
    set_value(progress_.at.impulse, p.end.impulse);
    set_value(progress_.at.normal_velocity, p.end.normal_velocity);
    set_value(progress_.at.store, p.end.store);
    for (std::size_t i = 0; i < 2; ++i) {
      set_value(progress_.friction[i], value_of(progress_.friction[i]) + p.friction[static_cast<int>(i)]);
    }
    const double slip = std::exp(p.end_log_slip);
    set_value(progress_.slip, slip);
    if constexpr (follows_slopes) {
      for (std::size_t k = 0; k < turned_.y.size(); ++k) progress_.slip.slope[k] = slip * turned_.log_slip[k];
    }
    progress_.least_slip = std::fmin(std::fmin(progress_.least_slip, slip), std::exp(p.log_slip.minCoeff()));
  }

  void end_stage() {
    if constexpr (follows_slopes) move_end();
    progress_.end_stage();
    at_ = values(progress_.at);
  }

  /// δy, so that the angle at the start changes as given.
  void start_slopes() {
    const ArcPlaces<double> start = map_.at(std::exp(point_.y));
    for (std::size_t k = 0; k < turned_.y.size(); ++k) {
      double turn = slopes_->angle[k];
      if (k < 2) {
        const int row = static_cast<int>(k);
        const double width = map_.sense() * (slopes_->attracting[row] - slopes_->repelling[row]);
        turn -= slopes_->repelling[row] + map_.sense() * start.of_width * width;
      }
      turned_.y[k] = map_.sense() * turn / start.pace;
      turned_.log_slip[k] = progress_.slip.slope[k] / progress_.slip.value;
    }
  }

  /// Derivatives by one variable of φ, E, f and h at the nodes of a panel of fixed length, and of sin(w/2), relative.
  struct NodeChanges {
    Nodes turn, factor, slip_rate, rise;
    double stretch = 0;
  };

  [[nodiscard]] NodeChanges changes(const ArcPlaces<Nodes>& places, std::size_t k) const {
    const auto& [cosine, sine, pace, of_width, factor] = places;
    const double friction = field_.friction(), anisotropy = field_.anisotropy();
    const Direction& m = map_.middle();
    const double sine2 = 2 * m.sine * m.cosine, cosine2 = (m.cosine - m.sine) * (m.cosine + m.sine);
    const Nodes sum_sine = sine * m.cosine + cosine * m.sine, sum_cosine = cosine * m.cosine - sine * m.sine;
    NodeChanges c{
        .turn = map_.sense() * turned_.y[k] * pace, .factor = pace, .slip_rate = Nodes::Zero(), .rise = Nodes::Zero()};
    c.factor = anisotropy * sum_cosine * c.turn;
    if (k < 2) {
      const int row = static_cast<int>(k);
      const SlipFieldSlopes& f = slopes_->field;
      const double from = slopes_->repelling[row], to = slopes_->attracting[row];
      const double width = map_.sense() * (to - from), middle = (from + to) / 2;
      const Nodes moved = from + map_.sense() * width * of_width;
      c.turn += moved;
      c.stretch = width / 2 * map_.half_cosine() / map_.half_sine();
      c.factor += anisotropy * sum_cosine * (moved + middle) + f.b2[row] * m.cosine - f.b1[row] * m.sine -
                  (field_.b2() * m.sine + field_.b1() * m.cosine) * middle +
                  anisotropy * (2 * map_.half_cosine() * cosine2 * middle - map_.half_sine() * width / 2 * sine2) +
                  friction * ((f.a11[row] - f.a22[row]) * (map_.half_cosine() * sine2 + sum_sine) -
                              2 * f.a12[row] * (map_.half_cosine() * cosine2 + sum_cosine));
      const Nodes push = f.b1[row] * cosine + f.b2[row] * sine;
      c.slip_rate =
          push - friction * (f.a11[row] * cosine * cosine + 2 * f.a12[row] * cosine * sine + f.a22[row] * sine * sine);
      c.rise = -friction * push;
    }
    const Nodes across = field_.b2() * cosine - field_.b1() * sine;  // of b to the direction of slip
    c.slip_rate += (across + 2 * anisotropy * sine * cosine) * c.turn;
    c.rise -= friction * across * c.turn;
    return c;
  }

  /// Adds what the variable k does to the integrals of a panel of fixed length.
  void add_slopes(const Panel& p, std::size_t k) {
    const PanelRule& r = panel_rule();
    const Nodes &cosine = p.places.cosine, &sine = p.places.sine;
    const NodeChanges c = changes(p.places, k);
    const Nodes slowing = -c.factor / p.places.factor - c.stretch;  // of dτ/dy, relative
    const Nodes growth = (c.slip_rate + p.slip_rate * slowing) * p.time_rate;
    const Nodes impulse = p.impulse_rate * (turned_.log_slip[k] + r.to_nodes(growth) + slowing);
    const Nodes velocity = c.rise * p.impulse_rate + p.rise * impulse;
    if (progress_.is_energetic()) {
      const Nodes left = 1 / (1 - progress_.damping() * p.normal_velocity);
      const Nodes speed = progress_.at.normal_velocity.slope[k] + r.to_nodes(velocity);
      progress_.at.store.slope[k] -= r.total(left * (p.normal_velocity * impulse + left * speed * p.impulse_rate));
    }
    turned_.log_slip[k] += r.total(growth);
    progress_.at.impulse.slope[k] += r.total(impulse);
    progress_.at.normal_velocity.slope[k] += r.total(velocity);
    const double friction = field_.friction();
    progress_.friction[0].slope[k] -= friction * r.total(cosine * impulse - sine * c.turn * p.impulse_rate);
    progress_.friction[1].slope[k] -= friction * r.total(sine * impulse + cosine * c.turn * p.impulse_rate);
  }

  /// Moves the end of the path to where the changed path ends the stage.
  void move_end() {
    const Place end = place(point_.y);
    const double time_rate = end.time_rate, impulse = std::exp(point_.log_slip) * time_rate;
    const double rise = field_.normal_rate(end.direction);
    const Number excess = progress_.excess(progress_.at);
    const double rate = progress_.excess_rate(at_, rise) * impulse;
    for (std::size_t k = 0; k < turned_.y.size(); ++k) {
      const double shift = -excess.slope[k] / rate;
      turned_.y[k] += shift;
      turned_.log_slip[k] += field_.slip_rate(end.direction) * time_rate * shift;
      progress_.slip.slope[k] = progress_.slip.value * turned_.log_slip[k];
      progress_.at.impulse.slope[k] += impulse * shift;
      progress_.at.normal_velocity.slope[k] += rise * impulse * shift;
      progress_.at.store.slope[k] += progress_.storing(at_.normal_velocity) * impulse * shift;
      progress_.friction[0].slope[k] -= field_.friction() * end.direction.cosine * impulse * shift;
      progress_.friction[1].slope[k] -= field_.friction() * end.direction.sine * impulse * shift;
    }
  }

  const SlipField& field_;
  Direction attracting_;
  ArcMap map_;
  double final_rate_;
  const SlipArcSlopes* slopes_;
  PathProgress<Number>& progress_;
  Measure<> at_;
  Point point_;
  TurningSlopes turned_;
};

}  // namespace

template <class Number>
Direction follow_turning_slip(const SlipField& field, const SlipArc& arc, const SlipArcSlopes* slopes,
                              PathProgress<Number>& progress) {
  return TurningPath<Number>(field, arc, slopes, progress).follow();
}

template Direction follow_turning_slip(const SlipField&, const SlipArc&, const SlipArcSlopes*, PathProgress<double>&);
template Direction follow_turning_slip(const SlipField&, const SlipArc&, const SlipArcSlopes*, PathProgress<PathDual>&);

}  // namespace clatter::analytic::space
