// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/model_hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "analytic/base/errors.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

using numeric::Matrix3;
using numeric::Vector3;

constexpr double same = 1e-9;       // of the body's size: meshes from files carry the rounding of their text
constexpr double cell_size = 1e-3;  // likewise; a vertex near a wall is looked for on both sides of it

std::uint64_t key(const Eigen::Array3d& cells) {
  std::uint64_t hash = 0;
  for (const double coordinate : cells)
    hash = hash * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate));
  return hash;
}

/// Vertices by the cell that they lie in.
class VertexGrid {
 public:
  explicit VertexGrid(const std::vector<Vector3>& vertices) : vertices_(vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) cells_.emplace(key((vertices[i] / cell_size).array().floor()), i);
  }

  [[nodiscard]] bool has(const Vector3& point) const {
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 shift(corner & 1 ? same : -same, corner & 2 ? same : -same, corner & 4 ? same : -same);
      const auto [first, last] = cells_.equal_range(key(((point + shift) / cell_size).array().floor()));
      for (auto found = first; found != last; ++found) {
        if ((vertices_[found->second] - point).cwiseAbs().maxCoeff() <= same) return true;
      }
    }
    return false;
  }

 private:
  const std::vector<Vector3>& vertices_;
  std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

bool moves_in_plane(const numeric::MotionState& state) {
  constexpr double turn_rounding = 1e-14;  // of the turn from body to world components
  const Vector3 rate = state.attitude * state.angular_velocity;
  return std::fabs(state.velocity.y()) <= turn_rounding * state.velocity.norm() &&
         std::hypot(rate.x(), rate.z()) <= turn_rounding * rate.norm();
}

/// Whether the plane through the centre of mass with this normal (body frame) is one of symmetry of the shape.
bool is_mirrored(const numeric::SmoothShape& shape, const Vector3& normal) {
  const Vector3 squares = shape.semiaxes.cwiseProduct(shape.semiaxes).cwiseProduct(normal);
  const double size = shape.reach(), along = std::fabs(normal.x());
  return squares.cross(normal).norm() <= same * size * size && std::fabs(shape.centre.dot(normal)) <= same * size &&
         (shape.straight == 0 || along <= same || along >= 1 - same);
}

}  // namespace

bool is_mirror_image(const numeric::Body& body, const numeric::MotionState& state) {
  if (!moves_in_plane(state)) return false;
  const double size = body.radius();
  const Matrix3 turn = state.attitude.toRotationMatrix();
  const Matrix3 inertia = turn * body.inertia() * turn.transpose();
  if (!(std::hypot(inertia(0, 1), inertia(1, 2)) <= same * body.mass() * size * size)) return false;
  if (body.smooth()) return is_mirrored(*body.smooth(), turn.transpose() * Vector3::UnitY());
  std::vector<Vector3> vertices;
  for (const Vector3& vertex : body.facets().vertices) vertices.emplace_back(turn * vertex / size);
  const VertexGrid grid(vertices);
  for (const Vector3& vertex : vertices) {
    if (!grid.has({vertex.x(), -vertex.y(), vertex.z()})) return false;
  }
  return true;
}

namespace {

using analytic::Drop;
using analytic::ImpactRow;
using analytic::PlanarVelocity;
using analytic::Sequence;

constexpr int most_impacts = 3;
constexpr analytic::VertexSet vertex_a = 1, vertex_b = 2;

double kinetic_energy(const Drop& drop, const PlanarVelocity& v) {
  const double mass = drop.body.mass;
  return 0.5 * mass *
         (v.normal * v.normal + v.tangential * v.tangential + drop.body.gyration_square * v.angular * v.angular);
}

/// The row of impact i from its contact angle, the velocity before it and what the impact did.
ImpactRow row_of(const Drop& drop, int i, double start, double angle, const PlanarVelocity& before,
                 const analytic::Impact& impact) {
  const bool end_a = i != 1;
  ImpactRow row;
  row.start = start;
  row.vertices = end_a ? vertex_a : vertex_b;
  row.inclination = end_a ? angle : -angle;
  row.contact_angle = angle;
  row.before = before;
  row.impact = impact;
  row.centre_height = drop.body.reach() * std::sin(angle);
  const double height = drop.body.mass * drop.gravity * row.centre_height;
  row.energy_before = kinetic_energy(drop, before) + height;
  row.energy_after = kinetic_energy(drop, impact.after) + height;
  row.amplification = std::numeric_limits<double>::quiet_NaN();
  return row;
}

/// Eqs. 8 and 9 at the end that strikes.
analytic::Impact strike_at(const Drop& drop, const ImpactRow& row) {
  const int vertex = row.vertices == vertex_a ? 0 : 1;
  const analytic::ContactPoint end =
      drop.body.contact_point(vertex, std::sin(row.inclination), std::cos(row.inclination));
  return analytic::strike(drop.body, row.before, end, drop.law);
}

/// Contact angles and times, in the drop's units.
struct Instants {
  int count = 1;
  double angle[most_impacts], time[most_impacts];
};

Instants instants_of(const Drop& drop, int impacts) {
  Instants at{.count = 1, .angle = {drop.inclination.radians, 0, 0}, .time = {0, 0, 0}};
  if (impacts == 1) return at;
  const double speed = -drop.velocity.normal, length = 2 * drop.body.reach();
  const analytic::ContactAngles angles =
      contact_angles(drop.inclination, {.gravity_number = drop.gravity * length / (speed * speed),
                                        .restitution = drop.law.restitution,
                                        .impulse_ratio = drop.law.friction_value});
  at.count = std::min(angles.impacts(), impacts);
  at.angle[1] = angles.beta.angle;
  at.angle[2] = angles.gamma.angle;
  at.time[1] = angles.beta.time * length / speed;
  at.time[2] = at.time[1] + angles.gamma.time * length / speed;
  return at;
}

}  // namespace

