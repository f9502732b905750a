// SPDX-License-Identifier: GPL-3.0-or-later
// The ground's load on a body: normal force, its moment, powers and stored energy, and friction over the patch.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/contact/contact_polygon.hpp"
#include "numeric/contact/ground.hpp"
#include "numeric/contact/slip_integrals.hpp"

namespace clatter::numeric {

class Footprint;

/// How the body lies over the ground and moves, seen from the body frame.  Height above the ground of the body's
/// point u: (reference.normal·u + reference.offset) + (turn·u + sink); the second part is the small change since
/// touch-down, kept apart so that depths far below the body's size keep their digits.
struct GroundView {
  GroundPlane reference;                       ///< at touch-down
  Vector3 turn = Vector3::Zero();              ///< change of the ground's normal since then
  double sink = 0;                             ///< change of the height of the centre of mass [m]
  double vertical_speed = 0;                   ///< of the centre of mass, upward [m/s]
  Vector3 angular_velocity = Vector3::Zero();  ///< body frame [rad/s]
  Vector3 east = Vector3::UnitX();             ///< world x in the body frame
  Vector3 north = Vector3::UnitY();            ///< world y in the body frame
  double east_speed = 0;                       ///< of the centre of mass along world x and y [m/s]
  double north_speed = 0;

  [[nodiscard]] Vector3 normal() const { return reference.normal + turn; }
  [[nodiscard]] GroundPlane plane() const { return {normal(), reference.offset + sink}; }
  [[nodiscard]] double height(const Vector3& u) const { return reference.height(u) + (turn.dot(u) + sink); }
};

/// Slip velocities of the patch, for friction whose direction varies over it.
struct SlipField {
  enum class Kind {
    turning,  ///< −v/|v|, v = slip of the centre + spin × distance from it: the patch taken as flat
    points,   ///< −v/√(v² + v_r²), v the velocity of each point
  };
  Kind kind = Kind::points;
  bool planar = false;        ///< v has no part to the north
  bool rough = false;         ///< for an estimate, right to some per cent
  double digits = 15;         ///< of the sums that are needed, at least
  double regularisation = 0;  ///< v_r; 0: −v/|v| [m/s]
  /// The v_r of a facet whose points slip alike, within `alike` times this [m/s].  A facet that lies flat slips as one:
  /// without it the friction of its whole area would reverse at once.
  double floor = 0;
  static constexpr double alike = 1e4;
  Vector3 centre = Vector3::Zero();  ///< of pressure, body frame [m]
  double east = 0, north = 0;        ///< slip velocity there; of `points`, added to that of each [m/s]
  double spin = 0;                   ///< about the vertical [rad/s]
};

/// The slip velocities that the patch has, component by component.
struct SlipRange {
  double low_east = std::numeric_limits<double>::infinity(), high_east = -low_east;  ///< [m/s]
  double low_north = low_east, high_north = -low_east;
  void add(double east, double north);
  /// Largest difference between two points, of either component; 0 where nothing slips or touches.
  [[nodiscard]] double width() const;
};

/// The normal part of Eq. 4 of Shan et al. (2005), F_n = ∫f_n with f_n = (k_G + c_G δ̇) δ, and of Eq. 7, ∫f_n u; with
/// what friction, events and the ledger of energy need.
struct ContactLoad {
  double force = 0;                        ///< F_n [N]
  Vector3 first_moment = Vector3::Zero();  ///< ∫f_n u, body frame [N·m]
  double energy = 0;                       ///< ½ k_G ∫δ² over all that is below the ground [J]
  double damping_power = 0;                ///< c_G ∫δδ̇² where the ground presses [W]
  double release_power = 0;                ///< −k_G ∫δδ̇ where the clamp lets go [W]
  /// Largest δ of a vertex near the ground, or of a smooth shape's lowest point [m]; not positive: nothing touches.
  double deepest = 0;
  double deepest_rate = 0;  ///< its δ̇ [m/s]

  [[nodiscard]] Vector3 pressure_centre() const { return first_moment / force; }
};

struct LoadRates;

/// Makes of a load, whose energy and powers are sums of ∫δ² and ∫δδ̇ over the parts that they are of, what it is on the
/// ground: times k_G and c_G, with F_n and ∫f_n u from the integrals over all that presses.
/// @param rates  gets k_G, c_G and the integrals if not null.
void take_ground(const Ground& ground, const LoadIntegrals& pressing, ContactLoad& load, LoadRates* rates);

/// What the rates of change of F_n and ∫f_n u are made of, over the pressing part and weighted by the area measure.
struct LoadRates {
  double stiffness = 0, damping = 0;  ///< k and c that act at the instant
  LoadIntegrals load;
  RateIntegrals rates;
  /// Rates through the change of the areas' vertical components (projected measure), depths held.
  double force_by_area = 0;
  Vector3 first_moment_by_area = Vector3::Zero();
  /// What a force of the springs brings besides, of force and moment per force: of a half-space.
  double rest = 0;
  Vector3 rest_moment = Vector3::Zero();
};

/// Friction's part of a load, Eq. 6 of Shan et al. (2005) for μ_k = 1.
struct SlipLoad {
  double east = 0, north = 0;        ///< ∫f_n s, s the direction of the slip field [N]
  Vector3 moment = Vector3::Zero();  ///< ∫f_n u × s, body frame [N·m]
};

/// What presses on the ground: a body's surface with its scratch memory, one per thread.  Asked once per evaluation; no
/// allocation.
class ContactSurface {
 public:
  virtual ~ContactSurface() = default;
  /// @param rates  filled if not null.
  /// @param submerged  gets the indices of vertices, or ends of a smooth shape, below the ground, with repetitions, if
  /// not
  ///                   null.
  [[nodiscard]] virtual ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) = 0;
  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates = nullptr) {
    return load(view, rates, nullptr);
  }
  /// Friction of a field of `points` or `turning` over the patch of the last load, which had the same view.
  [[nodiscard]] virtual SlipLoad slip_load(const GroundView& view, const SlipField& field) = 0;
  /// The slip velocities that a field of `points` has over that patch.
  [[nodiscard]] virtual SlipRange slip_range(const GroundView& view, const SlipField& field) const = 0;
};

/// Slip velocity of the body's points: `value` at an origin, and its rates of change over the body, per metre.
struct BodySlip {
  double east = 0, north = 0;
  Vector3 east_slope, north_slope;
};
[[nodiscard]] BodySlip body_slip(const Vector3& origin, const GroundView& view, const SlipField& field);

/// The surface of a body's facets.
/// @param footprint  gets all that lies below the ground, if not null.
[[nodiscard]] std::unique_ptr<ContactSurface> facet_surface(const Body& body, const Ground& ground,
                                                            Footprint* footprint = nullptr);
/// The surface of a body: smooth where its shape is, else its facets.
/// @param footprint  as above.
[[nodiscard]] std::unique_ptr<ContactSurface> contact_surface(const Body& body, const Ground& ground,
                                                              Footprint* footprint = nullptr);
/// What presses on a ground: on springs, the body's surface; on a pad, that on each of its beds; on a half-space, that
/// over a patch of the same.
[[nodiscard]] std::unique_ptr<ContactSurface> contact_on(const Body& body, const Ground& ground);

}  // namespace clatter::numeric
