// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/discrete_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "analytic/law/impact_law.hpp"
#include "validation/compare/stiff_limit.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using analytic::Drop;
using analytic::ImpactRow;
using analytic::Sequence;
using analytic::Vertex;
using space::Vector3;

void mirror(Drop& drop, double& inclination) {
  inclination = -inclination;
  drop.velocity.tangential = -drop.velocity.tangential;
  drop.velocity.angular = -drop.velocity.angular;
  for (Vertex& vertex : drop.body.vertices) vertex.x = -vertex.x;
}

void turn_over(Drop& drop, double& inclination) {
  inclination -= std::copysign(analytic::pi, inclination);
  for (Vertex& vertex : drop.body.vertices) vertex = {-vertex.x, -vertex.z};
}

auto run(const auto& drop, std::size_t impacts) {
  return impact_sequence(drop, {.impacts = static_cast<int>(impacts), .amplification = false});
}

bool same_contact(const ImpactRow& one, const ImpactRow& other) { return one.vertices == other.vertices; }

bool same_contact(const space::ImpactRow& one, const space::ImpactRow& other) {
  return std::ranges::equal(one.corners, other.corners, {}, &space::Corner::index, &space::Corner::index);
}

/// |difference| of each number of each row from `first` on, added to `sizes`.
template <class AnySequence>
void add_difference(const AnySequence& base, const AnySequence& other, std::size_t first,
                    std::vector<PredictedSize>& sizes, MotionNumbers PredictedSize::*effect) {
  bool same = true;
  for (std::size_t i = 0; first + i < sizes.size(); ++i) {
    same = same && i < base.rows.size() && i < other.rows.size() && same_contact(base.rows[i], other.rows[i]);
    MotionNumbers apart;
    apart.fill(unknown_error);
    if (same) {
      const MotionNumbers a = motion_numbers(impact_of(base.rows[i]).value),
                          b = motion_numbers(impact_of(other.rows[i]).value);
      for (std::size_t q = 0; q < motion_number_count; ++q) apart[q] = std::fabs(b[q] - a[q]);
    }
    for (std::size_t q = i == 0 ? 2 : 0; q < motion_number_count; ++q) {  // time and angle of a contact are before it
      (sizes[first + i].*effect)[q] += apart[q];
    }
  }
}

Drop faster(Drop drop, double by) {
  drop.velocity.normal -= by;
  return drop;
}

space::Drop faster(space::Drop drop, double by) {
  drop.velocity.z() -= by;
  return drop;
}

/// The drop turned by what it turns until the middle of a contact; nothing where it stays as it lies.
std::optional<Drop> turned(Drop drop, const ImpactRow& row, double time) {
  if (row.contact_angle == 0 || std::fabs(std::cos(row.contact_angle)) < 1e-15) return std::nullopt;
  const double by = std::max(std::fabs(row.before.angular), std::fabs(row.impact.after.angular)) * time / 2;
  const double angle = drop.inclination.radians;
  const double to = angle + by <= analytic::pi / 2 ? angle + by : angle - by;
  drop.inclination = analytic::Angle::from_radians(std::clamp(to, 0.0, analytic::pi / 2));
  return drop;
}

std::optional<space::Drop> turned(space::Drop drop, const space::ImpactRow& row, double time) {
  if (row.corners.size() != 1) return std::nullopt;  // several corners stay together while they are in contact
  const Vector3 &before = row.before.angular_velocity, &after = row.impact.angular_velocity_after;
  const Vector3 by = (before.norm() > after.norm() ? before : after) * (time / 2);
  if (by.norm() > 0) drop.attitude = Eigen::AngleAxisd(by.norm(), by.normalized()) * drop.attitude;
  return drop;
}

/// The drop with its contact as far inside the body as a contact of this duration brings it.
std::vector<Drop> shrunk(Drop drop, const ImpactRow& row, double time) {
  const double depth = row.impact.approach_speed * time / analytic::pi;
  const double factor = 1 - std::min(depth / drop.body.reach(), 0.5);
  for (Vertex& vertex : drop.body.vertices) vertex = {factor * vertex.x, factor * vertex.z};
  return {drop};
}

