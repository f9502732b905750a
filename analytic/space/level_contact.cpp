// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/level_contact.hpp"

#include <Eigen/LU>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/law/viscoelastic.hpp"
#include "analytic/space/edge_friction.hpp"
#include "analytic/space/path_progress.hpp"
#include "analytic/space/slip_motion.hpp"

namespace clatter::analytic::space {

namespace {

/// Of C: a pressure point nearer to a side has the friction of the side.
constexpr double near_side = 1.0 / 300;
/// Pressure on less than this part of the area is that of a side.
constexpr double least_part = 1e-4;
/// Of C: a corner rubs as a disc of this size.
constexpr double corner_size = 0.01;
constexpr double level_rounding = 16 * detail::epsilon;

double at(const Vector3& linear, const Vector2& x) { return linear[0] + linear.tail<2>().dot(x); }
Vector3 with_one(const Vector2& x) { return {1, x.x(), x.y()}; }

/// Where the ground pushes, and what comes of it, per P.
struct Push {
  enum class At { inside, side, corner, rim };
  At kind = At::inside;
  std::size_t index = 0;               ///< of the corner, or of that with which the side begins
  double along = 0;                    ///< of the side, −1 to 1; angle on the rim [rad]
  Vector3 pressure = Vector3::UnitX(); ///< inside
  Vector2 place = Vector2::Zero();     ///< x̂
  Vector3 friction = Vector3::Zero();  ///< (F, K)
  double rate = 0;                     ///< κ
};

/// Finds where the ground pushes, (2).
class PushSearch {
 public:
  /// n changes with (F, K) and with (P, X) by these.
  struct Response {
    Matrix3 of_friction, of_pushes;
  };
  PushSearch(const ContactArea& area, const Vector3& profile, double friction)
      : area_(&area), profile_(profile), friction_(friction), pushed_(area), whole_moments_(pushed_.moments()),
        pressure_(1 / whole_moments_(0, 0), 0, 0) {}

  /// Under friction that does not depend on the place.
  [[nodiscard]] std::optional<Push> find(const Response& response, const Vector3& friction);
  /// Under Coulomb's friction against this slip; nothing if the search fails.
  [[nodiscard]] std::optional<Push> find_sliding(const Response& response, const Vector3& slip);
  /// Friction against `slip` where the ground pushes as in `push`.
  [[nodiscard]] Vector3 friction_of(const Push& push, const Vector3& slip);
  /// Gives a push inside the pressure that has its place; false if there is none to rounding.
  bool find_pressure(Push& push);
  [[nodiscard]] double profile(const Vector2& x) const { return at(profile_, x); }

 private:
  struct Target {
    Vector2 place;                      ///< x̂ of the whole without friction
    Eigen::Matrix<double, 2, 3> shift;  ///< of it by (F, K)
  };
  [[nodiscard]] std::size_t count() const { return area_->corners.size(); }
  [[nodiscard]] bool is_edge() const { return count() == 2; }
  [[nodiscard]] bool is_disc() const { return area_->radius > 0; }
  [[nodiscard]] Vector3 friction_at(const Push& push);
  [[nodiscard]] Vector3 friction_along(std::size_t side, double along) const;
  [[nodiscard]] Vector3 friction_of_point(const Vector2& place) const;
  [[nodiscard]] Vector3 rise(const Push& push) const {
    return response_.of_friction * push.friction + response_.of_pushes * with_one(push.place);
  }
  void aim();
  bool settle(const Target& target, const Vector2& slack, double share);
  [[nodiscard]] std::optional<Push> inside();
  [[nodiscard]] std::optional<Push> homotopy();
  [[nodiscard]] Push of_whole(const Vector3& friction) const;
  [[nodiscard]] std::optional<Push> at_boundary();
  [[nodiscard]] Push at_corner(std::size_t i);
  [[nodiscard]] Push on_side(std::size_t i, double along);
  [[nodiscard]] Push on_rim(double angle);
  /// > 0 where corner `other` rises faster than in step with the pushed place.
  [[nodiscard]] double ahead(const Push& push, const Vector2& other) const {
    const Vector3 n = rise(push);
    return at(n, other) * profile(push.place) - at(n, push.place) * profile(other);
  }
  [[nodiscard]] double turning_on_rim(const Push& push) const;
  void consider(Push push, bool others_rise);
  void search_sides();
  void search_side(std::size_t i);
  [[nodiscard]] double out_of_step(std::size_t side, double along);
  [[nodiscard]] bool stays_on_side();
  void consider_side(std::size_t i, double along);
  void search_rim();

