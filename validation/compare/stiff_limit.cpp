// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/stiff_limit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "validation/output/number.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

using numeric::ImpactRecord;
using numeric::Simulation;
using numeric::Vector3;

/// Sizes beside which a contact must be short, and how its ground is damped.
struct ContactSizes {
  const numeric::Body& body;
  double feature = 0;  ///< length below which the contact of a planar run sees the shape that it has in the limit [m]
  double gravity = 0;  ///< [m/s²]
  bool planar = true;
  double damping_per_stiffness = 0;  ///< c_G/k_G, the same for all runs [s/m]
};

/// The first impacts of a ladder of runs, and why there are no more.
struct CommonRows {
  std::size_t count = 0;
  std::string ended;  ///< one clause; empty: all that were asked for are there
};

constexpr double small = 0.02;  // what turning, gravity and indentation may be at the first stiffness

double feature_of(const Scene& scene, const numeric::Body& body) {
  const BodyScene& shape = scene.body;
  if (shape.is_polyhedron()) return body.radius() / 100;
  const bool is_rod = shape.traits().has_sectors && !shape.is_round();
  const double half = is_rod ? shape.meshed_radius() : shape.extents(shape.radius).minCoeff() / 2;
  if (!shape.traits().has_sectors) return 2 * half;
  if (shape.is_smooth()) return half;
  if (is_rod) return half * (1 - std::cos(2 * std::numbers::pi / shape.meshed_sectors()));
  return half * (1 - std::cos(std::numbers::pi / std::max(shape.meshed_sectors(), 4 * shape.meshed_rings())));
}

/// Height at touch-down of the lowest vertex that does not touch; of a smooth shape that of its other end, or its least
/// half axis.
double next_height(const ImpactRecord& row, const numeric::Body& body) {
  const Vector3 up = row.attitude.conjugate() * Vector3::UnitZ();
  const double ground = up.dot(row.place), touching = 1e-9 * body.radius();
  double next = std::numeric_limits<double>::infinity();
  if (const auto& smooth = body.smooth()) {
    next = smooth->semiaxes.minCoeff();
    for (int end = 0; end < smooth->ends(); ++end) {
      const double height = up.dot(smooth->lowest(end, up)) - ground;
      if (height > touching) next = std::min(next, height);
    }
    return next;
  }
  for (const Vector3& vertex : body.facets().vertices) {
    const double height = up.dot(vertex) - ground;
    if (height > touching) next = std::min(next, height);
  }
  return next;
}

/// In the plane turning counts against the angle to the ground, and indentation against the body's smallest feature.
bool sees_its_shape_in_plane(const ImpactRecord& row, double feature) {
  const numeric::ImpactNumbers& n = row.value;
  const double turning = n.duration * n.angular_velocity_after.norm();
  const double angle = std::min(n.contact_angle, std::numbers::pi / 2 - n.contact_angle);
  const bool along_an_axis = row.end == numeric::ContactEnd::both || angle < 1e-12;  // flat or upright
  if (!along_an_axis && !(turning <= small * angle)) return false;
  return n.duration * n.approach_speed <= small * feature;
}

bool sees_its_shape(const ImpactRecord& row, const ContactSizes& sizes) {
  if (sizes.planar) return sees_its_shape_in_plane(row, sizes.feature);
  const numeric::ImpactNumbers& n = row.value;
  const double moved = n.duration * (n.approach_speed + n.angular_velocity_after.norm() * sizes.body.radius());
  return moved <= small * next_height(row, sizes.body);
}

/// Why contact `i` of the run is not as short as the extrapolation wants it; empty: short enough.
std::string what_is_long(const Simulation& run, std::size_t i, const ContactSizes& sizes) {
  const numeric::ImpactNumbers& n = run.impacts[i].value;
  const double time = n.duration;
  if (!sees_its_shape(run.impacts[i], sizes)) return "the next corner comes down before the contact has ended";
  const double separation = std::isfinite(n.restitution) ? n.restitution * n.approach_speed : n.approach_speed;
  if (!(sizes.gravity * time <= small * std::min(n.approach_speed, separation)))
    return "the approach is so slow that gravity acts during the contact";
  if (i == 0) return "";
  const numeric::ImpactNumbers& before = run.impacts[i - 1].value;
  const double gap = n.start - before.start - before.duration;
  if (std::max(time, before.duration) <= small * gap) return "";
  return fmt::format("its contact is as long as the flight before it, {} s", significant(gap, 2));
}

