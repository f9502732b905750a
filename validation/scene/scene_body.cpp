// SPDX-License-Identifier: GPL-3.0-or-later
// A scene, its body and how that comes to the ground.
#include "validation/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analytic/law/viscoelastic.hpp"
#include "numeric/equilibrium.hpp"
#include "numeric/files/import.hpp"
#include "numeric/motion/free_flight.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {

analytic::RestitutionLaw restitution_law(const Scene& scene) {
  if (scene.impact.law) return *scene.impact.law;
  return scene.impact.restitution || !scene.has_ground() ? analytic::RestitutionLaw::newton
                                                         : analytic::RestitutionLaw::viscoelastic;
}

bool takes_friction_of_ground(const Scene& scene) {
  const DiscreteImpact& impact = scene.impact;
  return !impact.impulse_ratio && !impact.friction && scene.has_ground() && scene.world.ground.has_friction();
}

Scene Scene::at(double value) const {
  Scene one = *this;
  if (sweep->quantity == SceneSweep::Quantity::angle_deg) one.angle_deg = value;
  else one.world.ground.static_friction = one.world.ground.sliding_friction = value;
  one.sweep.reset();
  one.settle_restitution();
  return one;
}

int Scene::most_impacts() const { return until_rest || std::isfinite(request.until) ? 100'000 : request.impacts; }

bool Scene::has_vectors() const { return !attitude.empty() || !velocity.empty() || !angular_velocity.empty(); }

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const ShapeTraits& shape : shape_traits) all.emplace_back(shape.name);
    return all;
  }();
  return names;
}

bool BodyScene::is_surface() const { return numeric::is_surface_file(file); }

int BodyScene::own_sectors() const { return shape == Shape::rod && meshed_radius() > length / 20 ? 64 : 16; }

numeric::Vector3 BodyScene::extents(double of_radius) const {
  if (has_size()) return size;
  return {has_length() ? length : 2 * of_radius, 2 * of_radius, 2 * of_radius};
}

numeric::Body Scene::make_body() const {
  const SolidBody solid = solid_body(*this);
  return {solid.properties, solid.surface, body.merge, solid.smooth};
}

Eigen::Quaterniond Scene::touch_attitude() const {
  constexpr double degree = std::numbers::pi / 180;
  if (attitude.empty())
    return numeric::attitude_of({.inclination = angle_deg * degree, .out_of_plane_tilt = tilt_deg * degree});
  return Eigen::Quaterniond(attitude[0], attitude[1], attitude[2], attitude[3]).normalized();
}

numeric::Vector3 Scene::touch_velocity() const {
  if (!velocity.empty()) return vector_of(velocity);
  return {tangential_velocity, 0, clearance ? -std::sqrt(2 * world.gravity * *clearance) : -speed};
}

numeric::Vector3 Scene::touch_angular_velocity() const {
  return angular_velocity.empty() ? numeric::Vector3(0, spin, 0) : vector_of(angular_velocity);
}

double Scene::release_height(double touch) const {
  const double lowest = release.clearance ? *release.clearance : *release.height - touch;
  if (!(lowest > 0)) {
    throw BadInput(
        "{}drop.release.height = {}: must be greater than {} m, where the body touches (lengths are in metres)",
        path.empty() ? "" : path + ": ", shortest(*release.height), significant(touch, 6));
  }
  return touch + lowest;
}