/// The same along each of the body's axes.
std::vector<space::Drop> shrunk(const space::Drop& drop, const space::ImpactRow& row, double time) {
  const double depth =
      row.impact.approach_speed * time / (2 * std::numbers::pi);  // of the pressure centre, in the mean
  std::vector<space::Drop> all(3, drop);
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = std::fabs(row.corners.front().place[axis]);
    const double factor = 1 - (reach > 0 ? std::min(depth / reach, 0.5) : 0);
    for (Vector3& vertex : all[static_cast<std::size_t>(axis)].body.vertices) vertex[axis] *= factor;
  }
  return all;
}

void add_effects(const auto& drop, const auto& row, double time, std::size_t index, std::vector<PredictedSize>& sizes) {
  const auto here = drop_at(drop, row);
  const std::size_t impacts = sizes.size() - index;
  const auto base = run(here, impacts);
  const auto add = [&](const auto& other, MotionNumbers PredictedSize::*effect) {
    add_difference(base, run(other, impacts), index, sizes, effect);
  };
  add(faster(here, drop.gravity * time), &PredictedSize::gravity);
  if (const auto other = turned(here, row, time)) add(*other, &PredictedSize::turning);
  for (const auto& smaller : shrunk(here, row, time)) add(smaller, &PredictedSize::indentation);
  for (std::size_t i = index + 1; i < sizes.size(); ++i) sizes[i].delay[0] += time / 2;
}

std::vector<PredictedSize> sizes_of(const auto& drop, const auto& sequence, const std::vector<double>& contact_times) {
  std::vector<PredictedSize> sizes(std::min(sequence.rows.size(), contact_times.size()));
  const auto give_up_from = [&](std::size_t i) {
    for (; i < sizes.size(); ++i) sizes[i].turning.fill(unknown_error);
  };
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    try {
      add_effects(drop, sequence.rows[i], contact_times[i], i, sizes);
    } catch (const std::domain_error&) {  // the shifted state no longer approaches the ground
      give_up_from(i);
    } catch (const analytic::NumericalError&) {
      give_up_from(i);
    } catch (const analytic::OutsideModelError&) {
      give_up_from(i);
    }
  }
  return sizes;
}

/// The same with the centre of mass as low as the ground and no product of inertia that tilts by a couple about the
/// vertical: the face is pressed evenly.
space::Drop pressed_evenly(space::Drop drop, double depth) {
  const space::Matrix3 axes = drop.attitude.toRotationMatrix();
  for (Vector3& vertex : drop.body.vertices) vertex += axes.transpose() * Vector3(0, 0, depth);
  space::Matrix3 inverse = axes * drop.body.inertia.inverse() * axes.transpose();
  inverse.topRightCorner<2, 1>().setZero();
  inverse.bottomLeftCorner<1, 2>().setZero();
  drop.body.inertia = axes.transpose() * inverse.inverse() * axes;
  return drop;
}

using analytic::ImpactMode;
using numeric::Vector3;
using space::PathKind;

/// End of the continuous model's kind: by the side of the body that the vertices are on.
std::string end_of(const analytic::PlanarBody& body, const ImpactRow& row) {
  bool left = false, right = false;
  for (int i = 0; i < body.vertex_count; ++i) {
    if (!(row.vertices >> i & 1)) continue;
    (body.vertices[static_cast<std::size_t>(i)].x < 0 ? left : right) = true;
  }
  return left && right ? "both" : left ? "a" : "b";
}

bool jams(const analytic::Drop& drop, const ImpactRow& row) {
  if (drop.law.friction != analytic::FrictionKind::coulomb || std::popcount(row.vertices) != 1) return false;
  const analytic::ContactPoint d =
      drop.body.contact_point(std::countr_zero(row.vertices), std::sin(row.inclination), std::cos(row.inclination));
  const double limit = analytic::jamming_ratio(contact_inertia(drop.body.gyration_square, d));
  return drop.law.friction_value >= std::fabs(limit);
}

