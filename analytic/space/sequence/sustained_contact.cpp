// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/sustained_contact.hpp"

#include <algorithm>
#include <cmath>

#include "analytic/base/limits.hpp"
#include "analytic/space/sequence/contact_motion.hpp"

namespace clatter::analytic::space {

namespace {

using Changes = Eigen::Matrix<double, 9, 1>;  ///< of attitude, velocity, angular velocity

/// Part of a change that may be of second order.
constexpr double most_second_order = 0.02;

State shifted(const State& s, const Changes& by) {
  State other = s;
  other.attitude = turn_by(by.head<3>()) * s.attitude;
  other.velocity += by.segment<3>(3);
  other.angular_velocity += by.tail<3>();
  return other;
}

Changes change(const State& from, const State& to) {
  const Quaternion turn = to.attitude * from.attitude.conjugate();
  Changes c;
  c << std::copysign(2, turn.w()) * turn.vec(), to.velocity - from.velocity,
      to.angular_velocity - from.angular_velocity;
  return c;
}

/// The contact once more, and its neighbours.
class Neighbours {
 public:
  Neighbours(const Drop& drop, const State& now, const SustainedContact& contact)
      : drop_(drop), contact_(contact), base_(drop, now, contact.corners), start_(base_.state()),
        vertex_(contact.arriving.empty() ? 0 : contact.arriving.front()) {
    const double reach = drop.body.reach(), speed = base_.speed_scale();
    const double slip = base_.least_slip() / speed;  // its direction has to change little
    slips_ = base_.slips();
    sizes_ << Vector3::Ones(), Vector3::Constant(speed), Vector3::Constant(speed / reach);
    steps_ = std::fmin(1e-6, 1e-3 * slip) * sizes_;
    most_ = 1e-2 * std::fmin(1, slip) * sizes_;
    followed_ = base_.advance(contact.duration);
  }

  /// The state at the end, with bounds on its errors at exactly that time.
  [[nodiscard]] std::optional<StateInContact> at_end(const StateErrors& errors) const;
  /// Derivatives of time and state at the end by those at the beginning; nothing where errors are too large for that.
  [[nodiscard]] std::optional<ContactDerivatives> derivatives(const StateErrors& errors) const;

 private:
  struct Slope {
    Changes state;
    double margin;
  };
  [[nodiscard]] std::optional<Slope> slope(int k, double error) const;
  [[nodiscard]] std::optional<Slope> slope(int k, double error, double length) const;
  [[nodiscard]] double parted(const ContactMotion& other) const;
  [[nodiscard]] double clearance() const;
  /// The ground would have to pull from the start.
  [[nodiscard]] bool lifts_at_once() const {
    return contact_.end == ContactEnd::lift_off &&
           contact_.duration <= 1e-12 * std::sqrt(drop_.body.reach() / drop_.gravity);
  }

