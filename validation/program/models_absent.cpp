// SPDX-License-Identifier: GPL-3.0-or-later
// Stands in for the models in space, meshes and their explanations in clatter-plane, which leaves scenes that need one
// of them to the program after it.
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/impulse/slip_field.hpp"
#include "analytic/space/landing/tilted_outcomes.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "analytic/space/sequence/sustained_contact.hpp"
#include "numeric/body/body.hpp"
#include "numeric/files/import.hpp"
#include "numeric/mesh/generators.hpp"
#include "numeric/motion/free_flight.hpp"
#include "numeric/motion/start.hpp"
#include "validation/explain/steps.hpp"
#include "validation/program/program.hpp"

namespace clatter {
namespace {

/// Nothing has been written yet: a scene is refused here as soon as its body is made.
[[noreturn]] void leave() { throw validation::LeftToNextProgram(); }

}  // namespace

namespace analytic::space {

PrincipalAxes::PrincipalAxes(const Matrix3&) { leave(); }
FreeRotation::FreeRotation(const PrincipalAxes&, const Quaternion&, const Vector3&) { leave(); }
Body polyhedron(const std::vector<Vector3>&, const MassProperties&) { leave(); }
Body box(double, const Box&) { leave(); }
Body cylinder(double, const Cylinder&) { leave(); }
Body capsule(double, const Cylinder&) { leave(); }
Body ellipsoid(double, const Vector3&) { leave(); }
Body outline(const PlanarBody&) { leave(); }
double Body::reach() const { leave(); }
bool Body::is_flat() const { leave(); }
double touch_height(const Body&, const Quaternion&) { leave(); }
State FreeFlight::at(double) const { leave(); }
double Impact::restitution() const { leave(); }
Corner touching_corner(const Body&, const Quaternion&, int) { leave(); }
Sequence impact_sequence(const Drop&, const SequenceOptions&, const std::vector<double>&) { leave(); }
std::optional<SustainedContact> contact_after(const Drop&, const Sequence&) { leave(); }
OutcomeSet tilted_outcomes(const Body&, const State&, std::span<const Corner>, const ImpactLaw&, const TiltEffort&) {
  leave();
}

}  // namespace analytic::space

namespace numeric {

Mesh box_mesh(const BoxMesh&) { leave(); }
Mesh rod_mesh(const RodMesh&) { leave(); }
Mesh round_mesh(const RoundMesh&) { leave(); }
Mesh read_gmsh(const std::string&, double, double) { leave(); }
SurfaceFile read_surface(const std::string&, const SurfaceFileOptions&) { leave(); }
SurfaceFile parse_surface(const std::string&, std::string_view, const SurfaceFileOptions&) { leave(); }
std::string Repairs::words() const { leave(); }
Surface boundary_surface(const Mesh&) { leave(); }
MassProperties mass_properties(const Mesh&) { leave(); }
MassProperties mass_properties(const Surface&, double) { leave(); }
Body::Body(const MassProperties&, const Surface&, bool, const std::optional<SmoothShape>&) { leave(); }
Eigen::Quaterniond attitude_of(const Drop&) { leave(); }
MotionState on_ground(const Body&, MotionState) { leave(); }
FirstTouch first_touch(const Body&, const MotionState&) { leave(); }
SteadyPrecession::SteadyPrecession(const Rotation&, const Rates&) { leave(); }
FreeRotation::FreeRotation(const Matrix3&, const Rotation& start) : rotation_(SteadyPrecession(start)) {}
FreeFlight::FreeFlight(const Body&, const MotionState& start, const Gravity& gravity, bool)
    : start_(start), gravity_(gravity), rotation_(Matrix3::Identity(), {}) {}
MotionState FreeFlight::at(double) const { leave(); }
TouchDown next_touch_down(const Body&, const FreeFlight&, long) { leave(); }
Vector3 touch_point(const Body&, const MotionState&) { leave(); }

}  // namespace numeric

namespace validation {

std::vector<Step> impact_steps(const Scene&, const analytic::space::Drop&, const analytic::space::Sequence&, int) {
  leave();
}

}  // namespace validation
}  // namespace clatter
