// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/scene_values.hpp"

namespace clatter::validation {
namespace {

using analytic::space::Body;

constexpr Range any{-1e100, 1e100, false, "from -1e100 to 1e100"};
constexpr Range positive{0, 1e100, true, "greater than 0, at most 1e100"};
constexpr Range from_0_to_1{0, 1, false, "from 0 to 1"};
constexpr Range not_negative{0, 1e100, false, "from 0 to 1e100"};

const std::string folder = "validation/measured/", ending = ".toml";

std::vector<std::string> description_keys() {
  std::vector<std::string> keys;
  for (const auto& [table, names] :
       {std::pair{"body", "size radius mesh.file mesh.unit mass"},
        {"track",
         "point motion rate drop sample time time_unit quaternion x y z angle q0 q1 q2 q3 unit turns attitude "
         "angle_unit"},
        {"world", "ground gravity"},
        {"source", "text licence"},
        {"impact", "lever_tolerance"},
        {"published", "restitution friction"}}) {
    std::istringstream words(names);
    for (std::string name; words >> name;) keys.push_back(fmt::format("{}.{}", table, name));
  }
  return keys;
}

std::string column_name(const SceneValues& values, const std::string& key, const std::string& fallback) {
  return values.has("track." + key) ? values.text("track." + key) : fallback;
}

void put_columns(const SceneValues& values, TrackDescription& d) {
  d.drop = column_name(values, "drop", "drop");
  d.sample = column_name(values, "sample", "sample");
  values.exclude("track.sample", "track.time");
  d.time = column_name(values, "time", "");
  if (values.has("track.time_unit") && d.time.empty())
    values.refuse("track.time_unit", "left out: it is only for a column of times");
  d.x = column_name(values, "x", "x_m");
  d.z = column_name(values, "z", "z_m");
  if (d.is_planar()) {
    for (const char* key :
         {"track.y", "track.q0", "track.q1", "track.q2", "track.q3", "track.attitude", "track.quaternion"})
      if (values.has(key)) values.refuse(key, "left out: motion is in a plane");
    d.angle = column_name(values, "angle", "angle_rad");
    return;
  }
  for (const char* key : {"track.angle", "track.angle_unit", "track.turns"})
    if (values.has(key)) values.refuse(key, "left out: motion is in space");
  d.y = column_name(values, "y", "y_m");
  for (const char* name : {"q0", "q1", "q2", "q3"}) d.quaternion.push_back(column_name(values, name, name));
}

/// The body of a mesh's file, as scenes have it.
std::shared_ptr<const TrackedMesh> read_mesh(SceneValues& values, double mass) {
  constexpr Range units{0, 1e100, true, "mm, cm, m, in, or a length in m greater than 0 and at most 1e100"};
  values.name_numbers("body.mesh.unit", {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}});
  Scene scene;
  scene.body.shape = BodyScene::Shape::mesh;
  scene.body.mass = mass;
  scene.body.file = values.file("body.mesh.file");
  scene.body.mesh_file = unread_mesh();
  scene.body.has_unit = values.has("body.mesh.unit");
  scene.body.unit = values.number("body.mesh.unit", 1, units);
  const SolidBody solid = solid_body(scene);
  const BodyProperties properties = body_properties(scene, Model::discrete);
  constexpr double least = 1e-5, largest = 20;  // [m]
  if (const double across = properties.extents.maxCoeff(); !(across >= least && across <= largest)) {
    values.require("body.mesh.unit",
                   fmt::format("mm, cm, m or in: without it the mesh is {} m across", shortest(across)));
  }
  TrackedMesh mesh;
  mesh.centre = solid.properties.centre;
  mesh.extents = properties.extents;
  std::vector<Vector3> corners = solid.surface.nodes;
  for (Vector3& corner : corners) corner -= mesh.centre;
  // Only velocities are measured, which a common factor of mass and inertia leaves alone.
  mesh.body = analytic::space::polyhedron(
      hull_corners(corners, properties.extents.norm()),
      {.mass = mass, .centre = Vector3::Zero(), .inertia = mass / solid.properties.mass * solid.properties.inertia});
  mesh.faces = resting_faces(mesh.body.vertices);
  mesh.name = std::filesystem::path(scene.body.file).filename().string();
  mesh.words = mesh_words(scene);
  return std::make_shared<const TrackedMesh>(std::move(mesh));
}

void put_body(SceneValues& values, TrackDescription& d) {
  d.mass = values.number("body.mass", 1, positive);
  for (const auto& [one, other] : {std::pair("body.size", "body.radius"), std::pair("body.size", "body.mesh.file"),
                                   std::pair("body.radius", "body.mesh.file")})
    values.exclude(one, other);
  const bool has_file = values.has("body.mesh.file");
  if (values.has("body.mesh.unit") && !has_file) values.refuse("body.mesh.unit", "left out: it is only for a mesh");
  if (values.has("track.point") && !has_file) values.refuse("track.point", "left out: it is only for a mesh");
  if (has_file) {
    if (d.is_planar()) values.refuse("track.motion", "\"space\": the body is a mesh");
    d.mesh = read_mesh(values, d.mass);
    d.size = d.mesh->extents;
    d.of_origin = values.name("track.point", 0, {"centre-of-mass", "origin"}) == 1;
  } else if (values.has("body.radius")) {
    d.radius = values.number("body.radius", 0, positive);
    d.size = 2 * d.radius * Vector3::Ones();
  } else {
    values.require("body.size", "the box's [L, W, T] in m, or body.radius of a ball, or body.mesh.file");
    const std::vector<double> size = values.numbers("body.size", {3}, positive, "three lengths in m");
    d.size = {size[0], size[1], size[2]};
  }
}

TrackDescription described(SceneValues values) {
  TrackDescription d;
  d.path = values.path();
  if (!values.has("track.time")) values.require("track.rate", "frames per second, or track.time, a column of times");
  values.require("track.motion", "\"plane\" or \"space\"");
  d.motion = static_cast<TrackDescription::Motion>(values.name("track.motion", 1, {"plane", "space"}));
  put_body(values, d);
  d.rate = values.number("track.rate", 0, positive);
  d.unit = values.number("track.unit", 1, positive);
  d.angle_unit = values.number("track.angle_unit", 1, positive);
  d.clockwise = values.name("track.turns", 0, {"counter-clockwise", "clockwise"}) == 1;
  d.to_body = values.name("track.attitude", 0, {"body-to-world", "world-to-body"}) == 1;
  d.scalar_last = values.name("track.quaternion", 0, {"scalar-first", "scalar-last"}) == 1;
  d.time_unit = values.number("track.time_unit", 1, positive);
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

Body body_with(const TrackDescription& d, double rounding, double inertia_factor) {
  if (d.is_box()) return box_with(d, rounding, inertia_factor);
  Body body = d.is_ball() ? analytic::space::ellipsoid(d.mass, d.radius * Vector3::Ones()) : d.mesh->body;
  body.inertia *= inertia_factor;
  return body;
}

constexpr double least_noise = 1e-7;     // [m], [rad]
constexpr double least_motion = 0.1;     // in three frames, over the body's size
constexpr double worst_length = 0.05;    // of a quaternion, off 1
constexpr double third_difference = 20;  // variance of (1, −3, 3, −1) of independent noise

TableRequest request_for(const TrackDescription& d) {
  TableRequest request;
  request.renaming = fmt::format("track.drop, track.x and so on in {} name them", d.path);
  const std::string& sample = d.time.empty() ? d.sample : d.time;
  request.names = {{"drop", d.drop}, {"sample", sample}, {"x", d.x}, {"z", d.z}};
  request.required = {"drop", "sample", "x", "z"};
  if (d.is_planar()) {
    request.names["angle"] = d.angle;
    request.required.push_back("angle");
    return request;
  }
  request.names["y"] = d.y;
  request.required.push_back("y");
  for (std::size_t i = 0; i < 4; ++i) {
    request.required.push_back(fmt::format("q{}", i));
    request.names[request.required.back()] = d.quaternion[i];
  }
  return request;
}

/// The rows of a table as frames.
class FrameReader {
 public:
  FrameReader(const NumericTable& table, const TrackDescription& description)
      : table_(table), description_(description) {}

  [[nodiscard]] double value(std::size_t row, const char* name) const { return table_.at(row, *table_.column(name)); }

  [[nodiscard]] Frame frame(std::size_t row) const {
    const TrackDescription& d = description_;
    Frame frame{.time = d.time.empty() ? value(row, "sample") / d.rate : d.time_unit * value(row, "sample")};
    frame.position = d.unit * Vector3(value(row, "x"), d.is_planar() ? 0 : value(row, "y"), value(row, "z"));
    if (d.is_planar()) {
      const double angle = d.angle_unit * value(row, "angle");
      frame.attitude = rotation_of((d.clockwise ? angle : -angle) * Vector3::UnitY());
      return frame;
    }
    std::array<double, 4> p{value(row, "q0"), value(row, "q1"), value(row, "q2"), value(row, "q3")};
    if (d.scalar_last) std::rotate(p.begin(), p.begin() + 3, p.end());
    const Quaternion q(p[0], p[1], p[2], p[3]);
    if (!(std::fabs(q.norm() - 1) <= worst_length)) table_.refuse(row, "q0", "part of a quaternion of length 1");
    frame.attitude = d.to_body ? q.normalized().conjugate() : q.normalized();
    if (d.of_origin) frame.position += frame.attitude * d.mesh->centre;
    return frame;
  }

 private:
  const NumericTable& table_;
  const TrackDescription& description_;
};

/// Root of the mean square that a normal distribution with this median of its magnitude has.
double spread_of(std::vector<double>& magnitudes) {
  return magnitudes.empty() ? 0 : deviation_of_median * median(std::move(magnitudes)) / std::sqrt(third_difference);
}

/// Frames per second by the middle step of the times within a drop.
double rate_of(const NumericTable& table, double time_unit) {
  std::vector<double> steps;
  const std::size_t drop = *table.column("drop"), time = *table.column("sample");
  for (std::size_t row = 1; row < table.rows(); ++row) {
    if (table.at(row, drop) == table.at(row - 1, drop)) steps.push_back(table.at(row, time) - table.at(row - 1, time));
  }
  const double step = time_unit * median(std::move(steps));
  if (!(step > 0)) throw BadInput(fmt::format("{}: has no two times one after the other in a drop", table.path()));
  return 1 / step;
}

TrackFile tracks_of(const NumericTable& table, TrackDescription description) {
  if (!(description.rate > 0)) description.rate = rate_of(table, description.time_unit);
  const double in_samples = description.time.empty() ? 1 : description.time_unit * description.rate;
  const FrameReader reader(table, description);
  TrackFile file{.path = table.path(), .description = description, .tracks = {}, .frames = table.rows()};
  double before = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string name = shortest(reader.value(row, "drop"));
    const double sample = reader.value(row, "sample");
    if (file.tracks.empty() || file.tracks.back().name != name) {
      const auto same = [&](const Track& track) { return track.name == name; };
      if (std::any_of(file.tracks.begin(), file.tracks.end(), same))
        table.refuse(row, "drop", "a new one, or that of the row before");
      file.tracks.push_back({.name = name, .frames = {}});
    } else {
      if (!(sample > before))
        table.refuse(row, "sample", fmt::format("greater than {}, that of the row before", before));
      file.tracks.back().missing += std::max(static_cast<int>(std::lround(in_samples * (sample - before))) - 1, 0);
    }
    before = sample;
    file.tracks.back().frames.push_back(reader.frame(row));
  }
  return file;
}

/// Names of the descriptions that the program carries.
std::vector<std::string> carried_descriptions() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.name.starts_with(folder) || !file.name.ends_with(ending)) continue;
    names.emplace_back(file.name.substr(folder.size(), file.name.size() - folder.size() - ending.size()));
  }
  return names;
}