/// How many of the first impacts are single contacts of their own and short.
CommonRows clean_rows(const Simulation& run, const ContactSizes& sizes) {
  CommonRows rows;
  for (; rows.count < run.impacts.size(); ++rows.count) {
    const ImpactRecord& row = run.impacts[rows.count];
    const bool merged = row.touches > 1 && !(sizes.planar && row.end == numeric::ContactEnd::both);
    rows.ended = merged ? fmt::format("{} contacts merge into one", row.touches) : what_is_long(run, rows.count, sizes);
    if (!rows.ended.empty()) return rows;
  }
  if (run.outcome != numeric::Outcome::impact_limit) rows.ended = "the runs have ended: " + run.message;
  return rows;
}

/// What tells two runs' impacts apart; empty: nothing.
std::string difference(const ImpactRecord& one, const ImpactRecord& other, const ContactSizes& sizes) {
  if (one.end != other.end) return "another end of the body strikes from run to run";
  if (!sizes.planar && !is_same_place(sizes.body, one.place, other.place))
    return "another corner strikes from run to run";
  if (one.mode != other.mode) {
    return fmt::format("the course of friction still changes from run to run, {} and {}", mode_name(one.mode),
                       mode_name(other.mode));
  }
  return one.touches != other.touches ? "contacts merge in some of the runs" : "";
}

/// Rows that all runs have, with the same places and the same course of friction, and whose contacts are single and
/// short in the softest of them.
CommonRows common_rows(const std::vector<Simulation>& ladder, const ContactSizes& sizes) {
  CommonRows rows = clean_rows(ladder.front(), sizes);
  for (const Simulation& run : ladder) {
    if (run.impacts.size() < rows.count)
      rows = {run.impacts.size(), "a stiffer ground gives fewer impacts: " + run.message};
    for (std::size_t i = 0; i < rows.count; ++i) {
      const std::string apart = difference(ladder.front().impacts[i], run.impacts[i], sizes);
      if (!apart.empty()) rows = {i, apart};
    }
  }
  return rows;
}

constexpr double stiffening = 16;   // halves the contact time of a corner, F ∝ δ³, the slowest to converge
constexpr int runs_of_a_limit = 5;  // three triples of runs
constexpr int most_runs = 24;
constexpr double least_indentation = 1e-8;  // of the body: the depth that doubles still resolve to 12 digits
constexpr double run_error = 3e-12;         // of a planar run of 12 digits, relative, per impact
constexpr double space_run_error = 3e-11;   // in space, at most: slip that turns costs digits
constexpr double safety = 2;
constexpr double strong_damping = 1, doubt_of_damping = 4;  // of c_G v/k_G; in space, where numbers go like T ln T
constexpr double no_limit = 1e-3;                 // a relative error bar above it: the runs are not near any limit yet
constexpr double settled_change = 1e-6;           // from one triple of runs to the next; what is left is far below it
constexpr long evaluations_in_plane = 200'000;    // contacts that are short take some thousand each
constexpr long evaluations_in_space = 2'000'000;  // slip that is let go, or turns, close to zero takes very short steps

/// Powers of T in which the numbers approach their limit; the third is that of the error left.
struct Powers {
  double first = 1, second = 2, third = 3;
};

/// A contact that sticks lets go before it ends, where its force has fallen to what turning and the wandering of the
/// pressure centre ask of friction: for F ∝ δ^p the last T^(1/p) of it, which takes T^(1 + 1/p) of the impulse.
Powers powers_of(const std::vector<Simulation>& ladder, std::size_t row, double exponent) {
  using Mode = numeric::FrictionMode;
  const auto& impacts = ladder.back().impacts;
  const bool sticks = std::any_of(
      impacts.begin(), impacts.begin() + static_cast<std::ptrdiff_t>(row) + 1,
      [](const ImpactRecord& record) { return record.mode != Mode::frictionless && record.mode != Mode::slip; });
  if (!sticks || !(exponent > 1)) return {};
  return {1, 1 + 1 / exponent, 1 + 2 / exponent};
}

/// Weights of three values at the points x that give the limit at x = 0 of a + b x^first + c x^second.
Eigen::Vector3d limit_weights(const Eigen::Vector3d& x, const Powers& powers) {
  const Eigen::Array3d scaled = x.array() / x[0];
  const Eigen::Vector3d weights = scaled.pow(powers.first).matrix().cross(scaled.pow(powers.second).matrix());
  return weights / weights.sum();
}

