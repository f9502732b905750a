// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/tracked_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/scene/scene_values.hpp"

namespace clatter::validation {
namespace {

using analytic::space::Body;

constexpr Range any{-1e100, 1e100, false, "from -1e100 to 1e100"};
constexpr Range positive{0, 1e100, true, "greater than 0, at most 1e100"};
constexpr Range from_0_to_1{0, 1, false, "from 0 to 1"};
constexpr Range not_negative{0, 1e100, false, "from 0 to 1e100"};

const std::string folder = "validation/measured/", ending = ".toml";

const std::vector<std::string>& description_keys() {
  static const std::vector<std::string> keys{"body.size",
                                             "body.mass",
                                             "track.motion",
                                             "track.rate",
                                             "track.drop",
                                             "track.sample",
                                             "track.x",
                                             "track.y",
                                             "track.z",
                                             "track.angle",
                                             "track.q0",
                                             "track.q1",
                                             "track.q2",
                                             "track.q3",
                                             "track.unit",
                                             "track.turns",
                                             "track.attitude",
                                             "track.angle_unit",
                                             "world.ground",
                                             "world.gravity",
                                             "source.text",
                                             "source.licence",
                                             "impact.lever_tolerance",
                                             "published.restitution",
                                             "published.friction"};
  return keys;
}

std::string column_name(const SceneValues& values, const std::string& key, const std::string& fallback) {
  return values.has("track." + key) ? values.text("track." + key) : fallback;
}

void put_columns(const SceneValues& values, TrackDescription& d) {
  d.drop = column_name(values, "drop", "drop");
  d.sample = column_name(values, "sample", "sample");
  d.x = column_name(values, "x", "x_m");
  d.z = column_name(values, "z", "z_m");
  if (d.is_planar()) {
    for (const char* key : {"track.y", "track.q0", "track.q1", "track.q2", "track.q3", "track.attitude"})
      if (values.has(key)) values.refuse(key, "left out: motion is in a plane");
    d.angle = column_name(values, "angle", "angle_rad");
    return;
  }
  for (const char* key : {"track.angle", "track.angle_unit", "track.turns"})
    if (values.has(key)) values.refuse(key, "left out: motion is in space");
  d.y = column_name(values, "y", "y_m");
  for (const char* name : {"q0", "q1", "q2", "q3"}) d.quaternion.push_back(column_name(values, name, name));
}

TrackDescription described(const SceneValues& values) {
  TrackDescription d;
  d.path = values.path();
  values.require("body.size", "the box's [L, W, T] in m");
  values.require("track.rate", "frames per second");
  values.require("track.motion", "\"plane\" or \"space\"");
  const std::vector<double> size = values.numbers("body.size", {3}, positive, "three lengths in m");
  d.size = {size[0], size[1], size[2]};
  d.motion = static_cast<TrackDescription::Motion>(values.name("track.motion", 1, {"plane", "space"}));
  d.mass = values.number("body.mass", 1, positive);
  d.rate = values.number("track.rate", 0, positive);
  d.unit = values.number("track.unit", 1, positive);
  d.angle_unit = values.number("track.angle_unit", 1, positive);
  d.clockwise = values.name("track.turns", 0, {"counter-clockwise", "clockwise"}) == 1;
  d.to_body = values.name("track.attitude", 0, {"body-to-world", "world-to-body"}) == 1;
  d.ground = values.number("world.ground", 0, any);
  d.gravity = values.number("world.gravity", 9.81, positive);
  d.lever_tolerance = values.number("impact.lever_tolerance", 0.1, from_0_to_1);
  if (values.has_table("published")) {
    values.require("published.restitution", from_0_to_1.words);
    values.require("published.friction", not_negative.words);
    d.published = StatedLaw{values.number("published.restitution", 0, from_0_to_1),
                            values.number("published.friction", 0, not_negative)};
  }
  if (values.has("source.text")) d.source = values.text("source.text");
  if (values.has("source.licence")) d.licence = values.text("source.licence");
  put_columns(values, d);
  return d;
}

Body box_with(const TrackDescription& d, double rounding, double inertia_factor) {
  Body body;
  body.mass = d.mass;
  const Vector3 s = d.size;
  if (d.is_planar()) {
    body.inertia = inertia_factor * d.mass / 12 * (s.x() * s.x() + s.z() * s.z()) * Matrix3::Identity();
  } else {
    const Vector3 square = s.cwiseProduct(s);
    const Vector3 moments = square.sum() * Vector3::Ones() - square;
    body.inertia = inertia_factor * d.mass / 12 * Matrix3(moments.asDiagonal());
  }
  for (int i = 0; i < 8; ++i) {
    if (d.is_planar() && (i & 2)) continue;
    Vector3 corner(i & 4 ? 1 : -1, i & 2 ? 1 : -1, i & 1 ? 1 : -1);
    corner = corner.cwiseProduct(s / 2 - rounding * Vector3::Ones());
    if (d.is_planar()) corner.y() = 0;
    body.vertices.push_back(corner);
  }
  return body;
}

}  // namespace

std::vector<std::string> carried_descriptions() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.name.starts_with(folder) || !file.name.ends_with(ending)) continue;
    names.emplace_back(file.name.substr(folder.size(), file.name.size() - folder.size() - ending.size()));
  }
  return names;
}

