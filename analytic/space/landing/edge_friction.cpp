// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/edge_friction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "analytic/base/limits.hpp"
#include "analytic/space/flight/gauss_rule.hpp"
#include "analytic/space/impulse/path_progress.hpp"
#include "analytic/space/impulse/slip_motion.hpp"

namespace clatter::analytic::space {

namespace {

using Vector5 = EdgeContact::Vector;
using Row5 = Eigen::Matrix<double, 1, 5>;

/// Slip without a zero, complex ones too, within this many halves of a piece is smooth enough for Gauss's rule; closed
/// forms would cancel digits of its square.
constexpr double smooth_slip = 3;
/// 1 − η: pressure whose centre is farther out, in halves of the edge, rubs as the one with its centre there.
constexpr double farthest_rubbed = 0.99;
constexpr double edge_rounding = 16 * detail::epsilon;

/// ∫ d_t ξᵏ and ∫ d_m ξᵏ over −1 <= ξ <= 1, slip (α, β + w ξ).
struct DirectionMoments {
  Vector2 along;
  Vector3 across;

  explicit DirectionMoments(const Vector3& slip) : along(Vector2::Zero()), across(Vector3::Zero()) {
    static const GaussRule<10> rule;
    const double a = slip[0], b = slip[1], w = slip[2];
    if (a * a + b * b > smooth_slip * smooth_slip * w * w) {
      const auto& x = rule.nodes;
      const GaussRule<10>::Array z = b + w * x, part = rule.weights / (a * a + z.square()).sqrt(),
                                 across_part = part * z;
      along << a * part.sum(), a * (part * x).sum();
      across << across_part.sum(), (across_part * x).sum(), (across_part * x.square()).sum();
      return;
    }
    const double from = b - w, to = b + w, r1 = std::hypot(a, from), r2 = std::hypot(a, to);
    const double log = a == 0 ? 0 : std::asinh(to / std::fabs(a)) - std::asinh(from / std::fabs(a));  // ∫ dz/r
    const double first = r2 - r1, second = (to * r2 - from * r1 - a * a * log) / 2;                   // ∫ zᵏ dz/r
    const double third = (r2 * r2 * r2 - r1 * r1 * r1) / 3 - a * a * first;
    along << a * log / w, a * (first - b * log) / (w * w);
    across << first / w, (second - b * first) / (w * w), (third - b * (2 * second - b * first)) / (w * w * w);
  }
};

/// Where a linear pressure of mean x̄ pushes, x = centre + half ξ, and q there, q dx = (level + slope ξ) dξ.
struct PressedPiece {
  double centre = 0, half = 1, level = 0.5, slope;

  explicit PressedPiece(double mean) : slope(1.5 * mean) {
    if (std::fabs(mean) <= 1.0 / 3) return;
    half = 1.5 * (1 - std::fabs(mean));
    centre = std::copysign(1 - half, mean);
    slope = std::copysign(0.5, mean);
  }
};

/// Local error of a step, and relative error of the impulse, where pushes come to an end of the edge; and where they
/// jump.
constexpr double step_of_edge = 1e-11, error_of_edge = 1e-9, error_of_edge_jump = 1e-5;

/// Pressure that jumps more often than this does so without end, and slip that takes more steps cannot be followed.
constexpr int most_jumps = 16, most_steps = 1000;

/// Where a function is zero, to rounding, between places where it has one sign and the other.
double root_between(const auto& function, double low, double high, double at_low, double at_high) {
  std::uintmax_t most = 100;
  const auto [left, right] = boost::math::tools::toms748_solve(function, low, high, at_low, at_high,
                                                               boost::math::tools::eps_tolerance<double>(51), most);
  return (left + right) / 2;
}

/// Where a function rises through zero, to rounding, not far from a place; by secants.
std::optional<double> root_near(const auto& function, double place) {
  constexpr int most_turns = 30;
  constexpr double first = 1e-6, far = 0.2, settled = 1e-12;
  double x = place, at = function(x), step = first;
  for (int i = 0; i < most_turns; ++i) {
    if (at == 0) return x;
    const double there = function(x + step), slope = (there - at) / step;
    if (!(slope > 0)) return {};
    const bool is_nearer = std::fabs(there) < std::fabs(at);
    if (std::fabs(step) <= settled && i > 1) return is_nearer ? x + step : x;
    if (i > 0) x += step, at = there;
    step = -at / slope;
    if (!(std::fabs(x + step - place) <= far)) return {};
    if (x + step == x) return x;
  }
  return {};
}

/// What would turn the edge out of (2), by f.
Row5 out_of_step(const EdgeContact& edge) {
  return edge.velocity[3] * edge.inverse_inertia.row(4) - edge.velocity[4] * edge.inverse_inertia.row(3);
}

/// Pushes of an edge that slips.
struct EdgePush {
  double point, asked;   ///< x̂, R
  double share, rubbed;  ///< λ, and the centre of the pressure that rubs
  Vector3 rub;
  [[nodiscard]] bool is_at_end() const { return std::fabs(point) == 1; }
};

/// The path of slip, with ∫x̂ dP, u, the work and ∫(R − x̂) dP; units: the approach speed of the pressure point without
/// friction, and its inverse inertia.
class EdgePath final : SlipMotion {
 public:
  EdgePath(const EdgeContact& edge, const ImpactLaw& law, double point)
      : SlipMotion(7), speed_(-(edge.velocity[3] + point * edge.velocity[4])), friction_(law.friction_value),
        without_friction_(edge.pressure_point()), profile_(-edge.velocity.tail<2>() / speed_),
        slow_(edge_rounding * edge.velocity_scale / speed_), begin_(edge.velocity.head<3>() / speed_),
        progress_({.law = law.law, .restitution = law.restitution, .damping = law.damping_per_stiffness * speed_}, 0,
                  1) {
    const EdgeContact::Matrix& g = edge.inverse_inertia;
    unit_ = g(3, 3) + point * (2 * g(3, 4) + point * g(4, 4));
    g_ = g / unit_;
    turning_ = profile_[0] * g_.row(4) - profile_[1] * g_.row(3);
    rise_ = g_.row(3) + point * g_.row(4);
    most_steps_ = most_steps;
    y_.head<3>() = begin_;
    y_[4] = -1;
  }