  const ContactArea* area_;
  Vector3 profile_;
  double friction_;
  PressedArea pushed_;
  Matrix3 whole_moments_;
  Vector3 pressure_;  ///< as it was last
  Response response_{};
  Target target_{};
  bool is_constant_ = false;
  Vector3 constant_ = Vector3::Zero(), slip_ = Vector3::Zero();
  std::optional<Push> best_;
  double best_deviation_ = 0;
  bool was_inside_ = true;
  Push last_;  ///< against slip, of the boundary
};

Vector3 PushSearch::friction_of_point(const Vector2& place) const {
  const Vector2 s = slip_.head<2>() + slip_[2] * Vector2(-place.y(), place.x());
  const double size = std::hypot(s.norm(), corner_size * slip_[2]);
  if (size == 0) return Vector3::Zero();
  const Vector2 d = s / size;
  return -friction_ * Vector3(d.x(), d.y(), cross(place, d));
}

Vector3 PushSearch::friction_along(std::size_t side, double along) const {
  const Vector2 &from = area_->corners[side], &to = area_->corners[(side + 1) % count()];
  const Vector2 middle = (from + to) / 2, half = (to - from) / 2, t = half.normalized(), m(-t.y(), t.x());
  const double length = half.norm();
  const Vector2 s = slip_.head<2>() + slip_[2] * Vector2(-middle.y(), middle.x());
  const Vector3 rub = rub_along({s.dot(t), s.dot(m), slip_[2] * length},
                                {.place = along, .power = is_edge() ? 1 : 2, .end_size = corner_size / length});
  const Vector2 force = rub[0] * t + rub[1] * m;
  return -friction_ * Vector3(force.x(), force.y(), cross(middle, force) + length * rub[2]);
}

Vector3 PushSearch::friction_at(const Push& push) {
  if (is_constant_) return constant_;
  switch (push.kind) {
    case Push::At::inside:
      pushed_.press(push.pressure);
      return -friction_ * (pushed_.slip_moments(slip_.head<2>(), slip_[2]) * push.pressure);
    case Push::At::side:
      return friction_along(push.index, push.along);
    default:
      return friction_of_point(push.place);
  }
}

Vector3 PushSearch::friction_of(const Push& push, const Vector3& slip) {
  is_constant_ = false;
  slip_ = slip;
  return friction_at(push);
}

/// Where all of C rises in step: (1, x̂) = G_nn⁻¹ (κ φ − G_nt f).
void PushSearch::aim() {
  const Eigen::PartialPivLU<Matrix3> pushes(response_.of_pushes);
  const Vector3 wanted = pushes.solve(profile_);
  const Matrix3 by_friction = pushes.solve(response_.of_friction);
  target_.place = wanted.tail<2>() / wanted[0];
  target_.shift = target_.place * by_friction.row(0) - by_friction.bottomRows<2>();
}

Push PushSearch::of_whole(const Vector3& friction) const {
  Push push{.place = target_.place + target_.shift * friction, .friction = friction};
  push.rate = at(rise(push), push.place) / profile(push.place);
  return push;
}

/// Newton's method for a pressure with (1, x̂) as its moments, x̂ = target + slack by `share` of its friction: linear
/// equations on the area that is pushed, damped so that the residual falls.
bool PushSearch::settle(const Target& target, const Vector2& slack, double share) {
  constexpr int most_turns = 60;
  constexpr double settled = 1e-7;  // where the error of Newton's method is its square
  Vector3 wanted = with_one(target.place + slack), before = pressure_;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_turns; ++i) {
    const bool whole = pushed_.press(pressure_);
    const Matrix3 moments = whole ? whole_moments_ : pushed_.moments();
    Matrix3 equations = moments;
    const bool enough = moments(0, 0) > least_part * whole_moments_(0, 0);
    if (enough && share > 0) {
      const Matrix3 rubs = pushed_.slip_moments(slip_.head<2>(), slip_[2]);
      equations.bottomRows<2>() += share * friction_ * target.shift * rubs;
    }
    const double residual = enough ? (equations * pressure_ - wanted).norm() : least;
    if (!enough || residual > least) {
      if (pressure_ == before) return false;
      pressure_ = (before + pressure_) / 2;
      continue;
    }
    least = residual;
    const Vector3 next = equations.partialPivLu().solve(wanted);
    const bool stays_whole = whole && pushed_.press(next);
    before = pressure_;
    pressure_ = next;
    if (stays_whole || (next - before).norm() <= settled * next.norm()) return true;
  }
  return false;
}

/// From even pressure, which has the slack that it needs, to none.
std::optional<Push> PushSearch::homotopy() {
  constexpr double shortest = 1.0 / 1024;
  const Vector3 even(1 / whole_moments_(0, 0), 0, 0);
  pressure_ = even;
  pushed_.press(even);
  const Vector3 rub = -friction_ * (pushed_.slip_moments(slip_.head<2>(), slip_[2]) * even);
  const Vector2 slack = -(target_.place + target_.shift * rub);
  for (double done = 0, step = 1; done < 1;) {
    const Vector3 before = pressure_;
    const double next = std::fmin(done + step, 1);
    if (settle(target_, (1 - next) * slack, 1)) {
      done = next;
      step *= 2;
      continue;
    }
    pressure_ = before;
    step /= 4;
    if (step < shortest) return {};
  }
  return inside();
}

/// A pressure of all of C or of a part that is no sliver.
std::optional<Push> PushSearch::inside() {
  if (is_edge()) return {};
  if (is_constant_) {
    const Push push = of_whole(constant_);
    return area_->contains(push.place) ? std::optional(push) : std::nullopt;
  }
  if (!pressure_.allFinite()) pressure_ << 1 / whole_moments_(0, 0), 0, 0;
  if (!settle(target_, Vector2::Zero(), 1)) return {};
  Push push{.pressure = pressure_};
  push.friction = friction_at(push);
  const Vector3 pressure = push.pressure;
  push = of_whole(push.friction);
  push.pressure = pressure;
  return push;
}

bool PushSearch::find_pressure(Push& push) {
  if (push.kind != Push::At::inside) return true;
  pressure_ << 1 / whole_moments_(0, 0), 0, 0;
  if (!settle({.place = push.place, .shift = {}}, Vector2::Zero(), 0)) return false;
  push.pressure = pressure_;
  return true;
}

Push PushSearch::at_corner(std::size_t i) {
  Push push{.kind = Push::At::corner, .index = i, .place = area_->corners[i]};
  push.friction = friction_at(push);
  return push;
}

Push PushSearch::on_side(std::size_t i, double along) {
  Push push{.kind = Push::At::side, .index = i, .along = along};
  push.place = ((1 - along) * area_->corners[i] + (1 + along) * area_->corners[(i + 1) % count()]) / 2;
  push.friction = friction_at(push);
  return push;
}

Push PushSearch::on_rim(double angle) {
  Push push{.kind = Push::At::rim, .along = angle, .place = {std::cos(angle), std::sin(angle)}};
  push.friction = friction_at(push);
  return push;
}

/// > 0 where the next point of the rim, counter-clockwise, rises faster than in step.
double PushSearch::turning_on_rim(const Push& push) const {
  const Vector2 along(-push.place.y(), push.place.x());
  return ahead(push, push.place + along);
}

/// Takes a push of the boundary if it is one by (2), the one with the least change of velocity beside that in step if
/// there are several, or a push beside the boundary if its friction brings the pressure point of the whole there.
void PushSearch::consider(Push push, bool others_rise) {
  const Push whole = of_whole(push.friction);
  if (!is_edge() && !others_rise) {
    if (!((whole.place - push.place).norm() <= near_side && area_->contains(whole.place))) return;
    push.place = whole.place;
  }
  const Vector3 n = rise(push);
  push.rate = at(n, push.place) / profile(push.place);
  const Vector3 beyond = n - push.rate * profile_;
  const double deviation = beyond.dot(response_.of_pushes.partialPivLu().solve(beyond));
  if (best_ && !(deviation < best_deviation_)) return;
  best_ = push;
  best_deviation_ = deviation;
}

double root_between(const auto& function, double low, double high, double at_low, double at_high) {
  std::uintmax_t most = 100;
  const auto [a, b] = boost::math::tools::toms748_solve(function, low, high, at_low, at_high,
                                                        boost::math::tools::eps_tolerance<double>(51), most);
  return (a + b) / 2;
}

/// > 0 where the end of a side rises faster than in step with its beginning.
double PushSearch::out_of_step(std::size_t side, double along) {
  const Vector2 &here = area_->corners[side], &there = area_->corners[(side + 1) % count()];
  const Vector3 n = rise(on_side(side, along));
  return at(n, there) * profile(here) - at(n, here) * profile(there);
}

void PushSearch::consider_side(std::size_t i, double along) {
  const Vector2 &here = area_->corners[i], &there = area_->corners[(i + 1) % count()];
  const Push push = on_side(i, along);
  const Vector2 inward(here.y() - there.y(), there.x() - here.x());
  consider(push, is_edge() || ahead(push, push.place + inward) >= 0);
}

/// Beside where the ground pushed last, so that of several places the one stays that it came to.
bool PushSearch::stays_on_side() {
  const auto function = [&](double along) { return out_of_step(last_.index, along); };
  for (double reach = 0.01; reach < 1; reach *= 3) {
    const double low = std::fmax(last_.along - reach, -1), high = std::fmin(last_.along + reach, 1);
    const double at_low = function(low), at_high = function(high);
    if (!(at_low < 0 && at_high > 0)) continue;
    consider_side(last_.index, root_between(function, low, high, at_low, at_high));
    return best_ && best_->kind == Push::At::side;
  }
  return false;
}

/// Where friction turns along the side there may be several places.
void PushSearch::search_side(std::size_t i) {
  constexpr int parts = 12;
  const auto place = [](int k) { return -std::cos(k * std::numbers::pi / parts); };
  const auto function = [&](double along) { return out_of_step(i, along); };
  double before = function(-1);
  for (int k = 1; k <= parts; ++k) {
    const double now = function(place(k));
    if (before < 0 && now >= 0) consider_side(i, root_between(function, place(k - 1), place(k), before, now));
    before = now;
  }
}

void PushSearch::search_sides() {
  if (!is_constant_ && !was_inside_ && last_.kind == Push::At::side && stays_on_side()) return;
  for (std::size_t i = 0; i < count(); ++i) {
    const Push corner = at_corner(i);
    const Vector2 &next = area_->corners[(i + 1) % count()], &last = area_->corners[(i + count() - 1) % count()];
    consider(corner, ahead(corner, next) >= 0 && ahead(corner, last) >= 0);
    if (i == 0 || !is_edge()) search_side(i);
  }
}

void PushSearch::search_rim() {
  constexpr int parts = 32;
  constexpr double part = 2 * std::numbers::pi / parts;
  const auto turning = [&](double angle) { return turning_on_rim(on_rim(angle)); };
  double before = turning(0);
  for (int i = 0; i < parts; ++i) {
    const double from = i * part, to = (i + 1) * part, now = turning(to);
    if (before < 0 && now >= 0) {
      const Push push = on_rim(root_between(turning, from, to, before, now));
      consider(push, ahead(push, Vector2::Zero()) >= 0);
    }
    before = now;
  }
}

std::optional<Push> PushSearch::at_boundary() {
  best_.reset();
  if (is_disc()) search_rim();
  else search_sides();
  return best_;
}

std::optional<Push> PushSearch::find(const Response& response, const Vector3& friction) {
  response_ = response;
  is_constant_ = true;
  constant_ = friction;
  aim();
  const auto push = inside();
  return push ? push : at_boundary();
}

std::optional<Push> PushSearch::find_sliding(const Response& response, const Vector3& slip) {
  if (is_constant_ || response_.of_pushes != response.of_pushes) {
    response_ = response;
    aim();
  }
  is_constant_ = false;
  slip_ = slip / slip.lpNorm<Eigen::Infinity>();
  std::optional<Push> push = was_inside_ ? inside() : at_boundary();
  if (!push) push = was_inside_ ? at_boundary() : inside();
  if (!push && !is_edge()) push = homotopy();
  if (push) was_inside_ = push->kind == Push::At::inside, last_ = *push;
  return push;
}

/// The path of slip with the normal motion of C, λ, and the work by λ and by n at the place; units: the approach speed
/// of the place where the ground pushes without friction, and its inverse inertia.
class LevelPath final : SlipMotion {
 public:
  LevelPath(const LevelContact& contact, const Law& law);
  LevelImpulse follow();

