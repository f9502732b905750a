// SPDX-License-Identifier: GPL-3.0-or-later
// A scene: what falls, how, on what ground, and what is asked of either model.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analytic/plane/impact.hpp"
#include "numeric/simulate.hpp"
#include "validation/output/value.hpp"
#include "validation/scene/scene_values.hpp"

namespace clatter::validation {

/// A flag as given, and the key of the scene file that it overrides.
struct SceneOverride {
  std::string key, flag, text;
};

/// What a scene says of the discrete model's impacts; what it leaves out comes from the ground (discrete_law).
struct DiscreteImpact {
  std::optional<double> restitution;
  std::optional<analytic::RestitutionLaw> law;
  std::optional<double> impulse_ratio, friction;
  bool is_moreau = false;  ///< friction judged by the slip after the impact
};

/// The mesh of a body's file, read once for all who ask (body_properties.cpp).
class MeshFile;

/// What a shape of bodies is and has: the one table of shapes, in the order of BodyScene::Shape.
struct ShapeTraits {
  const char* name;    ///< in scene files, flags and JSON
  bool is_polyhedron;  ///< its corners, mass and inertia are those of a surface
  bool is_round;       ///< without vertices
  bool has_length, has_radius, has_size;
  bool has_sectors;  ///< its mesh is one around an axis
};
inline constexpr ShapeTraits shape_traits[]{
    {"rod", false, false, true, true, false, true},       {"box", false, false, false, false, true, false},
    {"mesh", true, false, false, false, false, false},    {"sphere", false, true, false, true, false, true},
    {"ellipsoid", false, true, false, false, true, true}, {"capsule", false, true, true, true, false, true}};

/// What the body is made of.
struct BodyScene {
  enum class Shape { rod, box, mesh, sphere, ellipsoid, capsule } shape = Shape::rod;
  double mass = 1;                      ///< [kg]
  double length = 1, radius = 0;        ///< of a rod, radius 0: a thin one; of a capsule, over all [m]
  numeric::Vector3 size{0, 0, 0};       ///< of a box, or the axes of an ellipsoid [m]
  int sectors = 0;                      ///< around the mesh of what is round; 0: as meshed_sectors() says
  int rings = 0;                        ///< of that mesh, from a rod's axis outward, else from pole to equator; 0: 4
  int layers = 30;                      ///< of a rod's mesh
  int nx = 1, ny = 1, nz = 1;           ///< of a box's mesh
  std::string file;                     ///< triangles (STL, OBJ, ...) or what Gmsh reads, resolved
  std::shared_ptr<MeshFile> mesh_file;  ///< shared by copies of the scene
  double unit = 1;                      ///< of the file's coordinates [m]
  bool has_unit = false;                ///< it is given, and goes before one that the file names
  double weld = 1e-6;                   ///< numeric::RepairOptions::weld
  bool strict = false;                  ///< numeric::RepairOptions::strict
  std::optional<double> density;        ///< of a file's body, instead of a mass [kg/m³]
  /// About the centre of mass, axes of the body frame: three principal moments, or xx, yy, zz, xy, xz, yz [kg·m²];
  /// empty: that of the uniform body about its own centre, wherever `centre` has moved the mass to.
  std::vector<double> inertia;
  /// The centre of mass, from the geometric centre of a rod or box [m], of a mesh in the file's frame and unit; empty:
  /// that of the enclosed volume.
  std::vector<double> centre;
  bool merge = true;

