// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <utility>

#include "analytic/base/errors.hpp"
#include "analytic/plane/sequence.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/impulse/impulse_path.hpp"
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
/// Texts of a statement.
const std::vector<std::pair<std::string, std::string Problem::*>> texts{{"id", &Problem::id},
                                                                        {"title", &Problem::title},
                                                                        {"motivation", &Problem::motivation},
                                                                        {"separates", &Problem::separates},
                                                                        {"acceptance", &Problem::acceptance}};
const std::vector<std::string> numbers{"t",  "Px", "Py", "Pz", "Vx",       "Vy",
                                       "Vz", "Wx", "Wy", "Wz", "duration", "uncertainty"};

std::vector<std::string> known_keys() {
  std::vector<std::string> keys = scene_keys();
  for (const auto& [text, member] : texts) keys.push_back("problem." + text);
  for (const char* key : {"class", "version", "gaps", "until", "tolerances", "energy_alone", "at_rest", "end_energy",
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
  for (const auto& [text, member] : texts) problem.*member = values.text("problem." + text);
  problem.version = static_cast<int>(values.integer("problem.version", 1, 1, 1000));
  problem.is_compliant = values.text("problem.class") == "compliant";
  problem.energy_alone = values.truth("problem.energy_alone", false);
  problem.at_rest = values.truth("problem.at_rest", false);
  constexpr Range finite{-1e9, 1e9, false, "finite"};
  const auto optional = [&](const std::string& key, const Range& range) {
    return values.has(key) ? std::optional(values.number(key, 0, range)) : std::nullopt;
  };
  problem.end_energy = optional("problem.end_energy", finite);
  problem.ground_end = optional("problem.ground_end", finite);
  problem.until = optional("problem.until", positive);
  problem.gaps = values.numbers("problem.gaps", {1, 2, 3, 4, 5, 6, 7, 8}, positive, "heights in m");
  problem.tolerances = values.numbers("problem.tolerances", {4}, positive, "four errors");
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

namespace space = analytic::space;
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
space::Body body_in_space(const analytic::PlanarBody& planar) {
  space::Body body{
      .mass = planar.mass, .inertia = planar.inertia() * space::Matrix3::Identity(), .vertices = {}, .rims = {}};
  for (int i = 0; i < planar.vertex_count; ++i) {
    const analytic::Vertex& vertex = planar.vertices[static_cast<std::size_t>(i)];
    body.vertices.emplace_back(vertex.x, 0, vertex.z);
  }
  return body;
}

/// The body where it first touches the ground, with its lowest point on it.
void put_down(Reference& reference, const space::Drop& drop, const space::Quaternion& attitude) {
  reference.body = drop.body;
  reference.principal = space::PrincipalAxes(drop.body.inertia);
  reference.start = {.position = Vector3::Zero(),
                     .attitude = attitude,
                     .velocity = drop.velocity,
                     .angular_velocity = drop.angular_velocity};
  reference.gravity = drop.gravity;
  reference.gravity_along = drop.gravity_along;
  double lowest = 0;
  for (const Vector3& arm : reference.arms(reference.start.attitude)) lowest = std::fmin(lowest, arm.z());
  reference.start.position.z() = -lowest;
}

void set_planar(Reference& reference, const analytic::Drop& drop) {
  for (int i = 0; i < drop.body.vertex_count; ++i)
    reference.points.push_back(analytic::PlanarBody::vertex_set_name(static_cast<analytic::VertexSet>(1 << i)));
  const space::Drop flat = in_space(drop, body_in_space(drop.body));
  put_down(reference, flat, flat.attitude);
}

void set_space(Reference& reference, const Scene& scene, const space::Drop& drop) {
  reference.is_planar = false;
  for (std::size_t i = 0; i < drop.body.vertices.size(); ++i)
    reference.points.push_back(corner_name(scene, {static_cast<int>(i), drop.body.vertices[i]}));
  for (const space::Rim& rim : drop.body.rims) reference.points.push_back(corner_name(scene, {0, rim.centre}));
  for (const auto& [centre, axes] : drop.body.ellipsoids) reference.points.push_back(corner_name(scene, {0, centre}));
  put_down(reference, drop, drop.attitude.normalized());
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

std::string place_of(const Reference&, const analytic::ImpactRow& row) {
  return analytic::PlanarBody::vertex_set_name(row.vertices);
}

std::string place_of(const Reference& reference, const space::ImpactRow& row) {
  std::vector<int> group;
  for (const space::Corner& corner : row.corners) group.push_back(corner.index);
  std::ranges::sort(group);
  return reference.place_name(group);
}

/// The laws beside a scene's, where friction tells them apart.
std::vector<DeclaredLaw> laws_beside(const analytic::ImpactLaw& own) {
  if (!own.has_cone() || own.friction_value == 0 || own.law == analytic::RestitutionLaw::viscoelastic) return {};
  analytic::ImpactLaw base = own;
  base.friction = analytic::FrictionKind::coulomb;
  std::vector<DeclaredLaw> laws;
  for (const char* name : {"newton routh", "newton moreau", "poisson routh", "stronge routh"}) {
    const DeclaredLaw law = declared(name, base);
    const bool is_moreau = own.friction == analytic::FrictionKind::moreau;
    if (law.law.law != own.law || law.is_moreau != is_moreau) laws.push_back(law);
  }
  return laws;
}

/// What the discrete model says of the first impacts; rows from the first that cannot be predicted on are no truth.
std::vector<TruthRow> discrete_truth(const Reference& reference, const auto& drop, int impacts) {
  const auto sequence = impact_sequence(drop, {.impacts = impacts});
  const auto vector = [](const EntryVector& v) { return Vector3(v[0], v[1], v[2]); };
  std::vector<TruthRow> rows;
  for (const auto& row : sequence.rows) {
    if (!row.error.predictable) break;
    const Numbers found = impact_of(row).value;
    rows.push_back({.place = place_of(reference, row),
                    .time = row.start,
                    .impulse = vector(found.impulse),
                    .velocity = vector(found.velocity_after),
                    .angular_velocity = vector(found.angular_velocity_after),
                    .uncertainty = row.error.start});
  }
  return rows;
}

/// The normal impulse without friction, then the tangential one that stops the slip that is left, or is at the bound.
Vector3 normal_first_impulse(const space::Contact& contact, const analytic::ImpactLaw& law) {
  const space::Matrix3& inverse = contact.inverse_inertia;
  Vector3 impulse(0, 0, -(1 + law.restitution) * contact.velocity.z() / inverse(2, 2));
  const Eigen::Vector2d slip = (contact.velocity + inverse * impulse).head<2>();
  const Eigen::Vector2d stop = -inverse.topLeftCorner<2, 2>().inverse() * slip;
  const double bound = law.friction_value * impulse.z();
  impulse.head<2>() = stop * std::fmin(1, bound / std::fmax(stop.norm(), 1e-300));
  return impulse;
}

/// μ times the normal impulse along the slip before, by Newton's restitution.
Vector3 pushing_on_impulse(const space::Contact& contact, const analytic::ImpactLaw& law) {
  Vector3 way(contact.velocity.x(), contact.velocity.y(), 0);
  if (way.norm() > 0) way *= law.friction_value / way.norm();
  way.z() = 1;
  return -(1 + law.restitution) * contact.velocity.z() / (contact.inverse_inertia * way).z() * way;
}

/// An impulse of Newton's restitution and one of the cones that are not round, by projected Gauss-Seidel.
/// @throws std::domain_error where that does not converge
Vector3 cut_impulse(const space::Contact& contact, const DeclaredLaw& law) {
  constexpr int most = 2000;
  const space::Matrix3& inverse = contact.inverse_inertia;
  const Vector3& start = contact.velocity;
  Vector3 impulse = Vector3::Zero(), last = Vector3::Ones();
  const auto solved = [&](int i) { return impulse[i] - (start + inverse * impulse)[i] / inverse(i, i); };
  for (int i = 0; i < most && (impulse - last).norm() > 1e-15 * impulse.norm(); ++i) {
    last = impulse;
    impulse.z() = std::fmax(0, solved(2) - law.law.restitution * start.z() / inverse(2, 2));
    const double bound = law.law.friction_value * impulse.z();
    if (law.solver == Solver::pyramid) {
      for (const int k : {0, 1}) impulse[k] = std::clamp(solved(k), -bound, bound);
    } else {
      const Eigen::Vector2d wanted(solved(0), solved(1));
      impulse.head<2>() = wanted * std::fmin(1, bound / std::fmax(wanted.norm(), 1e-300));
    }
  }
  if (!((impulse - last).norm() <= 1e-12 * impulse.norm())) throw std::domain_error("no impulse within the cone");
  return impulse;
}

/// The impulse of one contact by Moreau's law, or as a code finds it that solves that wrongly.
/// @throws as moreau_map()
Vector3 solved_impulse(const space::Contact& contact, const DeclaredLaw& declared) {
  const Vector3 mirror(-1, -1, 1);
  const auto right = [&] {
    return space::moreau_impulse(contact, declared.law.friction_value, declared.law.restitution).impulse;
  };
  switch (declared.solver) {
    case Solver::right: return right();
    case Solver::reversed: return mirror.cwiseProduct(right());
    case Solver::pushing:
      return space::moreau_impulse(contact, -declared.law.friction_value, declared.law.restitution).impulse;
    case Solver::pushing_on: return pushing_on_impulse(contact, declared.law);
    case Solver::normal_first: return normal_first_impulse(contact, declared.law);
    case Solver::normal_first_reversed: return mirror.cwiseProduct(normal_first_impulse(contact, declared.law));
    default: return cut_impulse(contact, declared);
  }
}

/// Moreau's impulse of one contact: Newton's restitution and Coulomb's cone for the velocity at the end; a negative
/// coefficient of friction acts along the slip.
/// @throws NumericalError if no direction of slip satisfies it.
State moreau_map(const Reference& reference, const DeclaredLaw& declared, const State& before, int point) {
  const Vector3 arm = reference.arm(before.attitude, point), velocity = reference.velocity(before, point);
  State after = before;
  if (!(velocity.z() < 0)) return after;
  const space::Matrix3 turned = before.attitude.toRotationMatrix();
  const space::Matrix3 inverse = turned * reference.body.inertia.inverse() * turned.transpose();
  const space::Contact contact{.inverse_inertia = space::inverse_contact_inertia(reference.body.mass, inverse, arm),
                               .velocity = velocity};
  const Vector3 impulse = solved_impulse(contact, declared);
  after.velocity += impulse / reference.body.mass;
  after.angular_velocity += inverse * arm.cross(impulse);
  return after;
}

State with_velocities(State state, const Vector3& velocity, const Vector3& angular_velocity) {
  state.velocity = velocity;
  state.angular_velocity = angular_velocity;
  return state;
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
  return with_velocities(before, {impact->after.tangential, 0, impact->after.normal}, {0, impact->after.angular, 0});
}

/// Points that strike together with friction of the other sign, from what the law gives them.
State pushed_group(const Reference& reference, const DeclaredLaw& declared, const State& before, const State& right,
                   const Vector3& arm) {
  const Vector3 change = right.velocity - before.velocity;
  Vector3 along(-change.x(), -change.y(), 0);
  if (declared.solver == Solver::pushing) {
    const Vector3 velocity = before.velocity + before.angular_velocity.cross(arm);
    const Vector3 slip(velocity.x(), velocity.y(), 0);
    if (!(slip.norm() > 0)) return right;
    along = declared.law.friction_value * change.z() * slip.normalized();
  }
  State after = right;
  after.velocity.head<2>() = (before.velocity + along).head<2>();
  if (declared.solver != Solver::reversed) return after;
  const space::Matrix3 turned = before.attitude.toRotationMatrix();
  const space::Matrix3 inertia = turned * reference.body.inertia * turned.transpose();
  Vector3 moment = inertia * (right.angular_velocity - before.angular_velocity);
  moment += reference.body.mass * Vector3(0, 0, arm.z()).cross(2 * along);
  moment.z() *= -1;
  after.angular_velocity = before.angular_velocity + inertia.inverse() * moment;
  return after;
}

bool is_of_other_sign(Solver solver) {
  return solver == Solver::reversed || solver == Solver::pushing || solver == Solver::normal_first_reversed;
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
  throw BadInput(
      fmt::format("{}: no problem {}{}", where, printable.empty() ? "(empty)" : printable, suggestion(id, ids)));
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

Value truth_digits(const Problem& problem, const std::string& law) {
  Value all;
  for (const std::size_t i : rows_of(problem, law)) {
    Value row;
    for (std::size_t k = 0; k + 1 < numbers.size(); ++k) row[numbers[k]] = truth_table().field(i, numbers[k]);
    all.push_back(std::move(row));
  }
  return all;
}

double enough_time(const Problem& problem) {
  double last = 0;
  for (const std::string& law : truth_laws(problem)) last = std::fmax(last, truth_of(problem, law).back().time);
  return problem.until.value_or(rounded_up(1.2 * last + 0.05));
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

double Reference::impulse_ratio(const space::State& before, const space::State& after) const {
  const Vector3 change = after.velocity - before.velocity;
  return (is_planar ? change.x() : change.head<2>().norm()) / change.z();
}

space::State Reference::struck(const space::State& state, int point, const Vector3& impulse) const {
  space::State after = state;
  after.velocity += impulse / body.mass;
  const Vector3 moment = state.attitude.conjugate() * arm(state.attitude, point).cross(impulse);
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

Vector3 Reference::arm(const space::Quaternion& attitude, int point) const {
  return arms(attitude)[static_cast<std::size_t>(point)];
}

double Reference::height(const State& state, int point) const {
  return state.position.z() + arm(state.attitude, point).z();
}

Vector3 Reference::velocity(const State& state, int point) const {
  return state.velocity + state.angular_velocity.cross(arm(state.attitude, point));
}

int Reference::lowest(const space::Quaternion& attitude) const {
  const std::vector<Vector3> all = arms(attitude);
  return static_cast<int>(std::ranges::min_element(all, {}, [](const Vector3& one) { return one.z(); }) - all.begin());
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
  Reference reference{problem};
  reference.name = problem.id;
  reference.drop = discrete_drop(problem.scene);
  if (auto* planar = std::get_if<analytic::Drop>(&reference.drop)) {
    if (problem.ground_end) planar->body.vertices[1].x = *problem.ground_end;  // in place of b, which is over none
    set_planar(reference, *planar);
    if (problem.ground_end) reference.points[1] = "edge";
  } else set_space(reference, problem.scene, std::get<space::Drop>(reference.drop));
  for (const std::string& law : truth_laws(problem)) {
    ReferenceSequence sequence{
        .law = declared(law, discrete_law(problem.scene).law), .truth = truth_of(problem, law), .after = {}};
    add_states(reference, sequence);
    reference.laws.push_back(sequence.law);
    reference.sequences.push_back(std::move(sequence));
  }
  return reference;
}

Reference reference_of(const Scene& scene) {
  Reference reference;
  reference.name = scene.path.empty() ? "the scene" : scene.path;
  const int impacts = scene.request.impacts;
  reference.drop = discrete_drop(scene);
  if (const auto* drop = std::get_if<analytic::Drop>(&reference.drop)) set_planar(reference, *drop);
  else set_space(reference, scene, std::get<space::Drop>(reference.drop));
  const analytic::ImpactLaw law = law_of(reference.drop);
  const bool is_moreau = law.friction == analytic::FrictionKind::moreau;
  ReferenceSequence sequence{.law = {.name = "any", .law = law, .is_moreau = is_moreau}, .truth = {}, .after = {}};
  reference.laws = laws_beside(law);
  std::visit([&](const auto& drop) { sequence.truth = discrete_truth(reference, drop, impacts); }, reference.drop);
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
  if (law.aims_by_centre) {
    double lowest = 0;  // velocity of the fastest point
    for (const int point : points) lowest = std::fmin(lowest, reference.velocity(before, point).z());
    DeclaredLaw aimed = law;
    aimed.aims_by_centre = false;
    if (lowest < 0) aimed.law.restitution *= before.velocity.z() / lowest;
    return exact_map(reference, aimed, before, points);
  }
  const bool is_level_rim = reference.corner(before.attitude, points.front()).radius > 0;
  const bool goes_as_group = is_level_rim && law.law.friction == analytic::FrictionKind::moreau;
  if (law.is_moreau && points.size() == 1 && !goes_as_group) return moreau_map(reference, law, before, points.front());
  if (is_of_other_sign(law.solver)) {
    DeclaredLaw own = law;
    own.solver = Solver::right;
    Vector3 arm = Vector3::Zero();
    for (const int point : points) arm += reference.arm(before.attitude, point) / static_cast<double>(points.size());
    return pushed_group(reference, law, before, exact_map(reference, own, before, points), arm);
  }
  if (reference.is_planar && points.size() == 2) {
    const auto arm = [&](int point) { return reference.arm(before.attitude, point); };
    if (const auto flat = flat_map(reference, law.law, before, arm(points[0]), arm(points[1]))) return *flat;
  }
  std::vector<space::Corner> corners;
  for (const int point : points) corners.push_back(reference.corner(before.attitude, point));
  if (points.size() == 1 && !is_level_rim) {
    const space::Impact impact = strike(reference.body, before, corners.front().place, law.law);
    return with_velocities(before, impact.velocity_after, impact.angular_velocity_after);
  }
  const State level = is_level_rim ? levelled(reference.body, before, corners.front()) : before;
  const space::GroupImpact impact = strike_together(reference.body, level, corners, law.law);
  return with_velocities(before, impact.velocity_after, impact.angular_velocity_after);
}

std::optional<State> answer_of(const Reference& reference, const DeclaredLaw& law, const State& before,
                               const std::vector<int>& points) {
  try {
    return exact_map(reference, law, before, points);
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace clatter::validation
