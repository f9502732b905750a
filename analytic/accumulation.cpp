#include "analytic/accumulation.hpp"

#include <bit>
#include <cmath>

namespace clatter::analytic {
namespace {

constexpr int blocks = 4;  // two extrapolations, whose difference is the error, need three ratios

/// Limit of a shrinking series beyond its last term.
struct Remainder {
  double value = 0;
  double error = 0;
};

/// Aitken's Δ² from the last two of `terms` (latest last) and from the two before.
std::optional<Remainder> shrinking_remainder(const double (&terms)[blocks]) {
  const auto remaining = [&](int k) {
    const double ratio = terms[k] / terms[k - 1];
    return ratio > 0 && ratio < 1 ? terms[k] * ratio / (1 - ratio) : NAN;
  };
  const double last = remaining(3);
  const double one_earlier = remaining(2) - terms[3];
  const double two_earlier = remaining(1) - terms[3] - terms[2];
  const double error = std::fmax(std::fabs(last - one_earlier), std::fabs(one_earlier - two_earlier));
  if (!(last > 0 && error < last)) return {};
  return Remainder{last, error};
}

/// Tangential impulse of a face that slides with `slip` while it takes the normal impulse `normal`.
double sliding_impulse(const ImpactLaw& law, double mass, double slip, double normal) {
  if (law.friction == FrictionKind::none) return 0;
  if (law.friction == FrictionKind::impulse_ratio) return law.friction_value * normal;
  return -std::copysign(std::fmin(law.friction_value * normal, mass * std::fabs(slip)), slip);
}

}  // namespace

std::optional<Tail> bouncing_tail(const BodyMotion& motion, const ImpactLaw& law, double gravity,
                                  const BodyMotion::Strike& last) {
  const PlanarVelocity v = motion.velocity();
  if (v.angular != 0 || !(gravity > 0) || !(law.restitution < 1)) return {};
  const bool upright = std::popcount(last.vertices) == 1;
  if (upright && (motion.contact_point(std::countr_zero(last.vertices)).tangential != 0 ||
                  last.impact.tangential_impulse != 0)) {
    return {};
  }
  const double w = last.impact.separation_speed;
  const double e = law.restitution;
  const double mass = motion.body().mass;
  const double normal = mass * (1 + e) * w / (1 - e);
  const double tangential = upright ? 0 : sliding_impulse(law, mass, v.tangential, normal);
  return Tail{.end_time = motion.time() + 2 * w / (gravity * (1 - e)),
              .normal_impulse = normal,
              .tangential_impulse = tangential,
              .vertices = last.vertices,
              .closed_form = true,
              .after = {.tangential = v.tangential + tangential / mass}};
}

bool Accumulation::repeats(int period) const {
  const int count = static_cast<int>(events_.size());
  if (count < blocks * period) return false;
  for (int i = count - (blocks - 1) * period; i < count; ++i) {
    if (events_[i].vertices != events_[i - period].vertices) return false;
  }
  return true;
}

double Accumulation::block(int period, int index, double Event::*quantity) const {
  const auto end = events_.size() - static_cast<std::size_t>((blocks - 1 - index) * period);
  double sum = 0;
  for (std::size_t i = end - static_cast<std::size_t>(period); i < end; ++i) {
    sum += events_[i].*quantity;
  }
  return sum;
}

std::optional<Tail> Accumulation::extrapolate(const Tolerance& tolerance) const {
  for (int period = 1; period <= 4; ++period) {
    if (!repeats(period)) continue;
    double times[blocks], impulses[blocks];
    for (int k = 0; k < blocks; ++k) {
      times[k] = block(period, k, &Event::flight_time);
      impulses[k] = block(period, k, &Event::normal_impulse);
    }
    const auto time = shrinking_remainder(times);
    const auto impulse = shrinking_remainder(impulses);
    if (!time || !impulse ||
        !(time->error <= std::fmax(tolerance.relative * time->value, tolerance.time)) ||
        !(impulse->error <= std::fmax(tolerance.relative * impulse->value, tolerance.impulse))) {
      continue;
    }
    const double ratio = block(period, blocks - 1, &Event::tangential_impulse) / impulses[blocks - 1];
    VertexSet vertices = 0;
    for (int i = 1; i <= period; ++i) vertices |= events_[events_.size() - i].vertices;
    return Tail{.end_time = time->value,
                .end_time_error = time->error,
                .normal_impulse = impulse->value,
                .normal_impulse_error = impulse->error,
                .tangential_impulse = ratio * impulse->value,
                .vertices = vertices,
                .after = {}};
  }
  return {};
}

}  // namespace clatter::analytic
