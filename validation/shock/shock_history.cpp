// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "numeric/motion/free_flight.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/shock/shock_rows.hpp"

namespace clatter::validation {
namespace {

/// One instant.  World frame unless it says otherwise.
struct HistoryInstant {
  double time = 0;   ///< after the first touch-down [s]
  int impact = 0;    ///< of a flight, that of the impact before it
  int peak_of = -1;  ///< a mark: the probe whose peak this is; -1: none
  bool in_contact = false;
  Vector3 force = Vector3::Zero();                 ///< of contact [N]
  Vector3 torque = Vector3::Zero();                ///< of that about the centre of mass [N·m]
  Vector3 angular_acceleration = Vector3::Zero();  ///< [rad/s²]
  /// Where the line of action of the force meets the ground [m]; NaN without a normal force.
  double action_x = 0, action_y = 0;
  double indentation = 0;  ///< of the deepest point, < 0 above the ground [m]
  /// Largest, (k_G + c_G δ̇) δ, of the body's points below the ground; NaN on a half-space, where edges have no bound
  /// [Pa]
  double pressure = 0;
  std::vector<Vector3> specific_forces;  ///< of each probe, body axes [m/s²]
};

double largest_pressure(const numeric::Body& body, const numeric::MotionState& state, const numeric::Ground& ground);

constexpr double most_instants = 1e7;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A piece as polynomials of all that its samples have.
struct PiecePolynomials {
  VectorPolynomial centre, velocity, spin, force, acceleration, axis;
  ChebyshevPolynomial scalar;

  explicit PiecePolynomials(const MotionPiece& piece)
      : centre(polynomial_of(piece, [](const auto& s) { return s.state.centre; })),
        velocity(polynomial_of(piece, [](const auto& s) { return s.state.velocity; })),
        spin(polynomial_of(piece, [](const auto& s) { return s.state.angular_velocity; })),
        force(polynomial_of(piece, [](const auto& s) { return s.force; })),
        acceleration(polynomial_of(piece, [](const auto& s) { return s.angular_acceleration; })),
        axis(polynomial_of(piece, [&](const auto& s) { return Vector3(sign(piece, s) * s.state.attitude.vec()); })) {
    Samples samples{};
    for (std::size_t j = 0; j < sample_count; ++j)
      samples[j] = sign(piece, piece.samples[j]) * piece.samples[j].state.attitude.w();
    scalar = ChebyshevPolynomial(samples);
  }

  /// The one of the two quaternions of an attitude that lies on the first sample's side.
  static double sign(const MotionPiece& piece, const numeric::PieceSample& sample) {
    return piece.samples.front().state.attitude.dot(sample.state.attitude) < 0 ? -1 : 1;
  }

