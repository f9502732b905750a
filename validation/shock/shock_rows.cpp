// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_rows.hpp"

#include <boost/math/tools/minima.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <span>

#include "validation/scene/body_properties.hpp"
#include "validation/shock/response_spectrum.hpp"

namespace clatter::validation {
namespace {

constexpr double width_level = 0.1;  ///< of the peak, at which its width is measured

/// The size of a vector over a piece.
double size_at(const VectorPolynomial& vector, double x) { return value_at(vector, x).norm(); }

/// Where a vector is largest over a piece, and its size there.
struct Largest {
  std::size_t piece = 0;
  double x = 0;
  double size = -1;
};

/// Looks through one piece at points closer than its samples, then refines about the best: the size near a smooth
/// maximum is known to rounding where its place is known to the root of that.
void look(const VectorPolynomial& vector, std::size_t piece, Largest& best) {
  constexpr int points = 4 * numeric::piece_points;
  int at = 0;
  double size = -1;
  for (int i = 0; i <= points; ++i) {
    const double found = size_at(vector, static_cast<double>(i) / points);
    if (found > size) {
      size = found;
      at = i;
    }
  }
  if (!(size > 0.9 * best.size)) return;
  const double low = std::max(at - 1, 0) / static_cast<double>(points),
               high = std::min(at + 1, points) / static_cast<double>(points);
  const auto [x, least] =
      boost::math::tools::brent_find_minima([&](double t) { return -size_at(vector, t); }, low, high, 30);
  const bool is_inside = -least > size;
  const Largest found{piece, is_inside ? x : static_cast<double>(at) / points, is_inside ? -least : size};
  if (found.size > best.size) best = found;
}

Largest largest(std::span<const MotionPiece> contact, const auto& value) {
  Largest best;
  for (std::size_t i = 0; i < contact.size(); ++i) look(polynomial_of(contact[i], value), i, best);
  return best;
}

double time_at(const MotionPiece& piece, double x) { return piece.piece.start + x * piece.piece.length; }

/// Time after the touch-down at which the size first falls to `level` from the peak on, forward or backward; the
/// contact's end where it does not.
double crossing(std::span<const MotionPiece> contact, const Largest& peak, double level, bool forward,
                const auto& value) {
  constexpr int points = 4 * numeric::piece_points;
  std::size_t i = peak.piece;
  double above = peak.x;
  for (;;) {
    const VectorPolynomial vector = polynomial_of(contact[i], value);
    const double end = forward ? 1 : 0;
    const int parts = std::max(1, static_cast<int>(std::ceil(std::fabs(end - above) * points)));
    const double from = above;
    for (int k = 1; k <= parts; ++k) {
      const double x = from + (end - from) * k / parts;
      if (size_at(vector, x) > level) {
        above = x;
        continue;
      }
      double below = x;
      for (int halvings = 0; halvings < 60; ++halvings) {
        const double middle = (above + below) / 2;
        (size_at(vector, middle) > level ? above : below) = middle;
      }
      return time_at(contact[i], above);
    }
    if (forward ? i + 1 == contact.size() : i == 0) return time_at(contact[i], end);
    i = forward ? i + 1 : i - 1;
    above = forward ? 0 : 1;
  }
}

/// World velocity of the body's point.
Vector3 velocity_of(const numeric::PieceSample& at, const Vector3& r) {
  return at.state.velocity + at.state.attitude * at.state.angular_velocity.cross(r);
}

Vector3 world_spin(const numeric::PieceSample& at) { return at.state.attitude * at.state.angular_velocity; }

/// ∫a dt of the point, world.
Vector3 integral_of_acceleration(std::span<const MotionPiece> contact, const Vector3& r, double mass, double gravity) {
  Vector3 sum = Vector3::Zero();
  for (const MotionPiece& piece : contact) {
    const VectorPolynomial acceleration = polynomial_of(piece, [&](const numeric::PieceSample& at) {
      return Vector3(at.state.attitude * specific_force(at, r, mass) - Vector3(0, 0, gravity));
    });
    for (int i = 0; i < 3; ++i) sum[i] += piece.piece.length * acceleration[static_cast<std::size_t>(i)].integral();
  }
  return sum;
}

/// How far the polynomials about the peak may be from what they stand for [m/s²].
double tail_of(const VectorPolynomial& vector) {
  return std::hypot(vector[0].tail(), vector[1].tail(), vector[2].tail());
}

ShockRow row_of(std::span<const MotionPiece> contact, const Vector3& r, const RecordedShock& asked) {
  const double mass = asked.mass;
  const numeric::PieceSample &first = contact.front().samples.front(), &last = contact.back().samples.back();
  const auto felt = [&](const numeric::PieceSample& at) { return specific_force(at, r, mass); };
  const auto turning = [&](const numeric::PieceSample& at) { return at.angular_acceleration; };
  ShockRow row;
  row.impact = contact.front().piece.impact;
  row.start = contact.front().piece.origin;
  row.duration = contact.back().piece.start + contact.back().piece.length;
  ShockNumbers& n = row.value;
  n.delta_v = velocity_of(last, r) - velocity_of(first, r);
  n.delta_v_size = n.delta_v.norm();
  row.delta_v_body = first.state.attitude.conjugate() * n.delta_v;
  n.delta_omega = world_spin(last) - world_spin(first);
  n.delta_omega_size = n.delta_omega.norm();
  const Largest peak = largest(contact, felt);
  const VectorPolynomial about = polynomial_of(contact[peak.piece], felt);
  n.peak = value_at(about, peak.x);
  n.peak_size = n.peak.norm();
  n.peak_time = time_at(contact[peak.piece], peak.x);
  row.peak_piece = peak.piece;
  row.peak_place = peak.x;
  n.width = crossing(contact, peak, width_level * n.peak_size, true, felt) -
            crossing(contact, peak, width_level * n.peak_size, false, felt);
  const Largest turn = largest(contact, turning);
  n.peak_alpha = turn.size;
  row.error.peak_size = tail_of(about);
  row.error.peak_alpha = tail_of(polynomial_of(contact[turn.piece], turning));
  row.closure = (integral_of_acceleration(contact, r, mass, asked.gravity) - n.delta_v).norm() / n.delta_v_size;
  for (const FragilePart& part : asked.parts) {
    if (const auto mass_on_spring = part.oscillator())
      row.responses[mass_on_spring->frequency] = undamped_response(contact, r, mass, mass_on_spring->frequency);
  }
  return row;
}

using Number = double ShockNumbers::*;
using Vector = Vector3 ShockNumbers::*;

/// Adds to the errors of a row those that the other run tells, and what rounding leaves.
void add_errors(const ShockRow& other, double error_per_distance, double trust, double rounding, ShockRow& row) {
  const auto add = [&](double& error, double distance, double size) {
    error += error_per_distance * distance + (trust + rounding) * size;
  };
  for (const Number number : {&ShockNumbers::delta_v_size, &ShockNumbers::peak_size, &ShockNumbers::width,
                              &ShockNumbers::delta_omega_size, &ShockNumbers::peak_alpha}) {
    add(row.error.*number, std::fabs(row.value.*number - other.value.*number), std::fabs(row.value.*number));
  }
  for (const Vector vector : {&ShockNumbers::delta_v, &ShockNumbers::peak, &ShockNumbers::delta_omega}) {
    const double distance = (row.value.*vector - other.value.*vector).norm(), size = (row.value.*vector).norm();
    for (int i = 0; i < 3; ++i) add((row.error.*vector)[i], distance, size);
  }
  row.error.peak += Vector3::Constant(row.error.peak_size);
  // The time of a flat maximum is known to the root of what its height is known to; that is also how far the vector
  // there may have turned.
  const double slack = std::sqrt(row.error.peak_size / row.value.peak_size) * row.value.width;
  add(row.error.peak_time, std::fabs(row.value.peak_time - other.value.peak_time), row.duration);
  row.error.peak_time += slack;
  row.error.width += row.value.width * row.error.peak_size / row.value.peak_size;
  for (auto& [frequency, response] : row.responses)
    add(response.error, std::fabs(response.value - other.responses.at(frequency).value), response.value);
}

/// The runs of pieces that belong to one contact.
std::vector<std::span<const MotionPiece>> contacts_of(const MotionRecorder& motion) {
  std::vector<std::span<const MotionPiece>> contacts;
  const std::vector<MotionPiece>& pieces = motion.pieces();
  for (std::size_t i = 0; i < pieces.size();) {
    std::size_t end = i;
    while (end < pieces.size() && pieces[end].piece.impact == pieces[i].piece.impact &&
           pieces[end].piece.in_contact == pieces[i].piece.in_contact) {
      ++end;
    }
    if (pieces[i].piece.in_contact) contacts.emplace_back(pieces.data() + i, end - i);
    i = end;
  }
  return contacts;
}

/// The settings that a planned run ended with.
numeric::Accuracy settled(const Scene& scene, const numeric::Simulation& run) {
  numeric::Accuracy accuracy = scene.accuracy;
  accuracy.method = run.method;
  accuracy.tolerance = run.tolerance;
  accuracy.step = run.step;
  accuracy.evaluation_limit *= 2 * numeric::piece_points;  // the samples count
  return accuracy;
}

/// A recorded drop, without estimates.
numeric::Simulation record(const Scene& scene, const numeric::Body& body, int impacts,
                           const numeric::Accuracy& accuracy,
                           const std::function<void(const numeric::HistoryPiece&)>& take,
                           const numeric::Observer& observer) {
  numeric::Request alone = scene.request;
  alone.impacts = impacts;
  alone.error_estimates = alone.amplification = alone.local_slip = false;
  return numeric::simulate(body, scene.world, scene.start(body), alone, accuracy,
                           {.pieces = take, .progress = observer.progress});
}

/// Relative error of each impact's impulse; infinite from the impact on that cannot be predicted, or in which the
/// second run of the plan went another way.
std::vector<double> trust_of(const numeric::Simulation& run) {
  std::vector<double> trust;
  bool lost = false;
  for (const numeric::ImpactRecord& row : run.impacts) {
    const double error = row.error.impulse.norm() / row.value.impulse.norm();
    lost = lost || !row.predictable || !std::isfinite(error);
    trust.push_back(lost ? unknown_error : error);
  }
  return trust;
}

/// ln(peak) of each row at a stiffness e^shift times the scene's, c_G/k_G held; empty where the impacts are others.
std::vector<double> shifted_peaks(const Scene& scene, const numeric::Body& body, const std::vector<Vector3>& places,
                                  const ContinuousShock& shock, double shift, const numeric::Observer& observer) {
  Scene other = scene;
  other.world.ground.stiffen(std::exp(shift));
  const std::vector<numeric::ImpactRecord>& impacts = shock.planned.run.impacts;
  MotionRecorder motion;
  const numeric::Simulation run = record(other, body, static_cast<int>(impacts.size()),
                                         settled(scene, shock.planned.run), std::ref(motion), observer);
  std::vector<double> peaks;
  for (const ShockRow& row : shock_rows(motion, {.places = places, .mass = body.mass()})) {
    const auto i = static_cast<std::size_t>(row.impact - 1);
    if (i >= run.impacts.size() || run.impacts[i].end != impacts[i].end || run.impacts[i].touches != impacts[i].touches)
      break;
    peaks.push_back(std::log(row.value.peak_size));
  }
  return peaks;
}

/// Central differences at two steps, extrapolated; the error is what that changed, and what the peaks' errors make of
/// the smaller step.
void add_sensitivities(const Scene& scene, const numeric::Body& body, const std::vector<Vector3>& places,
                       const numeric::Observer& observer, ContinuousShock& shock) {
  constexpr double step = 0.02;
  std::vector<double> peaks[4];
  const double shifts[4] = {-2 * step, -step, step, 2 * step};
  for (int i = 0; i < 4; ++i) peaks[i] = shifted_peaks(scene, body, places, shock, shifts[i], observer);
  for (std::size_t i = 0; i < shock.rows.size(); ++i) {
    ShockRow& row = shock.rows[i];
    row.sensitivity = Estimated{0, unknown_error};
    if (std::any_of(std::begin(peaks), std::end(peaks), [&](const auto& some) { return some.size() <= i; })) continue;
    const double near = (peaks[2][i] - peaks[1][i]) / (2 * step), far = (peaks[3][i] - peaks[0][i]) / (4 * step);
    const double value = near + (near - far) / 3;
    const double noise = 2 * row.error.peak_size / row.value.peak_size / step;
    row.sensitivity = Estimated{value, std::fabs(value - near) + noise};
  }
}

}  // namespace

ShockNumbers ShockNumbers::unknown() {
  constexpr double x = unknown_error;
  const Vector3 all = Vector3::Constant(x);
  return {all, x, all, x, x, x, all, x, x};
}

double landing_end(const Scene& scene, double approach_speed) {
  return body_properties(scene, Model::continuous).extents.maxCoeff() / approach_speed;
}

std::optional<Estimated> ShockRow::response_of(const FragilePart& part) const {
  const auto oscillator = part.oscillator();
  const auto found = oscillator ? responses.find(oscillator->frequency) : responses.end();
  return found == responses.end() ? std::nullopt : std::optional(found->second);
}

BlowMargin blow_margin(const ShockRow& row, const FragilePart& part, bool has_peaks) {
  const ShockNumbers& value = row.value;
  if (!has_peaks) return {velocity_margin(part, value.delta_v_size), BlowMargin::By::velocity};
  const auto response = row.response_of(part);
  return blow_margin(part, value.delta_v_size, value.peak_size, response ? response->value : 0);
}

Estimated margin_of(const ShockRow& row, const FragilePart& part, bool has_peaks) {
  const ShockNumbers &value = row.value, &error = row.error;
  const BlowMargin margin = blow_margin(row, part, has_peaks);
  const auto response = row.response_of(part);
  // ln of a response to a pulse changes by no more than ln of f T does.
  const double of_v = error.delta_v_size / value.delta_v_size,
               of_pulse = has_peaks ? of_v + 2 * error.peak_size / value.peak_size : of_v,
               of_history = response ? response->error / response->value : 0;
  // The least of several is known no better than each: where one is close to the other, that one may be less.
  return {margin.value, margin.value * std::fmax(of_pulse, of_history)};
}

std::vector<ShockRow> shock_rows(const MotionRecorder& motion, const RecordedShock& asked) {
  std::vector<ShockRow> rows;
  for (const std::span<const MotionPiece> contact : contacts_of(motion)) {
    for (std::size_t i = 0; i < asked.places.size(); ++i) {
      rows.push_back(row_of(contact, asked.places[i], asked));
      rows.back().probe = i;
      rows.back().peak_piece += static_cast<std::size_t>(contact.data() - motion.pieces().data());
    }
  }
  return rows;
}

ContinuousShock continuous_shock(const Scene& scene, const numeric::Body& body, const std::vector<Vector3>& places,
                                 const ContinuousRequest& request) {
  const numeric::Observer& observer = request.observer;
  ContinuousShock shock;
  shock.planned = run_to_digits(scene, body, {.progress = observer.progress});
  const numeric::Simulation& run = shock.planned.run;
  const int impacts = static_cast<int>(run.impacts.size());
  if (impacts == 0) return shock;
  numeric::Accuracy accuracy = settled(scene, run), other = accuracy;
  const bool is_fixed = run.step > 0 && !(run.tolerance > 0);
  if (is_fixed) other.step /= 2;
  else other.tolerance *= 0.1 * run.tolerance >= numeric::least_tolerance ? 0.1 : 10;
  shock.error_per_distance = 4;  // as the simulator's own estimates take for a tenth of the tolerance
  const double gravity = scene.world.gravity_in_contact ? scene.world.gravity : 0;
  const RecordedShock asked{.places = places, .mass = body.mass(), .gravity = gravity, .parts = request.parts};
  const auto recorded = [&](const numeric::Accuracy& by, MotionRecorder& motion) {
    std::vector<ShockRow> rows;
    const auto take_rows = [&] { std::ranges::move(shock_rows(motion, asked), std::back_inserter(rows)); };
    const auto take = [&](const numeric::HistoryPiece& piece) {
      if (!request.keeps_motion && !piece.in_contact) {
        take_rows();
        motion = {};
      } else {
        motion(piece);
      }
    };
    record(scene, body, impacts, by, take, observer);
    take_rows();
    if (!request.keeps_motion) motion = {};
    return rows;
  };
  shock.rows = recorded(accuracy, shock.motion);
  const std::vector<ShockRow> others =
      scene.request.error_estimates ? recorded(other, shock.other) : std::vector<ShockRow>{};
  shock.trust = trust_of(run);
  for (std::size_t i = 0; i < shock.rows.size(); ++i) {
    ShockRow& row = shock.rows[i];
    const auto n = static_cast<std::size_t>(row.impact - 1);
    row.predictable = n < run.impacts.size() && run.impacts[n].predictable;
    const bool is_known = i < others.size() && n < shock.trust.size() && std::isfinite(shock.trust[n]);
    const double growth = is_known && std::isfinite(run.impacts[n].amplification) ? run.impacts[n].amplification : 1;
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * (1 + growth);
    row.start_error = is_known ? run.impacts[n].error.start : unknown_error;
    if (is_known) add_errors(others[i], shock.error_per_distance, shock.trust[n], rounding, row);
    else {
      row.error = ShockNumbers::unknown();
      for (auto& [frequency, response] : row.responses) response.error = unknown_error;
    }
  }
  if (request.sensitivity) add_sensitivities(scene, body, places, observer, shock);
  return shock;
}

namespace {

namespace space = analytic::space;

/// An impact of either kind of sequence: what it does to the body, and how well that is known.
struct Strike {
  double start = 0, start_error = 0;  ///< [s]
  Eigen::Quaterniond attitude;
  Vector3 delta_velocity, delta_omega;  ///< of the centre of mass [m/s] and the body [rad/s], world
  double velocity_error = 0, omega_error = 0;
  double attitude_error = 0;  ///< [rad]
  bool predictable = true;
};

Eigen::Quaterniond turned(double inclination) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(-inclination, Vector3::UnitY()));
}