std::string reason_against_closed_form(const Drop& drop) {
  if (drop.body.vertex_count != 2) return "it is for a thin rod";
  if (drop.velocity.tangential != 0 || drop.velocity.angular != 0) return "it starts from a straight fall";
  if (drop.inclination.radians == 0) return "in it one end strikes first";
  if (drop.law.has_cone()) return "it knows an impulse ratio, not Coulomb's law";
  if (drop.law.law == analytic::RestitutionLaw::viscoelastic && drop.law.damping_per_stiffness > 0)
    return "it has one coefficient of restitution, and damping makes it depend on the speed";
  return "";
}

Sequence closed_form_sequence(const Drop& drop, int impacts) {
  const Instants at = instants_of(drop, impacts);
  Sequence sequence;
  sequence.total_normal_impulse_error = std::numeric_limits<double>::infinity();
  PlanarVelocity velocity = drop.velocity;
  for (int i = 0; i < at.count; ++i) {
    if (i > 0) velocity.normal -= drop.gravity * (at.time[i] - at.time[i - 1]);
    ImpactRow row = row_of(drop, i, at.time[i], at.angle[i], velocity, {});
    row = row_of(drop, i, at.time[i], at.angle[i], velocity, strike_at(drop, row));
    sequence.total_normal_impulse += row.impact.normal_impulse;
    velocity = row.impact.after;
    sequence.rows.push_back(row);
  }
  sequence.outcome = at.count == impacts || at.count == most_impacts ? analytic::Outcome::impact_limit
                                                                     : analytic::Outcome::no_further_impact;
  sequence.message =
      at.count == most_impacts ? "the closed form ends with the third impact" : "the closed form has no further impact";
  if (at.count == impacts) sequence.message = "as many impacts as asked for";
  return sequence;
}

namespace {

using numeric::Method;
using numeric::Simulation;

std::string reason_words(const Scene& scene) {
  const std::string reason = reason_in_space(scene);
  return reason.empty() ? "" : ": " + reason;
}

std::size_t index(ModelLevel level) { return static_cast<std::size_t>(level); }

}  // namespace

const char* level_name(ModelLevel level) {
  switch (level) {
    case ModelLevel::closed_form: return "closed form";
    case ModelLevel::discrete: return "discrete";
    case ModelLevel::discrete_in_space: return "discrete 3D";
    case ModelLevel::planar: return "planar";
    case ModelLevel::spatial: return "spatial";
  }
  return "";
}

const char* level_assumption(ModelLevel level, const numeric::Ground& ground) {
  switch (level) {
    case ModelLevel::closed_form: return "the rod is thin, and nothing strikes after the third impact";
    case ModelLevel::discrete:
    case ModelLevel::discrete_in_space: return "contacts take no time and no depth";
    case ModelLevel::planar: return "the body stays in the plane of its motion";
    case ModelLevel::spatial:
      return ground.is_half_space() ? "the body is rigid, the ground an elastic half-space"
             : ground.is_pad()      ? "the body is rigid, the ground a pad without shear"
                                    : "the body is rigid, the ground a bed of springs and dampers";
  }
  return "";
}

const char* part_name(Part part) {
  switch (part) {
    case Part::friction: return "friction";
    case Part::damping: return "damping";
    case Part::gravity_in_contact: return "gravity during contact";
    case Part::unmerged_faces: return "elements of flat faces";
  }
  return "";
}

bool has_part(const Scene& scene, Part part) {
  switch (part) {
    case Part::friction: return scene.world.ground.has_friction();
    case Part::damping: return scene.world.ground.is_damped();
    case Part::gravity_in_contact: return scene.world.gravity > 0 && scene.world.gravity_in_contact;
    case Part::unmerged_faces: return !scene.body.merge;
  }
  return false;
}

Scene without(Scene scene, Part part) {
  switch (part) {
    case Part::friction: scene.world.ground.static_friction = scene.world.ground.sliding_friction = 0; break;
    case Part::damping: scene.world.ground.damping = scene.world.ground.dissipation = 0; break;
    case Part::gravity_in_contact: scene.world.gravity_in_contact = false; break;
    case Part::unmerged_faces: scene.body.merge = true; break;
  }
  return scene;
}

Scene limited(Scene scene) {
  constexpr long evaluations_per_run = 2'000'000;
  scene.accuracy.evaluation_limit = std::min(scene.accuracy.evaluation_limit, evaluations_per_run);
  return scene;
}

