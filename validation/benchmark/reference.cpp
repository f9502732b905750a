// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic/base/errors.hpp"
#include "analytic/plane/sequence.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/landing/level_rim.hpp"
#include "analytic/space/landing/simultaneous.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

const std::string folder = "validation/benchmark/problems/";
const std::vector<std::string> texts{"id", "title", "class", "motivation", "separates", "acceptance"};
const std::vector<std::string> numbers{"t",  "Px", "Py", "Pz", "Vx",       "Vy",
                                       "Vz", "Wx", "Wy", "Wz", "duration", "uncertainty"};

std::vector<std::string> known_keys() {
  std::vector<std::string> keys = scene_keys();
  for (const std::string& text : texts) keys.push_back("problem." + text);
  for (const char* key : {"version", "gaps", "until", "tolerances", "energy_alone", "at_rest", "end_energy",
                          "ground_end", "laws_agree"}) {
    keys.push_back(std::string("problem.") + key);
  }
  return keys;
}

Problem read_problem(const EmbeddedFile& file) {
  constexpr Range positive{0, 1e9, false, "at least 0"};
  const std::string path(file.name);
  const SceneValues values(path, file.text, known_keys());
  Problem problem;
  problem.id = values.text("problem.id");
  problem.version = static_cast<int>(values.integer("problem.version", 1, 1, 1000));
  problem.title = values.text("problem.title");
  problem.motivation = values.text("problem.motivation");
  problem.separates = values.text("problem.separates");
  problem.acceptance = values.text("problem.acceptance");
  problem.is_compliant = values.text("problem.class") == "compliant";
  problem.energy_alone = values.truth("problem.energy_alone", false);
  problem.at_rest = values.truth("problem.at_rest", false);
  constexpr Range finite{-1e9, 1e9, false, "finite"};
  if (values.has("problem.end_energy")) problem.end_energy = values.number("problem.end_energy", 0, finite);
  if (values.has("problem.ground_end")) problem.ground_end = values.number("problem.ground_end", 0, finite);
  problem.gaps = values.numbers("problem.gaps", {1, 2, 3, 4, 5, 6, 7, 8}, positive, "heights in m");
  problem.tolerances = values.numbers("problem.tolerances", {4}, positive, "four errors");
  if (values.has("problem.until")) problem.until = values.number("problem.until", 0, positive);
  problem.scene = read_discrete_scene(values, {}).scene;
  problem.scene_text = file.text.substr(file.text.find("[drop]"));
  return problem;
}

const NumericTable& truth_table() {
  static const NumericTable table = NumericTable::parse(
      "validation/benchmark/truth.csv", std::string(embedded_text("validation/benchmark/truth.csv")),
      {.required = numbers, .optional = {"n"}, .words = {"problem", "law", "place"}, .names = {}});
  return table;
}

std::vector<std::size_t> rows_of(const Problem& problem, const std::string& law) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < truth_table().rows(); ++i) {
    if (truth_table().word(i, "problem") == problem.id && truth_table().word(i, "law") == law) rows.push_back(i);
  }
  return rows;
}

}  // namespace

const std::vector<Problem>& benchmark_problems() {
  static const std::vector<Problem> problems = [] {
    std::vector<Problem> all;
    for (const EmbeddedFile& file : embedded_files()) {
      if (file.name.starts_with(folder)) all.push_back(read_problem(file));
    }
    std::sort(all.begin(), all.end(), [](const Problem& a, const Problem& b) { return a.id < b.id; });
    return all;
  }();
  return problems;
}

const Problem& problem_named(const std::string& where, const std::string& id) {
  std::vector<std::string> ids;
  for (const Problem& problem : benchmark_problems()) {
    if (problem.id == id) return problem;
    ids.push_back(problem.id);
  }
  std::string printable = id.substr(0, 40);
  for (char& c : printable) c = c < ' ' || c > '~' ? '?' : c;
  throw BadInput(fmt::format("{}: no problem {}; did you mean {}?", where, printable.empty() ? "(empty)" : printable,
                             nearest_name(id, ids)));
}