/// By what a relative error of the state has grown at a row: with the lever by which each contact arises.
double growth(const Simulation& run, std::size_t row) {
  double grown = 1;
  for (std::size_t i = 1; i <= row; ++i)
    grown *= 2 + 1 / std::max(std::min(run.impacts[i].value.contact_angle, 1.0), 1e-3);
  return grown;
}

/// What errors of the runs make of a limit with these weights: in the plane by how errors grow there; in space as the
/// stiffest run estimates them by a rougher one, at most what runs of these digits were seen to have, grown as the
/// discrete model says.
MotionNumbers error_of_runs(const Simulation& stiffest, std::size_t row, double weight, const LimitRequest& request,
                            const MotionNumbers& size) {
  const MotionNumbers estimates = motion_numbers(impact_of(stiffest.impacts[row]).error);
  const double most = request.planar ? weight * run_error * growth(stiffest, row)
                                     : weight * space_run_error * std::max(request.amplification[row], 1.0);
  MotionNumbers errors{};
  for (std::size_t q = 0; q < motion_number_count; ++q) {
    const bool is_told = request.whole_patch && std::isfinite(estimates[q]);  // where slide and spin end together
    const bool estimated = !request.planar && (is_told || weight * estimates[q] <= most * size[q]);
    errors[q] = estimated ? weight * estimates[q] : most * size[q];
  }
  return errors;
}

/// Error bar of the last of three extrapolations by the two changes between them.  They should fall by the factor
/// `expected`; where they do not, the numbers approach their limit more slowly than the powers say (on a strongly
/// damped ground the clamp acts on parts of the patch), and the factor seen counts.
double error_bar(double before, double last, double expected) {
  constexpr double slowest = 1.3;
  const double larger = std::max(std::fabs(last), std::fabs(before) / expected);  // `last` may be small by chance
  const double seen = larger > 0 ? std::fabs(before) / larger : expected;
  return safety * larger / (std::clamp(seen, slowest, expected) - 1);
}

/// What an extrapolation needs beside the runs.
struct Extrapolation {
  const numeric::Body& body;
  const LimitRequest& request;
  double exponent = 1;        ///< p of the force ∝ δ^p
  double doubt = 1;           ///< factor of the bars
  double largest_change = 0;  ///< relative, from triple to triple, over all numbers so far
};

LimitRow extrapolate(const std::vector<Simulation>& ladder, std::size_t row, Extrapolation& at) {
  Eigen::Matrix<double, runs_of_a_limit, 1> x;
  Eigen::Matrix<double, static_cast<int>(motion_number_count), runs_of_a_limit> y;
  for (int j = 0; j < runs_of_a_limit; ++j) {
    const Simulation& run = ladder[static_cast<std::size_t>(j)];
    x[j] = run.impacts[0].value.duration;
    const MotionNumbers numbers = motion_numbers(impact_of(run.impacts[row]).value);
    for (std::size_t q = 0; q < motion_number_count; ++q) y(static_cast<int>(q), j) = numbers[q];
  }
  const Powers powers = powers_of(ladder, row, at.exponent);
  const Eigen::Vector3d weights[] = {limit_weights(x.segment<3>(0), powers), limit_weights(x.segment<3>(1), powers),
                                     limit_weights(x.segment<3>(2), powers)};
  const double expected = std::pow(x[3] / x[4], powers.third);
  const MotionNumbers size = motion_sizes(ladder.back(), row + 1, at.body);
  const double weight = weights[2].cwiseAbs().sum();
  const MotionNumbers runs = error_of_runs(ladder.back(), row, weight, at.request, size);
  const ImpactRecord& stiffest = ladder.back().impacts[row];
  LimitRow limit{.end = stiffest.end, .place = stiffest.place, .mode = stiffest.mode};
  for (std::size_t q = 0; q < motion_number_count; ++q) {
    const Eigen::Matrix<double, 1, runs_of_a_limit> values = y.row(static_cast<int>(q));
    double triples[3];
    for (int t = 0; t < 3; ++t) triples[t] = values.segment<3>(t).dot(weights[t]);
    const double last = triples[2] - triples[1];
    limit.value[q] = triples[2];
    limit.error[q] = at.doubt * error_bar(triples[1] - triples[0], last, expected) + runs[q];
    at.largest_change = std::max(at.largest_change, std::fabs(last) / size[q]);
    limit.relative_error = std::max(limit.relative_error, limit.error[q] / size[q]);
  }
  return limit;
}

