// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"

namespace clatter::validation {
namespace {

constexpr double least_noise = 1e-7;     // [m], [rad]
constexpr double least_motion = 0.1;     // in three frames, over the body's size
constexpr double worst_length = 0.05;    // of a quaternion, off 1
constexpr double third_difference = 20;  // variance of (1, −3, 3, −1) of independent noise

TableRequest request_for(const TrackDescription& d) {
  TableRequest request;
  request.renaming = fmt::format("track.drop, track.x and so on in {} name them", d.path);
  request.names = {{"drop", d.drop}, {"sample", d.sample}, {"x", d.x}, {"z", d.z}};
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
    Frame frame{.time = value(row, "sample") / d.rate};
    frame.position = d.unit * Vector3(value(row, "x"), d.is_planar() ? 0 : value(row, "y"), value(row, "z"));
    if (d.is_planar()) {
      const double angle = d.angle_unit * value(row, "angle");
      frame.attitude = rotation_of((d.clockwise ? angle : -angle) * Vector3::UnitY());
      return frame;
    }
    const Quaternion q(value(row, "q0"), value(row, "q1"), value(row, "q2"), value(row, "q3"));
    if (!(std::fabs(q.norm() - 1) <= worst_length)) table_.refuse(row, "q0", "part of a quaternion of length 1");
    frame.attitude = d.to_body ? q.normalized().conjugate() : q.normalized();
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

TrackFile tracks_of(const NumericTable& table, const TrackDescription& description) {
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
      file.tracks.back().missing += static_cast<int>(std::lround(sample - before)) - 1;
    }
    before = sample;
    file.tracks.back().frames.push_back(reader.frame(row));
  }
  return file;
}

}  // namespace

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

TrackFile read_tracks(const std::string& path, const TrackDescription& description) {
  if (means_carried(path)) return carried_tracks(path, description);
  return tracks_of(NumericTable::read(path, request_for(description)), description);
}

TrackFile carried_tracks(const std::string& name, const TrackDescription& description) {
  return parse_tracks(name, std::string(embedded_text("validation/measured/" + name + ".csv")), description);
}

TrackFile parse_tracks(const std::string& path, std::string text, const TrackDescription& description) {
  return tracks_of(NumericTable::parse(path, std::move(text), request_for(description)), description);
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