std::vector<std::string> truth_laws(const Problem& problem) {
  std::vector<std::string> laws;
  for (std::size_t i = 0; i < truth_table().rows(); ++i) {
    const std::string& law = truth_table().word(i, "law");
    if (truth_table().word(i, "problem") != problem.id) continue;
    if (std::find(laws.begin(), laws.end(), law) == laws.end()) laws.push_back(law);
  }
  return laws;
}

std::vector<TruthRow> truth_of(const Problem& problem, const std::string& law) {
  std::vector<TruthRow> rows;
  const NumericTable& table = truth_table();
  const auto number = [&](std::size_t row, const char* name) { return table.at(row, table.column(name).value()); };
  for (const std::size_t i : rows_of(problem, law)) {
    rows.push_back({.place = table.word(i, "place"),
                    .time = number(i, "t"),
                    .duration = number(i, "duration"),
                    .impulse = {number(i, "Px"), number(i, "Py"), number(i, "Pz")},
                    .velocity = {number(i, "Vx"), number(i, "Vy"), number(i, "Vz")},
                    .angular_velocity = {number(i, "Wx"), number(i, "Wy"), number(i, "Wz")},
                    .uncertainty = number(i, "uncertainty")});
  }
  return rows;
}

std::vector<std::vector<std::string>> truth_digits(const Problem& problem, const std::string& law) {
  std::vector<std::vector<std::string>> all;
  const NumericTable& table = truth_table();
  for (const std::size_t i : rows_of(problem, law)) {
    std::vector<std::string>& row = all.emplace_back();
    for (std::size_t k = 0; k + 1 < numbers.size(); ++k) row.push_back(table.field(i, numbers[k]));
  }
  return all;
}

std::string oracle_of(const Problem& problem) {
  if (problem.is_compliant)
    return "50-digit arithmetic: exact integrals of the pressure, Taylor series in time; second route: the simulator";
  if (problem.scene.body.is_round())
    return "50-digit arithmetic: closed forms of a ball's impact and flight; second route: the discrete model in space";
  if (truth_of(problem, truth_laws(problem).front()).front().place.find(' ') != std::string::npos) {
    return "50-digit arithmetic: closed forms of a level landing that friction stops; second route: the discrete model "
           "in space";
  }
  if (problem.scene.has_vectors()) {
    return "50-digit arithmetic: impulses from the 3 x 3 inverse contact inertia, Taylor series of flights and slip; "
           "second route: closed forms of the discrete model";
  }
  return "50-digit arithmetic: Eq. 8 piece by piece, roots of the height with a bound on its curvature; second route: "
         "the discrete model";
}

