// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/level_rim.hpp"

#include <cmath>
#include <stdexcept>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

namespace {

/// Rebounds slower than this part of the first approach are taken for a rolling rim.
constexpr double settled = 1e-4;
/// Turn of the lowest point between two strikes of a rolling rim [rad]; its error is of this order times the impulse
/// of rolling alone.
constexpr double rolling_step = 0.02;
/// A rim rolls on until its lowest point has no more than this angle left to go [rad].
constexpr double rolled_out = 1e-3;

/// After so many touches the rest goes by the order of approach speeds; rims of random bodies take some hundred.
constexpr int most_touches = 5000;

/// The law of a contact that stays.
ImpactLaw without_rebound(ImpactLaw law) {
  law.law = RestitutionLaw::newton;
  law.restitution = 0;
  return law;
}

}  // namespace

const Corner* level_rim(std::span<const Corner> touching) {
  for (const Corner& corner : touching) {
    if (!(corner.radius > 0)) continue;
    if (touching.size() > 1) throw std::domain_error("a level rim touches together with another corner: not foreseen");
    return &corner;
  }
  return nullptr;
}

State levelled(const Body& body, const State& state, const Corner& rim) {
  State level = state;
  const Vector3 axis = state.attitude * body.rims[static_cast<std::size_t>(rim.index) - body.vertices.size()].axis;
  const Vector3 up = std::copysign(1.0, axis.z()) * Vector3::UnitZ();
  level.attitude = (turn_between(axis, up) * state.attitude).normalized();
  const Vector3& spin = state.angular_velocity;
  if (spin.head<2>().norm() <= 64 * detail::epsilon * std::fabs(spin.z())) level.angular_velocity = {0, 0, spin.z()};
  return level;
}

LevelRim::LevelRim(const Body& body, const State& before, const Corner& rim, const ImpactLaw& law)
    : struck_(body, before, law), index_(rim.index), radius_(rim.radius), arm_(struck_.arm(rim.place)),
      rounding_(64 * detail::epsilon * (before.velocity.norm() + before.angular_velocity.norm() * reach())) {
  struck_.know_approach(-slowest_rise(motion()));
}

LevelRim::Motion LevelRim::motion() const {
  const Vector3& spin = struck_.state().angular_velocity;
  return {.rise = struck_.velocity(arm_).z(), .slope = {-spin.y(), spin.x()}};
}

bool LevelRim::whole() {
  const Motion before = motion();
  if (!(slowest_rise(before) < -rounding_)) return false;
  const auto face = struck_.face_rebound(-arm_.z(), {.corners = {arm_.head<2>()}, .radius = radius_});
  if (face && face->is_lost) struck_.leave_open();
  if (!face || face->is_lost) return false;
  const Vector2 x = face->pressure_point - arm_.head<2>();
  const bool all_approach = before.rise + radius_ * before.slope.norm() <= rounding_;
  if (!face->tilts && !(x.norm() <= radius_)) return false;
  if (!(all_approach || before.at(x) <= 0)) return false;
  LevelRim after = *this;
  after.struck_.push(*face, {index_});
  if (!face->tilts && !(slowest_rise(after.motion()) >= -rounding_)) return false;
  struck_.take(after.struck_);
  return true;
}

void LevelRim::strike_at(const Vector2& x, const ImpactLaw& law) {
  struck_.strike_at(struck_.place(arm_ + Vector3(x.x(), x.y(), 0)), {index_}, law);
}

void LevelRim::one_after_the_other() {
  StrikeSeries series;
  for (Motion m = motion(); slowest_rise(m) < -rounding_; m = motion()) {
    check_number_of_strikes(struck_.strikes());
    if (series.converges(struck_)) continue;
    const double steepness = m.slope.norm();
    if (radius_ * steepness > 1e-12 * std::fabs(m.rise)) {
      strike_at(-radius_ / steepness * m.slope, struck_.law());
      continue;
    }
    if (whole()) continue;
    const Vector2 x = struck_.face_rebound(-arm_.z())->pressure_point - arm_.head<2>();
    strike_at(radius_ / x.norm() * x, struck_.law());
  }
}

std::optional<GroupImpact> LevelRim::rebound_as_a_whole() const {
  LevelRim rim = *this;
  if (!rim.whole()) return {};
  GroupImpact result = rim.struck_.result();
  result.is_whole = !result.tilts;
  return result;
}

GroupImpact LevelRim::strike() const {
  LevelRim rim = *this;
  const bool is_whole = rim.whole();
  rim.one_after_the_other();
  GroupImpact result = rim.struck_.result();
  result.is_whole = is_whole && !result.tilts;
  return result;
}

/// Turns the tilt to what it is when the rim touches again, by (2); false if the rim does not.
bool LevelRim::touches_again(Vector2& tilt) const {
  const Motion m = motion();
  const double size = tilt.norm(), steepness = m.slope.norm();
  const double leaving = m.rise - radius_ * tilt.dot(m.slope) / size;
  const double closing = (radius_ * steepness - m.rise) * (radius_ * steepness + m.rise);
  if (!(closing > 0) || !(steepness > 0)) return false;
  const Vector2 later = tilt + 2 * radius_ * size * leaving / closing * m.slope;
  const bool level = !(later.norm() > 1e-12 * size);  // the tilt goes through zero, and goes on as the slope has it
  tilt = level ? m.slope / steepness : later / later.norm();
  return true;
}

/// The lowest point, at rest on the ground, moves on along the rim, or the body falls flat about the point and the
/// opposite one comes down.
LevelRim::Rolling LevelRim::roll(Vector2& tilt) const {
  const Motion m = motion();
  const double steepness = m.slope.norm();
  if (!(radius_ * steepness > rounding_)) return Rolling::ends;
  const double along = tilt.dot(m.slope), across = std::fabs(tilt.x() * m.slope.y() - tilt.y() * m.slope.x());
  if (across > rolled_out * steepness) {
    tilt = (tilt + rolling_step / steepness * m.slope).normalized();
    return Rolling::goes_on;
  }
  if (along >= 0) return Rolling::ends;
  tilt = m.slope / steepness;
  return Rolling::falls_flat;
}

GroupImpact LevelRim::tilted(double direction) const {
  LevelRim rim = *this;
  Vector2 tilt(std::cos(direction), std::sin(direction));
  const ImpactLaw& law = struck_.law();
  const ImpactLaw plastic = without_rebound(law);
  const double slow = settled * -slowest_rise(motion());
  Rolling rolling = Rolling::falls_flat;
  for (int touches = 0; touches < most_touches; ++touches) {
    const Vector2 x = -radius_ * tilt;
    if (rim.motion().at(x) < -rounding_) {
      const bool rolls = rolling == Rolling::goes_on;
      rim.struck_.merge_strikes(rolls);
      rim.strike_at(x, rolls ? plastic : law);
    }
    if (rim.motion().at(x) > slow) {
      rolling = Rolling::falls_flat;  // the next point strikes with its rebound
      if (!rim.touches_again(tilt)) break;
    } else {
      rolling = rim.roll(tilt);
      if (rolling == Rolling::ends) break;
    }
  }
  rim.one_after_the_other();  // no point approaches, unless the touches were too many
  GroupImpact result = rim.struck_.result();
  result.is_whole = result.order.size() == 1;
  return result;
}

}  // namespace clatter::analytic::space