/// Whether a path names tracks that the program carries, and no file.
bool means_carried(const std::string& path) {
  const std::vector<std::string> names = carried_descriptions();
  return std::find(names.begin(), names.end(), path) != names.end() && !std::filesystem::exists(path);
}

}  // namespace

std::string TrackDescription::frame_words() const {
  if (is_planar())
    return fmt::format("x to the right and z up, angles {}", clockwise ? "clockwise" : "counter-clockwise");
  const std::string words = fmt::format("z up; quaternions with the scalar part {}, {}", scalar_last ? "last" : "first",
                                        to_body ? "world to body" : "body to world");
  if (!mesh) return words;
  return fmt::format("of the {}, axes of {}; {}", of_origin ? "file's origin" : "centre of mass", mesh->name, words);
}

TrackDescription read_description(const std::string& path) {
  const std::vector<std::string> names = carried_descriptions();
  if (std::find(names.begin(), names.end(), path) != names.end()) {
    const std::string file = folder + path + ending;
    return described(SceneValues(file, embedded_text(file), description_keys()));
  }
  if (!std::filesystem::exists(path))
    throw BadInput(fmt::format("--body {}: neither a file nor one of {}", path, fmt::join(names, ", ")));
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
    : calibration_(calibration), core_(body_with(d, calibration.rounding, calibration.inertia_factor)),
      sharp_(body_with(d, 0, calibration.inertia_factor)),
      turn_(Eigen::AngleAxisd(calibration.turn.norm(), calibration.turn.norm() > 0
                                                           ? Vector3(calibration.turn.normalized())
                                                           : Vector3::UnitX())) {
  for (int axis = 0; axis < 3 && d.is_box(); ++axis) {
    if (d.is_planar() && axis == 1) continue;
    for (const double side : {-1.0, 1.0}) faces_.push_back(side * Vector3::Unit(axis));
  }
  if (d.mesh) {
    for (const HullFace& face : d.mesh->faces) faces_.push_back(face.normal);
  }
  gyration_square_ = sharp_.inertia.trace() / (3 * d.mass * calibration.inertia_factor);
  reach_ = d.is_ball() ? d.radius : 0;
  for (const Vector3& corner : sharp_.vertices) reach_ = std::max(reach_, corner.norm());
  constexpr double alike = 1e-6;  // so small a difference bends no flight between two impacts
  const analytic::space::PrincipalAxes principal(core_.inertia);
  turns_steadily_ = !(principal.moments[2] - principal.moments[0] > alike * principal.moments[2]);
}

Vector3 TrackedBody::core_arm(const Quaternion& attitude, int corner) const {
  if (is_ball()) return -reach_ * Vector3::UnitZ();
  return attitude * core_.vertices[static_cast<std::size_t>(corner)];
}

Vector3 TrackedBody::arm(const Quaternion& attitude, int corner) const {
  return core_arm(attitude, corner) - calibration_.rounding * Vector3::UnitZ();
}

int TrackedBody::lowest(const Quaternion& attitude) const {
  if (is_ball()) return 0;
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

Vector3 rotation_vector(const Quaternion& rotation) {
  const Quaternion q = rotation.w() < 0 ? Quaternion(-rotation.coeffs()) : rotation;
  const double sine = q.vec().norm();
  if (sine == 0) return Vector3::Zero();
  return 2 * std::atan2(sine, q.w()) / sine * q.vec();
}

Quaternion rotation_of(const Vector3& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Quaternion::Identity();
  Quaternion q;
  q.w() = std::cos(angle / 2);
  q.vec() = std::sin(angle / 2) / angle * vector;
  return q;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

Middle middle_of(std::vector<double> values, const std::vector<double>& own_errors) {
  const double middle = median(values);
  for (double& value : values) value = std::fabs(value - middle);
  const double spread = deviation_of_median * median(values), own = median(own_errors);
  return {middle,
          std::sqrt(std::max(0.0, spread * spread - own * own) + spread * spread / static_cast<double>(values.size()))};
}

TrackFile read_tracks(const std::string& path, const TrackDescription& description) {
  if (means_carried(path)) return carried_tracks(path, description);
  return tracks_of(NumericTable::read(path, request_for(description)), description);
}

TrackFile carried_tracks(const std::string& name, const TrackDescription& description) {
  std::string text(embedded_text("validation/measured/" + name + ".csv"));
  return tracks_of(NumericTable::parse(name, std::move(text), request_for(description)), description);
}

PoseNoise pose_noise(const TrackFile& file) {
  std::vector<double> positions[3], rotations[3];
  const double least_way = least_motion * file.description.size.minCoeff();
  for (const Track& track : file.tracks) {
    const std::vector<Frame>& f = track.frames;
    for (std::size_t i = 3; i < f.size(); ++i) {
      if (!((f[i].time - f[i - 3].time) * file.description.rate < 3.5)) continue;
      if (!((f[i].position - f[i - 3].position).norm() >= least_way)) continue;
      const Vector3 jump = f[i].position - 3 * f[i - 1].position + 3 * f[i - 2].position - f[i - 3].position;
      const auto turn = [&](std::size_t k) { return rotation_vector(f[k].attitude * f[k - 1].attitude.conjugate()); };
      const Vector3 twist = turn(i) - 2 * turn(i - 1) + turn(i - 2);
      for (int axis = 0; axis < 3; ++axis) {
        positions[axis].push_back(std::fabs(jump[axis]));
        rotations[axis].push_back(std::fabs(twist[axis]));
      }
    }
  }
  PoseNoise noise{least_noise, least_noise};
  for (int axis = 0; axis < 3; ++axis) {
    noise.position = std::max(noise.position, spread_of(positions[axis]));
    noise.rotation = std::max(noise.rotation, spread_of(rotations[axis]));
  }
  return noise;
}

}  // namespace clatter::validation