namespace {

namespace space = analytic::space;
using space::Matrix3;
using space::State;
using space::Vector3;

constexpr double level_slope = 1e-6;  ///< of a rim that lies level in the rows of a run [rad]

DeclaredLaw declared(const std::string& name, const analytic::ImpactLaw& base) {
  DeclaredLaw declared{.name = name, .law = {}};
  declared.law = base;
  if (name == "any") return declared;
  declared.law.law = name.starts_with("poisson")   ? analytic::RestitutionLaw::poisson
                     : name.starts_with("stronge") ? analytic::RestitutionLaw::stronge
                                                   : analytic::RestitutionLaw::newton;
  declared.is_moreau = name.ends_with("moreau");
  return declared;
}

/// The same body in space, with its plane's moment of inertia about every axis, so that it turns about y alone.
space::Body in_space(const analytic::PlanarBody& planar) {
  space::Body body{
      .mass = planar.mass, .inertia = planar.inertia() * space::Matrix3::Identity(), .vertices = {}, .rims = {}};
  for (int i = 0; i < planar.vertex_count; ++i) {
    const analytic::Vertex& vertex = planar.vertices[static_cast<std::size_t>(i)];
    body.vertices.emplace_back(vertex.x, 0, vertex.z);
  }
  return body;
}

void set_planar(Reference& reference, const analytic::Drop& drop) {
  reference.body = in_space(drop.body);
  reference.principal = space::PrincipalAxes(reference.body.inertia);
  for (int i = 0; i < drop.body.vertex_count; ++i)
    reference.points.push_back(analytic::PlanarBody::vertex_set_name(static_cast<analytic::VertexSet>(1 << i)));
  const double half = drop.inclination.radians / 2;
  reference.start.attitude = space::Quaternion(std::cos(half), 0, -std::sin(half), 0);
  reference.start.velocity = {drop.velocity.tangential, 0, drop.velocity.normal};
  reference.start.angular_velocity = {0, drop.velocity.angular, 0};
  reference.gravity = drop.gravity;
  reference.gravity_along = drop.gravity_along;
}

void set_space(Reference& reference, const Scene& scene, const space::Drop& drop) {
  reference.is_planar = false;
  reference.body = drop.body;
  reference.principal = space::PrincipalAxes(drop.body.inertia);
  for (std::size_t i = 0; i < drop.body.vertices.size(); ++i)
    reference.points.push_back(corner_name(scene, {static_cast<int>(i), drop.body.vertices[i]}));
  for (const space::Rim& rim : drop.body.rims) reference.points.push_back(corner_name(scene, {0, rim.centre}));
  for (const auto& [centre, axes] : drop.body.ellipsoids) reference.points.push_back(corner_name(scene, {0, centre}));
  reference.start.attitude = drop.attitude.normalized();
  reference.start.velocity = drop.velocity;
  reference.start.angular_velocity = drop.angular_velocity;
  reference.gravity = drop.gravity;
  reference.gravity_along = drop.gravity_along;
}

/// Puts the lowest point on the ground.
void touch_down(Reference& reference) {
  double lowest = 0;
  for (const Vector3& arm : reference.arms(reference.start.attitude)) lowest = std::fmin(lowest, arm.z());
  reference.start.position.z() = -lowest;
}

void add_states(const Reference& reference, ReferenceSequence& sequence) {
  space::State state = reference.start;
  double time = 0;
  for (const TruthRow& row : sequence.truth) {
    state = reference.flight(state).at(row.time - time);
    time = row.time;
    state.velocity = row.velocity;
    state.angular_velocity = row.angular_velocity;
    sequence.after.push_back(state);
  }
}

// Rows from the first that cannot be predicted on are no truth.

std::vector<TruthRow> planar_truth(const analytic::Drop& drop, int impacts) {
  const analytic::Sequence sequence = impact_sequence(drop, {.impacts = impacts});
  std::vector<TruthRow> rows;
  for (const analytic::ImpactRow& row : sequence.rows) {
    if (!row.error.predictable) break;
    const analytic::PlanarVelocity& after = row.impact.after;
    rows.push_back({.place = analytic::PlanarBody::vertex_set_name(row.vertices),
                    .time = row.start,
                    .impulse = {row.impact.tangential_impulse, 0, row.impact.normal_impulse},
                    .velocity = {after.tangential, 0, after.normal},
                    .angular_velocity = {0, after.angular, 0},
                    .uncertainty = row.error.start});
  }
  return rows;
}

std::vector<TruthRow> space_truth(const Reference& reference, const space::Drop& drop, int impacts) {
  const space::Sequence sequence = impact_sequence(drop, {.impacts = impacts});
  std::vector<TruthRow> rows;
  for (const space::ImpactRow& row : sequence.rows) {
    if (!row.error.predictable) break;
    std::vector<int> group;
    for (const space::Corner& corner : row.corners) group.push_back(corner.index);
    std::sort(group.begin(), group.end());
    rows.push_back({.place = reference.place_name(group),
                    .time = row.start,
                    .impulse = row.group ? row.group->impulse : row.impact.impulse,
                    .velocity = row.impact.velocity_after,
                    .angular_velocity = row.impact.angular_velocity_after,
                    .uncertainty = row.error.start});
  }
  return rows;
}

/// Slip in a direction all through the impact, and what it leaves.
struct Slip {
  Vector3 impulse, after;
  double across;  ///< of the slip left over, across the direction
};

Slip slip_along(double angle, const Matrix3& w, const Vector3& v, const analytic::ImpactLaw& law) {
  const Vector3 direction(std::cos(angle), std::sin(angle), 0);
  const Vector3 rate = w * (Vector3::UnitZ() - law.friction_value * direction);
  const double normal = -(1 + law.restitution) * v.z() / rate.z();
  const Vector3 after = v + normal * rate;
  return {normal * (Vector3::UnitZ() - law.friction_value * direction), after, direction.cross(after).z()};
}

bool goes_along(const Slip& slip, double angle) {
  return slip.impulse.z() > 0 && slip.after.x() * std::cos(angle) + slip.after.y() * std::sin(angle) >= 0;
}

Matrix3 inverse_inertia(const Reference& reference, const State& state) {
  const Matrix3 turned = state.attitude.toRotationMatrix();
  return turned * reference.body.inertia.inverse() * turned.transpose();
}

/// Moreau's impulse of one contact: Newton's restitution and Coulomb's cone for the velocity at the end,
///     v′ = v + W P,   v′_n = −e v_n,   |P_t| <= μ P_n,   P_t = −μ P_n v′_t/|v′_t| where v′_t ≠ 0.        (1)
/// Source: Moreau (1988), with e_t = 0.
/// @pre v_n < 0
/// @throws NumericalError if no direction of slip satisfies (1).
Vector3 moreau_impulse(const Matrix3& w, const Vector3& v, const analytic::ImpactLaw& law) {
  const Vector3 sticking = w.inverse() * Vector3(-v.x(), -v.y(), -(1 + law.restitution) * v.z());
  if (sticking.head<2>().norm() <= law.friction_value * sticking.z()) return sticking;
  constexpr int parts = 720;
  const double part = 2 * std::numbers::pi / parts;
  // In the plane the direction is exactly 0 or π.
  for (const double angle : {0.0, std::numbers::pi}) {
    const Slip slip = slip_along(angle, w, v, law);
    if (std::fabs(slip.across) <= 1e-15 * v.norm() && goes_along(slip, angle))
      return {slip.impulse.x(), 0, slip.impulse.z()};
  }
  for (int i = 0; i < parts; ++i) {
    double low = i * part, high = (i + 1) * part;
    const bool is_left = slip_along(low, w, v, law).across > 0;
    if (is_left == (slip_along(high, w, v, law).across > 0) || !goes_along(slip_along(low, w, v, law), low)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (is_left == (slip_along(middle, w, v, law).across > 0) ? low : high) = middle;
    }
    return slip_along(low, w, v, law).impulse;
  }
  throw analytic::NumericalError("no direction of slip satisfies Moreau's law");
}

State moreau_map(const Reference& reference, const analytic::ImpactLaw& law, const State& before, const Vector3& arm) {
  const Vector3 velocity = before.velocity + before.angular_velocity.cross(arm);
  State after = before;
  if (!(velocity.z() < 0)) return after;
  const Matrix3 inverse = inverse_inertia(reference, before);
  const Vector3 impulse =
      moreau_impulse(space::inverse_contact_inertia(reference.body.mass, inverse, arm), velocity, law);
  after.velocity += impulse / reference.body.mass;
  after.angular_velocity += inverse * arm.cross(impulse);
  return after;
}

/// Two points of a planar body that land together, as the plane's model has them: friction may act below the centre of
/// mass without turning the body.  Nothing where they strike one after the other.
std::optional<State> flat_map(const Reference& reference, const analytic::ImpactLaw& law, const State& before,
                              const Vector3& first, const Vector3& second) {
  const analytic::PlanarBody body{.mass = reference.body.mass,
                                  .gyration_square = reference.body.inertia(1, 1) / reference.body.mass};
  const analytic::PlanarVelocity velocity{
      .normal = before.velocity.z(), .tangential = before.velocity.x(), .angular = before.angular_velocity.y()};
  const auto impact = strike_flat(body, velocity, {.tangential = first.x(), .normal = first.z()},
                                  {.tangential = second.x(), .normal = second.z()}, law);
  if (!impact) return {};
  State after = before;
  after.velocity = {impact->after.tangential, 0, impact->after.normal};
  after.angular_velocity = {0, impact->after.angular, 0};
  return after;
}

}  // namespace

