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
/// Part of the edge's half: a pressure point nearer to the end counts as one on it, where there is no pressure.
constexpr double nearest_to_end = 1e-4;
constexpr double edge_rounding = 16 * detail::epsilon;

/// ∫ d_t ξᵏ and ∫ d_m ξᵏ over −1 <= ξ <= 1, slip (α, β + w ξ).
struct DirectionMoments {
  Vector2 along;
  Vector3 across;

  explicit DirectionMoments(const Vector3& slip);
};

DirectionMoments::DirectionMoments(const Vector3& slip) : along(Vector2::Zero()), across(Vector3::Zero()) {
  static const GaussRule<10> rule;
  const double a = slip[0], b = slip[1], w = slip[2];
  if (a * a + b * b > smooth_slip * smooth_slip * w * w) {
    const auto& x = rule.nodes;
    const GaussRule<10>::Array z = b + w * x, part = rule.weights / (a * a + z.square()).sqrt(), across_part = part * z;
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

/// What would turn the edge out of (2), by f.
Row5 out_of_step(const EdgeContact& edge) {
  return edge.velocity[3] * edge.inverse_inertia.row(4) - edge.velocity[4] * edge.inverse_inertia.row(3);
}

/// The path of slip, with ∫x dP, u and the work; units: the approach speed of the pressure point without friction, and
/// its inverse inertia.
class EdgePath final : SlipMotion {
 public:
  EdgePath(const EdgeContact& edge, const ImpactLaw& law, double point);
  std::optional<EdgeImpulse> follow();

 private:
  Values rate(const Values& y) override;
  double impulse_left(const Values& rate) override;
  bool end_stage() override;
  [[nodiscard]] Vector5 holding() const;
  End go_on_from_rest();
  void stick(const Vector5& f);
  [[nodiscard]] std::optional<double> pressure_point(const Vector3& slip) const;
  [[nodiscard]] double out_of_step(const Vector3& slip, double point) const;
  [[nodiscard]] double profile(double x) const { return profile_[0] + profile_[1] * x; }

  double speed_, unit_;  ///< [m/s], [1/kg]
  double friction_;
  EdgeContact::Matrix g_;
  Vector2 profile_;      ///< φ(0), φ′
  Row5 turning_, rise_;  ///< by f: out of step, and u
  double slow_;          ///< slip below it is rounding
  Vector3 begin_;
  double weight_ = 1;  ///< φ(x̄)
  PathProgress<> progress_;
};

EdgePath::EdgePath(const EdgeContact& edge, const ImpactLaw& law, double point)
    : SlipMotion(6), speed_(-(edge.velocity[3] + point * edge.velocity[4])), friction_(law.friction_value),
      profile_(-edge.velocity.tail<2>() / speed_), slow_(edge_rounding * edge.velocity_scale / speed_),
      begin_(edge.velocity.head<3>() / speed_),
      progress_({.law = law.law, .restitution = law.restitution, .damping = law.damping_per_stiffness * speed_}, 0, 1) {
  const EdgeContact::Matrix& g = edge.inverse_inertia;
  unit_ = g(3, 3) + point * (2 * g(3, 4) + point * g(4, 4));
  g_ = g / unit_;
  turning_ = profile_[0] * g_.row(4) - profile_[1] * g_.row(3);
  rise_ = g_.row(3) + point * g_.row(4);
  y_.head<3>() = begin_;
  y_[4] = -1;
}

double EdgePath::out_of_step(const Vector3& slip, double point) const {
  return turning_[3] + turning_[4] * point - friction_ * turning_.head<3>().dot(rub_of_edge(slip, point));
}

/// x̄ of (2): in closed form where all of the edge is pressed.
std::optional<double> EdgePath::pressure_point(const Vector3& slip) const {
  constexpr double part = 1.0 / 3;
  const double middle = out_of_step(slip, 0), change = (out_of_step(slip, part) - middle) / part;
  const double whole = -middle / change;
  if (std::fabs(whole) <= part) return whole;
  const double inner = std::copysign(part, whole), outer = std::copysign(1 - nearest_to_end, whole);
  const double at_inner = middle + inner * change, at_outer = out_of_step(slip, outer);
  if (!(at_inner * at_outer < 0)) return {};
  std::uintmax_t most = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(
      [&](double x) { return out_of_step(slip, x); }, std::fmin(inner, outer), std::fmax(inner, outer),
      whole > 0 ? at_inner : at_outer, whole > 0 ? at_outer : at_inner, boost::math::tools::eps_tolerance<double>(51),
      most);
  return (low + high) / 2;
}

EdgePath::Values EdgePath::rate(const Values& y) {
  Values change(6);
  const Vector3 slip = y.head<3>();
  const auto point = pressure_point(slip);
  if (!point) return change.setConstant(std::numeric_limits<double>::quiet_NaN());
  Vector5 f;
  f << -friction_ * rub_of_edge(slip, *point), 1, *point;
  change << g_.topRows<3>() * f, *point, rise_.dot(f), progress_.storing(y[4]) * profile(*point);
  return change;
}

double EdgePath::impulse_left(const Values& rate) {
  weight_ = profile(rate[3]);
  progress_.at = {.impulse = spent_, .normal_velocity = y_[4], .store = y_[5] / weight_};
  if (progress_.is_at_limit_speed()) return 0;
  const double excess = progress_.excess(progress_.at);
  const bool gave_too_much = progress_.is_energetic() && progress_.stage() == Stage::restitution && excess > 0;
  return gave_too_much ? -excess / progress_.excess_rate(progress_.at, rate[4]) : progress_.length_of_stage(rate[4]);
}

bool EdgePath::end_stage() {
  progress_.end_stage();
  y_[4] = progress_.at.normal_velocity;
  y_[5] = progress_.at.store * weight_;
  return progress_.is_done();
}

/// The rest of the impulse, along which the ground pushes and holds with f per unit of u.
void EdgePath::stick(const Vector5& f) {
  const double point = f[4] / f[3], begin = spent_;
  progress_.at = {.impulse = spent_, .normal_velocity = y_[4], .store = y_[5] / profile(point)};
  progress_.follow({.normal_rate = 1 / f[3]});
  spent_ = progress_.at.impulse;
  y_.head<3>().setZero();
  y_[3] += point * (spent_ - begin);
}

/// f with G f = (0, 0, 0, profile), by elimination of the pushes along the ground.
Vector5 EdgePath::holding() const {
  const Eigen::Matrix<double, 3, 2> held = g_.topLeftCorner<3, 3>().inverse() * g_.topRightCorner<3, 2>();
  const Matrix2 rest = g_.bottomRightCorner<2, 2>() - g_.bottomLeftCorner<2, 3>() * held;
  const Vector2 normal = rest.inverse() * profile_;
  Vector5 f;
  f << -held * normal, normal;
  return f;
}

/// Sticks if friction can hold the edge under a pressure that it has; slips on otherwise.
EdgePath::End EdgePath::go_on_from_rest() {
  const Vector5 f = holding();
  constexpr double most = 1 - nearest_to_end;
  const double point = f[4] / f[3];
  const double pushed = std::clamp(point, -most, most);
  const Vector3 load = g_.block<3, 2>(0, 3) * Vector2(1, pushed);
  SlipLetGo slip(load, [&](const Vector3& s) -> Vector3 {
    return -friction_ * (g_.topLeftCorner<3, 3>() * rub_of_edge(s, pushed));
  });
  if (slip.is_held() && f[3] > 0 && std::fabs(point) <= most) return stick(f), End::stopped;
  y_.head<3>() = first_slip * slip.direction();
  return slide(true) == End::impulse_spent ? End::impulse_spent : End::no_pressure;
}

std::optional<EdgeImpulse> EdgePath::follow() {
  EdgeImpulse result;
  const bool slips = begin_.norm() > slow_;
  End end = slips ? slide() : End::stopped;
  if (end == End::stopped) {
    end = go_on_from_rest();
    const bool sticks = end == End::stopped;
    result.path =
        slips ? (sticks ? PathKind::slip_stick : PathKind::slip_reslip) : (sticks ? PathKind::stick : PathKind::slip);
  }
  if (end == End::no_pressure) return {};
  const Vector2 pushes(spent_, y_[3]);
  const Vector3 change = y_.head<3>() - begin_ - g_.block<3, 2>(0, 3) * pushes;
  result.impulse << g_.topLeftCorner<3, 3>().inverse() * change, pushes;
  result.impulse *= speed_ / unit_;
  return result;
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