numeric::MotionState Scene::start(const numeric::Body& dropped, double* fall) const {
  numeric::MotionState state;
  state.attitude = touch_attitude();
  state.velocity = touch_velocity();
  state.angular_velocity = state.attitude.conjugate() * touch_angular_velocity();
  state = numeric::on_ground(dropped, state);
  if (request.starts_on_ground) {
    if (fall) *fall = 0;
    const bool slides = state.angular_velocity.isZero(0);
    numeric::MotionState rest =
        (slides ? numeric::sliding_equilibrium : numeric::equilibrium)(dropped, world, state).state;
    rest.velocity = {state.velocity.x(), state.velocity.y(), 0};
    rest.angular_velocity = rest.attitude.conjugate() * touch_angular_velocity();
    return rest;
  }
  double fallen = 0;
  if (height) {
    state.velocity.z() = -fallen_speed(state.centre.z());
    fallen = -state.velocity.z() / world.gravity;
  }
  if (is_released()) {
    state.centre.z() = release_height(state.centre.z());
    const numeric::FreeFlight flight(dropped, state, world.pull(), world.planar);
    const numeric::TouchDown touch = numeric::next_touch_down(dropped, flight);
    if (touch.kind != numeric::TouchDown::Kind::touch)
      throw BadInput("drop.release: the body never reaches the ground");
    fallen = touch.time;
    state = numeric::on_ground(dropped, flight.at(fallen));
  }
  if (fall) *fall = fallen;
  const numeric::FirstTouch first = numeric::first_touch(dropped, state);
  if (!(first.approach_speed > 0)) {  // in the discrete model's words
    throw BadInput("the first contact, end {}, does not approach the ground: speed and spin must bring it down",
                   end_name(first.end));
  }
  return state;
}

void Scene::settle_restitution() {
  if (!ground_restitution || !has_ground()) return;
  const numeric::Body dropped = make_body();
  const double approach = numeric::first_touch(dropped, start(dropped)).approach_speed;
  numeric::Ground& ground = world.ground;
  const double dissipation = analytic::damping_of_restitution(*ground_restitution) / approach;
  if (ground.has_dissipation()) ground.dissipation = dissipation;
  else ground.damping = dissipation * ground.stiffness;
}

TouchMotion toppled(const Scene& scene) {
  const auto refuse = [](const std::string& what) { throw BadInput("drop.topple: " + what); };
  if (scene.body.shape != BodyScene::Shape::rod && scene.body.shape != BodyScene::Shape::box)
    refuse("must be left out where the body is neither rod nor box");
  const numeric::Matrix3 turn = scene.touch_attitude().toRotationMatrix();
  constexpr double level = 1e-12;  // of the axes' sines: what an attitude typed with all its digits leaves
  const auto is_level = [](double cosine) { return std::fabs(cosine) < level || std::fabs(cosine) > 1 - level; };
  if (!std::ranges::all_of(turn.row(2), is_level) || !std::ranges::all_of(turn.row(0), is_level))
    refuse("must be left out where the body does not arrive on a face, its edges along x and y: drop.angle_deg = 0");
  const BodyProperties body = body_properties(scene, Model::discrete);
  const numeric::Vector3 half = turn.cwiseAbs() * scene.body.extents(scene.body.radius) / 2;
  const numeric::Vector3 centre = turn * body.centre;
  const double b = half.x() - centre.x(), h = half.z() + centre.z(), length = 2 * half.x();
  const double most = length * b / std::hypot(b, h);
  if (!(*scene.topple <= most))
    refuse(fmt::format("must be at most {} m, where the centre of mass stands above the edge", shortest(most)));
  const double sine = *scene.topple / length, cosine = std::sqrt((1 - sine) * (1 + sine));
  const double fall = b * sine - h * sine * sine / (1 + cosine);
  const double inertia = (turn * body.gyration_square * turn.transpose())(1, 1) + b * b + h * h;
  const double rate = std::sqrt(2 * scene.world.gravity * fall / inertia);
  // Rounding must not lift the edge off, which would then strike by itself.
  constexpr double down = 1 + 1e-12;
  return {.velocity = {-rate * h, 0, -rate * b * down}, .angular_velocity = {0, -rate, 0}};
}

double Scene::fallen_speed(double touch) const {
  if (!(*height > touch)) {
    throw BadInput(
        "{}drop.height = {}: must be greater than {} m, the height of the centre of mass at the first touch (lengths "
        "are in metres)",
        path.empty() ? "" : path + ": ", shortest(*height), significant(touch, 6));
  }
  return std::sqrt(2 * world.gravity * (*height - touch));
}

}  // namespace clatter::validation