Strike strike_of(const analytic::ImpactRow& row, const analytic::PlanarBody& body) {
  const analytic::PlanarVelocity &before = row.before, &after = row.impact.after;
  const double impulse_error = std::hypot(row.error.normal_impulse, row.error.tangential_impulse);
  const Vector3 spin(0, after.angular - before.angular, 0);
  const double gain = body.reach() / (body.mass * body.gyration_square);
  return {.start = row.start,
          .start_error = row.error.start,
          .attitude = turned(row.inclination),
          .delta_velocity = {after.tangential - before.tangential, 0, after.normal - before.normal},
          .delta_omega = spin,
          .velocity_error = impulse_error / body.mass,
          .omega_error = gain * impulse_error + 2 * spin.norm() * row.error.inclination,
          .attitude_error = row.error.inclination,
          .predictable = row.error.predictable};
}

/// Largest |I⁻¹ (r × p)| of unit impulses p at the corners that strike [1/(kg·m)]; a moment of inertia that vanishes is
/// that of a thin rod about itself, which no impulse at it turns.
double turning_gain(const space::Body& body, const std::vector<space::Corner>& corners) {
  const Eigen::SelfAdjointEigenSolver<numeric::Matrix3> principal(body.inertia);
  const Vector3 moments = principal.eigenvalues();
  Vector3 inverse = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (moments[i] > 1e-14 * moments[2]) inverse[i] = 1 / moments[i];
  }
  double gain = 0;
  for (const space::Corner& corner : corners) {
    numeric::Matrix3 arm;
    const Vector3& r = corner.place;
    arm << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    gain = std::max(gain, (inverse.asDiagonal() * principal.eigenvectors().transpose() * arm).norm());
  }
  return gain;
}

