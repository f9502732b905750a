// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/rest_face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using numeric::Vector3;

// Sines by which a body that lies on a face may be off it: by rounding, and by what springs give way.
constexpr double rounded = 1e-6, sunk = 0.02;

/// The body's direction that points down when it lies on these of its vertices, in order around a face.
Vector3 lower_side(const std::vector<Vector3>& vertices, const std::vector<int>& corners) {
  Vector3 normal = Vector3::Zero(), middle = Vector3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3& here = vertices[static_cast<std::size_t>(corners[i])];
    normal += here.cross(vertices[static_cast<std::size_t>(corners[(i + 1) % corners.size()])]);
    middle += here;
  }
  // Two vertices bear a body that is flat: what is below lies in its plane, across their line.
  if (corners.size() == 2) {
    const Vector3 along =
        vertices[static_cast<std::size_t>(corners[1])] - vertices[static_cast<std::size_t>(corners[0])];
    normal = along.cross(Vector3::UnitY());
  }
  return (normal.dot(middle) < 0 ? -1 : 1) * normal.normalized();
}

/// The name of the face that points in this direction, unit, body frame, to a sine; empty: none does.
std::string name_of_face(const BodyScene& body, const Vector3& down, double aligned) {
  using Shape = BodyScene::Shape;
  if (body.shape == Shape::sphere) return "";
  if (body.has_length()) {
    if (std::fabs(down.x()) <= aligned) return "side";
    if (std::hypot(down.y(), down.z()) <= aligned) return down.x() < 0 ? "end a" : "end b";
    return "";
  }
  if (!body.is_polyhedron()) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::hypot(down[(axis + 1) % 3], down[(axis + 2) % 3]) <= aligned)
        return fmt::format("{}{}", down[axis] < 0 ? '-' : '+', "xyz"[axis]);
    }
    return "";
  }
  const auto part = [](double value) { return significant(std::fabs(value) < rounded ? 0.0 : value, 3); };
  return fmt::format("({}, {}, {})", part(down.x()), part(down.y()), part(down.z()));
}

Vector3 lower_side(const Eigen::Quaterniond& attitude) { return attitude.conjugate() * -Vector3::UnitZ(); }

/// @param tail  the sum of the impacts after the last row, if there is one
Estimated end_of(const auto& tail) { return {tail.end_time, tail.end_time_error}; }

std::optional<RestFace> rest_face(const Scene& scene, const space::Drop& drop, const space::Sequence& sequence) {
  if (!sequence.rest && !sequence.last_motion) return {};
  RestFace rest{.is_known = sequence.end_predictable};
  const Vector3 down = sequence.rest ? lower_side(drop.body.vertices, sequence.rest->corners)
                                     : lower_side(sequence.last_motion->state.attitude);
  rest.face = name_of_face(scene.body, down, rounded);
  if (sequence.last_motion) rest.time = {sequence.last_motion->begin, sequence.last_motion->begin_error};
  else if (sequence.tail) rest.time = end_of(*sequence.tail);
  else rest.time = {std::numeric_limits<double>::quiet_NaN(), unknown_error};
  // Where errors decide how the last impacts follow each other, their end is known to be before `latest` alone.
  const bool is_decided = sequence.rows.empty() || sequence.rows.back().error.predictable;
  const double latest = sequence.rest ? sequence.rest->latest : unknown_error;
  if (!is_decided) rest.time.error = std::fmax(rest.time.error, latest - rest.time.value);
  rest.time.error = std::fmax(rest.time.error, std::numeric_limits<double>::epsilon() * std::fabs(rest.time.value));
  return rest;
}

std::optional<RestFace> rest_face(const Scene& scene, const analytic::Drop& drop, const analytic::Sequence& sequence) {
  if (sequence.outcome != analytic::Outcome::at_rest || sequence.rows.empty()) return {};
  const analytic::VertexSet below = sequence.tail ? sequence.tail->vertices : sequence.rows.back().vertices;
  std::vector<Vector3> vertices;
  for (int i = 0; i < drop.body.vertex_count; ++i) {
    const analytic::Vertex& vertex = drop.body.vertices[static_cast<std::size_t>(i)];
    if ((below >> i & 1U) != 0) vertices.emplace_back(vertex.x, 0, vertex.z);
  }
  if (vertices.size() != 2) return {};
  RestFace rest{.face = name_of_face(scene.body, lower_side(vertices, {0, 1}), rounded),
                .is_known = sequence.end_predictable};
  const analytic::ImpactRow& last = sequence.rows.back();
  rest.time = sequence.tail ? end_of(*sequence.tail) : Estimated{last.start, last.error.start};
  return rest;
}

}  // namespace

std::optional<RestFace> rest_face(const Scene& scene, const DiscreteDrop& drop, const DiscreteSequence& sequence) {
  if (const auto* const planar = std::get_if<analytic::Sequence>(&sequence))
    return rest_face(scene, std::get<analytic::Drop>(drop), *planar);
  return rest_face(scene, std::get<space::Drop>(drop), std::get<space::Sequence>(sequence));
}

std::optional<RestFace> rest_face(const Scene& scene, const numeric::Simulation& simulation) {
  if (!simulation.on_ground || simulation.on_ground->kind == numeric::GroundMotionKind::rolls) return {};
  const bool rests = simulation.on_ground->kind == numeric::GroundMotionKind::rests;
  const numeric::MotionState& lies = rests ? simulation.on_ground->rest.state : simulation.on_ground->from;
  const bool is_known = std::ranges::all_of(simulation.impacts, &numeric::ImpactRecord::predictable);
  return RestFace{
      name_of_face(scene.body, lower_side(lies.attitude), sunk), {simulation.on_ground_from, unknown_error}, is_known};
}

DiscreteSequence sequence_to_face(const Scene& scene, const DiscreteDrop& drop, bool with_errors) {
  const analytic::SequenceOptions options{.impacts = scene.most_impacts(),
                                          .digits = scene.accuracy.digits,
                                          .amplification = with_errors,
                                          .until_rest = true,
                                          .until_face = true};
  return std::visit([&](const auto& one) -> DiscreteSequence { return impact_sequence(one, options); }, drop);
}

Value fields_of(const RestFace& rest) {
  return Value::Fields{{"face", text_or_nothing(rest.face)},
                       {"time", rest.time.value},
                       {"time_error", error_or_nothing(rest.time)},
                       {"known", rest.is_known}};
}

std::vector<Column> rest_columns() {
  return {word_column("rest_face", "rest",
                      "face on which it comes to lie: a box's -z and such, a rod's side or end, of "
                      "other bodies their direction that points down"),
          {"rest_time", "at", "s", "from when on it neither bounces nor rocks"},
          {"rest_known", "known", "", "whether no error of the numbers can lead to another face"}};
}

}  // namespace clatter::validation
