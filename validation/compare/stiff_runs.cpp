// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/stiff_runs.hpp"

#include <fmt/format.h>

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

constexpr double small = 0.02;  // what turning, gravity and indentation may be at the first stiffness

double feature_of(const Scene& scene, const numeric::Body& body) {
  switch (scene.body.shape) {
    case BodyScene::Shape::rod:
      return scene.body.meshed_radius() * (1 - std::cos(2 * std::numbers::pi / scene.body.meshed_sectors()));
    case BodyScene::Shape::box: return scene.body.size.minCoeff();
    case BodyScene::Shape::mesh: break;
    case BodyScene::Shape::sphere:
    case BodyScene::Shape::ellipsoid:
    case BodyScene::Shape::capsule: {
      const double half = scene.body.extents(scene.body.radius).minCoeff() / 2;
      if (scene.body.is_smooth()) return half;
      return half *
             (1 - std::cos(std::numbers::pi / std::max(scene.body.meshed_sectors(), 4 * scene.body.meshed_rings())));
    }
  }
  return body.radius() / 100;
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
  if (!(sizes.gravity * time <= small * std::min(n.approach_speed, separation))) {
    return "the approach is so slow that gravity acts during the contact";
  }
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
  if (!sizes.planar && !is_same_place(sizes.body, one.place, other.place)) {
    return "another corner strikes from run to run";
  }
  if (one.mode != other.mode) {
    return fmt::format("the course of friction still changes from run to run, {} and {}", mode_name(one.mode),
                       mode_name(other.mode));
  }
  return one.touches != other.touches ? "contacts merge in some of the runs" : "";
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

ContactSizes ContactSizes::of(const Scene& scene, const numeric::Body& body, bool planar) {
  return {.body = body,
          .feature = feature_of(scene, body),
          .gravity = scene.world.gravity,
          .planar = planar,
          .damping_per_stiffness = scene.world.ground.damping / scene.world.ground.stiffness};
}

CommonRows common_rows(const std::vector<Simulation>& ladder, const ContactSizes& sizes) {
  CommonRows rows = clean_rows(ladder.front(), sizes);
  for (const Simulation& run : ladder) {
    if (run.impacts.size() < rows.count) {
      rows = {run.impacts.size(), "a stiffer ground gives fewer impacts: " + run.message};
    }
    for (std::size_t i = 0; i < rows.count; ++i) {
      const std::string apart = difference(ladder.front().impacts[i], run.impacts[i], sizes);
      if (!apart.empty()) rows = {i, apart};
    }
  }
  return rows;
}

}  // namespace clatter::validation
