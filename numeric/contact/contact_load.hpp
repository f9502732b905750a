// SPDX-License-Identifier: GPL-3.0-or-later
// The ground's load on a body: normal force, its moment, powers and stored energy, and friction over the patch.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/contact/contact_polygon.hpp"
#include "numeric/contact/ground.hpp"
#include "numeric/contact/slip_integrals.hpp"

namespace clatter::numeric {

// What presses from above on a column of the ground, seen from the face that the column touches.

/// Faces whose unit area has less of a vertical component than this count as upright: where they meet the lower face is
/// rounding, and what presses on them is a part of 1e-10 of that on a level face.
inline constexpr double upright = 1e-10;

/// A face below the ground and the vertical component of its unit area: positive where it looks down.
struct PressedFace {
  ContactPolygon polygon;
  double weight;
};

/// A convex part of the face `lower`, above which the face `upper` looks up with nothing of the body between.  Its
/// corners lie in the plane of `lower`, from that face's origin, and carry the depth of `upper` above them.
struct Overhang {
  int lower = 0, upper = 0;
  int sign = 1;  ///< parts of sign −1 take back what others of the same two faces have too much
  std::size_t begin = 0;
  int count = 0;
};

/// Finds which face lies below each face that looks up.  With the vertical component of the area as measure, a column
/// of the ground is pressed by the difference of what its lower and its upper face have, (k_G + c_G δ̇)(δ_lower −
/// δ_upper): δ̇ is that of both, since turning moves points above each other up and down alike.  The difference is
/// therefore never negative, and it acts where the ground touches the body, at the lower face.  Polygons that are
/// not convex count as signed sums of triangles, of which each is cut by each.  Where several faces lie below one
/// another the nearest counts, by inclusion and exclusion.
class Overhangs {
 public:
  /// @param up  the ground's normal in the body frame.
  void find(std::span<const PressedFace> faces, const Vector3& up);
  [[nodiscard]] const std::vector<Overhang>& parts() const { return parts_; }
  [[nodiscard]] const ContactCorner* corners(const Overhang& part) const { return corners_.data() + part.begin; }

 private:
  /// A convex polygon in the plane of the lower face.
  struct Piece {
    static constexpr int most = 24;
    ContactCorner corners[most];
    int count = 0;
  };
  using Triangle = ContactCorner[3];

  void add(const Piece& piece, int lower, int upper, int sign, int from);
  /// The fan triangle of `face` before corner i, on the plane of the face `lower`, counter-clockwise there; its sign
  /// in the fan, or 0 where it has no area.
  int project(int face, int i, int lower, Triangle& out) const;
  [[nodiscard]] Piece cut(const Piece& piece, const Triangle& by, const Vector3& normal) const;
  [[nodiscard]] double depth_below(const Piece& piece, int face, int lower) const;

  std::span<const PressedFace> faces_;
  Vector3 up_;
  std::vector<Overhang> parts_;
  std::vector<ContactCorner> corners_;
};

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

/// Sums the load over the facets near the ground, and keeps the polygons that press, so that friction of any number of
/// slip fields needs no other clipping.
class ContactLoader final : public ContactSurface {
 public:
  /// @param footprint  gets all that lies below the ground, if not null.
  ContactLoader(const Body& body, const Ground& ground, Footprint* footprint = nullptr);

  using ContactSurface::load;
  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override;
  /// Where faces look up from below the ground (projected measure) a column of the ground rubs with the difference of
  /// what its two faces have, along the slip of the lower one, which it touches: never more than μ F_n, and never
  /// driving.
  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override;
  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override;

 private:
  struct Sums;
  struct FacetView;
  /// A polygon that presses, and the corners that it has in `corners_`.
  struct Pressing {
    std::size_t begin;
    int count;
    const Vector3* normal;  ///< of its facet
    Vector3 origin;
    double weight;  ///< of its area
    /// Depth that presses, at the origin and its slope over the plane.
    double depth = 0;
    Vector3 depth_slope = Vector3::Zero();
  };
  [[nodiscard]] ContactPolygon polygon_of(const Pressing& pressing) const;
  void add_facet(const Facet& facet, Sums& sums);
  void add_loop(const FacetView& facet, const Loop& loop, Sums& sums);
  void add_below(const ContactPolygon& below, const FacetView& facet, Sums& sums);
  /// @return ∫δ², not weighted.
  double add_pressing(const ContactPolygon& pressing, const FacetView& facet, Sums& sums);
  /// Adds the integrals of f_n = (k_G + c_G δ̇) δ against the slip direction over the polygon: by
  /// slip_integrals, right to rounding; in the plane exactly, by the polygon's parts on the two sides of the line of no
  /// slip.
  /// @param rounding  v_r.
  void add_slip(const Pressing& pressing, const ContactPolygon& polygon, const GroundView& view, const SlipField& field,
                double rounding, SlipLoad& load);
  [[nodiscard]] double rounding_of(const Pressing& pressing, const GroundView& view, const SlipField& field) const;
  void find_overhangs(const GroundView& view);

  const Body& body_;
  const Ground& ground_;
  Footprint* footprint_;
  std::vector<ContactCorner> whole_, below_, part_;
  std::vector<ContactCorner> side_;   ///< part of a polygon that slips one way
  std::vector<ContactCorner> above_;  ///< an overhang's part
  std::vector<PlanePoint> plane_;     ///< polygon in its facet's plane
  std::vector<Pressing> pressing_;    ///< of the last load
  std::vector<ContactCorner> corners_;
  bool looks_up_ = false;   ///< whether a face presses from above
  bool has_parts_ = false;  ///< whether overhangs_ is that of the last load
  Overhangs overhangs_;
  std::vector<PressedFace> faces_;
};

}  // namespace clatter::numeric