  /// Whether the file has triangles, of which neither mass nor density follows.
  [[nodiscard]] bool is_surface() const;
  [[nodiscard]] const ShapeTraits& traits() const { return shape_traits[static_cast<std::size_t>(shape)]; }
  [[nodiscard]] bool is_polyhedron() const { return traits().is_polyhedron; }
  [[nodiscard]] bool is_round() const { return traits().is_round; }
  [[nodiscard]] bool has_length() const { return traits().has_length; }
  [[nodiscard]] bool has_radius() const { return traits().has_radius; }
  [[nodiscard]] bool has_size() const { return traits().has_size; }
  /// Extents along the body axes, of a rod or capsule with this radius [m].  Domain: no mesh.
  [[nodiscard]] numeric::Vector3 extents(double of_radius) const;
  /// A rod without thickness, which the continuous model gives `meshed_radius()`.
  [[nodiscard]] bool is_thin_rod() const { return shape == Shape::rod && !(radius > 0); }
  /// The radius of the rod's mesh, 0.01 of the length of a thin one [m].
  [[nodiscard]] double meshed_radius() const { return is_thin_rod() ? 0.01 * length : radius; }
  /// The sectors of a mesh around an axis: the paper's 16, but 64 where a rod's rim is so wide beside the length that
  /// its corners turn the body noticeably otherwise than the rim does.
  [[nodiscard]] int own_sectors() const;
  /// Those that the scene gives, or else these.
  [[nodiscard]] int meshed_sectors() const { return sectors > 0 ? sectors : own_sectors(); }
  [[nodiscard]] int meshed_rings() const { return rings > 0 ? rings : 4; }
  /// Whether the continuous model takes the round shape itself: where no mesh is given for it.
  [[nodiscard]] bool is_smooth() const { return is_round() && sectors == 0 && rings == 0; }
};

/// A pad by its curve, from which settle_pad() makes the ground's springs.
struct PadScene {
  using Points = std::vector<std::array<double, 2>>;
  /// Depth [m], or with `thickness` and no other unit strain, and pressure [Pa]; empty: no pad.
  Points curve;
  std::string file;                 ///< that has the curve: resolved; empty: the scene has it
  std::string units;                ///< of both, "%,kPa"; of a settled curve "m,Pa" or "1,Pa"; empty: as said elsewhere
  std::optional<double> thickness;  ///< [m]
  std::optional<double> under;      ///< stiffness beyond the last point [Pa/m]; none: that before it
};

/// An elastic half-space by the moduli E/(1 − ν²) of ground and body, from which settle_half_space() makes E*.
struct HalfSpaceScene {
  double modulus = 0;                  ///< of the ground, or E* where the body has none [Pa]; 0: none
  std::optional<std::size_t> floor;    ///< of floors(), in its place
  std::optional<double> body_modulus;  ///< [Pa]
  /// One of body_materials(), in its place; beside a floor the first unless the body is named.
  std::optional<std::size_t> body_material;
};

/// Values of one quantity for which the drop is repeated: a list, or those from `from` to `to` by equal steps, equal
/// distances or equal ratios.
struct SceneSweep {
  enum class Quantity { angle_deg, friction } quantity = Quantity::angle_deg;
  double from = 0, to = 0;       ///< of a list the least and the largest
  double step = 0;               ///< from one value to the next, `to` at most; 0: by `count`
  long long count = 0;           ///< of the values, both ends taken; 0: by `step`
  bool logarithmic = false;      ///< with `count`: equal ratios
  std::vector<double> listed{};  ///< the values themselves, in place of a grid
  [[nodiscard]] std::vector<double> values() const;
  /// Key of the scene file under "sweep", and the quantity's name in JSON and CSV.
  [[nodiscard]] const std::string& name() const;
  /// As a scene file has it: an array, or an object with from and to.
  [[nodiscard]] Value fields() const;
};

/// The model that a scene is read for.  The discrete one needs no ground.
enum class Model { discrete, continuous };
/// In the order of Model.
inline const std::vector<std::string> model_names{"discrete", "continuous"};
[[nodiscard]] inline const std::string& name_of(Model model) { return model_names[static_cast<std::size_t>(model)]; }

/// How a body is let go that flies freely, turning, to its first touch.
struct Release {
  std::optional<double> height;          ///< of the centre of mass [m]
  std::optional<double> clearance;       ///< of the lowest point, instead [m]
  std::optional<double> angle_deg;       ///< turn about −y, of any size [°]
  std::vector<double> attitude;          ///< Euler parameters, instead; empty, without an angle too: that of the drop
  std::vector<double> velocity;          ///< of the centre of mass, world [m/s]; empty: none
  std::optional<double> spin;            ///< about y, as Ω in Eq. 8 [rad/s]
  std::vector<double> angular_velocity;  ///< instead, world components [rad/s]; empty: none
};

/// Names of keys of which nothing is to be said, since their values are not those of every scene of a sweep.
using KeyNames = std::vector<std::string>;

/// A checked scene.
struct Scene {
  std::string path;
  /// Turn about −y, after one of tilt_deg about the body's x axis.  With `attitude` its turn about −y if it is no more.
  double angle_deg = 0, tilt_deg = 0;
  std::vector<double> attitude;  ///< Euler parameters, body → world, scalar first, about unit length; empty: by angles
  std::optional<double> orientation;  ///< of a box, in 1..26 (orientation.hpp); gives `attitude`, by settle()
  double speed = 1;                   ///< of the centre of mass at the first touch, downward [m/s]
  std::optional<double> height;       ///< of the centre of mass at release, if given [m]
  std::optional<double> clearance;    ///< of the lowest point at release, if given [m]
  std::optional<double> topple;       ///< raised height of end a at release; gives both velocities, by settle() [m]
  double tangential_velocity = 0;     ///< [m/s]
  double spin = 0;                    ///< [rad/s]
  /// The velocity of the centre of mass at the first touch, world [m/s]; empty: (tangential_velocity, 0, −speed).
  std::vector<double> velocity;
  std::vector<double> angular_velocity;  ///< at the first touch, world components [rad/s]; empty: (0, spin, 0)
  Release release;  ///< with a height or clearance: attitude and velocities are those at release, by settle()
  DiscreteImpact impact;
  BodyScene body;
  numeric::World world;                      ///< a ground of stiffness 0: none given, for the discrete model
  PadScene pad;                              ///< what a ground with kinks was made of
  HalfSpaceScene half_space;                 ///< what a ground with a modulus was made of
  std::optional<double> ground_restitution;  ///< at the first approach, which gives the ground's damping
  numeric::Request request;  ///< with starts_on_ground the body lies still there, but for what drags and turns it
  numeric::Accuracy accuracy;
  bool until_rest = false;      ///< the discrete model goes on until nothing follows, whatever request.impacts is
  std::vector<double> times;    ///< times at which the state is wanted [s]
  double rate = 0;              ///< of further ones, equally far apart from 0 on; 0: none [Hz]
  bool require_digits = false;  ///< fewer known digits are exit status 3
  std::string history;          ///< file for the time history; empty: none
  std::optional<SceneSweep> sweep;

