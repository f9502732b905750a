// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/accumulation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "analytic/law/viscoelastic.hpp"

namespace clatter::analytic {

namespace {

constexpr int blocks = 4;  // two extrapolations, whose difference is the error, need three ratios

/// Limit of a shrinking series beyond its last term.
struct Remainder {
  double value = 0;
  double error = 0;
};

/// Aitken's Δ² from the last two of `terms` (latest last), the two before and the two before those.
/// The changes of the extrapolated limit shrink at least as fast as the terms, or as the changes themselves did last.
std::optional<Remainder> shrinking_remainder(const double (&terms)[blocks]) {
  const auto remaining = [&](int k) {
    const double ratio = terms[k] / terms[k - 1];
    return ratio > 0 && ratio < 1 ? terms[k] * ratio / (1 - ratio) : NAN;
  };
  const double last = remaining(3);
  const double change = std::fabs(last - (remaining(2) - terms[3]));
  const double change_before = std::fabs(remaining(2) - terms[3] - (remaining(1) - terms[3] - terms[2]));
  const double ratio = terms[3] / terms[2];
  const double rounding = 32 * std::numeric_limits<double>::epsilon() * (last + terms[2]) / (1 - ratio);
  if (!(last > 0) || std::isnan(change_before)) return {};
  if (change <= rounding && change_before <= rounding) return Remainder{last, 2 * rounding};
  const double shrinks = std::fmax(ratio, change / change_before);
  if (!(shrinks < 1)) return {};
  const double error = rounding + 2 * std::fmax(change, shrinks * change_before) / (1 - shrinks);
  if (!(error < last)) return {};
  return Remainder{last, error};
}

}  // namespace

std::optional<Slide> slide(const ImpactLaw& law, const SlidingFace& face) {
  const double mass = face.mass, slip = face.slip, normal = face.normal, pull = face.pull;
  const auto moved_by = [&](double friction) { return Slide{friction, slip + (friction + pull) / mass}; };
  if (law.friction == FrictionKind::none) return moved_by(0);
  if (law.friction == FrictionKind::impulse_ratio) return moved_by(law.friction_value * normal);
  const double most = law.friction_value * normal, down = pull != 0 ? pull : slip;
  const double held = mass * std::fabs(slip), pulled = std::fabs(pull);
  if (pull * slip >= 0) {  // with the pull, or without one
    if (most >= held + pulled) return Slide{-std::copysign(held + pulled, down), 0};
    return moved_by(-std::copysign(most, down));
  }
  if (most + pulled <= held) return moved_by(std::copysign(most, down));
  if (pulled > most) return {};
  return Slide{down > 0 ? held - pulled : pulled - held, 0};
}

bool slides_down(const ImpactLaw& law, double gravity, double gravity_along) {
  return gravity_along != 0 && std::fabs(gravity_along) > law.most_friction() * gravity;
}

/// About the centre of mass d_n P_t = p P_n, with the ground's push at p from it.
bool stays_level(const BodyMotion& motion, VertexSet face, double share) {
  double least = std::numeric_limits<double>::infinity(), most = -least, push = 0;
  for (int i = 0; i < motion.body().vertex_count; ++i) {
    if (!(face >> i & 1)) continue;
    const ContactPoint d = motion.contact_point(i);
    least = std::fmin(least, d.tangential);
    most = std::fmax(most, d.tangential);
    push = d.normal * share;
  }
  return least <= push && push <= most;
}

std::optional<Tail> bouncing_tail(const BodyMotion& motion, const ImpactLaw& law, const BodyMotion::Strike& last) {
  const PlanarVelocity v = motion.velocity();
  const Departure departure = motion.local_departure();
  const double gravity = departure.gravity, along = departure.gravity_along;
  if (v.angular != 0 || !(gravity > 0) || !(law.restitution < 1)) return {};
  const bool upright = std::popcount(last.vertices) == 1;
  if (upright &&
      (motion.contact_point(std::countr_zero(last.vertices)).tangential != 0 || last.impact.tangential_impulse != 0)) {
    return {};
  }
  const double w = last.impact.separation_speed;
  const double e = law.restitution;
  const double mass = motion.body().mass;
  const double normal = mass * (1 + e) * w / (1 - e);
  const double left = 2 * w / (gravity * (1 - e)), rubs = law.most_friction();
  if (along != 0 && rubs > 0) {
    const bool level = stays_level(motion, last.vertices, rubs) && stays_level(motion, last.vertices, -rubs);
    if (upright || !level) return {};  // friction may turn it yet
  }
  const ImpactLaw without;
  const auto slid = slide(upright ? without : law,
                          {.mass = mass, .slip = v.tangential, .normal = normal, .pull = mass * along * left});
  if (!slid) return {};
  return Tail{.end_time = motion.time() + left,
              .normal_impulse = normal,
              .tangential_impulse = {slid->impulse, 0},
              .vertices = last.vertices,
              .closed_form = true,
              .velocity_after = {slid->slip, 0, 0}};
}

std::optional<Tail> resting_tail(const BodyMotion& motion, const ImpactLaw& law, const BodyMotion::Strike& last) {
  const bool sticks = last.impact.mode == ImpactMode::stick || last.impact.mode == ImpactMode::slip_stick;
  const bool follows = sticks || (law.friction == FrictionKind::none && std::popcount(last.vertices) == 1);
  const Departure departure = motion.local_departure();
  if (!follows || law.restitution != 0 || std::popcount(departure.touching) != 2 || departure.rebound_speed != 0)
    return {};
  const int at_rest = departure.reference, coming = std::countr_zero(departure.touching & ~(1u << at_rest));
  if (!(vertex_height(motion.turned_body(), departure, coming).velocity < 0)) return {};
  const PlanarBody& body = motion.body();
  const ContactPoint one = motion.contact_point(at_rest), other = motion.contact_point(coming);
  double pushes_up = 1 + one.tangential * other.tangential / body.gyration_square;  // the other, per impulse
  if (sticks) {
    const ContactInertia of_one = contact_inertia(body.gyration_square, one);
    const ContactInertia of_other = contact_inertia(body.gyration_square, other);
    pushes_up -= of_one.coupling * of_other.coupling / of_one.tangential;
    const double most = law.friction_value * of_one.tangential;
    if (std::fabs(of_one.coupling) > most || std::fabs(of_other.coupling) > most) return {};
  }
  if (!(pushes_up < 0)) return {};
  const PlanarVelocity v = motion.velocity();
  return Tail{.end_time = motion.time(),
              .normal_impulse = -body.mass * v.normal,
              .tangential_impulse = {sticks ? -body.mass * v.tangential : 0, 0},
              .vertices = departure.touching,
              .closed_form = true,
              .velocity_after = {sticks ? 0 : v.tangential, 0, 0}};
}

bool may_accumulate(const ImpactLaw& law) { return law.restitution < 1 || law.has_cone(); }

double damping_loss(const ImpactLaw& law, double approach_speed) {
  const bool damped = law.law == RestitutionLaw::viscoelastic && approach_speed > 0;
  return damped ? restitution_loss_of_damping(law.damping_per_stiffness * approach_speed) : 0;
}

bool Accumulation::repeats(int period) const {
  const int count = static_cast<int>(events_.size());
  if (count < blocks * period) return false;
  for (int i = count - (blocks - 1) * period; i < count; ++i) {
    const Event &event = events_[i], &before = events_[i - period];
    if (event.vertices != before.vertices || event.mode != before.mode) return false;
  }
  return true;
}

double Accumulation::block(int period, int index, double Event::*quantity) const {
  const auto end = events_.size() - static_cast<std::size_t>((blocks - 1 - index) * period);
  double sum = 0;
  for (std::size_t i = end - static_cast<std::size_t>(period); i < end; ++i) sum += events_[i].*quantity;
  return sum;
}

VertexSet Accumulation::vertices(int last) const {
  VertexSet set = 0;
  for (std::size_t i = events_.size() - static_cast<std::size_t>(last); i < events_.size(); ++i)
    set |= events_[i].vertices;
  return set;
}

std::optional<Tail> Accumulation::periodic(int period, const Tolerance& tolerance) const {
  double times[blocks], impulses[blocks];
  for (int k = 0; k < blocks; ++k) {
    times[k] = block(period, k, &Event::flight_time);
    impulses[k] = block(period, k, &Event::normal_impulse);
  }
  const bool at_once = std::ranges::all_of(times, [](double t) { return t == 0; });
  const auto time = at_once ? Remainder{} : shrinking_remainder(times);
  const auto impulse = shrinking_remainder(impulses);
  if (!time || !impulse || !(time->error <= std::fmax(tolerance.relative * time->value, tolerance.time)) ||
      !(impulse->error <= std::fmax(tolerance.relative * impulse->value, tolerance.impulse))) {
    return {};
  }
  constexpr double damped_share = 0.01;  // of the shrinking, below which it no longer changes with the speed
  if (!(block(period, blocks - 1, &Event::damping_loss) <=
        damped_share * (1 - impulses[blocks - 1] / impulses[blocks - 2]))) {
    return {};
  }
  const double ratio = block(period, blocks - 1, &Event::tangential_impulse) / impulses[blocks - 1];
  const double ratio_before = block(period, blocks - 2, &Event::tangential_impulse) / impulses[blocks - 2];
  const double shrinks = impulses[blocks - 1] / impulses[blocks - 2];
  return Tail{.end_time = time->value,
              .end_time_error = time->error,
              .normal_impulse = impulse->value,
              .normal_impulse_error = impulse->error,
              .tangential_impulse = {ratio * impulse->value, 0},
              .tangential_impulse_error = 2 * std::fabs(ratio - ratio_before) / (1 - shrinks) * impulse->value +
                                          std::fabs(ratio) * impulse->error,
              .vertices = vertices(period)};
}

/// The last impacts took next to no time, and those before them little more than they.
std::optional<Tail> Accumulation::vanishing(const Tolerance& tolerance) const {
  constexpr int period = 12;
  if (events_.size() < static_cast<std::size_t>(blocks * period)) return {};
  const auto remainder = [&](double Event::*quantity) {
    double largest_ratio = 0;
    for (int k = 1; k < blocks; ++k) {
      largest_ratio = std::fmax(largest_ratio, block(period, k, quantity) / block(period, k - 1, quantity));
    }
    return largest_ratio < 1 ? block(period, blocks - 1, quantity) * largest_ratio / (1 - largest_ratio) : NAN;
  };
  const double time = remainder(&Event::flight_time), impulse = remainder(&Event::normal_impulse);
  if (!(4 * time <= tolerance.time && 4 * impulse <= tolerance.impulse)) return {};
  const double ratio =
      block(period, blocks - 1, &Event::tangential_impulse) / block(period, blocks - 1, &Event::normal_impulse);
  return Tail{.end_time = time,
              .end_time_error = 4 * time,
              .normal_impulse = impulse,
              .normal_impulse_error = 4 * impulse,
              .tangential_impulse = {ratio * impulse, 0},
              .tangential_impulse_error = 4 * (1 + std::fabs(ratio)) * impulse,
              .vertices = vertices(period)};
}

std::optional<Tail> Accumulation::extrapolate(const Tolerance& tolerance) const {
  constexpr int longest_period = 6;
  for (int period = 1; period <= longest_period; ++period) {
    if (!repeats(period)) continue;
    if (auto tail = periodic(period, tolerance)) return tail;
  }
  return vanishing(tolerance);
}

void end_state(const BodyMotion& motion, ImpactMode mode, Tail& tail) {
  const PlanarVelocity v = motion.velocity();
  const PlanarBody& body = motion.body();
  const double normal = tail.normal_impulse, tangential = tail.tangential_impulse.x();
  const double along = motion.local_departure().gravity_along;
  PlanarVelocity after{.tangential = v.tangential + tangential / body.mass + along * tail.end_time};
  PlanarVelocity error{.tangential =
                           tail.tangential_impulse_error / body.mass + std::fabs(along) * tail.end_time_error};
  if (std::popcount(tail.vertices) != 1) {
    if (mode == ImpactMode::stick || mode == ImpactMode::slip_stick) after.tangential = 0;
    const double share = std::fmin(tail.normal_impulse_error / normal, 1.0);  // of the motion that may be left
    error.normal = share * std::fabs(v.normal);
    error.angular = share * std::fabs(v.angular);
    tail.set_after(after);
    tail.set_errors(error);
    return;
  }
  const ContactPoint d = motion.contact_point(std::countr_zero(tail.vertices));
  const double inertia = body.mass * body.gyration_square;
  const double way =
      (std::fabs(v.angular) + (normal + std::fabs(tangential)) * body.reach() / inertia) * body.reach() * tail.end_time;
  after.angular = v.angular + (tangential * d.normal - normal * d.tangential) / inertia;
  after.normal = after.angular * d.tangential;
  error.angular = (tail.tangential_impulse_error * std::fabs(d.normal) +
                   tail.normal_impulse_error * std::fabs(d.tangential) + way * (normal + std::fabs(tangential))) /
                  inertia;
  error.normal = error.angular * std::fabs(d.tangential) + way * std::fabs(after.angular);
  tail.set_after(after);
  tail.set_errors(error);
}

bool keeps_its_mode(const BodyMotion& motion, const Tail& tail, ImpactMode mode) {
  if (mode == ImpactMode::frictionless || mode == ImpactMode::stick || mode == ImpactMode::slip_stick) return true;
  const PlanarBody& body = motion.body();
  const ContactInertia inertia =
      contact_inertia(body.gyration_square, motion.contact_point(motion.local_departure().reference));
  const double turning = std::fabs(motion.velocity().angular);
  const double change =
      (inertia.tangential * std::fabs(tail.tangential_impulse.x()) +
       std::fabs(inertia.coupling) * tail.normal_impulse) /
          body.mass +
      (turning * turning * body.reach() + std::fabs(motion.local_departure().gravity_along)) * tail.end_time;
  return 2 * change < std::fabs(motion.slip());
}

}  // namespace clatter::analytic