/// The body lies flat or stands upright as it lands.
bool is_face(const ImpactRow& row) {
  constexpr double square = 1e-12;  // [rad]
  return row.contact_angle < square || row.contact_angle > analytic::pi / 2 - square;
}

/// A whole face lands while it turns or slides.  Where along the face the ground then presses decides the rebound,
/// which impulses at corners do not know; only a face that lands at rest against the ground has one answer.
bool is_open_face(const ImpactRow& row) {
  return is_face(row) && (row.before.angular != 0 || row.impact.tangential_impulse != 0);
}

/// A whole face strikes first and slides without a turn.
bool lands_sliding(const analytic::Sequence& sequence) {
  return !sequence.rows.empty() && is_open_face(sequence.rows[0]) && sequence.rows[0].before.angular == 0;
}

SequenceImpact planar_impact(const analytic::Drop& drop, const ImpactRow& row, const Impact& found) {
  const ImpactMode mode = row.impact.mode;
  SequenceImpact impact{.numbers = motion_numbers(found.value),
                        .errors = motion_numbers(found.error),
                        .end = end_of(drop.body, row),
                        .amplification = row.amplification,
                        .predictable = row.amplification * std::numeric_limits<double>::epsilon() <= 0.01,
                        .sticks = mode == ImpactMode::stick || mode == ImpactMode::slip_stick,
                        .jams = jams(drop, row)};
  if (is_open_face(row))
    impact.open = "a whole face lands turning or sliding: its rebound depends on where along it the ground presses";
  return impact;
}

DiscreteSide planar_side(const Scene& scene, const analytic::Drop& drop, const analytic::Sequence& sequence) {
  const Run run = run_of(sequence, given_inclination(scene));
  DiscreteSide side{.in_space = false,
                    .quantities = plane_quantities,
                    .scales = comparison_scales(run.impacts, {.reach = drop.body.reach(), .mass = drop.body.mass}),
                    .outcome = sequence.outcome,
                    .message = sequence.message,
                    .predict = [drop, sequence](const auto& times) { return predicted_sizes(drop, sequence, times); }};
  bool after_face = false;
  for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
    const ImpactRow& row = sequence.rows[i];
    SequenceImpact& impact = side.impacts.emplace_back(planar_impact(drop, row, run.impacts[i]));
    if (after_face) impact.follows_open = "follows the landing of a whole face: rounding decides how it lands again";
    after_face = after_face || is_face(row);
  }
  return side;
}

/// Vertical velocities of the corners that arrived, before or after the impact.
bool moves_as_one(const space::ImpactRow& row, const Vector3& velocity, const Vector3& rate, double scale) {
  constexpr double rounding = 1e-10;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const space::Corner& corner : row.corners) {
    const double up = (velocity + rate.cross(row.before.attitude * corner.place)).z();
    least = std::min(least, up);
    most = std::max(most, up);
  }
  return most - least <= rounding * scale;
}

/// Whether the corners lie on one line.
bool is_edge(const space::ImpactRow& row) {
  const Vector3 along = row.corners[1].place - row.corners[0].place;
  return std::ranges::all_of(row.corners, [&](const space::Corner& corner) {
    return along.cross(corner.place - row.corners[0].place).norm() <= 1e-9 * along.squaredNorm();
  });
}