  [[nodiscard]] numeric::PieceSample at(double x) const {
    const Vector3 v = value_at(axis, x);
    numeric::PieceSample sample;
    sample.state = {value_at(centre, x), Eigen::Quaterniond(scalar.at(x), v.x(), v.y(), v.z()).normalized(),
                    value_at(velocity, x), value_at(spin, x)};
    sample.force = value_at(force, x);
    sample.angular_acceleration = value_at(acceleration, x);
    return sample;
  }
};

/// Largest value, between `low` and `high`, of a function that rises and then falls.
double largest_of(auto&& function, double low = 0, double high = 1) {
  for (int i = 0; i < 80; ++i) {
    const double one = (2 * low + high) / 3, other = (low + 2 * high) / 3;
    (function(one) < function(other) ? low : high) = function(one) < function(other) ? one : other;
  }
  return function((low + high) / 2);
}

constexpr int pad_parts = 16;  ///< of the arc, each with one hump of a pad's pressure

/// c_G of springs, or of a pad at its surface.
double damping_of(const numeric::Ground& ground) {
  return ground.is_pad() ? ground.dissipation * ground.stiffness : ground.damping;
}

double pressure_at(const numeric::Ground& ground, double depth, double rate) {
  return (ground.stiffness + damping_of(ground) * rate) * ground.pressed_depth(depth);
}

/// Along the arc from the lowest point of each section to where the ground presses fastest: depth and k + c δ̇ are
/// concave there.
double largest_pressure_on(const numeric::SmoothShape& shape, const numeric::MotionState& state,
                           const numeric::Ground& ground) {
  const Vector3 up = state.attitude.conjugate() * Vector3::UnitZ();
  const Vector3 stretched = shape.semiaxes.cwiseProduct(up), lowest = -stretched.normalized();
  const Vector3 faster = -shape.semiaxes.cwiseProduct(up.cross(state.angular_velocity));  // slope of δ̇ on the ball
  const Vector3 level = faster - faster.dot(lowest) * lowest;
  const Vector3 towards = level.norm() > 0 ? Vector3(level.normalized()) : lowest.unitOrthogonal();
  const auto at = [&](double along, double part) {
    const double angle = part * std::numbers::pi / 2;
    const Vector3 place = shape.end_centre(0) + Vector3(along * shape.straight, 0, 0) +
                          shape.semiaxes.cwiseProduct(lowest * std::cos(angle) + towards * std::sin(angle));
    const double depth = -(state.centre.z() + up.dot(place)), rate = -numeric::point_velocity(state, place).z();
    return depth > 0 ? std::max(pressure_at(ground, depth, rate), 0.0) : std::min(depth, 0.0);
  };
  const auto over_section = [&](double along) {
    const auto here = [&](double part) { return at(along, part); };
    double largest = -std::numeric_limits<double>::infinity();
    const int humps = ground.is_pad() ? pad_parts : 1;
    for (int i = 0; i < humps; ++i) {
      const double low = static_cast<double>(i) / humps, high = static_cast<double>(i + 1) / humps;
      largest = std::max(largest, largest_of(here, low, high));
    }
    return largest;
  };
  return std::max(shape.straight > 0 ? largest_of(over_section) : over_section(0), 0.0);
}

HistoryInstant instant_of(const numeric::PieceSample& sample, const MotionPiece& piece, const numeric::Body& body,
                          const numeric::Ground& ground, const std::vector<Vector3>& places) {
  HistoryInstant at;
  at.impact = piece.piece.impact;
  at.in_contact = piece.piece.in_contact;
  const numeric::MotionState& state = sample.state;
  at.angular_acceleration = state.attitude * sample.angular_acceleration;
  at.indentation = -numeric::lowest_height(body, state);
  for (const Vector3& r : places) at.specific_forces.push_back(specific_force(sample, r, body.mass()));
  at.action_x = at.action_y = nan;
  if (!at.in_contact) return at;
  const Vector3& omega = state.angular_velocity;
  at.force = sample.force;
  at.torque = state.attitude * (body.inertia() * sample.angular_acceleration + omega.cross(body.inertia() * omega));
  at.pressure = ground.modulus > 0 ? nan : largest_pressure(body, state, ground);
  if (!(at.force.z() > 0)) return at;
  // τ = r × F with r_z = −z_c.
  at.action_x = state.centre.x() + (-state.centre.z() * at.force.x() - at.torque.y()) / at.force.z();
  at.action_y = state.centre.y() + (-state.centre.z() * at.force.y() + at.torque.x()) / at.force.z();
  return at;
}

/// A time at which an instant is wanted.
struct Wanted {
  double time;
  const ShockRow* peak_of;  ///< the row whose peak it is, if it is one
};

std::vector<Wanted> wanted_times(const ContinuousShock& shock, double end, double rate) {
  if (!(end * rate < most_instants))
    throw std::domain_error(fmt::format("rate = {} Hz: must give at most {} rows over {} s", rate, most_instants, end));
  std::vector<Wanted> all;
  for (long i = 0; static_cast<double>(i) <= end * rate; ++i) all.push_back({static_cast<double>(i) / rate, nullptr});
  for (const ShockRow& row : shock.rows) all.push_back({row.start + row.value.peak_time, &row});
  std::stable_sort(all.begin(), all.end(), [](const Wanted& a, const Wanted& b) { return a.time < b.time; });
  return all;
}

/// Largest (k_G + c_G δ̇) δ, or of a pad p (1 + τ δ̇), >= 0 over the body's points below the ground, each face with its
/// full area: it lies on an edge, where it is a quadratic's, piece by piece.
double largest_pressure(const numeric::Body& body, const numeric::MotionState& state, const numeric::Ground& ground) {
  if (body.smooth()) return largest_pressure_on(*body.smooth(), state, ground);
  const numeric::Facets& facets = body.facets();
  const auto depth_and_rate = [&](int vertex) {
    const Vector3& u = facets.vertices[static_cast<std::size_t>(vertex)];
    return std::pair{-(state.centre + state.attitude * u).z(),
                     -(state.velocity + state.attitude * state.angular_velocity.cross(u)).z()};
  };
  const double damping = damping_of(ground);
  double largest = 0;
  for (const numeric::Loop& loop : facets.loops) {
    for (int c = loop.begin; c < loop.end; ++c) {
      const int next = c + 1 < loop.end ? c + 1 : loop.begin;
      const auto [d0, r0] = depth_and_rate(facets.corners[static_cast<std::size_t>(c)]);
      const auto [d1, r1] = depth_and_rate(facets.corners[static_cast<std::size_t>(next)]);
      const double depth = d0, deeper = d1 - d0, rate = r0, faster = r1 - r0;
      const auto pressure = [&](double x) {
        const double d = depth + x * deeper;
        return d > 0 ? pressure_at(ground, d, rate + x * faster) : 0;
      };
      largest = std::max({largest, pressure(0), pressure(1)});
      // (k + c r)' p + (k + c r) p' = 0 in each piece p = base + slope d of the ground's pressed depth.
      double base = 0, slope = 1;
      const auto look = [&] {
        const double curvature = 2 * damping * faster * slope * deeper;
        const double x =
            -((ground.stiffness + damping * rate) * slope * deeper + damping * faster * (base + slope * depth)) /
            curvature;
        if (x > 0 && x < 1) largest = std::max(largest, pressure(x));
      };
      look();
      for (const numeric::Kink& kink : ground.kinks) {
        base -= kink.change * kink.depth;
        slope += kink.change;
        look();
      }
    }
  }
  return largest;
}

/// From 0 to the end of the last piece by steps of 1/rate, and in between an instant for the peak of each row, on the
/// side of a jump on which it is one.  Pieces are polynomials of degree 8 through the method's own steps.  Most
/// instants: 10⁷.
/// @param rate  [Hz]
/// @throws std::domain_error if there were more.
std::vector<HistoryInstant> uniform_history(const ContinuousShock& shock, const numeric::Body& body,
                                            const numeric::Ground& ground, const std::vector<Vector3>& places,
                                            double rate) {
  std::vector<HistoryInstant> history;
  const std::vector<MotionPiece>& pieces = shock.motion.pieces();
  if (pieces.empty()) return history;
  const auto end_of = [](const MotionPiece& piece) { return piece.begin() + piece.piece.length; };
  std::size_t piece = 0;
  std::optional<PiecePolynomials> polynomials;
  for (const Wanted& wanted : wanted_times(shock, end_of(pieces.back()), rate)) {
    while (piece + 1 < pieces.size() && wanted.time >= pieces[piece + 1].begin()) {
      ++piece;
      polynomials.reset();
    }
    if (wanted.peak_of) {
      const MotionPiece& around = pieces[wanted.peak_of->peak_piece];
      history.push_back(
          instant_of(PiecePolynomials(around).at(wanted.peak_of->peak_place), around, body, ground, places));
      history.back().peak_of = static_cast<int>(wanted.peak_of->probe);
    } else {
      if (!polynomials) polynomials.emplace(pieces[piece]);
      const double x = (wanted.time - pieces[piece].begin()) / pieces[piece].piece.length;
      history.push_back(instant_of(polynomials->at(std::clamp(x, 0.0, 1.0)), pieces[piece], body, ground, places));
    }
    history.back().time = wanted.time;
  }
  return history;
}

constexpr const char* axes[] = {"x", "y", "z"};

void add_vector(Row& row, const Vector3& vector) {
  for (int i = 0; i < 3; ++i) row.emplace_back(vector[i], 6);
}

void add_known(Row& row, double number) { row.push_back(std::isfinite(number) ? Cell(number, 6) : Cell()); }

}  // namespace

std::vector<Column> shock_history_columns(const std::vector<std::string>& probes) {
  std::vector<Column> columns{{"time", "t", "s", "after the first touch-down"},
                              {"impact", "n", "", "number of the impact; in flight that of the one before"},
                              word_column("mark", "mark", "peak of PROBE: an instant beside those of the rate")};
  const auto add = [&](const std::string& name, const std::string& symbol, const char* unit, const char* meaning,
                       bool shown) {
    for (const char* axis : axes)
      columns.push_back({fmt::format("{}_{}", name, axis), fmt::format("{}_{}", symbol, axis), unit, meaning, shown});
  };
  add("force", "F", "N", "contact force, world", false);
  columns.back().shown = true;
  columns.push_back({"action_x", "", "m", "where the force's line of action meets the ground, world", false});
  columns.push_back({"action_y", "", "m", "where the force's line of action meets the ground, world", false});
  add("torque", "", "N·m", "of the contact force about the centre of mass, world", false);
  add("angular_acceleration", "", "rad/s²", "of the body, world", false);
  columns.push_back({"indentation", "δ", "m", "of the deepest point; negative above the ground"});
  columns.push_back({"pressure", "p", "Pa", "largest, (k_G + c_G δ̇) δ; empty on a half-space"});
  for (const std::string& probe : probes) {
    add(probe, "a", "m/s²", "specific force at the probe, body axes", false);
    columns.push_back({probe, probe, "m/s²", "its size"});
  }
  return columns;
}

Grid shock_history_grid(const ShockRun& run, double rate) {
  const numeric::Body body = run.scene.make_body();
  const Vector3 centre = body_properties(run.scene, Model::continuous).centre;
  std::vector<Vector3> places;
  std::vector<std::string> names;
  for (const Probe& probe : run.probes) {
    places.push_back(probe.place - centre);
    names.push_back(probe.name);
  }
  Grid grid{shock_history_columns(names), {}, 2};
  for (const HistoryInstant& at : uniform_history(*run.continuous, body, run.scene.world.ground, places, rate)) {
    Row row{Cell(at.time, 9), Cell(at.impact)};
    row.emplace_back(at.peak_of < 0 ? "" : "peak of " + names[static_cast<std::size_t>(at.peak_of)]);
    add_vector(row, at.force);
    add_known(row, at.action_x);
    add_known(row, at.action_y);
    add_vector(row, at.torque);
    add_vector(row, at.angular_acceleration);
    row.emplace_back(at.indentation, 6);
    row.emplace_back(at.pressure, 6);
    for (const Vector3& force : at.specific_forces) {
      add_vector(row, force);
      row.emplace_back(force.norm(), 6);
    }
    grid.rows.push_back(std::move(row));
  }
  return grid;
}

std::vector<std::vector<double>> felt_history(const ShockRun& run,
                                              const std::function<bool(const numeric::HistoryPiece&)>& wanted) {
  const BodyProperties body = body_properties(run.scene, Model::continuous);
  std::vector<std::vector<double>> rows;
  for (const MotionPiece& piece : run.continuous->motion.pieces()) {
    if (!wanted(piece.piece)) continue;
    for (std::size_t j = 0; j < piece.samples.size(); ++j) {
      std::vector<double>& row =
          rows.emplace_back(1, piece.begin() + numeric::piece_point(static_cast<int>(j)) * piece.piece.length);
      for (const Probe& probe : run.probes)
        row.push_back(specific_force(piece.samples[j], probe.place - body.centre, body.mass).norm() / standard_gravity);
    }
  }
  return rows;
}

}  // namespace clatter::validation