  std::optional<EdgeImpulse> follow() {
    EdgeImpulse result;
    const bool slips = begin_.norm() > slow_;
    End end = slips ? slide() : End::stopped;
    if (end == End::stopped) {
      end = go_on_from_rest();
      const bool sticks = end == End::stopped;
      result.path =
          slips ? (sticks ? PathKind::slip_stick : PathKind::slip_reslip) : (sticks ? PathKind::stick : PathKind::slip);
    }
    if (end == End::no_pressure || !(spent_ > 0)) return {};
    result.tilts = y_[6] != 0;
    if (step_error_ == step_of_edge) result.path_error = jumps_ > 0 ? error_of_edge_jump : error_of_edge;
    const Vector2 pushes(spent_, y_[3]);
    const Vector3 change = y_.head<3>() - begin_ - g_.block<3, 2>(0, 3) * pushes;
    result.impulse << g_.topLeftCorner<3, 3>().inverse() * change, pushes;
    result.impulse *= speed_ / unit_;
    return result;
  }

 private:
  Values rate(const Values& y) override {
    Values change(7);
    const auto push = push_against(y.head<3>());
    if (!push || jumps_ > most_jumps) return change.setConstant(std::numeric_limits<double>::quiet_NaN());
    Vector5 f;
    f << -friction_ * push->rub, 1, push->point;
    now_ = *push;
    const double beyond = push->asked - push->point;
    change << g_.topRows<3>() * f, push->point, rise_.dot(f) + rise_[4] * beyond,
        progress_.storing(y[4]) * profile(push->point), beyond;
    return change;
  }

  double impulse_left(const Values& rate) override {
    weight_ = profile(rate[3]);
    progress_.at = {.impulse = spent_, .normal_velocity = y_[4], .store = y_[5] / weight_};
    if (progress_.is_at_limit_speed()) return 0;
    const double excess = progress_.excess(progress_.at);
    const bool gave_too_much = progress_.is_energetic() && progress_.stage() == Stage::restitution && excess > 0;
    return gave_too_much ? -excess / progress_.excess_rate(progress_.at, rate[4]) : progress_.length_of_stage(rate[4]);
  }

  bool end_stage() override {
    progress_.end_stage();
    y_[4] = progress_.at.normal_velocity;
    y_[5] = progress_.at.store * weight_;
    return progress_.is_done();
  }

  /// f with G f = (0, 0, 0, profile), by elimination of the pushes along the ground.
  [[nodiscard]] Vector5 holding() const {
    const Eigen::Matrix<double, 3, 2> held = g_.topLeftCorner<3, 3>().inverse() * g_.topRightCorner<3, 2>();
    const Matrix2 rest = g_.bottomRightCorner<2, 2>() - g_.bottomLeftCorner<2, 3>() * held;
    const Vector2 normal = rest.inverse() * profile_;
    Vector5 f;
    f << -held * normal, normal;
    return f;
  }

