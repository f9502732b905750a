// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/mesh/generators.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "numeric/base/errors.hpp"

namespace clatter::numeric {
namespace {

/// Point i of n + 1 equidistant ones from −half to half, symmetric to the bit.
double station(int i, int n, double half) { return half * ((2. * i - n) / n); }

/// A direction across the rod: y right, z up.
struct Direction {
  double y;
  double z;
};

/// Direction at the angle 2π s/n from the bottom, counter-clockwise seen from +x.  Only the first
/// half (the first quarter, the first eighth) is computed, the rest is its mirror image.
Direction spoke(int s, int n) {
  if (s > n - s) {
    const auto [y, z] = spoke(n - s, n);
    return {-y, z};
  }
  if (n % 2 == 0 && s > n / 2 - s) {
    const auto [y, z] = spoke(n / 2 - s, n);
    return {y, -z};
  }
  if (n % 4 == 0 && s > n / 4 - s) {
    const auto [y, z] = spoke(n / 4 - s, n);
    return {-z, -y};
  }
  const double angle = 2 * std::numbers::pi * s / n;
  return {std::sin(angle), -std::cos(angle)};
}

/// The uniform density of a body whose mesh encloses `volume`.
double density(double mass, double volume) {
  const double density = mass / volume;
  detail::require_positive("mass / volume", density);
  return density;
}

/// Nodes and elements are numbered by int.
void require_countable(const char* what, double count) {
  if (count <= std::numeric_limits<int>::max()) return;
  throw std::domain_error(std::string(what) + ": must give at most 2147483647 nodes and elements");
}

/// Numbering of the rod's nodes: slice by slice from −x to +x, in each the axis first, then ring by
/// ring.
struct RodNumbering {
  int sectors;
  int rings;

