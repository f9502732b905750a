// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/contact/contact_instant.hpp"
#include "numeric/motion/euler_parameters.hpp"

namespace clatter::numeric {
namespace {

/// (Aᵀ − 1) v for the rotation A of Euler parameters (b; e): no cancellation when it is small.
Vector3 back_turned_change(double b, const Vector3& e, const Vector3& v) {
  const Vector3 across = e.cross(v);
  return -2 * b * across + 2 * e.cross(across);
}

AlongGround slip_at(const GroundView& view, const Vector3& u) {
  const Vector3 turning = view.angular_velocity.cross(u);
  return {view.east_speed + view.east.dot(turning), view.north_speed + view.north.dot(turning)};
}

}  // namespace

double AlongGround::norm() const { return std::hypot(east, north); }

ContactSystem::ContactSystem(const Body& body, const Ground& ground, double gravity, bool planar)
    : body_(body), ground_(ground), gravity_(gravity), planar_(planar), equations_(body.mass(), body.inertia()),
      loader_(body, ground) {}

void ContactSystem::begin(const MotionState& touch) {
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

void ContactSystem::derivative(const ContactState& y, ContactState& rate) { evaluate(y, rate, nullptr, nullptr); }

ContactDiagnosis ContactSystem::diagnose(const ContactState& y, ContactState& rate, std::vector<int>* submerged) {
  ContactDiagnosis diagnosis;
  evaluate(y, rate, &diagnosis, submerged);
  return diagnosis;
}

SlipField ContactSystem::slip_field() const {
  using Kind = FrictionPhase::Kind;
  SlipField field;
  if (phase_.kind != Kind::regularised && phase_.kind != Kind::local) return field;
  field.kind = SlipField::Kind::points;
  field.planar = planar_;
  if (phase_.kind == Kind::regularised) field.regularisation = ground_.regularisation_speed;
  else field.floor = phase_.floor;
  return field;
}

void ContactSystem::evaluate(const ContactState& y, ContactState& rate, ContactDiagnosis* diagnosis,
                             std::vector<int>* submerged) {
  ++evaluations_;
  const GroundView view = this->view(y);
  LoadRates rates;
  const bool wants_rates = diagnosis || phase_.kind == FrictionPhase::Kind::stick;
  const ContactLoad load = loader_.load(view, slip_field(), wants_rates ? &rates : nullptr, submerged);
  const bool presses = load.force > 0;
  Instant at{view,
             load,
             rates,
             view.normal(),
             presses ? load.pressure_centre() : Vector3::Zero(),
             Vector3::Zero(),
             equations_.linear({0, 0, load.force}).z() - gravity_,
             {}};
  at.moment = load.first_moment.cross(at.normal);
  at.slip = slip_at(view, at.centre);
  const Friction friction = presses ? this->friction(at) : Friction{};
  const Vector3 moment = at.moment + friction.moment;

  const Vector3& omega = view.angular_velocity;
  const Vector3 alpha = angular_acceleration(moment, omega);
  displacement(rate) = velocity(y);
  euler_parameters(rate) = euler_parameter_rates(euler_parameters(y), omega);
  velocity(rate) = equations_.linear({friction.force.east, friction.force.north, load.force}) - Vector3(0, 0, gravity_);
  angular_velocity(rate) = alpha;
  works(rate) << load.damping_power, load.release_power, friction.power;
  if (!diagnosis) return;
  *diagnosis = {load,
                at.changes(ground_, alpha).force,
                friction.force,
                friction.hold,
                at.centre,
                at.slip,
                at.normal.dot(omega),
                friction.moment - at.centre.cross(along(view, friction.force))};
}

AlongGround ContactSystem::sticking_force(const ContactState& y) {
  const FrictionPhase before = phase_;
  phase_ = {.kind = FrictionPhase::Kind::stick, .direction = {}};
  ContactState rate;
  const AlongGround force = diagnose(y, rate).hold;
  phase_ = before;
  return force;
}

SlipRange ContactSystem::slip_range(const ContactState& y) {
  ++evaluations_;
  return loader_.load(view(y), {.kind = SlipField::Kind::points, .planar = planar_, .rough = true}).slip_range;
}

LocalFriction ContactSystem::local_friction(const ContactState& y, const AlongGround& shift) {
  ++evaluations_;
  const GroundView view = this->view(y);
  const ContactLoad load = loader_.load(
      view,
      {.kind = SlipField::Kind::points, .planar = planar_, .rough = true, .east = shift.east, .north = shift.north});
  if (!(load.force > 0)) return {};
  const double mu = ground_.sliding_friction;
  const AlongGround force{mu * load.slip_east, planar_ ? 0 : mu * load.slip_north};
  return {force, mu * load.slip_moment - load.pressure_centre().cross(along(view, force)), load.slip_range.width()};
}

AlongGround ContactSystem::response(const ContactState& y, const Vector3& u, const AlongGround& impulse) const {
  const GroundView view = this->view(y);
  const Vector3 turning = response(u.cross(along(view, impulse))).cross(u);
  return {impulse.east / body_.mass() + view.east.dot(turning),
          planar_ ? 0 : impulse.north / body_.mass() + view.north.dot(turning)};
}

AlongGround ContactSystem::response(const ContactState& y, const Vector3& u, const Vector3& angular_impulse) const {
  const GroundView view = this->view(y);
  const Vector3 turning = response(angular_impulse).cross(u);
  return {view.east.dot(turning), planar_ ? 0 : view.north.dot(turning)};
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
  return loader_.load(view, {});
}

bool ContactSystem::is_submerged(const ContactState& y) const {
  if (!(plane_.offset + displacement(y).z() < 0)) return false;  // the centre of mass lies within the body
  const GroundView at = view(y);
  const std::vector<Vector3>& vertices = body_.facets().vertices;
  return std::all_of(vertices.begin(), vertices.end(), [&](const Vector3& u) { return at.height(u) < 0; });
}

}  // namespace clatter::numeric
