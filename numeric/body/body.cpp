// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/body/body.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/base/errors.hpp"
#include "numeric/body/mass_properties.hpp"

namespace clatter::numeric {
namespace {

/// Products of lengths that leave the range of doubles give no normals.
void check_surface(const Facets& facets, double radius) {
  const bool sound = !facets.facets.empty() && std::isfinite(radius) &&
                     std::all_of(facets.facets.begin(), facets.facets.end(),
                                 [](const Facet& facet) { return std::fabs(facet.normal.squaredNorm() - 1) <= 1e-9; });
  if (!sound) throw NumericalError("the surface of the body is not representable in double precision");
}

}  // namespace

Body::Body(const MassProperties& properties, const Surface& surface, bool merge,
           const std::optional<SmoothShape>& smooth)
    : smooth_(smooth) {
  set_up(properties, surface, merge);
  if (!smooth_) return;
  smooth_->centre -= properties.centre;
  radius_ = smooth_->reach();
  half_length_ = std::fabs(smooth_->centre.x()) + smooth_->straight / 2 + smooth_->semiaxes.x();
}

Body::Body(const Mesh& mesh, bool merge) { set_up(mass_properties(mesh), boundary_surface(mesh), merge); }

void Body::set_up(const MassProperties& properties, const Surface& surface, bool merge) {
  detail::require(properties.mass > 0, "mass", properties.mass, "finite and greater than 0");
  check_inertia(properties.inertia);
  mass_ = properties.mass;
  inertia_ = properties.inertia;
  inverse_inertia_ = numeric::inverse_inertia(inertia_);
  facets_ = planar_facets(surface, merge);
  for (Vector3& vertex : facets_.vertices) {
    vertex -= properties.centre;
    radius_ = std::max(radius_, vertex.norm());
    half_length_ = std::max(half_length_, std::fabs(vertex.x()));
  }
  if (!merge) find_outline(properties, surface);
  hierarchy_ = Hierarchy(facets_);
  check_surface(facets_, radius_);
}

/// Both list the surface's nodes that they use in the same order.
void Body::find_outline(const MassProperties& properties, const Surface& surface) {
  outline_ = planar_facets(surface, true);
  for (Vector3& vertex : outline_.vertices) vertex -= properties.centre;
  std::size_t next = 0;
  for (const Vector3& vertex : facets_.vertices) {
    const bool is_next = next < outline_.vertices.size() && vertex == outline_.vertices[next];
    outline_of_.push_back(is_next ? static_cast<int>(next++) : -1);
  }
}

}  // namespace clatter::numeric