  [[nodiscard]] bool has_ground() const { return world.ground.stiffness > 0 || world.ground.modulus > 0; }
  /// Most impacts of the discrete model.
  [[nodiscard]] int most_impacts() const;
  /// Whether states are wanted.
  [[nodiscard]] bool has_times() const { return !times.empty() || rate > 0; }
  /// Whether the body falls from rest, from a height or clearance.
  [[nodiscard]] bool falls() const { return height || clearance; }
  /// Whether it flies freely from a release.
  [[nodiscard]] bool is_released() const { return release.height || release.clearance; }
  /// The scene with the swept quantity at one value, and no sweep.
  [[nodiscard]] Scene at(double value) const;
  [[nodiscard]] numeric::Body make_body() const;
  /// Takes `attitude` from `orientation`, `angle_deg` from the attitude, the velocities from `topple`, all three from
  /// `release`, and the ground from half-space or pad, where they are given.
  /// @throws BadInput if the orientation is no whole number, or the body no box; as toppled().
  void settle();
  /// Gives the ground the damping c_G, or a half-space or pad the dissipation τ, with which a contact that approaches
  /// as fast as the first one has `ground_restitution`:  s(e) = τ v  (viscoelastic.hpp).  Nothing without that or a
  /// ground.
  /// @throws as start()
  void settle_restitution();
  /// Body → world; unit.  Here and in the velocities: at the release, where there is one.
  [[nodiscard]] Eigen::Quaterniond touch_attitude() const;
  /// The velocity of the centre of mass at the first touch, world [m/s]; with `height`, not with `clearance`, the speed
  /// is not yet that of the fall.
  [[nodiscard]] numeric::Vector3 touch_velocity() const;
  [[nodiscard]] numeric::Vector3 touch_angular_velocity() const;  ///< world components [rad/s]
  /// Height of the centre of mass at the release, if it is `touch` when the lowest point touches [m].
  /// @throws BadInput if it is not above that.
  [[nodiscard]] double release_height(double touch) const;
  /// State at the first touch; with `height` the speed there follows from the fall, with `release` all of it from the
  /// free flight.
  /// @param fall  set to the time since the release, 0 where neither `height` nor `release` tells it [s]
  /// @throws BadInput if a height is not above that at the touch, no touching vertex comes down, or none ever touches.
  [[nodiscard]] numeric::MotionState start(const numeric::Body& body, double* fall = nullptr) const;
  /// Downward speed after a fall from `height`, of a centre of mass that is `touch` [m] above the ground at the first
  /// touch [m/s].  @throws BadInput if `height` is not above that.
  [[nodiscard]] double fallen_speed(double touch) const;
  /// Whether attitude, velocity or angular velocity are given as vectors.
  [[nodiscard]] bool has_vectors() const;
  /// How the body comes to the ground, for a reader, without what is zero and without what `unsettled` keys say.
  [[nodiscard]] std::string drop_words(const KeyNames& unsettled = {}) const;
  /// The scene for a reader: a few lines, without the discrete model's law and without what `unsettled` keys say.
  [[nodiscard]] std::vector<std::string> summary(Model model = Model::continuous, const KeyNames& unsettled = {}) const;
};

/// Motion of the centre of mass and turn, world.
struct TouchMotion {
  numeric::Vector3 velocity, angular_velocity;  ///< [m/s], [rad/s]
};
/// The motion of a rod or box that lies on a face as it arrives there, when it turned about its lower edge on the side
/// of +x, which neither slipped nor lifted off, from rest with the opposite lower edge raised by H = scene.topple:
///     ½ ω² (k_y² + b² + h²) = g (b sin φ − h (1 − cos φ)),   sin φ = H/D,
/// with the centre of mass b [m] beside that edge and h above it, and D the face's length along x.  The edge comes down
/// at 1e-12 of the speeds, so that the face lands as a whole where pushes can do that.
/// @throws BadInput if the body is neither rod nor box or no face of it is level, or if H is beyond D b/√(b² + h²),
///         where the centre of mass stands above the edge; as body_properties.
[[nodiscard]] TouchMotion toppled(const Scene& scene);

/// The values of a scene file, of a case that comes with the program (by its name, "phone-damped"), or of neither ("":
/// flags alone), to be read with one set of overrides after another.  @throws BadInput as SceneValues.
[[nodiscard]] SceneValues scene_values(const std::string& source);

/// @throws BadInput with one line "file:line:column: key ..." or "--flag ...".
[[nodiscard]] Scene read_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides, Model model);
/// The same for one of many scenes, which is itself to say that it topples too far or that its first contact does not
/// come down: then its ground has no damping from ground.restitution.
[[nodiscard]] Scene read_scene_of_any_motion(const SceneValues& values, const std::vector<SceneOverride>& overrides,
                                             Model model);