  void keep() override {
    if (!y_.allFinite()) return;
    const double size = y_.head<3>().norm();
    const Vector3 direction = y_.head<3>() / size;
    const bool is_first = kept_direction_ == Vector3::Zero();
    const double change = std::fabs(now_.rubbed - kept_.rubbed) + std::fabs(now_.share - kept_.share);
    if (!is_first && change > 1e-6 && change > 1e6 * (direction - kept_direction_).norm()) ++jumps_;
    most_share_ = is_first ? now_.share : std::fmin(most_share_ * std::fmax(1, size / largest_), now_.share);
    largest_ = is_first ? size : std::fmax(largest_, size);
    kept_ = now_;
    kept_direction_ = direction;
    if (now_.share < 1 || now_.is_at_end()) step_error_ = step_of_edge;
  }

  /// The share of friction ends its fall within a millionth of slip from where it is least: the rest is of second
  /// order.
  bool may_step_to(const Values& next, const Values& then, double length) override {
    constexpr double near = 1e-6, ahead = 1e-5;
    const double size = next.head<3>().norm(), speed = then.head<3>().norm();
    if (!kept_.is_at_end() || length * speed <= near * size) return true;
    if (!now_.is_at_end()) return false;
    const double share = now_.share;
    const EdgePush here = now_;
    (void)rate(next + ahead * size / speed * then);
    const bool falls = now_.share <= share;
    now_ = here;
    return falls;
  }

  /// Sticks if friction can hold the edge under the pressure that it then has, or where slip dies out; slips on
  /// otherwise.
  End go_on_from_rest() {
    const Vector5 f = holding();
    const double asked = f[4] / f[3];
    const double pushed = f[3] > 0 ? std::clamp(asked, -1.0, 1.0) : std::copysign(1.0, f[4]);
    Vector3 direction;
    if (!can_hold(pushed, direction)) {
      const Values at_rest = y_;
      const double spent = spent_;
      const PathProgress<> progress = progress_;
      y_.head<3>() = first_slip * direction;
      most_share_ = 1, largest_ = 1;
      kept_direction_.setZero();
      const End end = slide(true);
      if (end != End::stopped) return end;
      y_ = at_rest;
      spent_ = spent;
      progress_ = progress;
    }
    if (!(f[3] > 0)) {  // the less pushing it would take, the more beyond the end: nothing is left of the impulse
      y_[6] = f[4];
      return End::stopped;
    }
    const double begin = spent_;
    stick(1 / f[3], pushed);
    y_[6] += (asked - pushed) * (spent_ - begin);
    return End::stopped;
  }

  /// Whether friction can hold the edge where it is pushed; else where slip goes.
  [[nodiscard]] bool can_hold(double pushed, Vector3& direction) const {
    const Vector3 load = g_.block<3, 2>(0, 3) * Vector2(1, pushed);
    const double rubbed = std::clamp(pushed, -farthest_rubbed, farthest_rubbed);
    SlipLetGo slip(load, [&](const Vector3& s) -> Vector3 {
      return -friction_ * (g_.topLeftCorner<3, 3>() * rub_of_edge(s, rubbed));
    });
    const bool is_held = slip.is_held();
    direction = slip.direction();
    return is_held;
  }

  /// The rest of the impulse, along which u rises by `rise` and the ground pushes at one point.
  void stick(double rise, double pushed) {
    const double begin = spent_;
    progress_.at = {.impulse = spent_, .normal_velocity = y_[4], .store = y_[5] / profile(pushed)};
    progress_.follow({.normal_rate = rise});
    spent_ = progress_.at.impulse;
    y_.head<3>().setZero();
    y_[3] += pushed * (spent_ - begin);
  }

  /// x̂ with all of the friction, in closed form where all of the edge is pressed.
  [[nodiscard]] std::optional<double> pressure_point(const Vector3& slip) const {
    constexpr double part = 1.0 / 3;
    const double middle = out_of_step(slip, 0), change = (out_of_step(slip, part) - middle) / part;
    const double whole = -middle / change;
    if (std::fabs(whole) <= part) return whole;
    const double inner = std::copysign(part, whole), outer = std::copysign(farthest_rubbed, whole);
    const double at_inner = middle + inner * change, at_outer = out_of_step(slip, outer);
    if (!(at_inner * at_outer < 0)) return {};
    const auto excess = [&](double x) { return out_of_step(slip, x); };
    return whole > 0 ? root_between(excess, inner, outer, at_inner, at_outer)
                     : root_between(excess, outer, inner, at_outer, at_inner);
  }