 private:
  static constexpr int normal = 3, progress = 6, store = 7, work = 8, size = 9;

  Values rate(const Values& y) override;
  double impulse_left(const Values& rate) override;
  bool end_stage() override;
  [[nodiscard]] PushSearch::Response response() const {
    return {g_.bottomLeftCorner<3, 3>(), g_.bottomRightCorner<3, 3>()};
  }
  [[nodiscard]] Values change(const Push& push, const Values& y) const;
  [[nodiscard]] double length_of_stage(double rate, const Vector2& place) const;
  void go_straight(const Push& push);
  End go_on_from_rest(PathKind& kind, bool slipped);
  [[noreturn]] static void fail();

  const ImpactLaw& law_;
  Vector2 ratio_direction_, below_;
  bool is_edge_;
  PushSearch search_;
  LevelContact::Matrix g_;
  double speed_ = 1, unit_ = 1;
  double slow_ = 0;
  LevelContact::Vector begin_;
  Push push_;
  PathProgress<> progress_;
};

Vector3 profile_of(const LevelContact& contact) { return -contact.velocity.tail<3>(); }

LevelPath::LevelPath(const LevelContact& contact, const Law& law)
    : SlipMotion(size, 1e-13), law_(law.law), ratio_direction_(law.ratio_direction), below_(contact.below), is_edge_(contact.area.corners.size() == 2),
      search_(contact.area, profile_of(contact), law.law.friction_value), g_(contact.inverse_inertia),
      progress_({}, 0, 1) {
  const auto free = search_.find(response(), Vector3::Zero());
  if (!free) fail();
  speed_ = search_.profile(free->place);
  const Vector3 pushes = with_one(free->place);
  unit_ = pushes.dot(g_.bottomRightCorner<3, 3>() * pushes);
  g_ /= unit_;
  begin_ = contact.velocity / speed_;
  slow_ = level_rounding * contact.velocity_scale / speed_;
  search_ = PushSearch(contact.area, -begin_.tail<3>(), law_.friction_value);
  progress_ = PathProgress<>(
      {.law = law_.law, .restitution = law_.restitution, .damping = law_.damping_per_stiffness * speed_}, 0, 1);
  y_.head<6>() = begin_;
  y_[progress] = -1;
}

void LevelPath::fail() { throw NumericalError("where the ground pushes on a level face or edge could not be found"); }

LevelPath::Values LevelPath::change(const Push& push, const Values& y) const {
  LevelContact::Vector f;
  f << push.friction, with_one(push.place);
  Values rates(size);
  const double speed = at(y.segment<3>(normal), push.place);
  rates << g_ * f, push.rate, progress_.storing(y[progress]), -speed / (1 - progress_.damping() * y[progress]);
  return rates;
}

LevelPath::Values LevelPath::rate(const Values& y) {
  const auto push = search_.find_sliding(response(), y.head<3>());
  if (!push) return Values::Constant(size, std::numeric_limits<double>::quiet_NaN());
  push_ = *push;
  return change(push_, y);
}

/// Of a law of work that by the normal motion at the place ends the stage, too: an edge goes by that alone, and a face
/// gets no more than that.
double LevelPath::length_of_stage(double rate, const Vector2& place) const {
  if (progress_.is_at_limit_speed()) return 0;
  if (progress_.stage() != Stage::restitution || !progress_.is_energetic()) return progress_.length_of_stage(rate);
  const auto length = [&](double speed, double left) {
    if (left < 0) return speed > 0 ? left / speed : 0;
    if (!(rate > 0)) return std::numeric_limits<double>::infinity();
    const double end = separation_speed(progress_.damping(), Unloading<double>{.from = speed, .slope = rate, .work = left});
    return std::fmax(end - speed, 0) / rate;
  };
  const double weight = search_.profile(place);
  const double by_work = length(at(y_.segment<3>(normal), place) / weight, y_[work] / weight);
  return is_edge_ ? by_work : std::fmin(by_work, length(y_[progress], y_[store]));
}

double LevelPath::impulse_left(const Values& rate) {
  progress_.at = {.impulse = spent_, .normal_velocity = y_[progress], .store = y_[store]};
  return length_of_stage(rate[progress], push_.place);
}

bool LevelPath::end_stage() {
  const bool compressed = progress_.stage() == Stage::compression;
  progress_.end_stage();
  y_[progress] = progress_.at.normal_velocity;
  if (compressed && law_.law != RestitutionLaw::viscoelastic) {
    y_[store] *= law_.restitution * law_.restitution;
    y_[work] *= law_.restitution * law_.restitution;
  }
  return progress_.is_done();
}

/// To the end of the law with pushes that stay where they are.
void LevelPath::go_straight(const Push& push) {
  push_ = push;
  const Values rates = change(push, y_);
  while (!progress_.is_done()) {
    const double length = impulse_left(rates);
    if (!std::isfinite(length)) fail();
    const Vector3 then = y_.segment<3>(normal) + length * rates.segment<3>(normal);
    const double weight = search_.profile(push.place), next = y_[progress] + length * push.rate;
    const auto stored = [&](double from, double to) {
      return stored_work(progress_.damping(), ImpulseStretch<double>{.from = from, .to = to, .length = length});
    };
    y_[store] += stored(y_[progress], next);
    y_[work] += weight * stored(at(y_.segment<3>(normal), push.place) / weight, at(then, push.place) / weight);
    y_.head<7>() += length * rates.head<7>();
    spent_ += length;
    progress_.at = {.impulse = spent_, .normal_velocity = next, .store = y_[store]};
    end_stage();
  }
}

/// Sticks if friction can hold C under the pressure that it then has; slips on otherwise.
LevelPath::End LevelPath::go_on_from_rest(PathKind& kind, bool slipped) {
  const Matrix3 held = g_.topLeftCorner<3, 3>().inverse() * g_.topRightCorner<3, 3>();
  auto hold = search_.find({Matrix3::Zero(), g_.bottomRightCorner<3, 3>() - g_.bottomLeftCorner<3, 3>() * held},
                           Vector3::Zero());
  if (!hold) fail();
  const Vector3 pushes = with_one(hold->place), load = g_.topRightCorner<3, 3>() * pushes;
  SlipLetGo slip(load, [&](const Vector3& s) -> Vector3 {
    return g_.topLeftCorner<3, 3>() * search_.friction_of(*hold, s);
  });
  if (search_.find_pressure(*hold) && slip.is_held()) {
    kind = slipped ? PathKind::slip_stick : PathKind::stick;
    y_.head<3>().setZero();
    hold->friction = -held * pushes;
    go_straight(*hold);
    y_.head<3>().setZero();
    return End::stopped;
  }
  kind = slipped ? PathKind::slip_reslip : PathKind::slip;
  y_.head<3>() = first_slip * slip.direction();
  return slide(true);
}

LevelImpulse LevelPath::follow() {
  LevelImpulse result;
  if (!law_.rubs()) {
    const bool is_ratio = law_.friction == FrictionKind::impulse_ratio && law_.friction_value != 0;
    Vector3 friction = Vector3::Zero();
    const Vector2 force = law_.friction_value * ratio_direction_;
    if (is_ratio) friction << force, cross(below_, force);
    const auto push = search_.find(response(), friction);
    if (!push || !(push->rate > 0)) throw OutsideModelError("jamming (Painlevé's paradox): a level contact digs in");
    go_straight(*push);
    result.path = is_ratio ? PathKind::slip : PathKind::frictionless;
  } else {
    const bool slips = y_.head<3>().norm() > slow_;
    result.path = PathKind::turning_slip;
    End end = slips ? slide() : End::stopped;
    if (end == End::stopped) end = go_on_from_rest(result.path, slips);
    if (end == End::no_pressure) fail();
  }
  LevelContact::Vector change = y_.head<6>() - begin_;
  result.impulse = speed_ / unit_ * g_.ldlt().solve(change);
  result.impulse[3] = speed_ / unit_ * spent_;
  result.velocity_after = speed_ * y_.head<6>();
  return result;
}

}  // namespace

LevelImpulse level_impulse(const LevelContact& contact, const Law& law) { return LevelPath(contact, law).follow(); }

}  // namespace clatter::analytic::space
