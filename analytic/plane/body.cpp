// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/body.hpp"

#include <cmath>

#include "analytic/base/errors.hpp"

namespace clatter::analytic {

namespace {

using detail::refuse;

void require_positive(const char* field, double value) {
  if (!(value > 0 && std::isfinite(value))) refuse(field, value, "greater than 0 and finite");
}

PlanarBody with_rim(double mass, double half_length, double half_height, double gyration_square) {
  PlanarBody body{.mass = mass, .gyration_square = gyration_square, .vertex_count = 4};
  body.vertices = {Vertex{-half_length, -half_height}, Vertex{half_length, -half_height},
                   Vertex{-half_length, half_height}, Vertex{half_length, half_height}};
  return body;
}

}  // namespace

double PlanarBody::reach() const {
  double reach = 0;
  for (int i = 0; i < vertex_count; ++i) reach = std::fmax(reach, std::hypot(vertices[i].x, vertices[i].z));
  return reach;
}

double PlanarBody::inertia() const { return mass * gyration_square; }

ContactPoint PlanarBody::contact_point(int vertex, double sine, double cosine) const {
  const auto [x, z] = vertices[vertex];
  return {.tangential = x * cosine - z * sine, .normal = x * sine + z * cosine};
}

std::string PlanarBody::vertex_set_name(VertexSet set) {
  static constexpr const char* names[max_vertices] = {"a", "b", "a-top", "b-top"};
  if (set == 0b0011) return "both";
  std::string name;
  for (int i = 0; i < max_vertices; ++i) {
    if (!(set >> i & 1)) continue;
    if (!name.empty()) name += '+';
    name += names[i];
  }
  return name;
}

PlanarBody make_rod(const RodSize& size) {
  require_positive("mass", size.mass);
  require_positive("length", size.length);
  if (!(size.radius >= 0 && std::isfinite(size.radius))) refuse("radius", size.radius, "at least 0 and finite");
  if (size.radius > 0) {
    const double gyration_square = (size.length * size.length + 3 * size.radius * size.radius) / 12;
    return with_rim(size.mass, size.length / 2, size.radius, gyration_square);
  }
  PlanarBody body{.mass = size.mass,
                  .gyration_square = size.length * size.length / 12,
                  .vertex_count = 2,
                  .uniform_thin_rod = true};
  body.vertices[0] = {-size.length / 2, 0};
  body.vertices[1] = {size.length / 2, 0};
  return body;
}

PlanarBody make_box(const BoxSize& size) {
  require_positive("mass", size.mass);
  require_positive("length", size.length);
  require_positive("width", size.width);
  require_positive("thickness", size.thickness);
  return with_rim(size.mass, size.length / 2, size.thickness / 2,
                  (size.length * size.length + size.thickness * size.thickness) / 12);
}

}  // namespace clatter::analytic