[[nodiscard]] Scene read_scene(const std::string& source, const std::vector<SceneOverride>& overrides,
                               Model model = Model::continuous);

/// For a command that takes level ground alone.  @throws BadInput if the scene's ground slopes
void require_level(const Scene& scene, const std::string& command);

/// Names of the cases that come with the program.
[[nodiscard]] std::vector<std::string> case_names();
/// The text of a case.  @throws BadInput if there is none of this name, with the nearest.
[[nodiscard]] std::string_view case_text(const std::string& name);
/// What to type for the scene whose path this is, in any folder: the name of a case, or the path of any other file.
[[nodiscard]] std::string name_of_source(const std::string& path);
/// The scene of a case.  @throws as case_text
[[nodiscard]] Scene case_scene(const std::string& name, const std::vector<SceneOverride>& overrides = {});

/// The restitution law: that of [impact]; else Newton's with a restitution or without a ground; else the ground's.
[[nodiscard]] analytic::RestitutionLaw restitution_law(const Scene& scene);
/// Whether friction is left to the ground, and the ground has some.
[[nodiscard]] bool takes_friction_of_ground(const Scene& scene);
[[nodiscard]] const char* method_name(numeric::Method method);
[[nodiscard]] const char* law_name(analytic::RestitutionLaw law);

}  // namespace clatter::validation
