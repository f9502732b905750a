// SPDX-License-Identifier: GPL-3.0-or-later
// Friction that varies over the contact patch.
#pragma once

#include <vector>

#include "numeric/contact/contact_load.hpp"
#include "numeric/contact/slip_integrals.hpp"

namespace clatter::numeric {

/// Room for the polygons that add_slip works on.
struct SlipScratch {
  std::vector<PlanePoint> corners;
  std::vector<ContactCorner> part;
};

/// Adds to `load` weight × the integrals of f_n = (k_G + c_G δ̇) δ against the slip direction over the polygon: by
/// slip_integrals, right to rounding; in the plane exactly, by the polygon's parts on the two sides of the line of no
/// slip.  `scratch` has room for twice the polygon's corners.
void add_slip(const ContactPolygon& polygon, double weight, const GroundView& view, const Ground& ground,
              const SlipField& slip, SlipScratch& scratch, ContactLoad& load);

}  // namespace clatter::numeric