/// Where a ground that gives way evenly presses: the centre of the area between the corners, of an edge its middle.
/// Body frame, from the centre of mass.
Vector3 middle_of(const space::ImpactRow& row, const Vector3& mean) {
  if (is_edge(row)) return mean;
  const auto foot = [&](const space::Corner& corner) {
    return space::Vector2((row.before.attitude * (corner.place - mean)).head<2>());
  };
  std::vector<space::Vector2> around;
  for (const space::Corner& corner : row.corners) around.push_back(foot(corner));
  std::ranges::sort(around, {}, [](const space::Vector2& p) { return std::atan2(p.y(), p.x()); });
  double area = 0;
  space::Vector2 moment = space::Vector2::Zero();
  for (std::size_t i = 0; i < around.size(); ++i) {
    const space::Vector2 &from = around[i], &to = around[(i + 1) % around.size()];
    const double twice = from.x() * to.y() - from.y() * to.x();
    area += 3 * twice;
    moment += twice * (from + to);
  }
  return mean + row.before.attitude.conjugate() * Vector3(moment.x() / area, moment.y() / area, 0);
}

/// Whether the impulse acts at the middle.
bool acts_in_the_middle(const space::ImpactRow& row, const Vector3& middle) {
  const Vector3 arm = row.before.attitude * middle, &impulse = row.impact.impulse;
  return (row.group->moment - arm.cross(impulse)).norm() <= 1e-9 * arm.norm() * impulse.norm();
}

/// Whether all of a face lands and leaves without a turn about the horizontal, its middle below the centre of mass: an
/// even bed then turns it by friction alone.
bool is_even_landing(const space::ImpactRow& row, const Vector3& middle) {
  const Vector3 arm = row.before.attitude * middle;
  return arm.head<2>().norm() <= 1e-9 * row.corners.front().place.norm();
}

/// Corners that come down and leave with one speed, pressed in their middle, have one answer on any ground; where they
/// do not, the rebound depends on where between them the ground presses.
bool is_settled(const space::ImpactRow& row, const Vector3& middle, double scale) {
  const space::Impact& impact = row.impact;
  const bool as_one = moves_as_one(row, row.before.velocity, row.before.angular_velocity, scale) &&
                      moves_as_one(row, impact.velocity_after, impact.angular_velocity_after, scale);
  if (!row.group->is_whole || !as_one) return false;
  return is_edge(row) ? acts_in_the_middle(row, middle) : is_even_landing(row, middle);
}

std::string open_words(const space::Drop& drop, const space::ImpactRow& row) {
  return fmt::format("{}: the rebound depends on where between them the ground presses; {}", landing_words(row.corners),
                     tilt_words(tilted_outcomes(drop.body, row.before, row.corners, drop.law)));
}

/// How far an even bed may be from the rule of a level face that rubs, whatever its stiffness.  Friction acts at the
/// depth h below the centre of mass.  The rule's pressure leans against it, so that the body does not turn; an even bed
/// leans only as far as the body tips.
struct FaceTipping {
  double lean = 0;  ///< δω × reach / approach speed, δω the turn by friction under even pressure; 0 without friction
  /// How far the row's numbers are from a face under even pressure, δω, what it does to slip, h δω, and lean² of
  /// the approach speed for the corners that let go early.
  MotionNumbers size{};
};

/// @pre row.group->is_whole
FaceTipping face_tipping(const space::Drop& drop, const space::ImpactRow& row) {
  const space::Drop here = drop_at(drop, row);
  const space::Matrix3 axes = here.attitude.toRotationMatrix();
  const double depth = -(axes * row.corners.front().place).z();
  const space::Sequence even = run(pressed_evenly(here, depth), 1);
  const space::GroupImpact& group = *even.rows.at(0).group;
  const Vector3 moment = Vector3(0, 0, -depth).cross(group.impulse) + group.moment.z() * Vector3::UnitZ();
  const Vector3 turn = axes * here.body.inertia.inverse() * (axes.transpose() * moment);
  const double tipped = turn.head<2>().norm(), reach = here.body.reach();
  FaceTipping tipping{.lean = tipped * reach / row.impact.approach_speed, .size = {}};
  const double speed = depth * tipped + tipping.lean * tipping.lean * row.impact.approach_speed;
  const MotionNumbers by_rule = motion_numbers(impact_of(row).value),
                      evenly = motion_numbers(impact_of(even.rows[0]).value);
  MotionNumbers& size = tipping.size;
  for (std::size_t q = 2; q < motion_number_count; ++q) size[q] = std::fabs(evenly[q] - by_rule[q]);
  for (const std::size_t axis : {0, 1, 2}) {
    size[2 + axis] += here.body.mass * speed;
    size[5 + axis] += speed;
  }
  for (const std::size_t axis : {0, 1}) size[8 + axis] += tipped;
  size[10] += speed / reach;
  return tipping;
}

