// The body of a scene and how it comes to the ground.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "numeric/mesh/generators.hpp"
#include "numeric/mesh/import.hpp"
#include "numeric/motion/free_flight.hpp"
#include "numeric/touch_point.hpp"
#include "validation/output/names.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/bad_input.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {
namespace {

constexpr double degree = std::numbers::pi / 180;

numeric::MassProperties stl_properties(const BodyScene& body) {
  numeric::MassProperties properties{body.mass, {body.centre[0], body.centre[1], body.centre[2]}, {}};
  properties.centre *= body.unit;
  const std::vector<double>& i = body.inertia;
  properties.inertia = numeric::Vector3(i[0], i[1], i[2]).asDiagonal();
  if (i.size() == 6) {
    properties.inertia(0, 1) = properties.inertia(1, 0) = i[3];
    properties.inertia(0, 2) = properties.inertia(2, 0) = i[4];
    properties.inertia(1, 2) = properties.inertia(2, 1) = i[5];
  }
  return properties;
}

/// With a mass instead of a density the mesh's own is scaled.
numeric::Body gmsh_body(const BodyScene& body) {
  numeric::Mesh mesh = numeric::read_gmsh(body.file, body.density.value_or(1), body.unit);
  if (!body.density) {
    const double factor = body.mass / numeric::mass_properties(mesh).mass;
    for (numeric::Element& element : mesh.elements) element.density *= factor;
  }
  return numeric::Body(mesh, body.merge);
}

}  // namespace

bool BodyScene::is_stl() const {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".stl";
}

numeric::Body Scene::make_body() const {
  switch (body.shape) {
    case BodyScene::Shape::rod:
      return numeric::Body(numeric::rod_mesh({.length = body.length,
                                              .radius = body.radius,
                                              .mass = body.mass,
                                              .sectors = body.sectors,
                                              .rings = body.rings,
                                              .layers = body.layers}),
                           body.merge);
    case BodyScene::Shape::box:
      return numeric::Body(
          numeric::box_mesh({.size = body.size, .mass = body.mass, .nx = body.nx, .ny = body.ny, .nz = body.nz}),
          body.merge);
    case BodyScene::Shape::mesh: break;
  }
  if (body.is_stl()) return {stl_properties(body), numeric::read_stl(body.file, body.unit), body.merge};
  return gmsh_body(body);
}

numeric::MotionState Scene::start(const numeric::Body& dropped) const {
  numeric::MotionState state = numeric::touching_state(dropped, {.inclination = angle_deg * degree,
                                                                 .velocity = {tangential_velocity, 0, -speed},
                                                                 .spin = spin,
                                                                 .out_of_plane_tilt = tilt_deg * degree});
  if (height) state.velocity.z() = -fallen_speed(state);
  const numeric::FirstTouch first = numeric::first_touch(dropped, state);
  if (!(first.approach_speed > 0)) {  // in the discrete model's words
    throw BadInput(
        fmt::format("the first contact, end {}, does not approach the ground: speed and spin must bring it down",
                    end_name(first.end)));
  }
  return state;
}

double Scene::fallen_speed(const numeric::MotionState& state) const {
  const double touch = state.centre.z();
  if (!(*height > touch)) {
    throw BadInput(fmt::format(
        "{}: drop.height = {}: must be greater than {} m, the height of the centre of mass at the first touch", path,
        shortest(*height), significant(touch, 6)));
  }
  return std::sqrt(2 * options.gravity * (*height - touch));
}

}  // namespace clatter::validation