double Reference::speed() const { return start.velocity.norm() + start.angular_velocity.norm() * reach(); }

double Reference::energy(const space::State& state) const {
  const Vector3 rate = state.attitude.conjugate() * state.angular_velocity;
  return (body.mass * state.velocity.squaredNorm() + rate.dot(body.inertia * rate)) / 2 +
         potential(state.position.x(), state.position.z());
}

double Reference::last_energy(const ReferenceSequence& sequence) const {
  if (end_energy) return *end_energy;
  return at_rest ? body.mass * gravity * start.position.z() : energy(sequence.after.back());
}

space::FreeFlight Reference::flight(const space::State& state) const {
  return {principal, state, gravity, gravity_along};
}

space::State Reference::struck(const space::State& state, int point, const Vector3& impulse) const {
  space::State after = state;
  after.velocity += impulse / body.mass;
  const Vector3 arm = arms(state.attitude)[static_cast<std::size_t>(point)];
  const Vector3 moment = state.attitude.conjugate() * arm.cross(impulse);
  after.angular_velocity += state.attitude * (body.inertia.inverse() * moment);
  return after;
}

std::string Reference::place_name(const std::vector<int>& group) const {
  if (is_planar && group.size() != 1) {
    analytic::VertexSet set = 0;
    for (const int point : group) set = static_cast<analytic::VertexSet>(set | 1 << point);
    return group.empty() ? "?" : analytic::PlanarBody::vertex_set_name(set);
  }
  std::string words;
  for (const int point : group) words += (words.empty() ? "" : " ") + points[static_cast<std::size_t>(point)];
  return group.empty() ? "?" : words;
}