/// Why the rule of corners that land at once is not that of an ever stiffer ground, and how far an even bed may be from
/// it where it is.
void judge_group(const space::Drop& drop, const space::ImpactRow& row, const Vector3& mean, SequenceImpact& impact) {
  constexpr double most_lean = 0.1;  // beyond it tipping has a limit of its own
  impact.is_face = row.group->is_whole && !is_edge(row) && row.held == 0;
  const double scale = row.before.velocity.norm() + row.before.angular_velocity.norm() * drop.body.reach();
  if (!is_settled(row, middle_of(row, mean), scale)) {
    impact.open = open_words(drop, row);
    return;
  }
  if (!impact.is_face) return;
  const FaceTipping tipping = face_tipping(drop, row);
  impact.tipping = tipping.size;
  if (tipping.lean <= most_lean) return;
  impact.open = fmt::format(
      "{}: friction, far below the centre of mass, tips the body on an even bed, its ends at up to {} of the approach "
      "speed, where the rule keeps it from turning",
      landing_words(row.corners), significant(tipping.lean, 2));
}

SequenceImpact space_impact(const Scene& scene, const space::Drop& drop, const space::ImpactRow& row,
                            const Impact& found) {
  Vector3 place = Vector3::Zero();
  std::string names;
  for (const space::Corner& corner : row.corners) {
    place += corner.place / static_cast<double>(row.corners.size());
    names += (names.empty() ? "" : " ") + corner_name(scene, corner);
  }
  const PathKind path = row.impact.path;
  SequenceImpact impact{.numbers = motion_numbers(found.value),
                        .errors = motion_numbers(found.error),
                        .end = names,
                        .place = place,
                        .amplification = row.amplification,
                        .predictable = row.error.predictable,
                        .is_group = row.group.has_value(),
                        .sticks = path == PathKind::stick || path == PathKind::slip_stick,
                        .nearly_stops = row.impact.least_slip <= 1e-3 * row.impact.contact_before.norm()};
  if (row.group) judge_group(drop, row, place, impact);
  return impact;
}

DiscreteSide space_side(const Scene& scene, const space::Drop& drop) {
  const space::Sequence sequence =
      impact_sequence(drop, {.impacts = scene.request.impacts, .until = scene.request.until});
  const Run run = run_of(sequence);
  DiscreteSide side{.in_space = true,
                    .quantities = space_quantities,
                    .scales = comparison_scales(run.impacts, {.reach = drop.body.reach(), .mass = drop.body.mass}),
                    .outcome = sequence.outcome,
                    .message = sequence.message,
                    .predict = [drop, sequence](const auto& times) { return predicted_sizes(drop, sequence, times); }};
  for (std::size_t i = 0; i < drop.body.vertices.size(); ++i) {
    const space::Corner corner{.index = static_cast<int>(i), .place = drop.body.vertices[i]};
    side.corners.push_back({corner.place, corner_name(scene, corner)});
  }
  bool after_group = false;
  for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
    const space::ImpactRow& row = sequence.rows[i];
    SequenceImpact& impact = side.impacts.emplace_back(space_impact(scene, drop, row, run.impacts[i]));
    if (after_group) impact.follows_open = "follows corners that landed at once: rounding decides their order";
    after_group = after_group || row.group.has_value();
  }
  return side;
}

}  // namespace

MotionNumbers PredictedSize::total() const {
  MotionNumbers sum{};
  for (std::size_t q = 0; q < motion_number_count; ++q)
    sum[q] = gravity[q] + turning[q] + indentation[q] + delay[q] + tipping[q];
  return sum;
}