  /// What decides x̂ against one slip.
  struct Balance {
    const EdgePath& path;
    Vector3 slip;
    double from, most;  ///< R₀ and the largest λ
    Balance(const EdgePath& edge, const Vector3& against);
    [[nodiscard]] Vector3 rub(double centre) const;
    [[nodiscard]] double lead(const Vector3& rubbed) const;  ///< S f
    /// R₀ + λ² S f − centre with the largest λ.
    [[nodiscard]] double excess(double centre) const { return from + most * most * lead(rub(centre)) - centre; }
    /// How far beyond an end of the edge R₀ + λ S f is, the pressure being that of an x̂ on it.
    [[nodiscard]] double beyond(double end, double share) const {
      return std::copysign(1, end) * (share * lead(rub(from + share * (end - from))) - (end - from));
    }
    [[nodiscard]] EdgePush inside(double centre) const;
    [[nodiscard]] EdgePush at_end(double end, double share) const;
  };
  [[nodiscard]] bool is_bounded() const { return std::fabs(without_friction_) <= 1; }

  /// With the largest share of the friction that keeps x̂ on the edge, no larger than before.
  [[nodiscard]] std::optional<EdgePush> some_push(const Balance& balance) const {
    if (balance.most == 1) {
      if (const auto point = pressure_point(balance.slip))
        return EdgePush{*point, *point, 1, *point, balance.rub(*point)};
    }
    const double from = balance.from, most = balance.most;
    if (!(std::fabs(from) <= 1)) return {};
    const auto excess = [&](double centre) { return balance.excess(centre); };
    const double low = from - most * (1 + from), high = from + most * (1 - from);
    const double at_low = excess(low), at_high = excess(high);
    if (at_low >= 0 && at_high <= 0) return balance.inside(root_between(excess, low, high, at_low, at_high));
    const double end = at_high > 0 ? 1 : -1;
    const auto beyond = [&](double share) { return balance.beyond(end, share); };
    const double at_most = beyond(most);
    if (!(at_most > 0)) return balance.at_end(end, most);
    return balance.at_end(end, root_between(beyond, 0, most, -std::fabs(end - from), at_most));
  }

  /// The solution that the last one becomes.
  [[nodiscard]] std::optional<EdgePush> next_push(const Balance& balance) const {
    const double from = balance.from, most = balance.most;
    const auto excess = [&](double centre) { return -balance.excess(centre); };
    double end = kept_.point > from ? 1 : -1, share = kept_.share;
    const auto beyond = [&](double part) { return balance.beyond(end, part); };
    if (!kept_.is_at_end()) {
      const auto centre = root_near(excess, kept_.rubbed);
      if (!centre) return {};
      const EdgePush push = balance.inside(*centre);
      if (std::fabs(push.point) <= 1) return push;
      end = push.point > 0 ? 1 : -1;
      share = most;
    }
    if (const auto part = root_near(beyond, share); part && *part <= most) return balance.at_end(end, *part);
    const auto centre = root_near(excess, from + most * (end - from));
    if (!centre) return {};
    const EdgePush push = balance.inside(*centre);
    return std::fabs(push.point) <= 1 ? std::optional(push) : std::nullopt;
  }

  /// A solution goes on from the last one; where that one ends, it may be another.
  [[nodiscard]] std::optional<EdgePush> push_against(const Vector3& slip) const {
    constexpr double steep = 100, same = 1e-9;
    const Balance balance(*this, slip);
    const auto some = some_push(balance);
    if (!some || !is_bounded() || kept_direction_ == Vector3::Zero()) return some;
    const auto apart = [&](const EdgePush& a) {
      return std::fabs(a.rubbed - some->rubbed) + std::fabs(a.share - some->share);
    };
    if (apart(kept_) <= steep * (slip.normalized() - kept_direction_).norm() + same) return some;
    const auto next = next_push(balance);
    if (next) return apart(*next) <= same ? some : next;
    return at_once_ ? some : std::nullopt;
  }

  [[nodiscard]] double out_of_step(const Vector3& slip, double point) const {
    return turning_[3] + turning_[4] * point - friction_ * turning_.head<3>().dot(rub_of_edge(slip, point));
  }

