// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/impulse_path.hpp"

#include <Eigen/LU>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/coulomb_path.hpp"
#include "analytic/space/body.hpp"
#include "analytic/space/path_progress.hpp"
#include "analytic/space/slip_field.hpp"

namespace clatter::analytic::space {

using detail::epsilon;

namespace {

// Slip that turns: the curved part of an impact's path, by quadrature between two invariant directions.
//
// Slip turns from a repelling direction φ_r towards the next attracting one, φ_a.  With f, g, h of slip_field.hpp and
//     y = ln[(φ − φ_r)/(φ_a − φ)],   dφ/dy = (φ − φ_r)(φ_a − φ)/(φ_a − φ_r),   dτ/dy = (dφ/dy)/g:        (1)
//     d ln σ/dy = f dτ/dy,   dp/dy = σ dτ/dy,   dP_t/dy = −μ s dp/dy,   du/dy = h dp/dy.                    (2)
// g/[(φ − φ_r)(φ_a − φ)] has neither pole nor zero between the two, so that (2) is smooth where slip stops (y → ∞) and
// near both directions; each right-hand side is a function of y and of integrals before it: quadratures, no ODE.

/// Two neighbouring invariant directions, and the angle of slip between them, not nearer to them than rounding.
struct SlipArc {
  Direction repelling;
  Direction attracting;
  double angle = 0;
};

constexpr int node_count = 15;
/// y beyond which the direction is the attracting one to rounding.
constexpr double last_y = 37;
constexpr double longest_panel = 8;
/// Neglected Legendre coefficients of an integrand stay below this part of the integral.
constexpr double resolution = 1e-14;

using Nodes = Eigen::Array<double, node_count, 1>;

/// Gauss–Legendre rule on [−1, 1] with integrals from −1 to each node and the last two Legendre coefficients.
struct Rule {
  Nodes nodes, weights, last, before_last;
  Eigen::Matrix<double, node_count, node_count> integral;

  Rule() {
    using Gauss = boost::math::quadrature::gauss<double, node_count>;
    constexpr int half = node_count / 2;
    for (int i = 0; i <= half; ++i) {
      const auto k = static_cast<std::size_t>(i);
      nodes[half + i] = Gauss::abscissa()[k], weights[half + i] = Gauss::weights()[k];
      nodes[half - i] = -nodes[half + i], weights[half - i] = weights[half + i];
    }
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
  /// First node with an excess that is not negative; `node_count` for the end, node_count + 1 for none.
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
  for (int i = 0; i < node_count; ++i) {
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
  const double noise = node_count * p.noise;
  const double growth = p.slip_growth.abs().maxCoeff();
  if (!(r.tail(p.slip_growth) <= resolution * (1 + growth) + noise * growth)) return false;
  if (!(r.tail(p.impulse_rate) <= resolution * p.end.impulse + noise * p.impulse_rate.maxCoeff())) return false;
  if (!progress_.is_energetic()) return true;
  const double damping = progress_.damping();
  const double fastest = std::fmax(p.normal_velocity.maxCoeff(), p.end.normal_velocity);
  if (!(1 - damping * fastest > (1 - damping * progress_.at.normal_velocity) / 4)) return false;
  // Rounding of u, which is that of p and of the approach speed 1, over what is left of 1 − τu.
  const double of_speed = node_count * epsilon * damping * (1 + p.end.impulse) / (1 - damping * fastest);
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
  if (node >= node_count) return p.end;
  return {p.impulse[node], p.normal_velocity[node], progress_.is_energetic() ? p.store[node] : 0};
}

double TurningPath::node_y(const Panel& p, int node) const {
  if (node < 0) return 0;
  return node >= node_count ? p.length : p.length / 2 * (1 + rule().nodes[node]);
}

int TurningPath::first_reached(const Panel& p) const {
  int node = 0;
  while (node <= node_count && !(progress_.excess(measure(p, node)) >= 0)) ++node;
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
    if (reached <= node_count) end_stage_in(p, reached);
    else {
      accept(p);
      length = std::fmin(2 * length, longest_panel);
    }
  }
  throw NumericalError("the turning slip of an impact could not be resolved");
}

}  // namespace

/// Follows turning slip to the end of the law, or until its direction is the attracting one to rounding.  Returns
/// the direction of slip there.
/// Accuracy: 1e-14 × (1 + changes of ln σ), times what rounding of φ at the start and of g where slip nearly stops
/// does.
/// @throws NumericalError if 4000 panels do not resolve the path.
Direction follow_turning_slip(const SlipField& field, const SlipArc& arc, PathProgress& progress) {
  return TurningPath(field, arc, progress).follow();
}

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// Relative distances below this are decided by rounding of W and v.
constexpr double rounding = 1e-13;
/// Slip below this part of the corner's speed can be brought to any smaller value by rounding.
constexpr double ambiguous_slip = 1e-12;

/// Coulomb's path in units of the approach speed v and of v/W_nn, in the frame of the slip field.
class CoulombPath {
 public:
  CoulombPath(const Contact& contact, const Law& law, NormalCoupling coupling)
      : contact_(contact), speed_(-contact.velocity.z()),
        field_(contact.inverse_inertia, law.law.friction_value, coupling),
        velocity_(field_.to_frame(contact.velocity.head<2>() / speed_)),
        progress_(
            {.law = law.law.law, .restitution = law.law.restitution, .damping = law.law.damping_per_stiffness * speed_},
            velocity_.norm()) {}

