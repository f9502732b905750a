// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "numeric/contact/contact_load.hpp"
#include "numeric/motion/equations_of_motion.hpp"

namespace clatter::numeric {

/// All that is known at an instant but the friction force.
struct ContactSystem::Instant {
  const FrictionPhase& phase;
  const GroundView& view;
  const ContactLoad& load;
  const LoadRates& rates;
  Vector3 normal;
  Vector3 centre;    ///< of pressure
  Vector3 moment;    ///< of the normal load, body frame
  double rise;       ///< vertical acceleration of the centre of mass
  AlongGround slip;  ///< velocity of the pressure centre

  struct Changes {
    double force;  ///< dF_n/dt
    Vector3 first_moment;
  };
  /// Rates of F_n and ∫f_n u for an angular acceleration, by δ̈ = −(V̇_z + h·u).
  [[nodiscard]] Changes changes(const Vector3& acceleration) const {
    const Vector3& omega = view.angular_velocity;
    const Vector3 h = normal.cross(acceleration) + normal.dot(omega) * omega - omega.squaredNorm() * normal;
    const double k = rates.stiffness, c = rates.damping;
    const LoadIntegrals& l = rates.load;
    const RateIntegrals& r = rates.rates;
    const Changes by_springs = with_rest(
        {k * r.rate + c * (r.rate_squared - rise * l.depth - h.dot(l.depth_position)),
         k * r.rate_position + c * (r.rate_squared_position - rise * l.depth_position - r.depth_position_squared * h)});
    return {by_springs.force + rates.force_by_area, by_springs.first_moment + rates.first_moment_by_area};
  }
  /// What an angular acceleration adds to them, by the dampers alone.
  [[nodiscard]] Changes response(const Vector3& acceleration) const {
    const Vector3 h = normal.cross(acceleration);
    return with_rest(
        {-rates.damping * h.dot(rates.load.depth_position), -rates.damping * (rates.rates.depth_position_squared * h)});
  }
  [[nodiscard]] Changes with_rest(const Changes& by_springs) const {
    return {by_springs.force * (1 + rates.rest), by_springs.first_moment + rates.rest_moment * by_springs.force};
  }
  /// F_n ċ, ċ being the velocity at which the pressure centre runs over the body: finite where F_n fades.
  [[nodiscard]] Vector3 wander(const Changes& change) const { return change.first_moment - centre * change.force; }
};

/// Friction's resultant, its moment about the centre of mass (body frame) and the power that it dissipates.
struct ContactSystem::Friction {
  AlongGround force;
  Vector3 moment = Vector3::Zero();
  double power = 0;
  AlongGround hold;  ///< see ContactDiagnosis
  bool spins = false;
};

/// What sticking takes: force and couple are linear in the couple C, force + C force_by_couple holds the centre, and C
/// = couple holds the spin too.
struct ContactSystem::Hold {
  AlongGround force;            ///< [N]
  AlongGround force_by_couple;  ///< [1/m]
  double couple = 0;            ///< about the vertical [N·m]
};

namespace {

constexpr double unit_rounding = 1e-9;  ///< of the square of an attitude's norm: what users may have rounded

/// (Aᵀ − 1) v for the rotation A of Euler parameters (b; e): no cancellation when it is small.
Vector3 back_turned_change(double b, const Vector3& e, const Vector3& v) {
  const Vector3 across = e.cross(v);
  return -2 * b * across + 2 * e.cross(across);
}

AlongGround slip_at(const GroundView& view, const Vector3& u) {
  const Vector3 turning = view.angular_velocity.cross(u);
  return {view.east_speed + view.east.dot(turning), view.north_speed + view.north.dot(turning)};
}

Vector3 along(const GroundView& view, const AlongGround& vector) {
  return vector.east * view.east + vector.north * view.north;
}

/// Slip that is slow leans to the direction that it had when the phase began: rounding must not choose one.  Beyond the
/// instant where slip ends, where the step is only a trial, it has the old direction alone, which keeps it smooth.
AlongGround leaning_slip(const AlongGround& slip, const FrictionPhase& phase) {
  const AlongGround lean = phase.direction * std::max(phase.slow, std::numeric_limits<double>::min());
  if (!(slip.dot(phase.direction) > 0)) return lean;
  return {slip.east + lean.east, slip.north + lean.north};
}

AlongGround bounded(const AlongGround& force, double limit) {
  const double size = force.norm();
  if (size <= limit) return force;
  return std::isfinite(size) ? force * (limit / size) : AlongGround{};
}

/// Root x of D x = b for D = (by_east, by_north); 0 if D is singular.
AlongGround solve(const AlongGround& by_east, const AlongGround& by_north, const AlongGround& b) {
  const double size = std::max(by_east.norm(), by_north.norm());
  const AlongGround p = by_east * (1 / size), q = by_north * (1 / size);
  const double determinant = p.east * q.north - q.east * p.north;
  if (!(std::fabs(determinant) > 0)) return {};
  return AlongGround{b.east * q.north - b.north * q.east, b.north * p.east - b.east * p.north} *
         (1 / (size * determinant));
}

/// The part of a couple, from 0 to 1, at which |a + part b|² + part² c² = 1; 1 where that is less, 0 where |a| is more.
double part_within(const AlongGround& a, const AlongGround& b, double c) {
  const double square = b.dot(b) + c * c, mixed = a.dot(b), left = 1 - a.dot(a);
  if (square + 2 * mixed <= left) return 1;
  if (!(left > 0)) return 0;
  const double root = std::sqrt(mixed * mixed + square * left);
  return mixed > 0 ? left / (mixed + root) : (root - mixed) / square;
}

/// Root mean square of the distance of what presses from the centre, along the ground.
double patch_radius(const LoadRates& rates, const Vector3& normal, const Vector3& centre) {
  const Matrix3& squares = rates.rates.depth_position_squared;
  const double square = (squares.trace() - normal.dot(squares * normal)) / rates.load.depth;
  const double up = normal.dot(centre);
  return std::sqrt(std::max(square - (centre.squaredNorm() - up * up), 0.0));
}

AlongGround unit_slip(const AlongGround& slip, const FrictionPhase& phase, bool planar) {
  if (planar) return phase.direction;
  const AlongGround leaning = leaning_slip(slip, phase);
  return leaning * (1 / leaning.norm());
}

}  // namespace

ContactSystem::ContactSystem(const Body& body, const Ground& ground, const Gravity& gravity, bool planar)
    : body_(body), ground_(ground), gravity_(gravity), planar_(planar), equations_(body.mass(), body.inertia()),
      loader_(contact_on(body, ground)) {}

void ContactSystem::begin(const MotionState& touch) {
  assert(std::fabs(touch.attitude.squaredNorm() - 1) <= unit_rounding);
  touch_ = touch;
  const Eigen::Quaterniond back = touch.attitude.conjugate();
  plane_ = {back * Vector3::UnitZ(), touch.centre.z()};
  east_ = back * Vector3::UnitX();
  north_ = back * Vector3::UnitY();
}

ContactState ContactSystem::initial() const {
  ContactState y = ContactState::Zero();
  euler_parameters(y)[0] = 1;
  velocity(y) = touch_.velocity;
  angular_velocity(y) = touch_.angular_velocity;
  return y;
}

MotionState ContactSystem::motion(const ContactState& y) const {
  const Eigen::Vector4d beta = euler_parameters(y);
  const Eigen::Quaterniond turn(beta[0], beta[1], beta[2], beta[3]);
  return {touch_.centre + displacement(y), (touch_.attitude * turn).normalized(), velocity(y), angular_velocity(y)};
}

GroundView ContactSystem::view(const ContactState& y) const {
  const double b = euler_parameters(y)[0];
  const Vector3 e = euler_parameters(y).tail<3>();
  GroundView view;
  view.reference = plane_;
  view.turn = back_turned_change(b, e, plane_.normal);
  view.sink = displacement(y).z();
  view.vertical_speed = velocity(y).z();
  view.angular_velocity = angular_velocity(y);
  view.east = east_ + back_turned_change(b, e, east_);
  view.north = north_ + back_turned_change(b, e, north_);
  view.east_speed = velocity(y).x();
  view.north_speed = velocity(y).y();
  return view;
}

Vector3 ContactSystem::angular_acceleration(const Vector3& moment, const Vector3& omega) const {
  return planar_ ? response(moment) : equations_.angular(omega, moment);
}

/// Angular acceleration that a moment causes by itself.
Vector3 ContactSystem::response(const Vector3& moment) const {
  return planar_ ? equations_.response_about(north_, moment) : equations_.response(moment);
}

void ContactSystem::derivative(const ContactState& y, ContactState& rate) {
  evaluate(y, phase_, rate, nullptr, nullptr);
}

ContactDiagnosis ContactSystem::diagnose(const ContactState& y, ContactState& rate, std::vector<int>* submerged) {
  ContactDiagnosis diagnosis;
  evaluate(y, phase_, rate, &diagnosis, submerged);
  return diagnosis;
}

SlipField ContactSystem::slip_field(const FrictionPhase& phase) const {
  SlipField field{.kind = SlipField::Kind::points, .planar = planar_, .digits = phase.digits};
  if (phase.kind == FrictionPhase::Kind::regularised) field.regularisation = ground_.regularisation_speed;
  else field.floor = phase.floor;
  return field;
}

void ContactSystem::evaluate(const ContactState& y, const FrictionPhase& phase, ContactState& rate,
                             ContactDiagnosis* diagnosis, std::vector<int>* submerged) {
  ++evaluations_;
  const GroundView view = this->view(y);
  LoadRates rates;
  const bool wants_rates = diagnosis || phase.kind == FrictionPhase::Kind::stick;
  const ContactLoad load = loader_->load(view, wants_rates ? &rates : nullptr, submerged);
  const bool presses = load.force > 0;
  Instant at{phase,
             view,
             load,
             rates,
             view.normal(),
             presses ? load.pressure_centre() : Vector3::Zero(),
             Vector3::Zero(),
             equations_.linear({0, 0, load.force}).z() - gravity_.down,
             {}};
  at.moment = load.first_moment.cross(at.normal);
  at.slip = slip_at(view, at.centre);
  const Friction friction = presses ? this->friction(at) : Friction{};
  const Vector3 moment = at.moment + friction.moment;

  const Vector3& omega = view.angular_velocity;
  const Vector3 alpha = angular_acceleration(moment, omega);
  displacement(rate) = velocity(y);
  euler_parameters(rate) = euler_parameter_rates(euler_parameters(y), omega);
  velocity(rate) = equations_.linear({friction.force.east, friction.force.north, load.force}) + gravity_.acceleration();
  angular_velocity(rate) = alpha;
  works(rate) << load.damping_power, load.release_power, friction.power;
  if (!diagnosis) return;
  *diagnosis = {load,
                at.changes(alpha).force,
                friction.force,
                friction.hold,
                friction.spins,
                at.centre,
                at.slip,
                at.normal.dot(omega),
                presses && !planar_ ? patch_radius(rates, at.normal, at.centre) : 0,
                friction.moment - at.centre.cross(along(view, friction.force))};
}

AlongGround ContactSystem::sticking_force(const ContactState& y) {
  ContactState rate;
  ContactDiagnosis diagnosis;
  evaluate(y, {.kind = FrictionPhase::Kind::stick, .direction = {}, .point = phase_.point}, rate, &diagnosis, nullptr);
  return diagnosis.hold;
}

SlipRange ContactSystem::slip_range(const ContactPatch& patch) const {
  return loader_->slip_range(patch.view, {.kind = SlipField::Kind::points, .planar = planar_});
}

AlongGround ContactSystem::slip_per_depth(const ContactState& y) const {
  const GroundView view = this->view(y);
  return {-view.north.dot(view.angular_velocity), planar_ ? 0 : view.east.dot(view.angular_velocity)};
}

ContactPatch ContactSystem::patch(const ContactState& y) {
  ++evaluations_;
  const GroundView view = this->view(y);
  const ContactLoad load = loader_->load(view);
  return {view, load.force > 0 ? load.pressure_centre() : Vector3::Zero()};
}

LocalFriction ContactSystem::local_friction(const ContactPatch& patch, const AlongGround& shift) {
  ++evaluations_;
  const SlipLoad load = loader_->slip_load(
      patch.view,
      {.kind = SlipField::Kind::points, .planar = planar_, .rough = true, .east = shift.east, .north = shift.north});
  const double mu = ground_.sliding_friction;
  const AlongGround force{mu * load.east, planar_ ? 0 : mu * load.north};
  return {force, mu * load.moment - patch.centre.cross(along(patch.view, force))};
}

AlongGround ContactSystem::response(const ContactPatch& patch, const AlongGround& impulse) const {
  const GroundView& view = patch.view;
  const Vector3& u = patch.centre;
  const Vector3 turning = response(u.cross(along(view, impulse))).cross(u);
  return {impulse.east / body_.mass() + view.east.dot(turning),
          planar_ ? 0 : impulse.north / body_.mass() + view.north.dot(turning)};
}

AlongGround ContactSystem::response(const ContactPatch& patch, const Vector3& angular_impulse) const {
  const Vector3 turning = response(angular_impulse).cross(patch.centre);
  return {patch.view.east.dot(turning), planar_ ? 0 : patch.view.north.dot(turning)};
}

double ContactSystem::vertical_spin(const ContactState& y) const {
  const GroundView view = this->view(y);
  return view.normal().dot(view.angular_velocity);
}

AlongGround ContactSystem::sticking_ratio(const Vector3& u) const {
  const auto acceleration = [&](const Vector3& force) {
    return Vector3(equations_.linear(force) + response(u.cross(force)).cross(u));
  };
  const Vector3 free = acceleration(plane_.normal), by_east = acceleration(east_), by_north = acceleration(north_);
  if (planar_) return {-east_.dot(free) / east_.dot(by_east), 0};
  Eigen::Matrix2d matrix;
  matrix << east_.dot(by_east), east_.dot(by_north), north_.dot(by_east), north_.dot(by_north);
  const Eigen::Vector2d ratio = matrix.inverse() * Eigen::Vector2d(-east_.dot(free), -north_.dot(free));
  return {ratio.x(), ratio.y()};
}

ContactLoad ContactSystem::pressed(double depth) {
  GroundView view = this->view(initial());
  view.sink = -depth;
  view.vertical_speed = 0;
  view.angular_velocity.setZero();
  ++evaluations_;
  return loader_->load(view);
}

bool ContactSystem::is_submerged(const ContactState& y) const {
  if (!(plane_.offset + displacement(y).z() < 0)) return false;  // the centre of mass lies within the body
  const GroundView at = view(y);
  if (const auto& smooth = body_.smooth()) {
    const auto is_below = [&](int end) { return at.height(smooth->lowest(end, -at.normal())) < 0; };
    return is_below(0) && is_below(smooth->ends() - 1);
  }
  const std::vector<Vector3>& vertices = body_.facets().vertices;
  return std::all_of(vertices.begin(), vertices.end(), [&](const Vector3& u) { return at.height(u) < 0; });
}

ContactSystem::Friction ContactSystem::friction(const Instant& at) {
  using Kind = FrictionPhase::Kind;
  const double mu = ground_.sliding_friction;
  switch (at.phase.kind) {
    case Kind::none: return {};
    case Kind::regularised:
    case Kind::local: return over_patch(at, slip_field(at.phase));
    case Kind::stick: return in_stick(at);
    case Kind::slip: break;
  }
  if (!at.phase.varies) return at_centre(at, unit_slip(at.slip, at.phase, planar_) * (-mu * at.load.force));
  SlipField field{.kind = SlipField::Kind::turning,
                  .digits = at.phase.digits,
                  .centre = at.centre,
                  .spin = at.normal.dot(at.view.angular_velocity)};
  const AlongGround slip = at.phase.slow > 0 ? leaning_slip(at.slip, at.phase) : at.slip;
  field.east = slip.east;
  field.north = slip.north;
  return over_patch(at, field);
}

ContactSystem::Friction ContactSystem::at_centre(const Instant& at, const AlongGround& force) const {
  return {force, at.centre.cross(along(at.view, force)), -force.dot(at.slip), {}};
}

/// Friction's couple about the pressure centre of the patch that only turns, for μ = 1.
double ContactSystem::turning_couple(const Instant& at) {
  const SlipField field{.kind = SlipField::Kind::turning, .digits = at.phase.digits, .centre = at.centre, .spin = 1};
  const SlipLoad load = loader_->slip_load(at.view, field);
  return -at.normal.dot(load.moment - at.centre.cross(along(at.view, {load.east, load.north})));
}

/// A patch at rest takes no work: where a remaining slip would give some back, none is booked.
ContactSystem::Friction ContactSystem::in_stick(const Instant& at) {
  const Hold hold = stick(at);
  const double mu = stick_coefficient(at.phase), bound = mu * at.load.force;
  double part = 1;
  if (hold.couple != 0) {
    const double over = 1 / bound;
    part = part_within(hold.force * over, hold.force_by_couple * (hold.couple * over),
                       hold.couple / (mu * turning_couple(at)));
  }
  const double couple = part * hold.couple;
  const AlongGround by_couple = hold.force_by_couple * couple;
  const AlongGround force{hold.force.east + by_couple.east, hold.force.north + by_couple.north};
  Friction friction = at_centre(at, bounded(force, bound));
  friction.moment += couple * at.normal;
  friction.power = std::max(friction.power - couple * at.normal.dot(at.view.angular_velocity), 0.0);
  friction.hold = bounded(force, 2 * bound);
  friction.spins = part < 1;
  return friction;
}

/// Only the resultant at the pressure centre and the moment about the vertical are real of a patch taken as flat; so
/// their power, −∫f·v over the flat patch, is never negative.
ContactSystem::Friction ContactSystem::over_patch(const Instant& at, const SlipField& field) {
  const SlipLoad load = loader_->slip_load(at.view, field);
  const double mu = ground_.sliding_friction;
  const AlongGround force{mu * load.east, planar_ ? 0 : mu * load.north};
  Friction friction{force, mu * load.moment, 0, {}};
  if (at.phase.kind == FrictionPhase::Kind::slip) {
    const Vector3 at_centre = at.centre.cross(along(at.view, force));
    friction.moment = at_centre + at.normal * at.normal.dot(friction.moment - at_centre);
  }
  friction.power =
      -friction.force.dot({at.view.east_speed, at.view.north_speed}) - friction.moment.dot(at.view.angular_velocity);
  return friction;
}

/// F_n times the condition of stick is linear in F_t and C:
///     F_n [F_t/m + α(F_t, C) × c]_t + [ω × F_n ċ(F_t, C)]_t = −F_n [g + α₀ × c + ω × (ω × c) + fading v]_t − [ω × F_n
///     ċ₀]_t,   n·α(F_t, C) = −n·α₀ − fading ω_z,
/// α₀ and ċ₀ being those without friction.  Both sides of the first vanish with F_n, so that neither is divided by F_n.
ContactSystem::Hold ContactSystem::stick(const Instant& at) const {
  const GroundView& view = at.view;
  const Vector3& omega = view.angular_velocity;
  const double normal = at.load.force;
  const auto along_ground = [&](const Vector3& point, const AlongGround& rest) {
    return AlongGround{view.east.dot(point) + normal * rest.east, view.north.dot(point) + normal * rest.north};
  };
  const auto turned = [&](const Vector3& alpha, const AlongGround& rest) {
    const Vector3 wander = at.wander(at.response(alpha));
    return along_ground(normal * alpha.cross(at.centre) + omega.cross(wander), rest);
  };
  const auto turning_by = [&](const AlongGround& force) { return response(at.centre.cross(along(view, force))); };
  const auto per_force = [&](const AlongGround& unit) { return turned(turning_by(unit), unit * (1 / body_.mass())); };
  const Vector3 alpha = angular_acceleration(at.moment, omega);
  const Vector3 wander = at.wander(at.changes(alpha));
  const Vector3 turning = alpha.cross(at.centre) + omega.cross(omega.cross(at.centre));
  const AlongGround free =
      along_ground(normal * turning + omega.cross(wander),
                   {at.slip.east * at.phase.fading + gravity_.along, at.slip.north * at.phase.fading});
  const AlongGround by_east = per_force({1, 0});
  if (planar_) return {by_east.east != 0 ? AlongGround{-free.east / by_east.east, 0} : AlongGround{}, {}, 0};
  const AlongGround by_north = per_force({0, 1});
  Hold hold{solve(by_east, by_north, free * -1), {}, 0};
  if (at.phase.point) return hold;
  const Vector3 by_couple = response(at.normal);
  hold.force_by_couple = solve(by_east, by_north, turned(by_couple, {}) * -1);
  const double per_couple = at.normal.dot(by_couple + turning_by(hold.force_by_couple));
  const double spinning = at.normal.dot(alpha + turning_by(hold.force)) + at.phase.fading * at.normal.dot(omega);
  if (per_couple > 0) hold.couple = -spinning / per_couple;
  return hold;
}

}  // namespace clatter::numeric