  const Drop& drop_;
  const SustainedContact& contact_;
  ContactMotion base_;
  State start_;
  int vertex_;
  Changes sizes_, steps_, most_;  ///< of what is changed; by how much at least and at most
  bool slips_, followed_;
};

/// How far apart the corners that come down together are, of the reach.
double Neighbours::parted(const ContactMotion& other) const {
  double most = 0;
  for (const int i : contact_.arriving) {
    most = std::fmax(most, std::fabs(other.margin(contact_.end, i) - other.margin(contact_.end, vertex_)));
  }
  return most / drop_.body.reach();
}

/// By the k-th number of the state; nothing where a neighbour as far off as the error is no longer of first order.
/// Nearer ones serve where those that far off slip or stick otherwise.
std::optional<Neighbours::Slope> Neighbours::slope(int k, double error) const {
  constexpr double nearer = 1e-2;
  const double least = std::fmax(1e-9 * sizes_[k], error);
  double length = std::fmax(steps_[k], std::fmin(error, most_[k]));
  auto found = slope(k, error, length);
  while (!found && nearer * length >= least) length *= nearer, found = slope(k, error, length);
  return found;
}

std::optional<Neighbours::Slope> Neighbours::slope(int k, double error, double length) const {
  const Changes step = length * Changes::Unit(k);
  ContactMotion plus(base_, shifted(start_, step)), minus(base_, shifted(start_, -step));
  if (!plus.advance(contact_.duration) || !minus.advance(contact_.duration)) return {};
  const State end = base_.state();
  const Changes up = change(end, plus.state()), down = change(end, minus.state());
  const double straight = (up - down).cwiseQuotient(sizes_).norm(), bent = (up + down).cwiseQuotient(sizes_).norm();
  const double noise = 1e-3 * length / sizes_[k];
  if (!(error / length * bent <= most_second_order * (straight + noise))) return {};
  if (!(parted(plus) <= noise) || !(parted(minus) <= noise)) return {};
  return Slope{.state = (up - down) / (2 * length),
               .margin = (plus.margin(contact_.end, vertex_) - minus.margin(contact_.end, vertex_)) / (2 * length)};
}

/// Least height of vertices that come down but have not.
double Neighbours::clearance() const {
  const State end = base_.state();
  const auto is_of = [](const std::vector<int>& some, int i) { return std::ranges::count(some, i) > 0; };
  double least = detail::infinite;
  for (int i = 0; i < static_cast<int>(drop_.body.vertices.size()); ++i) {
    if (is_of(contact_.pivots, i) || is_of(contact_.arriving, i)) continue;
    const Vector3& place = drop_.body.vertices[static_cast<std::size_t>(i)];
    if (!(velocity_at(end, place).z() < 0)) continue;
    least = std::fmin(least, end.position.z() + (end.attitude * place).z());
  }
  return least;
}

std::optional<ContactDerivatives> Neighbours::derivatives(const StateErrors& errors) const {
  const bool has_margin = contact_.end == ContactEnd::arrival || contact_.end == ContactEnd::lift_off;
  if (!followed_ || !has_margin) return {};
  const ContactMotion::Rates rates = base_.rates(contact_.end, vertex_);
  if (!(rates.margin < 0) && !lifts_at_once()) return {};
  const Changes of_state = errors.in_each_direction().tail<9>();
  const bool at_once = lifts_at_once();
  double push = 0;  // by which errors may change that of the ground
  Changes shift;    // of the end
  shift << base_.state().angular_velocity, rates.acceleration, rates.turning;
  ContactDerivatives d{.bend = std::fabs(rates.bend / rates.margin), .clearance = clearance()};
  d.of_state(0, 0) = 1;
  for (int k = 0; k < 9; ++k) {
    if (k == 5 || (!slips_ && k / 3 == 1)) continue;  // nothing is left of these where the corner is held
    const auto by = slope(k, of_state[k]);
    if (!by) return {};
    push += std::fabs(by->margin) * of_state[k];
    const double late = at_once ? 0 : -by->margin / rates.margin;
    d.of_state(0, k + 1) = late;
    d.of_state.block<9, 1>(1, k + 1) = by->state + late * shift;
  }
  if (!d.of_state.allFinite() || (at_once && !(base_.margin(contact_.end, vertex_) < -push))) return {};
  return d;
}

std::optional<StateInContact> Neighbours::at_end(const StateErrors& errors) const {
  if (!followed_) return {};
  StateInContact there{.state = base_.state(), .error = {}};
  if (!std::isfinite(errors.attitude + errors.velocity + errors.angular_velocity + errors.time)) return there;
  const ContactMotion::Rates rates = base_.rates(ContactEnd::arrival, vertex_);
  const Changes of_state = errors.in_each_direction().tail<9>();
  Changes all, drift;
  drift << there.state.angular_velocity, rates.acceleration, rates.turning;
  all = errors.time * drift.cwiseAbs();
  for (int k = 0; k < 9; ++k) {
    if (k == 5 || (!slips_ && k / 3 == 1)) continue;  // nothing is left of these where the corner is held
    const auto by = slope(k, of_state[k]);
    if (!by) return there;
    all += of_state[k] * by->state.cwiseAbs();
  }
  there.error = {.time = 0,
                 .attitude = all.head<3>().norm(),
                 .velocity = all.segment<3>(3).norm(),
                 .angular_velocity = all.tail<3>().norm()};
  return there;
}

}  // namespace

std::optional<StateInContact> contact_at(const Drop& drop, const State& now, const SustainedContact& contact,
                                         double time, const StateErrors& errors) {
  SustainedContact part;
  part.duration = time;
  part.corners = contact.corners;
  part.end = ContactEnd::arrival;
  auto there = Neighbours(drop, now, part).at_end(errors);
  if (!there) return {};
  const StateErrors rounding = contact_rounding(drop, now, part);
  there->error.attitude += 2 * rounding.attitude;
  there->error.velocity += 2 * rounding.velocity;
  there->error.angular_velocity += 2 * rounding.angular_velocity;
  return there;
}

SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners) {
  return ContactMotion(drop, now, corners).follow();
}