Strike strike_of(const space::ImpactRow& row, const space::Body& body) {
  const Vector3 spin = row.impact.angular_velocity_after - row.before.angular_velocity;
  return {.start = row.start,
          .start_error = row.error.start,
          .attitude = row.before.attitude,
          .delta_velocity = row.impact.velocity_after - row.before.velocity,
          .delta_omega = spin,
          .velocity_error = row.error.impulse / body.mass,
          .omega_error = turning_gain(body, row.corners) * row.error.impulse + 2 * spin.norm() * row.error.attitude,
          .attitude_error = row.error.attitude,
          .predictable = row.error.predictable};
}

std::vector<Strike> strikes_of(const DiscreteDrop& drop, const DiscreteSequence& sequence) {
  std::vector<Strike> strikes;
  if (const auto* const plane = std::get_if<analytic::Sequence>(&sequence)) {
    for (const auto& row : plane->rows) strikes.push_back(strike_of(row, std::get<analytic::Drop>(drop).body));
  } else {
    const auto& rows = std::get<space::Sequence>(sequence).rows;
    for (const auto& row : rows) strikes.push_back(strike_of(row, std::get<space::Drop>(drop).body));
  }
  return strikes;
}

ShockRow row_of(const Strike& strike, const Vector3& r) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const Vector3 arm = strike.attitude * r;
  ShockRow row;
  row.start = strike.start;
  row.predictable = strike.predictable;
  ShockNumbers &value = row.value, &error = row.error;
  value.delta_v = strike.delta_velocity + strike.delta_omega.cross(arm);
  value.delta_v_size = value.delta_v.norm();
  row.delta_v_body = strike.attitude.conjugate() * value.delta_v;
  row.start_error = strike.start_error;
  value.delta_omega = strike.delta_omega;
  value.delta_omega_size = value.delta_omega.norm();
  const double turn = value.delta_omega_size * arm.norm();
  error = {};
  error.delta_omega_size = strike.omega_error + rounding * value.delta_omega_size;
  error.delta_v_size = strike.velocity_error + arm.norm() * strike.omega_error + turn * strike.attitude_error +
                       rounding * (strike.delta_velocity.norm() + turn);
  if (!strike.predictable) error = ShockNumbers::unknown();
  error.delta_v = Vector3::Constant(error.delta_v_size);
  error.delta_omega = Vector3::Constant(error.delta_omega_size);
  return row;
}

}  // namespace

std::vector<ShockRow> discrete_shock(const DiscreteDrop& drop, const DiscreteSequence& sequence,
                                     const std::vector<Vector3>& places) {
  std::vector<ShockRow> rows;
  int impact = 0;
  for (const Strike& strike : strikes_of(drop, sequence)) {
    ++impact;
    for (std::size_t i = 0; i < places.size(); ++i) {
      rows.push_back(row_of(strike, places[i]));
      rows.back().impact = impact;
      rows.back().probe = i;
    }
  }
  return rows;
}

}  // namespace clatter::validation