  [[nodiscard]] int per_slice() const { return 1 + sectors * rings; }
  [[nodiscard]] int axis(int slice) const { return slice * per_slice(); }
  [[nodiscard]] int rim(int slice, int ring, int sector) const {
    return axis(slice) + 1 + (ring - 1) * sectors + sector % sectors;
  }
};

void validate(const RodMesh& rod) {
  detail::require_positive("length", rod.length);
  detail::require_positive("radius", rod.radius);
  detail::require_positive("mass", rod.mass);
  detail::require_at_least("sectors", rod.sectors, 3);
  detail::require_at_least("rings", rod.rings, 1);
  detail::require_at_least("layers", rod.layers, 1);
  require_countable("sectors, rings, layers", (1. + 1. * rod.sectors * rod.rings) * (1. + rod.layers));
}

void add_slice(Mesh& mesh, const RodMesh& rod, int slice) {
  const double x = station(slice, rod.layers, rod.length / 2);
  mesh.nodes.emplace_back(x, 0, 0);
  for (int ring = 1; ring <= rod.rings; ++ring) {
    const double radius = rod.radius * (static_cast<double>(ring) / rod.rings);
    for (int sector = 0; sector < rod.sectors; ++sector) {
      const auto [y, z] = spoke(sector, rod.sectors);
      mesh.nodes.emplace_back(x, radius * y, radius * z);
    }
  }
}

void add_sector(Mesh& mesh, const RodMesh& rod, double density, int layer, int sector) {
  const RodNumbering node{rod.sectors, rod.rings};
  const int top = node.per_slice(), s = sector, t = sector + 1;
  const int axis = node.axis(layer), p = node.rim(layer, 1, s), q = node.rim(layer, 1, t);
  mesh.elements.push_back({ElementShape::prism, {axis, p, q, axis + top, p + top, q + top, -1, -1}, density});
  for (int ring = 1; ring < rod.rings; ++ring) {
    const int a = node.rim(layer, ring, s), b = node.rim(layer, ring + 1, s);
    const int c = node.rim(layer, ring + 1, t), d = node.rim(layer, ring, t);
    mesh.elements.push_back({ElementShape::hexahedron, {a, b, c, d, a + top, b + top, c + top, d + top}, density});
  }
}

void validate(const BoxMesh& box) {
  detail::require_positive("size.x", box.size.x());
  detail::require_positive("size.y", box.size.y());
  detail::require_positive("size.z", box.size.z());
  detail::require_positive("mass", box.mass);
  detail::require_at_least("nx", box.nx, 1);
  detail::require_at_least("ny", box.ny, 1);
  detail::require_at_least("nz", box.nz, 1);
  require_countable("nx, ny, nz", (1. + box.nx) * (1. + box.ny) * (1. + box.nz));
}

void add_box_nodes(Mesh& mesh, const BoxMesh& box) {
  const Vector3 half = box.size / 2;
  for (int k = 0; k <= box.nz; ++k) {
    for (int j = 0; j <= box.ny; ++j) {
      for (int i = 0; i <= box.nx; ++i) {
        mesh.nodes.emplace_back(station(i, box.nx, half.x()), station(j, box.ny, half.y()),
                                station(k, box.nz, half.z()));
      }
    }
  }
}

void add_box_elements(Mesh& mesh, const BoxMesh& box, double density) {
  const int row = box.nx + 1, top = row * (box.ny + 1);
  for (int k = 0; k < box.nz; ++k) {
    for (int j = 0; j < box.ny; ++j) {
      for (int i = 0; i < box.nx; ++i) {
        const int a = k * top + j * row + i, b = a + 1, c = b + row, d = a + row;
        mesh.elements.push_back({ElementShape::hexahedron, {a, b, c, d, a + top, b + top, c + top, d + top}, density});
      }
    }
  }
}

void validate(const RoundMesh& shape) {
  detail::require_positive("semiaxes.x", shape.semiaxes.x());
  detail::require_positive("semiaxes.y", shape.semiaxes.y());
  detail::require_positive("semiaxes.z", shape.semiaxes.z());
  if (shape.straight != 0) detail::require_positive("straight", shape.straight);
  detail::require_positive("mass", shape.mass);
  detail::require_at_least("sectors", shape.sectors, 3);
  detail::require_at_least("rings", shape.rings, 1);
  require_countable("sectors, rings", 4. * (1. + shape.rings) * shape.sectors);
}

/// Node 0 in the middle, 1 and 2 the poles at −x and +x, then circle by circle from −x to +x; returns how many circles.
int add_round_nodes(Mesh& mesh, const RoundMesh& shape) {
  const double half = shape.straight / 2;
  const Vector3& a = shape.semiaxes;
  mesh.nodes = {{0, 0, 0}, {-half - a.x(), 0, 0}, {half + a.x(), 0, 0}};
  int circles = 0;
  const auto add_circle = [&](double sign, int ring) {
    const auto [across, along] = spoke(ring, 4 * shape.rings);
    for (int sector = 0; sector < shape.sectors; ++sector) {
      const auto [y, z] = spoke(sector, shape.sectors);
      mesh.nodes.emplace_back(sign * (half - a.x() * along), a.y() * (across * y), a.z() * (across * z));
    }
    ++circles;
  };
  for (int ring = 1; ring <= shape.rings; ++ring) add_circle(-1, ring);
  for (int ring = shape.straight > 0 ? shape.rings : shape.rings - 1; ring > 0; --ring) add_circle(1, ring);
  return circles;
}

}  // namespace

Mesh round_mesh(const RoundMesh& shape) {
  validate(shape);
  Mesh mesh;
  const int circles = add_round_nodes(mesh, shape), n = shape.sectors;
  double volume = 0;
  const auto add = [&](int i, int j, int k) {
    const auto at = [&](int node) { return mesh.nodes[node]; };
    volume += at(i).cross(at(j)).dot(at(k)) / 6;
    mesh.elements.push_back({ElementShape::tetrahedron, {0, i, j, k, -1, -1, -1, -1}, 1});
  };
  for (int s = 0; s < n; ++s) {
    const auto node = [&](int circle, int sector) { return 3 + circle * n + sector % n; };
    add(1, node(0, s + 1), node(0, s));
    for (int c = 0; c + 1 < circles; ++c) {
      add(node(c, s), node(c, s + 1), node(c + 1, s + 1));
      add(node(c, s), node(c + 1, s + 1), node(c + 1, s));
    }
    add(2, node(circles - 1, s), node(circles - 1, s + 1));
  }
  const double rho = density(shape.mass, volume);
  for (Element& element : mesh.elements) element.density = rho;
  return mesh;
}

Mesh rod_mesh(const RodMesh& rod) {
  validate(rod);
  const double sine = std::sin(2 * std::numbers::pi / rod.sectors);
  const double volume = rod.sectors * sine / 2 * rod.radius * rod.radius * rod.length;
  const double rho = density(rod.mass, volume);
  Mesh mesh;
  for (int slice = 0; slice <= rod.layers; ++slice) add_slice(mesh, rod, slice);
  for (int layer = 0; layer < rod.layers; ++layer) {
    for (int sector = 0; sector < rod.sectors; ++sector) add_sector(mesh, rod, rho, layer, sector);
  }
  return mesh;
}

Mesh box_mesh(const BoxMesh& box) {
  validate(box);
  const double rho = density(box.mass, box.size.prod());
  Mesh mesh;
  add_box_nodes(mesh, box);
  add_box_elements(mesh, box, rho);
  return mesh;
}

}  // namespace clatter::numeric