std::optional<std::vector<int>> Reference::place_named(const std::string& place) const {
  const int count = static_cast<int>(points.size());
  if (!is_planar) {
    std::vector<int> group;
    const std::string words = " " + place + " ";
    for (int i = 0; i < count; ++i) {
      if (words.find(" " + points[static_cast<std::size_t>(i)] + " ") != std::string::npos) group.push_back(i);
    }
    return !group.empty() && place_name(group) == place ? std::optional(group) : std::nullopt;
  }
  for (int i = 0; i < count; ++i) {
    if (place_name({i}) == place) return std::vector<int>{i};
    for (int j = i + 1; j < count; ++j) {
      if (place_name({i, j}) == place) return std::vector<int>{i, j};
    }
  }
  return std::nullopt;
}

space::Corner Reference::corner(const space::Quaternion& attitude, int point) const {
  const auto rim = static_cast<std::size_t>(point) - body.vertices.size();
  if (rim < body.rims.size() && steepness(body, attitude, point) <= level_slope)
    return {.index = point, .place = body.rims[rim].centre, .radius = body.rims[rim].radius};
  return touching_corner(body, attitude, point);
}

void Reference::scale_inertia(double factor) {
  body.inertia *= factor;
  principal = space::PrincipalAxes(body.inertia);
}

std::vector<Vector3> Reference::arms(const space::Quaternion& attitude) const {
  const space::Matrix3 turned = attitude.toRotationMatrix();
  std::vector<Vector3> arms;
  arms.reserve(points.size());
  for (const Vector3& vertex : body.vertices) arms.emplace_back(turned * vertex);
  for (int i = static_cast<int>(arms.size()); i < body.points(); ++i)
    arms.emplace_back(turned * corner(attitude, i).place);
  return arms;
}

std::size_t lowest_of(const std::vector<Vector3>& arms) {
  const auto lowest =
      std::min_element(arms.begin(), arms.end(), [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  return static_cast<std::size_t>(lowest - arms.begin());
}

Reference::Release Reference::release(double gap) const {
  if (gap == 0) return {start, 0};
  const space::FreeFlight back = flight(start);
  const auto height = [&](double time) {
    const space::State state = back.at(-time);
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vector3& arm : arms(state.attitude)) lowest = std::fmin(lowest, state.position.z() + arm.z());
    return lowest;
  };
  double low = 0, high = gap / speed();
  for (int i = 0; i < 60 && height(high) < gap; ++i) high *= 1.25;
  if (!(height(high) >= gap))
    throw BadInput(fmt::format("gap {}: the drop does not come from so high above the ground", shortest(gap)));
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    (height(middle) < gap ? low : high) = middle;
  }
  return {back.at(-high), high};
}

