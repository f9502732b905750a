// SPDX-License-Identifier: GPL-3.0-or-later
// Tracked motion: poses of a body, frame by frame, drop by drop.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analytic/space/flight/body.hpp"
#include "validation/scene/hull.hpp"

namespace clatter::validation {

// The body that was tracked, and how its file is to be read: a TOML file beside the CSV.
//
//     [body]       mass, and of a box size = [L, W, T] (in the plane W is left out of account), of a ball radius, of
//                  any body mesh.file and mesh.unit as scenes have them: its hull touches, in space alone
//     [track]      motion = "plane" or "space", rate [Hz], drop, sample, x, y, z, angle, q0 … q3: names of columns
//                  time: name of a column of times in place of the samples, time_unit [s]; the rate then follows
//                  quaternion = "scalar-first" or "scalar-last": the order of q0 … q3
//                  unit [m], angle_unit [rad], turns = "counter-clockwise" or "clockwise" (z up, x right),
//                  attitude = "body-to-world" or "world-to-body"
//                  point = "centre-of-mass" or, of a mesh, "origin": what x, y, z are the place of
//     [world]      ground: height of the ground [m]; gravity [m/s²]
//     [impact]     lever_tolerance: how far from the corner the touch may lie, over the corner's distance
//     [published]  restitution, friction: of the data's authors
//     [source]     text, licence

using analytic::space::cross_matrix;
using analytic::space::Matrix3;
using analytic::space::Quaternion;
using analytic::space::Vector3;

/// Parameters of an impact law as someone else states them.
struct StatedLaw {
  double restitution = 0;
  double friction = 0;
};

/// A body of a file of triangles or of Gmsh, uniform.
struct TrackedMesh {
  analytic::space::Body body;         ///< corners of the hull, from the centre of mass, axes of the file
  std::vector<HullFace> faces;        ///< of the hull, on which it can lie
  Vector3 centre = Vector3::Zero();   ///< of mass, in the file's frame [m]
  Vector3 extents = Vector3::Ones();  ///< along the file's axes [m]
  std::string name;                   ///< of the file, without its folder
  std::string words;                  ///< what was read and repaired; empty of Gmsh's files
};

struct TrackDescription {
  enum class Motion { plane, space };
  std::string path;  ///< of the description, for messages
  Motion motion = Motion::space;
  Vector3 size = Vector3::Ones();           ///< along the body's x, y, z [m]
  double radius = 0;                        ///< of a ball [m]; 0: none
  std::shared_ptr<const TrackedMesh> mesh;  ///< none: a box or a ball
  bool of_origin = false;                   ///< positions are those of the mesh's origin, not of the centre of mass
  double mass = 1;                          ///< [kg]
  double rate = 0;                          ///< frames per second [Hz]
  double unit = 1;                          ///< of the positions [m]
  double angle_unit = 1;                    ///< of the angle [rad]
  bool clockwise = false;                   ///< the angle's sense, with z up and x to the right
  double time_unit = 1;                     ///< of the times [s]
  bool to_body = false;                     ///< the quaternion maps world to body
  bool scalar_last = false;                 ///< of q0 … q3 the last is the scalar part
  double ground = 0;                        ///< its height [m]
  double gravity = 9.81;                    ///< expected along the fall [m/s²]
  double lever_tolerance = 0.1;             ///< of a point impact, over the corner's distance from the centre
  std::optional<StatedLaw> published;
  std::string source, licence;
  std::string drop, sample, x, y, z, angle;  ///< names of columns
  std::vector<std::string> quaternion;       ///< likewise, in their order
  std::string time;                          ///< likewise; empty: samples in its place

