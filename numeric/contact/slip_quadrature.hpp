// Friction that varies over the contact patch.
#pragma once

#include "numeric/contact/contact_load.hpp"

namespace clatter::numeric {

/// Adds to `load` weight × the integrals of f_n = (k_G + c_G δ̇) δ against the slip direction over the polygon's triangles, by
/// the seven-point rule of degree 5. The direction is no polynomial: the
/// error is that of the rule, small where the slip of the centre exceeds the speed of turning across the patch.  Where
/// the patch turns about a point inside it, the direction is rounded off over a tenth of that speed, and the
/// friction is right to about that part.
void add_slip(const ContactPolygon& polygon, double weight, const GroundView& view, const Ground& ground,
              const SlipField& slip, ContactLoad& load);

}  // namespace clatter::numeric