Reference reference_of(const Problem& problem) {
  Reference reference{.name = problem.id,
                      .is_compliant = problem.is_compliant,
                      .energy_alone = problem.energy_alone,
                      .at_rest = problem.at_rest,
                      .end_energy = problem.end_energy,
                      .ground_ends = problem.ground_end.has_value(),
                      .tolerances = problem.tolerances,
                      .gaps = problem.gaps,
                      .until = problem.until};
  reference.drop = discrete_drop(problem.scene);
  if (auto* planar = std::get_if<analytic::Drop>(&reference.drop)) {
    if (problem.ground_end) planar->body.vertices[1].x = *problem.ground_end;  // in place of b, which is over none
    set_planar(reference, *planar);
    if (problem.ground_end) reference.points[1] = "edge";
  } else set_space(reference, problem.scene, std::get<space::Drop>(reference.drop));
  touch_down(reference);
  for (const std::string& law : truth_laws(problem)) {
    ReferenceSequence sequence{
        .law = declared(law, discrete_law(problem.scene).law), .truth = truth_of(problem, law), .after = {}};
    add_states(reference, sequence);
    reference.sequences.push_back(std::move(sequence));
  }
  return reference;
}

Reference reference_of(const Scene& scene) {
  Reference reference{.name = scene.path.empty() ? "the scene" : scene.path};
  const int impacts = scene.request.impacts;
  ReferenceSequence sequence;
  reference.drop = discrete_drop(scene);
  if (const auto* drop = std::get_if<analytic::Drop>(&reference.drop)) {
    set_planar(reference, *drop);
    touch_down(reference);
    sequence = {.law = {.name = "any", .law = drop->law}, .truth = planar_truth(*drop, impacts), .after = {}};
  } else {
    const space::Drop& in_space = std::get<space::Drop>(reference.drop);
    set_space(reference, scene, in_space);
    touch_down(reference);
    sequence = {
        .law = {.name = "any", .law = in_space.law}, .truth = space_truth(reference, in_space, impacts), .after = {}};
  }
  const std::size_t known = sequence.truth.size();
  if (known > 0 && known < static_cast<std::size_t>(impacts)) {
    reference.remark =
        fmt::format("the truth has {} impact{}: nothing strikes after them, or rounding decides what does", known,
                    known == 1 ? "" : "s");
  }
  if (sequence.truth.empty()) throw BadInput(reference.name + ": the scene has no impact to compare with");
  add_states(reference, sequence);
  reference.sequences.push_back(std::move(sequence));
  return reference;
}

State exact_map(const Reference& reference, const DeclaredLaw& law, const State& before,
                const std::vector<int>& points) {
  const std::vector<Vector3> arms = reference.arms(before.attitude);
  std::vector<space::Corner> corners;
  for (const int point : points) corners.push_back(reference.corner(before.attitude, point));
  if (law.is_moreau && points.size() == 1)
    return moreau_map(reference, law.law, before, arms[static_cast<std::size_t>(points.front())]);
  if (reference.is_planar && points.size() == 2) {
    const auto arm = [&](int point) { return arms[static_cast<std::size_t>(point)]; };
    if (const auto flat = flat_map(reference, law.law, before, arm(points[0]), arm(points[1]))) return *flat;
  }
  State after = before;
  if (points.size() == 1 && corners.front().radius == 0) {
    const space::Impact impact = strike(reference.body, before, corners.front().place, law.law);
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
  } else {
    const bool is_level_rim = corners.front().radius > 0;
    const State level = is_level_rim ? levelled(reference.body, before, corners.front()) : before;
    const space::GroupImpact impact = strike_together(reference.body, level, corners, law.law);
    after.velocity = impact.velocity_after;
    after.angular_velocity = impact.angular_velocity_after;
  }
  return after;
}

}  // namespace clatter::validation