bool means_carried(const std::string& path) {
  const std::vector<std::string> names = carried_descriptions();
  return std::find(names.begin(), names.end(), path) != names.end() && !std::filesystem::exists(path);
}

TrackDescription read_description(const std::string& path) {
  const std::vector<std::string> names = carried_descriptions();
  if (std::find(names.begin(), names.end(), path) != names.end()) {
    const std::string file = folder + path + ending;
    return described(SceneValues(file, embedded_text(file), description_keys()));
  }
  if (!std::filesystem::exists(path)) {
    throw BadInput(fmt::format("--body {}: neither a file nor one of {}", path, fmt::join(names, ", ")));
  }
  return described(SceneValues(path, description_keys()));
}

TrackDescription description_of(const std::string& csv, const std::string& given) {
  if (!given.empty()) return read_description(given);
  if (means_carried(csv)) return read_description(csv);
  const std::string beside = std::filesystem::path(csv).replace_extension(ending).string();
  if (!std::filesystem::exists(beside)) {
    throw BadInput(
        fmt::format("{}: what was tracked is not known: no file {} beside it; --body takes a file or one of {}", csv,
                    beside, fmt::join(carried_descriptions(), ", ")));
  }
  return read_description(beside);
}

TrackedBody::TrackedBody(const TrackDescription& d, const Calibration& calibration)
    : calibration_(calibration), core_(box_with(d, calibration.rounding, calibration.inertia_factor)),
      sharp_(box_with(d, 0, calibration.inertia_factor)),
      turn_(Eigen::AngleAxisd(calibration.turn.norm(), calibration.turn.norm() > 0
                                                           ? Vector3(calibration.turn.normalized())
                                                           : Vector3::UnitX())) {
  for (int axis = 0; axis < 3; ++axis) {
    if (d.is_planar() && axis == 1) continue;
    for (const double side : {-1.0, 1.0}) {
      faces_.push_back(side * Vector3::Unit(axis));
      distances_.push_back(d.size[axis] / 2);
    }
  }
  gyration_square_ = sharp_.inertia.trace() / (3 * d.mass * calibration.inertia_factor);
  reach_ = sharp_.vertices.front().norm();
}

Vector3 TrackedBody::arm(const Quaternion& attitude, int corner) const {
  return attitude * core_.vertices[static_cast<std::size_t>(corner)] - calibration_.rounding * Vector3::UnitZ();
}

int TrackedBody::lowest(const Quaternion& attitude) const {
  const auto height = [&](const Vector3& corner) { return (attitude * corner).z(); };
  const auto place = std::min_element(core_.vertices.begin(), core_.vertices.end(),
                                      [&](const Vector3& a, const Vector3& b) { return height(a) < height(b); });
  return static_cast<int>(place - core_.vertices.begin());
}

std::size_t TrackedBody::down_face(const Quaternion& attitude) const {
  const auto height = [&](const Vector3& normal) { return (attitude * normal).z(); };
  const auto place = std::min_element(faces_.begin(), faces_.end(),
                                      [&](const Vector3& a, const Vector3& b) { return height(a) < height(b); });
  return static_cast<std::size_t>(place - faces_.begin());
}

}  // namespace clatter::validation