  [[nodiscard]] bool is_planar() const { return motion == Motion::plane; }
  [[nodiscard]] bool is_ball() const { return radius > 0; }
  [[nodiscard]] bool is_box() const { return !is_ball() && !mesh; }
  /// How poses are to be understood, for a reader.
  [[nodiscard]] std::string frame_words() const;
};

/// Reads a description: a file, or the name of one that the program carries ("square-drops").
/// @throws BadInput naming file, key, value and what is allowed.
[[nodiscard]] TrackDescription read_description(const std::string& path);
/// The description of a CSV file: `given`, or without it the file of the same name that ends in .toml.
[[nodiscard]] TrackDescription description_of(const std::string& csv, const std::string& given);
/// How the body differs from the one described: what resting poses and momentum about the touched corner say.  A ball
/// rests on no face, so that its axes stay as tracked; corners are rounded of a box alone.
struct Calibration {
  Vector3 turn = Vector3::Zero();  ///< rotation vector of the body's true axes in those tracked, body frame [rad]
  double ground = 0;               ///< height of the ground [m]
  double inertia_factor = 1;       ///< moments of inertia over those of the uniform body
  double rounding = 0;             ///< radius of the corners [m]
};

/// A body as tracks see it.  A corner rounded with radius ρ touches the ground ρ below the corner of a core that is
/// smaller by ρ on every side, so that the touching point lies inside the sharp corner.  A ball touches below its
/// centre; it has one corner by number, 0, which is that point.
class TrackedBody {
 public:
  TrackedBody(const TrackDescription& description, const Calibration& calibration);

  /// Mass, inertia and corners of the core.  A planar body has an inertia alike about all axes: only the one about y
  /// matters.
  [[nodiscard]] const analytic::space::Body& core() const { return core_; }
  /// The same without rounding.
  [[nodiscard]] const analytic::space::Body& sharp() const { return sharp_; }
  [[nodiscard]] const Calibration& calibration() const { return calibration_; }
  /// Outward normals of the faces that it can lie on, body frame; none of a ball.
  [[nodiscard]] const std::vector<Vector3>& faces() const { return faces_; }
  [[nodiscard]] bool is_ball() const { return !core_.ellipsoids.empty(); }
  /// Whether its moments of inertia are alike, so that it turns about a fixed axis in flight.
  [[nodiscard]] bool turns_steadily() const { return turns_steadily_; }
  /// k² = I/m of the uniform body, by which turning is weighed against translation: the same whatever is fitted [m²].
  [[nodiscard]] double gyration_square() const { return gyration_square_; }
  /// Largest distance of a sharp corner from the centre [m].
  [[nodiscard]] double reach() const { return reach_; }

  /// True attitude for a tracked one.
  [[nodiscard]] Quaternion attitude(const Quaternion& tracked) const { return (tracked * turn_).normalized(); }
  /// From the centre to the core's corner, world frame [m].
  [[nodiscard]] Vector3 core_arm(const Quaternion& attitude, int corner) const;
  /// From the centre to the touching point of a corner, world frame [m].
  [[nodiscard]] Vector3 arm(const Quaternion& attitude, int corner) const;
  /// The part of such an arm that turns with the body: none of a ball's, all of it elsewhere.
  [[nodiscard]] Vector3 turning_part(const Vector3& arm) const { return is_ball() ? Vector3(Vector3::Zero()) : arm; }
  /// The corner whose touching point is lowest.
  [[nodiscard]] int lowest(const Quaternion& attitude) const;
  /// The face that looks down most.  Domain: no ball.
  [[nodiscard]] std::size_t down_face(const Quaternion& attitude) const;

 private:
  Calibration calibration_;
  analytic::space::Body core_, sharp_;
  std::vector<Vector3> faces_;
  Quaternion turn_;
  double gyration_square_ = 1, reach_ = 1;
  bool turns_steadily_ = true;
};

/// Ends of the ranges of the angle between arm and vertical [°] by which scores and extremes list measured drops.
inline constexpr double arm_angle_edges[] = {0, 10, 20, 25, 30, 35, 40, 60};

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
/// The middle of a list, and how far its members are spread beyond their own errors, as standard deviation, with the
/// uncertainty of the middle.
struct Middle {
  double value = 0, spread = 0;
};
[[nodiscard]] Middle middle_of(std::vector<double> values, const std::vector<double>& own_errors);
/// The value below which a share of a list lies, between neighbours in proportion; NaN of none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace clatter::validation
