// SPDX-License-Identifier: GPL-3.0-or-later
// The ground's load on a convex body without corners, by quadrature over its true surface.
#pragma once

#include <array>
#include <memory>

#include "numeric/contact/contact_load.hpp"
#include "numeric/contact/smooth_patch.hpp"

namespace clatter::numeric {

/// ∫q s and ∫q s p over a piece, q the pressure and s the direction of the slip.
struct DirectionSums {
  double east = 0, north = 0;
  Vector3 east_place = Vector3::Zero(), north_place = Vector3::Zero();

  void add(const Vector3& p, double load, const SlipVector& direction) {
    const double e = load * direction.east, n = load * direction.north;
    east += e;
    north += n;
    for (int i = 0; i < 3; ++i) east_place[i] += e * p[i], north_place[i] += n * p[i];
  }
};

/// The load on a SmoothShape.  The affine map that makes its ends unit balls leaves heights linear: an end lies below
/// the ground within a cap about its lowest point, the straight part within a strip of a unit cylinder, and depth, rate
/// and the vertical component of the area are linear in the place on the ball.  So the integrals of the projected
/// measure are exact by three heights and six places around (over_zone), e.g. of a ball of radius R
///     F_n = π k_G d² (R − d/3)   (projected),      F_n = π k_G R d²   (surface);
/// where the measure is that of an ellipsoid's surface the rule is as fine as its axes ask for.  Where the clamp, or
/// the end of a half, cuts the cap, its parts are integrated over. Accuracy: 1e-13 of F_n; a strip that the clamp or a
/// change of slip cuts, 1e-9.
class SmoothContact final : public ContactSurface {
 public:
  /// `body` has a smooth shape.
  /// @param footprint  gets all that lies below the ground, if not null.
  SmoothContact(const Body& body, const Ground& ground, Footprint* footprint = nullptr);

  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override;
  /// About the place where nothing slips, or the two, if near the patch: there the direction of the slip varies around
  /// it alone; else along circles, graded towards where the slip vanishes.  Of a cap that rolls and hardly spins right
  /// to some 1e-7 of F_n, of what the clamp or a seam cuts no better than its slices where slip all but vanishes.
  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override;
  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override;

  /// A piece of the surface in coordinates of its own, u = origin + axes p: p of over_zone or of over_mantle.
  struct Piece {
    Vector3 origin;
    Matrix3 axes;
    SpaceLinear depth, rate;
    SpaceLinear weight, weight_rate;  ///< of the area on ball or cylinder, projected measure
    double area = 1;                  ///< the same of the surface, where it is one number
    bool by_normal = false;           ///< where it is not: |normal + normal_change p|
    Vector3 normal;
    Matrix3 normal_change;
    bool is_mantle = false;
    double height = 0;  ///< of the cap
    Mantle mantle;
    HalfSpaces parts;  ///< that what presses lies in; none: all that is below the ground
  };

 private:
  struct Sums;
  struct Shared;
  void add_end(int end, double depth, const Shared& shared, Sums& sums);
  void add_mantle(const std::array<double, 2>& depths, const Shared& shared, Sums& sums);
  void add_piece(Piece& piece, Sums& sums);
  void complete(Piece& piece, const Vector3& normal_at_origin, const Matrix3& normal_change,
                const Shared& shared) const;
  [[nodiscard]] CapRule rule_for(double height) const;
  struct SlipOver {
    SpaceLinear east, north;
  };
  [[nodiscard]] SlipOver slip_over(const Piece& piece, const GroundView& view, const SlipField& field) const;
  [[nodiscard]] DirectionSums directions(const Piece& piece, const GroundView& view, const SlipField& field) const;
  template <class Visit>
  void over(const Piece& piece, const HalfSpaces& parts, Visit&& visit) const;
  template <class Visit>
  void over_part_of_mantle(const Piece& piece, const HalfSpaces& parts, Visit&& visit) const;

  const Body& body_;
  const Ground& ground_;
  Footprint* footprint_;
  SmoothShape shape_;
  double slimness_ = 1;          ///< least over largest semiaxis
  std::array<Piece, 3> pieces_;  ///< that press, of the last load
  int count_ = 0;
};

/// The surface of a body: smooth where its shape is, else its facets.
/// @param footprint  gets all that lies below the ground, if not null.
[[nodiscard]] std::unique_ptr<ContactSurface> contact_surface(const Body& body, const Ground& ground,
                                                              Footprint* footprint = nullptr);

}  // namespace clatter::numeric