std::optional<ContactDerivatives> contact_derivatives(const Drop& drop, const State& now,
                                                      const SustainedContact& contact, const StateErrors& errors) {
  if (!std::isfinite(errors.attitude + errors.velocity + errors.angular_velocity)) return {};
  return Neighbours(drop, now, contact).derivatives(errors);
}

StateErrors contact_rounding(const Drop& drop, const State& now, const SustainedContact& contact) {
  constexpr double accuracy = 1e-12;
  const double reach = drop.body.reach(), falling = std::sqrt(reach / drop.gravity);
  const double speed = reach / falling + now.angular_velocity.norm() * reach;
  const double rounding = accuracy * std::fmin(1, contact.duration / falling) + 8 * detail::epsilon;
  // What is left of normal velocity and slip is taken away.
  const Changes held = change(now, ContactMotion(drop, now, contact.corners).state());
  return {.time = rounding * contact.duration,
          .attitude = rounding + held.head<3>().norm(),
          .velocity = rounding * speed + held.segment<3>(3).norm(),
          .angular_velocity = rounding * speed / reach + held.tail<3>().norm()};
}

SustainedContact follow_contact(const Drop& drop, const State& now, const std::vector<int>& corners,
                                const StateErrors& errors) {
  SustainedContact contact = follow_contact(drop, now, corners);
  const auto d = contact_derivatives(drop, now, contact, errors);
  if (!d) return contact;
  const StateErrors rounding = contact_rounding(drop, now, contact);
  const Eigen::Matrix<double, 10, 1> bounds =
      d->of_state.cwiseAbs() * (errors.in_each_direction() + rounding.in_each_direction());
  if (!d->hold(drop.body, bounds[0] - errors.time, bounds.segment<3>(1).norm())) return contact;
  contact.error = {.time = bounds[0] + rounding.time,
                   .attitude = bounds.segment<3>(1).norm() + rounding.attitude,
                   .velocity = bounds.segment<3>(4).norm() + rounding.velocity,
                   .angular_velocity = bounds.tail<3>().norm() + rounding.angular_velocity};
  add_impulse_error(drop, errors, contact);
  return contact;
}

void add_impulse_error(const Drop& drop, const StateErrors& before, SustainedContact& contact) {
  contact.normal_impulse_error =
      drop.body.mass * (before.velocity + contact.error.velocity + drop.gravity * (before.time + contact.error.time));
}

bool can_follow(const Drop& drop, const std::vector<int>& corners) {
  const ImpactLaw& law = drop.law;
  const auto is_vertex = [&](int i) { return static_cast<std::size_t>(i) < drop.body.vertices.size(); };
  const bool one_or_two = corners.size() == 1 || corners.size() == 2;
  return one_or_two && std::ranges::all_of(corners, is_vertex) && drop.gravity > 0 && drop.gravity_along == 0 &&
         law.law != RestitutionLaw::viscoelastic && law.friction != FrictionKind::impulse_ratio;
}

std::optional<SustainedContact> contact_after(const Drop& drop, const Sequence& sequence) {
  if (!sequence.standing || !can_follow(drop, sequence.standing->corners)) return {};
  const Standing& standing = *sequence.standing;
  SustainedContact contact = follow_contact(drop, standing.state, standing.corners, standing.error);
  contact.rows = sequence.rows.size();
  contact.begin = standing.time;
  return contact;
}

}  // namespace clatter::analytic::space