  ContactImpulse follow();

 private:
  void slip();
  void slip_straight(const Direction& direction);
  void slip_along_arc(double angle);
  void go_on_from_rest(bool has_slipped);
  [[nodiscard]] double direction_tolerance(const Direction& invariant) const;
  [[nodiscard]] bool is_invariant(double angle) const;
  [[nodiscard]] bool is_ambiguous() const;

  const Contact& contact_;
  double speed_;
  SlipField field_;
  Vector2 velocity_;  ///< of slip
  PathProgress progress_;
  Direction direction_;  ///< of slip at the end
  double stop_ = none;
  PathKind kind_ = PathKind::slip;
  bool passes_fourth_quadrant_ = false;
};

/// A direction of slip this near to an invariant one is not distinct from it: rounding of v and of g.
double CoulombPath::direction_tolerance(const Direction& zero) const {
  const double c = zero.cosine, s = zero.sine;
  const double slope = -field_.b1() * c - field_.b2() * s + field_.anisotropy() * (c - s) * (c + s);
  const double of_velocity = 4 * contact_.velocity_scale / (speed_ * progress_.slip);
  return epsilon * (8 + of_velocity + 8 * field_.rounding_scale() / std::fabs(slope));
}

bool CoulombPath::is_invariant(double angle) const {
  constexpr double turn = 2 * std::numbers::pi;
  if (field_.is_straight()) return true;
  for (int i = 0; i < field_.zero_count(); ++i) {
    const Direction& zero = field_.zero(i).at;
    if (std::fabs(std::remainder(angle - zero.angle, turn)) <= direction_tolerance(zero)) return true;
  }
  return false;
}

/// Slip along one line, to where it stops or the law ends.
void CoulombPath::slip_straight(const Direction& s) {
  const double rate = field_.slip_rate(s);
  const double length = rate < 0 ? progress_.slip / -rate : std::numeric_limits<double>::infinity();
  const double start = progress_.at.impulse;
  progress_.follow({.ratio = {-field_.friction() * s.cosine, -field_.friction() * s.sine},
                    .normal_rate = field_.normal_rate(s),
                    .length = length});
  direction_ = s;
  if (progress_.is_done()) {
    progress_.slip = std::fmax(progress_.slip + rate * (progress_.at.impulse - start), 0.0);
    progress_.least_slip = std::fmin(progress_.least_slip, progress_.slip);
    return;
  }
  stop_ = start + length;
  progress_.slip = progress_.least_slip = 0;
}

void CoulombPath::slip_along_arc(double angle) {
  constexpr double turn = 2 * std::numbers::pi;
  const int count = field_.zero_count();
  const double first = field_.zero(0).at.angle;
  while (angle < first) angle += turn;
  while (angle >= first + turn) angle -= turn;
  int above = 1;
  while (above < count && field_.zero(above).at.angle <= angle) ++above;
  InvariantAngle lower = field_.zero(above - 1), upper = field_.zero(above % count);
  if (above == count) upper.at.angle += turn;
  passes_fourth_quadrant_ = above < count;
  SlipArc arc{.repelling = lower.at, .attracting = upper.at, .angle = angle};
  if (lower.attracts) std::swap(arc.repelling, arc.attracting);
  kind_ = PathKind::turning_slip;
  direction_ = follow_turning_slip(field_, arc, progress_);
  if (!progress_.is_done()) slip_straight(direction_);
}

void CoulombPath::slip() {
  const double angle = std::atan2(velocity_.y(), velocity_.x());
  if (!is_invariant(angle)) return slip_along_arc(angle);
  slip_straight({angle, velocity_.x() / progress_.slip, velocity_.y() / progress_.slip});
}

void CoulombPath::go_on_from_rest(bool has_slipped) {
  if (field_.can_stick()) {
    kind_ = has_slipped ? PathKind::slip_stick : PathKind::stick;
    return progress_.follow({.ratio = field_.stick_ratio(), .normal_rate = field_.stick_rate()});
  }
  kind_ = has_slipped ? PathKind::slip_reslip : PathKind::slip;
  slip_straight(field_.outgoing());
}

bool CoulombPath::is_ambiguous() const {
  const double speed = std::hypot(1.0, velocity_.norm());
  const double slip = velocity_.norm();
  const bool stopped = !(stop_ != stop_);
  if (slip > 0 && slip * speed_ <= 4 * epsilon * contact_.velocity_scale) return true;
  if (!stopped && slip > 0 && progress_.least_slip <= ambiguous_slip * speed) return true;
  if (passes_fourth_quadrant_ && std::fabs(field_.astroid_excess()) <= rounding) return true;
  if (stopped && std::fabs(progress_.at.impulse - stop_) <= rounding * stop_) return true;
  const double excess = field_.stick_ratio().norm() - field_.friction();
  return (stopped || slip == 0) && std::fabs(excess) <= rounding * field_.friction();
}

ContactImpulse CoulombPath::follow() {
  const bool slips = progress_.slip > 0;
  if (slips) slip();
  if (!progress_.is_done()) go_on_from_rest(slips);
  const double unit = speed_ / contact_.inverse_inertia(2, 2);
  const Vector2 friction = field_.to_world(progress_.friction);
  const Vector2 slip = field_.to_world({direction_.cosine, direction_.sine}) * progress_.slip;
  ContactImpulse result;
  result.impulse = unit * Vector3(friction.x(), friction.y(), progress_.at.impulse);
  result.velocity_after = speed_ * Vector3(slip.x(), slip.y(), progress_.at.normal_velocity);
  result.compression_impulse = unit * progress_.compression;
  result.slip_stop_impulse = unit * stop_;
  result.least_slip = speed_ * progress_.least_slip;
  result.path = kind_;
  result.is_path_ambiguous = is_ambiguous();
  return result;
}

[[noreturn]] void jam(double ratio) {
  std::ostringstream text;
  text.precision(6);
  text << "jamming (Painlevé's paradox): at the impulse ratio " << ratio
       << " in the direction given the corner can no longer leave the ground, since c + μ_i b·d <= 0";
  throw OutsideModelError(text.str());
}

/// Eq. 8 in space, and without friction: P_t = μ_i P_n d, P_n = −(1+e) v_n/(c + μ_i b·d).
ContactImpulse ratio_impulse(const Contact& contact, const Law& law, NormalCoupling coupling, ImpulseSlopes* slopes) {
  const Matrix3& w = contact.inverse_inertia;
  const double ratio = law.law.friction == FrictionKind::impulse_ratio ? law.law.friction_value : 0;
  const double speed = -contact.velocity.z();
  const Vector3 direction(ratio * law.ratio_direction.x(), ratio * law.ratio_direction.y(), 1);
  const double rate = coupling == NormalCoupling::none ? w(2, 2) : w.row(2).dot(direction);
  if (!(rate > 0)) jam(ratio);
  const double e = restitution_at(law.law, speed);
  ContactImpulse result;
  result.impulse = (1 + e) * speed / rate * direction;
  result.velocity_after = contact.velocity + w * result.impulse;
  result.velocity_after.z() = e * speed;
  result.compression_impulse = speed / rate;
  result.slip_stop_impulse = none;
  result.least_slip = std::fmin(contact.velocity.head<2>().norm(), result.velocity_after.head<2>().norm());
  result.path = ratio == 0 ? PathKind::frictionless : PathKind::slip;
  if (slopes == nullptr) return result;
  const detail::Dual<1> gain = 1 + restitution_at(law.law, detail::Dual<1>(speed, {1}));
  slopes->of_velocity = -(gain.value + speed * gain.slope[0]) / rate * direction * Vector3::UnitZ().transpose();
  for (std::size_t k = 0; k < 3; ++k) {
    slopes->of_turns.col(static_cast<int>(k)) = -slopes->turns[k].row(2).dot(direction) / rate * result.impulse;
  }
  return result;
}

ContactImpulse impulse(const Contact& contact, const Law& law, NormalCoupling coupling, ImpulseSlopes* slopes) {
  if (slopes != nullptr) slopes->of_turns = slopes->of_velocity = Matrix3::Constant(none);
  const bool rubs = law.law.friction == FrictionKind::coulomb && law.law.friction_value > 0;
  const ContactImpulse result =
      rubs ? CoulombPath(contact, law, coupling).follow() : ratio_impulse(contact, law, coupling, slopes);
  if (!result.impulse.allFinite() || !result.velocity_after.allFinite()) {
    throw NumericalError("the impulse of a corner overflows");
  }
  return result;
}

}  // namespace

ContactImpulse contact_impulse(const Contact& contact, const Law& law, ImpulseSlopes* slopes) {
  return impulse(contact, law, NormalCoupling::of_friction, slopes);
}

ContactImpulse face_impulse(const FaceContact& face, const Law& law) {
  Contact contact{.inverse_inertia = Matrix3::Identity() / face.mass,
                  .velocity = {face.slip.x(), face.slip.y(), -face.approach_speed},
                  .velocity_scale = face.velocity_scale};
  contact.inverse_inertia.block<2, 1>(0, 2) = face.drift;
  Law whole = law;
  whole.law = {.restitution = face.restitution,
               .law = RestitutionLaw::newton,
               .friction = law.law.friction,
               .friction_value = law.law.friction_value};
  return impulse(contact, whole, NormalCoupling::none, nullptr);
}

void Law::validate() const {
  law.validate();
  const double length = ratio_direction.norm();
  if (!(std::fabs(length - 1) <= 8 * std::numeric_limits<double>::epsilon())) {
    std::ostringstream text;
    text.precision(17);
    text << "length of the impulse ratio's direction = " << length << ": must be 1";
    throw std::domain_error(text.str());
  }
}

}  // namespace clatter::analytic::space
