// SPDX-License-Identifier: GPL-3.0-or-later
// Tracked motion: poses of a body, frame by frame, drop by drop.
#pragma once

#include <string>
#include <vector>

#include "validation/measured/tracked_body.hpp"

namespace clatter::validation {

/// One pose.
struct Frame {
  double time = 0;                               ///< sample over the rate [s]
  Vector3 position = Vector3::Zero();            ///< of the centre, world frame [m]
  Quaternion attitude = Quaternion::Identity();  ///< body to world, unit
};

/// The frames of one drop, in the order of time.
struct Track {
  std::string name;  ///< the drop's number in the file
  std::vector<Frame> frames;
  int missing = 0;  ///< samples that are not in the file between its first and its last
};

struct TrackFile {
  std::string path;
  TrackDescription description;
  std::vector<Track> tracks;
  std::size_t frames = 0;
};

/// Reads a file of poses, or the data set of this name that the program carries; a planar angle α becomes the rotation
/// by −α about y (x right, z up), or by +α if it is clockwise.
/// @throws BadInput as NumericTable::read; for drops whose samples do not increase; for a quaternion whose length is
///         off 1 by more than a twentieth.
[[nodiscard]] TrackFile read_tracks(const std::string& path, const TrackDescription& description);

/// The data set of this name that the program carries.
[[nodiscard]] TrackFile carried_tracks(const std::string& name, const TrackDescription& description);

/// The same from a text; `path` is its name in errors.
[[nodiscard]] TrackFile parse_tracks(const std::string& path, std::string text, const TrackDescription& description);

/// Standard deviations of a pose's noise, of each component.
struct PoseNoise {
  double position = 0;  ///< [m]
  double rotation = 0;  ///< [rad]
};

/// Noise from third differences of positions and angles, which flights leave at rounding: a median, so that impacts and
/// torn frames do not count; of the noisiest axis, while the body moves: at rest tracking is steadier.  A tenth of a
/// micrometre and of a microradian at least: numbers are printed with as many digits.
[[nodiscard]] PoseNoise pose_noise(const TrackFile& file);

/// Rotation vector of a unit quaternion, in (−π, π] [rad].
[[nodiscard]] Vector3 rotation_vector(const Quaternion& rotation);
/// Unit quaternion of a rotation vector.
[[nodiscard]] Quaternion rotation_of(const Vector3& vector);
/// Standard deviation of a normal distribution over the median of its magnitude.
inline constexpr double deviation_of_median = 1.4826;
/// The middle of a list; NaN of none.
[[nodiscard]] double median(std::vector<double> values);
/// The value below which a share of a list lies, between neighbours in proportion; NaN of none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace clatter::validation