Drop drop_at(const Drop& drop, const ImpactRow& row) {
  Drop here = drop;
  here.velocity = row.before;
  double inclination = row.inclination;
  if (std::fabs(inclination) > analytic::pi / 2) turn_over(here, inclination);
  if (inclination < 0) mirror(here, inclination);
  here.inclination = analytic::Angle::from_radians(std::min(inclination, analytic::pi / 2));
  return here;
}

space::Drop drop_at(const space::Drop& drop, const space::ImpactRow& row) {
  space::Drop here = drop;
  here.attitude = row.before.attitude;
  here.velocity = row.before.velocity;
  here.angular_velocity = row.before.angular_velocity;
  return here;
}

std::vector<PredictedSize> predicted_sizes(const Drop& drop, const Sequence& sequence,
                                           const std::vector<double>& contact_times) {
  return sizes_of(drop, sequence, contact_times);
}

std::vector<PredictedSize> predicted_sizes(const space::Drop& drop, const space::Sequence& sequence,
                                           const std::vector<double>& contact_times) {
  return sizes_of(drop, sequence, contact_times);
}

DiscreteSide discrete_side(const Scene& scene, DiscreteBody& body) {
  const DiscreteDrop drop = body.drop(scene);
  const auto* const planar = std::get_if<analytic::Drop>(&drop);
  if (planar == nullptr) return space_side(scene, std::get<space::Drop>(drop));
  const analytic::Sequence sequence =
      impact_sequence(*planar, {.impacts = scene.request.impacts, .until = scene.request.until});
  if (!scene.world.planar && lands_sliding(sequence)) return space_side(scene, body.drop_in_space(scene));
  return planar_side(scene, *planar, sequence);
}

using numeric::ImpactRecord;
using numeric::Vector3;

bool same_contact(const SequenceImpact& discrete, numeric::ContactEnd end, const Vector3& place,
                  const numeric::Body& body) {
  if (!discrete.place) return discrete.end == end_name(end);
  return is_same_place(body, *discrete.place, place);
}

std::string contact_name(const DiscreteSide& side, numeric::ContactEnd end, const Vector3& place,
                         const numeric::Body& body) {
  if (!side.in_space) return end_name(end);
  for (const SequenceImpact& impact : side.impacts) {
    if (same_contact(impact, end, place, body)) return impact.end;
  }
  for (const NamedCorner& corner : side.corners) {
    if (is_same_place(body, corner.place, place)) return corner.name;
  }
  return "several";
}

std::string contacts_differ(const DiscreteSide& side, const std::string& discrete, const std::string& continuous) {
  if (!side.in_space) return fmt::format("end {} strikes in one model, end {} in the other", discrete, continuous);
  if (discrete == continuous) return fmt::format("another point of {} strikes in each model", discrete);
  return fmt::format("corner {} strikes in the discrete model, corner {} in the continuous one", discrete, continuous);
}

std::string other_blow(const DiscreteSide& side, const SequenceImpact& discrete, const ImpactRecord& record,
                       const numeric::Body& body) {
  if (record.touches > 1 && discrete.end != "both") return "another place touches before the first contact has ended";
  if (same_contact(discrete, record.end, record.place, body)) return "";
  return contacts_differ(side, discrete.end, contact_name(side, record.end, record.place, body));
}

PartedBlows parted_blows(const DiscreteSide& side, const std::vector<ImpactRecord>& records,
                         const numeric::Body& body) {
  for (std::size_t i = 0; i < std::min(side.impacts.size(), records.size()); ++i) {
    if (side.impacts[i].is_group) continue;  // several corners at once, of which a run may know one
    const std::string reason = other_blow(side, side.impacts[i], records[i], body);
    if (!reason.empty()) return {static_cast<int>(i) + 1, reason};
  }
  return {};
}

}  // namespace clatter::validation