ModelHierarchy::ModelHierarchy(Scene scene, numeric::Observer observer)
    : scene_(std::move(scene)), observer_(std::move(observer)), body_(scene_.make_body()), start_(scene_.start(body_)) {
  find_discrete();
  against_[index(ModelLevel::closed_form)] = find_closed_form();
  against_[index(ModelLevel::planar)] = reason_against_planar();
}

/// The drop in the plane, or else in space.
void ModelHierarchy::find_discrete() {
  std::string &in_plane = against_[index(ModelLevel::discrete)],
              &in_space = against_[index(ModelLevel::discrete_in_space)];
  try {
    const DiscreteDrop drop = DiscreteBody(scene_, body_).drop(scene_);
    if (const auto* const planar = std::get_if<analytic::Drop>(&drop)) {
      drop_ = *planar;
      in_space = "the drop stays in its plane, where the discrete model gives the same";
      return;
    }
    space_drop_ = std::get<analytic::space::Drop>(drop);
    in_plane = "the discrete model is planar: the body moves in space" + reason_words(scene_);
  } catch (const analytic::OutsideModelError& error) {
    in_plane = in_space = error.what();
  }
}

/// The same rod without its radius.
std::string ModelHierarchy::find_closed_form() {
  if (scene_.body.shape != BodyScene::Shape::rod) return "it is for a thin rod";
  if (!drop_) return against(ModelLevel::discrete);
  if (!scene_.body.centre.empty() || !scene_.body.inertia.empty()) return "it is for a uniform rod";
  if (scene_.world.ground.has_friction()) return "it has no friction";
  analytic::Drop thin = *drop_;
  thin.body = analytic::make_rod({.mass = scene_.body.mass, .length = scene_.body.length, .radius = 0});
  if (!scene_.world.ground.is_damped()) thin.law = {};
  const std::string reason = reason_against_closed_form(thin);
  if (reason.empty()) thin_rod_ = thin;
  return reason;
}

std::string ModelHierarchy::reason_against_planar() const {
  if (scene_.world.planar || is_mirror_image(body_, start_)) return "";
  return "the body is not its own mirror image in the plane of its motion";
}

Simulation ModelHierarchy::simulate(const LevelSetting& setting, int impacts) const {
  return simulate(setting, {.impacts = impacts, .error_estimates = false, .amplification = false});
}

Simulation ModelHierarchy::simulate(const LevelSetting& setting, const numeric::Request& request) const {
  numeric::World world = scene_.world;
  world.planar = setting.level == ModelLevel::planar;
  numeric::Accuracy accuracy = scene_.accuracy;
  accuracy.method = setting.method;
  accuracy.tolerance = setting.step > 0 ? 0 : setting.tolerance;
  accuracy.step = setting.step;
  return numeric::simulate(body_, world, start_, request, accuracy, observer_);
}

LevelResult ModelHierarchy::run(const LevelSetting& setting, int impacts) const {
  const auto of = [](const auto& sequence) -> LevelResult {
    return {motion_rows(run_of(sequence)), sequence.root_evaluations, sequence.message};
  };
  const analytic::SequenceOptions options{.impacts = impacts, .amplification = false};
  if (setting.level == ModelLevel::closed_form) return of(closed_form_sequence(*thin_rod_, impacts));
  if (setting.level == ModelLevel::discrete) return of(impact_sequence(*drop_, options));
  if (setting.level == ModelLevel::discrete_in_space) return of(impact_sequence(*space_drop_, options));
  const Simulation run = simulate(setting, impacts);
  return {motion_rows(run_of(run)), run.force_evaluations, std::string(outcome_name(run)) + ": " + run.message};
}

Truth true_values(const ModelHierarchy& hierarchy, double trusted) {
  Truth truth;
  truth.setting = {.level = hierarchy.full(), .method = Method::rk8pd, .tolerance = numeric::least_tolerance};
  const int impacts = hierarchy.scene().request.impacts;
  const Simulation run = hierarchy.simulate(truth.setting, impacts);
  if (is_cut_short(run.outcome)) truth.cut_short = fmt::format("{}: {}", outcome_name(run), run.message);
  if (run.impacts.empty()) return truth;
  LevelSetting coarser = truth.setting;
  coarser.tolerance *= 30;
  const Simulation other = hierarchy.simulate(coarser, impacts);
  truth.sizes = motion_sizes(run, run.impacts.size(), hierarchy.body());
  truth.contact_time = run.impacts[0].value.duration;
  const auto rows = motion_rows(run_of(run)), others = motion_rows(run_of(other));
  for (std::size_t i = 0; i < std::min(rows.size(), others.size()); ++i) {
    const double error = row_distance(rows[i], others[i], truth.sizes);
    if (!(error <= trusted) || run.impacts[i].end != other.impacts[i].end) break;
    truth.error = std::max(truth.error, error);
    truth.rows.push_back(rows[i]);
  }
  if (!truth.rows.empty()) truth.sizes = motion_sizes(run, truth.rows.size(), hierarchy.body());
  return truth;
}

}  // namespace clatter::validation