/// Takes the rows of the ladder into the limit.  @returns whether all impacts are there and settled.
bool take_limit(const std::vector<Simulation>& ladder, const ContactSizes& sizes, const LimitRequest& request,
                StiffLimit& limit) {
  const double ratio =
      ladder[runs_of_a_limit - 2].impacts[0].value.duration / ladder[runs_of_a_limit - 1].impacts[0].value.duration;
  limit.power = std::log(ratio) / std::log(stiffening);
  const CommonRows rows = common_rows(ladder, sizes);
  const double damping = sizes.damping_per_stiffness * ladder.back().impacts[0].value.approach_speed;
  Extrapolation at{.body = sizes.body,
                   .request = request,
                   .exponent = 1 / limit.power - 1,
                   .doubt = !request.planar && damping > strong_damping ? doubt_of_damping : 1};
  limit.rows.clear();
  limit.ended = rows.ended;
  for (std::size_t i = 0; i < rows.count; ++i) {
    const LimitRow row = extrapolate(ladder, i, at);
    if (!(row.relative_error <= no_limit)) {  // another sequence of contacts may follow from here
      limit.ended = fmt::format("its numbers have not come near a limit: error bar {} of their sizes",
                                significant(row.relative_error, 2));
      break;
    }
    limit.rows.push_back(row);
  }
  return rows.count == ladder.front().impacts.size() && at.largest_change <= settled_change;
}

}  // namespace

bool is_same_place(const numeric::Body& body, const Vector3& one, const Vector3& other) {
  const double near = 1e-6 * body.radius();
  const auto& smooth = body.smooth();
  if (!smooth) return (one - other).norm() <= near;
  if (smooth->ends() == 1) return true;
  const auto half = [&](const Vector3& place) {
    const double off = place.x() - smooth->centre.x();
    return off < -near ? -1 : off > near ? 1 : 0;
  };
  return half(one) == half(other);
}

StiffLimit stiff_limit(const Scene& scene, const numeric::Body& body, const LimitRequest& request) {
  numeric::World world = scene.world;
  world.planar = request.planar;
  world.point_friction = !request.planar && !request.whole_patch;
  numeric::Accuracy accuracy = scene.accuracy;
  accuracy.method = numeric::Method::automatic;
  accuracy.step = 0;
  accuracy.digits = 12;
  accuracy.evaluation_limit =
      request.planar ? std::min(accuracy.evaluation_limit, evaluations_in_plane) : evaluations_in_space;
  const numeric::MotionState start = scene.start(body);
  numeric::Request wanted{.impacts = request.impacts, .error_estimates = false, .amplification = false};
  const ContactSizes sizes{.body = body,
                           .feature = feature_of(scene, body),
                           .gravity = scene.world.gravity,
                           .planar = request.planar,
                           .damping_per_stiffness = scene.world.ground.damping_per_stiffness()};
  StiffLimit limit{
      .rows = {}, .by_modulus = scene.world.ground.modulus > 0, .ended = "the runs end before a limit shows"};
  const auto run_at = [&](double stiffness) {  // the same damping over stiffness
    ++limit.runs;
    (limit.by_modulus ? world.ground.modulus : world.ground.stiffness) = stiffness;
    if (!world.ground.has_dissipation()) world.ground.damping = sizes.damping_per_stiffness * stiffness;
    return numeric::simulate(body, world, start, wanted, accuracy);
  };
  double stiffness = limit.by_modulus ? scene.world.ground.modulus : scene.world.ground.stiffness;
  std::vector<Simulation> ladder;
  // The runs' contacts must all be short enough, and the limit must have settled: climb until they are and it has.
  while (limit.runs < most_runs) {
    ladder.push_back(run_at(stiffness));
    limit.stiffness = stiffness;
    stiffness *= stiffening;
    if (ladder.back().impacts.empty()) {
      limit.ended = "no contact ends: " + ladder.back().message;
      if (request.planar) return limit;
      ladder.clear();  // a soft ground may hold a body that a stiffer one throws back
      continue;
    }
    if (ladder.size() > runs_of_a_limit) ladder.erase(ladder.begin());
    if (ladder.size() < runs_of_a_limit) continue;
    const bool settled = take_limit(ladder, sizes, request, limit);
    const numeric::ImpactNumbers& first = ladder.back().impacts.front().value;
    if (settled || first.duration * first.approach_speed < least_indentation * body.radius()) break;
  }
  if (request.planar || ladder.size() < runs_of_a_limit) return limit;
  // Slip that turns costs the runs digits: how many, the stiffest estimates.
  wanted.error_estimates = true;
  ladder.back() = run_at(limit.stiffness);
  static_cast<void>(take_limit(ladder, sizes, request, limit));
  return limit;
}

}  // namespace clatter::validation
