// SPDX-License-Identifier: GPL-3.0-or-later
// Box2D 2.4: impulses with Newton's restitution in single precision.  It has no capsule that moves: the rod is two
// circles.
#include <box2d/box2d.h>

#include "problem.hpp"

namespace {

float single(double value) { return static_cast<float>(value); }

void add_floor(b2World& world) {
  b2BodyDef place;
  b2PolygonShape half_space;
  // Polygons have a skin of b2_polygonRadius, in which contacts begin; the floor is lowered by that much.
  half_space.SetAsBox(100, 10, b2Vec2(0, -10 - b2_polygonRadius), 0);
  b2FixtureDef fixture;
  fixture.shape = &half_space;
  fixture.friction = 1;     // of a contact: the root of the product
  fixture.restitution = 0;  // of a contact: the larger one
  world.CreateBody(&place)->CreateFixture(&fixture);
}

void add_shapes(const league::Problem& problem, b2Body* body) {
  b2FixtureDef fixture;
  fixture.density = 0;  // the mass comes from SetMassData
  fixture.friction = single(problem.friction * problem.friction);
  fixture.restitution = single(problem.restitution);
  // b2_fixture.h: collisions below restitutionThreshold, 1 m/s by default, have no restitution.
  if (problem.tuned()) fixture.restitutionThreshold = 0;
  if (problem.rod() || problem.tuned()) {  // a box's corners as circles have no skin
    b2CircleShape circle;
    circle.m_radius = single(problem.radius);
    fixture.shape = &circle;
    for (const league::Vector3& point : league::contact_points(problem)) {
      circle.m_p.Set(single(point[0]), single(point[2]));
      body->CreateFixture(&fixture);
    }
  } else {
    b2PolygonShape box;
    box.SetAsBox(single(problem.length / 2) - b2_polygonRadius, single(problem.height / 2) - b2_polygonRadius);
    fixture.shape = &box;
    body->CreateFixture(&fixture);
  }
}

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  problem.require_plane();
  b2World world(b2Vec2(0, single(-problem.gravity)));
  add_floor(world);
  b2BodyDef start;
  start.type = b2_dynamicBody;
  start.position.Set(single(problem.position[0]), single(problem.position[2]));
  start.angle = single(problem.phi());
  start.linearVelocity.Set(single(problem.velocity[0]), single(problem.velocity[2]));
  start.angularVelocity = single(problem.omega());
  start.allowSleep = !problem.tuned();
  b2Body* body = world.CreateBody(&start);
  add_shapes(problem, body);
  b2MassData mass;
  mass.mass = single(problem.mass);
  mass.center.SetZero();
  mass.I = single(problem.planar_inertia());
  body->SetMassData(&mass);
  // The manual suggests 8 iterations for velocities and 3 for positions.
  const int velocity_iterations = problem.tuned() ? 50 : 8, position_iterations = 3;
  trajectory.record([&] { world.Step(single(problem.step), velocity_iterations, position_iterations); },
                    [&] {
                      const b2Vec2 p = body->GetPosition(), v = body->GetLinearVelocity();
                      trajectory.add_planar(p.x, p.y, body->GetAngle(), v.x, v.y, body->GetAngularVelocity());
                    });
}

}  // namespace

int main() {
  const std::string version = std::to_string(b2_version.major) + '.' + std::to_string(b2_version.minor) + '.' +
                              std::to_string(b2_version.revision);
  return league::run_all({"Box2D 2", version}, simulate);
}