  [[nodiscard]] double profile(double x) const { return profile_[0] + profile_[1] * x; }

  double speed_, unit_;                 ///< [m/s], [1/kg]
  double friction_, without_friction_;  ///< μ, R₀
  EdgeContact::Matrix g_;
  Vector2 profile_;      ///< φ(0), φ′
  Row5 turning_, rise_;  ///< by f: out of step, and u
  double slow_;          ///< slip below it is rounding
  Vector3 begin_;
  double weight_ = 1;  ///< φ(x̂)
  EdgePush now_, kept_;
  Vector3 kept_direction_ = Vector3::Zero();  ///< zero: there is no last solution
  double most_share_ = 1, largest_ = 1;       ///< the largest λ of the slide from here; the largest slip so far
  int jumps_ = 0;                             ///< of the pressure
  PathProgress<> progress_;
};

EdgePath::Balance::Balance(const EdgePath& edge, const Vector3& against)
    : path(edge), slip(against), from(edge.without_friction_),
      most(std::fmin(1, edge.most_share_ * std::fmax(1, slip.norm() / edge.largest_))) {}

Vector3 EdgePath::Balance::rub(double centre) const {
  return rub_of_edge(slip, std::clamp(centre, -farthest_rubbed, farthest_rubbed));
}

double EdgePath::Balance::lead(const Vector3& rubbed) const {
  return path.friction_ / path.turning_[4] * path.turning_.head<3>().dot(rubbed);
}

EdgePush EdgePath::Balance::inside(double centre) const {
  const Vector3 rubbed = rub(centre);
  return {from + most * lead(rubbed), from + lead(rubbed), most, centre, rubbed};
}

EdgePush EdgePath::Balance::at_end(double end, double share) const {
  const double centre = from + share * (end - from);
  const Vector3 rubbed = rub(centre);
  return {end, from + lead(rubbed), share, centre, rubbed};
}

}  // namespace

Vector3 rub_of_edge(const Vector3& slip, double pressure_point) {
  const PressedPiece piece(pressure_point);
  const Vector3 s = slip / slip.lpNorm<Eigen::Infinity>();  // its direction decides, and squares of it exist
  const DirectionMoments d({s[0], s[1] + piece.centre * s[2], piece.half * s[2]});
  const auto weighted = [&](const auto& moments, int k) {
    return piece.level * moments[k] + piece.slope * moments[k + 1];
  };
  const double across = weighted(d.across, 0);
  return {weighted(d.along, 0), across, piece.centre * across + piece.half * weighted(d.across, 1)};
}

double EdgeContact::pressure_point() const {
  const Row5 turning = out_of_step(*this);
  return -turning[3] / turning[4];
}

bool EdgeContact::strikes_as_corner() const {
  const double x = pressure_point();
  Eigen::Matrix<double, 5, 3> pushes = Eigen::Matrix<double, 5, 3>::Zero();  // along t, m, ẑ there
  pushes(0, 0) = pushes(1, 1) = pushes(3, 2) = 1;
  pushes(2, 1) = pushes(4, 2) = x;
  const Matrix& g = inverse_inertia;
  const auto slip_of = [&](const Vector& v) { return Vector2(v[0], v[1] + x * v[2]); };
  const Vector normal = g * pushes.col(2);
  const Vector2 slip = slip_of(velocity), drift = slip_of(normal);
  const bool slips = slip.norm() > edge_rounding * velocity_scale;
  const Vector2 s = (slips ? slip : drift).normalized();
  const Vector rub = pushes.leftCols<2>() * s;
  const Row5 turning = out_of_step(*this) / (std::fabs(velocity[3]) + std::fabs(velocity[4]));
  const double most = edge_rounding * g.diagonal().maxCoeff();
  const auto stays_straight = [&](const Vector& change) {
    return std::fabs(change[2]) <= most && std::fabs(cross(s, slip_of(change))) <= most;
  };
  return std::fabs(velocity[2]) <= edge_rounding * velocity_scale && stays_straight(normal) &&
         stays_straight(g * rub) && std::fabs(turning.dot(rub)) <= most;
}

std::optional<EdgeImpulse> edge_impulse(const EdgeContact& edge, const ImpactLaw& law) {
  const Row5 turning = out_of_step(edge);
  if (!(turning[4] < 0)) return {};  // pushes as a whole would pull
  return EdgePath(edge, law, std::clamp(edge.pressure_point(), -1.0, 1.0)).follow();
}

}  // namespace clatter::analytic::space
