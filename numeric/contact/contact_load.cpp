// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/contact/contact_load.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include "numeric/contact/footprint.hpp"

namespace clatter::numeric {

BodySlip body_slip(const Vector3& origin, const GroundView& view, const SlipField& field) {
  if (field.kind == SlipField::Kind::turning) {
    const Vector3 away = origin - field.centre;
    const Vector3 east_slope = -field.spin * view.north, north_slope = field.spin * view.east;
    return {field.east + east_slope.dot(away), field.north + north_slope.dot(away), east_slope, north_slope};
  }
  // a·(ω × u) = (a × ω)·u
  const Vector3 east_slope = view.east.cross(view.angular_velocity),
                north_slope = view.north.cross(view.angular_velocity);
  return {view.east_speed + field.east + east_slope.dot(origin),
          view.north_speed + field.north + north_slope.dot(origin), east_slope, north_slope};
}

void take_ground(const Ground& ground, const LoadIntegrals& pressing, ContactLoad& load, LoadRates* rates) {
  const double k = ground.stiffness, c = ground.damping;
  load.force = k * pressing.depth + c * pressing.depth_rate;
  load.first_moment = k * pressing.depth_position + c * pressing.depth_rate_position;
  load.energy *= k / 2;
  load.damping_power = c * pressing.depth_rate_squared;
  load.release_power *= -k;
  if (!rates) return;
  rates->stiffness = k;
  rates->damping = c;
  rates->load = pressing;
}

void SlipRange::add(double east, double north) {
  low_east = std::min(low_east, east);
  high_east = std::max(high_east, east);
  low_north = std::min(low_north, north);
  high_north = std::max(high_north, north);
}

double SlipRange::width() const { return std::max({high_east - low_east, high_north - low_north, 0.0}); }

namespace {

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
  void find(std::span<const PressedFace> faces, const Vector3& up) {
    faces_ = faces;
    up_ = up;
    parts_.clear();
    corners_.clear();
    const int count = static_cast<int>(faces.size());
    for (int upper = 0; upper < count; ++upper) {
      if (!(faces[upper].weight < -upright)) continue;
      for (int lower = 0; lower < count; ++lower) {
        const PressedFace& below = faces[lower];
        if (!(below.weight > upright)) continue;
        for (int i = 2; i < faces[upper].polygon.count; ++i) {
          Triangle triangle;
          const int sign = project(upper, i, lower, triangle);
          if (sign == 0) continue;
          Piece whole;
          std::copy(triangle, triangle + 3, whole.corners);
          whole.count = 3;
          for (int j = 2; j < below.polygon.count; ++j) {
            const int other = project(lower, j, lower, triangle);
            if (other == 0) continue;
            const Piece piece = cut(whole, triangle, below.polygon.normal);
            if (piece.count >= 3 && depth_below(piece, lower, lower) > 0) add(piece, lower, upper, sign * other, 0);
          }
        }
      }
    }
  }

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

  /// What of the piece has another lower face, from number `from` on, between its two is taken back.
  void add(const Piece& piece, int lower, int upper, int sign, int from) {
    parts_.push_back({lower, upper, sign, corners_.size(), piece.count});
    corners_.insert(corners_.end(), piece.corners, piece.corners + piece.count);
    for (int face = from; face < static_cast<int>(faces_.size()); ++face) {
      const PressedFace& between = faces_[face];
      if (face == lower || !(between.weight > upright)) continue;
      for (int i = 2; i < between.polygon.count; ++i) {
        Triangle triangle;
        const int other = project(face, i, lower, triangle);
        if (other == 0) continue;
        const Piece part = cut(piece, triangle, faces_[lower].polygon.normal);
        if (part.count < 3) continue;
        const double under_upper = depth_below(part, face, lower), under_lower = depth_below(part, lower, lower);
        if (under_upper > 0 && under_upper < under_lower) add(part, lower, upper, -sign * other, face + 1);
      }
    }
  }

  /// The fan triangle of `face` before corner i, on the plane of the face `lower`, counter-clockwise there; its sign
  /// in the fan, or 0 where it has no area.
  int project(int face, int i, int lower, Triangle& out) const {
    const ContactPolygon& from = faces_[face].polygon;
    const ContactPolygon& onto = faces_[lower].polygon;
    const ContactCorner* corners[] = {&from.corners[0], &from.corners[i - 1], &from.corners[i]};
    const Vector3 shift = from.origin - onto.origin;
    const double slope = onto.normal.dot(up_);
    for (int j = 0; j < 3; ++j) {
      out[j] = *corners[j];
      if (face == lower) continue;
      out[j].position += shift;
      out[j].position -= (onto.normal.dot(out[j].position) / slope) * up_;
    }
    const auto area = [](const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& normal) {
      return normal.dot((b - a).cross(c - a));
    };
    const double own = area(corners[0]->position, corners[1]->position, corners[2]->position, from.normal);
    const double here = area(out[0].position, out[1].position, out[2].position, onto.normal);
    if (own == 0 || here == 0) return 0;
    if (here < 0) std::swap(out[1], out[2]);
    return own > 0 ? 1 : -1;
  }

  [[nodiscard]] Piece cut(const Piece& piece, const Triangle& by, const Vector3& normal) const {
    Piece part = piece, next;
    for (int i = 0; i < 3 && part.count >= 3; ++i) {
      const Vector3& a = by[i].position;
      const Vector3 inward = normal.cross(by[(i + 1) % 3].position - a);
      if (2 * part.count > Piece::most) return {};
      next.count = clip(part.corners, part.count, next.corners,
                        [&](const ContactCorner& corner) { return inward.dot(corner.position - a); });
      std::swap(part, next);
    }
    return part;
  }

  /// How far, in its middle, the piece of an upper face lies above the plane of another face.  The piece is given on
  /// the plane of `lower`.
  [[nodiscard]] double depth_below(const Piece& piece, int face, int lower) const {
    Vector3 middle = Vector3::Zero();
    double depth = 0;
    for (int i = 0; i < piece.count; ++i) {
      middle += piece.corners[i].position / piece.count;
      depth += piece.corners[i].depth / piece.count;
    }
    const ContactPolygon& onto = faces_[face].polygon;
    const ContactCorner& known = onto.corners[0];
    const ContactPolygon& plane = faces_[lower].polygon;
    // The depth of a face changes over its plane by the height along `up` alone.
    const Vector3 away = middle + (plane.origin - onto.origin) - known.position;
    const double fall = onto.normal.dot(away) / onto.normal.dot(up_);
    return known.depth - up_.dot(away - fall * up_) - depth;
  }

  std::span<const PressedFace> faces_;
  Vector3 up_;
  std::vector<Overhang> parts_;
  std::vector<ContactCorner> corners_;
};

/// Width of a shadow, over the body's radius, below which some per cent of what it rubs are 1e-10 of all.
constexpr double narrow_shadow = 1e-6;

constexpr std::size_t most_kept = 64;    ///< polygons that press for which room is made at the start
constexpr double clip_rounding = 1e-15;  ///< of the largest depth: how far above the ground clipping may put a corner

void add_force(double east, const Vector3& east_moment, double weight, const Vector3& direction, double& sum,
               SlipLoad& load) {
  sum -= weight * east;
  load.moment -= weight * east_moment.cross(direction);
}

/// One direction of slip: the part of the polygon that slips forward, less the part that slips back.  `room` has twice
/// the polygon's corners.
void add_split(const ContactPolygon& polygon, double weight, const GroundView& view, const Ground& ground,
               const BodySlip& slip, ContactCorner* room, SlipLoad& load) {
  ContactPolygon part = polygon;
  part.corners = room;
  for (const double side : {1.0, -1.0}) {
    part.count = clip(polygon.corners, polygon.count, room, [&](const ContactCorner& corner) {
      return side * (slip.east + slip.east_slope.dot(corner.position));
    });
    if (part.count < 3) continue;
    const LoadIntegrals here = load_integrals(part);
    const double k = ground.stiffness, c = ground.damping;
    add_force(k * here.depth + c * here.depth_rate, k * here.depth_position + c * here.depth_rate_position,
              side * weight, view.east, load.east, load);
  }
}

/// Widens the range of slip by the polygon's.
void widen(const BodySlip& slip, const ContactPolygon& polygon, bool planar, SlipRange& range) {
  for (int i = 0; i < polygon.count; ++i) {
    const Vector3& u = polygon.corners[i].position;
    const double east = slip.east + slip.east_slope.dot(u), north = planar ? 0 : slip.north + slip.north_slope.dot(u);
    range.add(east, north);
  }
}

/// Sums the load over the facets near the ground, and keeps the polygons that press, so that friction of any number of
/// slip fields needs no other clipping.
class ContactLoader final : public ContactSurface {
 public:
  ContactLoader(const Body& body, const Ground& ground, Footprint* footprint = nullptr)
      : body_(body), ground_(ground), footprint_(footprint) {
    std::size_t longest = 0;
    for (const Loop& loop : body.facets().loops) {
      longest = std::max(longest, static_cast<std::size_t>(loop.end - loop.begin));
    }
    whole_.resize(longest);
    below_.resize(2 * longest);
    part_.resize(4 * longest);
    side_.resize(8 * longest);
    plane_.resize(4 * longest);
    pressing_.reserve(most_kept);
    corners_.reserve(4 * most_kept);
  }

  using ContactSurface::load;

  [[nodiscard]] ContactLoad load(const GroundView& view, LoadRates* rates, std::vector<int>* submerged) override {
    pressing_.clear();
    corners_.clear();
    looks_up_ = has_parts_ = false;
    Sums sums{view, view.normal(), {}, {}, {}, {}, rates, submerged};
    sums.rate_slope = sums.normal.cross(view.angular_velocity);
    sums.normal_rate = sums.rate_slope;
    sums.load.deepest = -2 * body_.radius();  // where no facet is looked at
    // Boxes are rounded, vertices are not: a margin keeps facets that just touch.
    const double margin = 1e-14 * body_.radius();
    body_.hierarchy().visit_below(view.plane(), margin,
                                  [&](int facet) { add_facet(body_.facets().facets[facet], sums); });
    take_ground(ground_, sums.pressing, sums.load, rates);
    return sums.load;
  }

  /// Where faces look up from below the ground (projected measure) a column of the ground rubs with the difference of
  /// what its two faces have, along the slip of the lower one, which it touches: never more than μ F_n, and never
  /// driving.
  [[nodiscard]] SlipLoad slip_load(const GroundView& view, const SlipField& field) override {
    SlipLoad load;
    // Over a patch taken as flat the two faces of a column have one velocity.
    const bool by_columns = looks_up_ && field.kind == SlipField::Kind::points;
    for (const Pressing& pressing : pressing_) {
      if (by_columns && !(pressing.weight > 0)) continue;
      add_slip(pressing, polygon_of(pressing), view, field, rounding_of(pressing, view, field), load);
    }
    if (!by_columns) return load;
    if (!has_parts_) find_overhangs(view);
    const Vector3 up = view.normal();
    for (const Overhang& part : overhangs_.parts()) {
      const Pressing& lower = pressing_[part.lower];
      const Pressing& upper = pressing_[part.upper];
      // From a corner of its own, since the depth of a steep face over one far from it is lost in rounding, as the
      // exact integrals of friction over the face's narrow shadow are.
      const ContactCorner* corners = overhangs_.corners(part);
      const Vector3 place = corners[0].position;
      Pressing above = lower;
      above.origin += place;
      above.weight *= -part.sign;
      above.depth = corners[0].depth;
      above.depth_slope += *upper.normal / upper.normal->dot(up);
      above_.assign(corners, corners + part.count);
      double deepest = 0;
      for (ContactCorner& corner : above_) {
        corner.position -= place;
        deepest = std::max(deepest, corner.depth);
      }
      SlipField over = field;
      over.rough = field.rough || -upper.weight * deepest <= narrow_shadow * body_.radius();
      const ContactPolygon polygon{above_.data(), part.count, *lower.normal, above.origin};
      add_slip(above, polygon, view, over, rounding_of(lower, view, field), load);
    }
    return load;
  }

  [[nodiscard]] SlipRange slip_range(const GroundView& view, const SlipField& field) const override {
    SlipRange range;
    for (const Pressing& pressing : pressing_) {
      if (!(pressing.weight > 0)) continue;
      widen(body_slip(pressing.origin, view, field), polygon_of(pressing), field.planar, range);
    }
    return range;
  }

 private:
  /// One evaluation: what it sees and what it has summed so far.
  struct Sums {
    const GroundView& view;
    Vector3 normal;       ///< of the ground, body frame
    Vector3 normal_rate;  ///< its rate of change there
    Vector3 rate_slope;   ///< δ̇ = −(vertical speed + rate_slope·u)
    LoadIntegrals pressing;
    ContactLoad load;
    LoadRates* rates;
    std::vector<int>* submerged;
  };
  struct FacetView {
    const Vector3& normal;
    double weight;  ///< of its area
    double weight_rate;
  };
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

  [[nodiscard]] ContactPolygon polygon_of(const Pressing& pressing) const {
    return {corners_.data() + pressing.begin, pressing.count, *pressing.normal, pressing.origin};
  }

  void add_facet(const Facet& facet, Sums& sums) {
    const bool projected = ground_.area == AreaMeasure::projected;
    const FacetView view{facet.normal, projected ? -facet.normal.dot(sums.normal) : 1,
                         projected ? -facet.normal.dot(sums.normal_rate) : 0};
    for (int l = facet.begin; l < facet.end; ++l) add_loop(view, body_.facets().loops[l], sums);
  }

  void add_loop(const FacetView& facet, const Loop& loop, Sums& sums) {
    const Facets& facets = body_.facets();
    ContactCorner* whole = whole_.data();
    const int count = loop.end - loop.begin;
    int deepest = 0;
    for (int i = 0; i < count; ++i) {
      const int vertex = facets.corners[loop.begin + i];
      const Vector3& u = facets.vertices[vertex];
      whole[i] = {u, -sums.view.height(u), -(sums.view.vertical_speed + sums.rate_slope.dot(u))};
      if (whole[i].depth > whole[deepest].depth) deepest = i;
      if (sums.submerged && whole[i].depth > 0) sums.submerged->push_back(vertex);
    }
    if (whole[deepest].depth > sums.load.deepest) {
      sums.load.deepest = whole[deepest].depth;
      sums.load.deepest_rate = whole[deepest].rate;
    }
    if (!(whole[deepest].depth > 0)) return;
    const Vector3 origin = whole[deepest].position;
    for (int i = 0; i < count; ++i) whole[i].position -= origin;
    const int below = clip(whole, count, below_.data(), [](const ContactCorner& corner) { return corner.depth; });
    add_below({below_.data(), below, facet.normal, origin}, facet, sums);
  }

  void add_below(const ContactPolygon& below, const FacetView& facet, Sums& sums) {
    assert(std::none_of(below.corners, below.corners + below.count, [&](const ContactCorner& corner) {
      return corner.depth < -clip_rounding * sums.load.deepest;
    }));
    if (footprint_) footprint_->add(below);
    const double k = ground_.stiffness, c = ground_.damping;
    const auto pressure = [&](const ContactCorner& corner) { return k + c * corner.rate; };
    const auto presses = [&](const ContactCorner& corner) { return pressure(corner) > 0; };
    if (std::all_of(below.corners, below.corners + below.count, presses)) {
      sums.load.energy += facet.weight * add_pressing(below, facet, sums);
      return;
    }
    const DepthIntegrals all = depth_integrals(below);
    sums.load.energy += facet.weight * all.depth_squared;
    // A heavily damped ground pushes bodies out at just the speed at which it lets go of them: no pressure, all
    // released.
    if (std::none_of(below.corners, below.corners + below.count, presses)) {
      sums.load.release_power += facet.weight * all.depth_rate;
      return;
    }
    ContactPolygon part = below;
    part.corners = part_.data();
    part.count =
        clip(below.corners, below.count, part_.data(), [&](const ContactCorner& corner) { return -pressure(corner); });
    sums.load.release_power += facet.weight * depth_integrals(part).depth_rate;
    part.count = clip(below.corners, below.count, part_.data(), pressure);
    add_pressing(part, facet, sums);
  }

  /// @return ∫δ², not weighted.
  double add_pressing(const ContactPolygon& pressing, const FacetView& facet, Sums& sums) {
    const LoadIntegrals here = load_integrals(pressing);
    sums.pressing.add(here, facet.weight);
    if (ground_.has_friction()) {
      const GroundView& view = sums.view;
      pressing_.push_back({corners_.size(), pressing.count, &facet.normal, pressing.origin, facet.weight,
                           -view.height(pressing.origin), -sums.normal});
      looks_up_ = looks_up_ || facet.weight < -upright;
      corners_.insert(corners_.end(), pressing.corners, pressing.corners + pressing.count);
    }
    if (!sums.rates) return here.depth_squared;
    sums.rates->rates.add(rate_integrals(pressing), facet.weight);
    const double k = ground_.stiffness, c = ground_.damping;
    sums.rates->force_by_area += facet.weight_rate * (k * here.depth + c * here.depth_rate);
    sums.rates->first_moment_by_area += facet.weight_rate * (k * here.depth_position + c * here.depth_rate_position);
    return here.depth_squared;
  }

  /// Adds the integrals of f_n = (k_G + c_G δ̇) δ against the slip direction over the polygon: by
  /// slip_integrals, right to rounding; in the plane exactly, by the polygon's parts on the two sides of the line of no
  /// slip.
  /// @param rounding  v_r.
  void add_slip(const Pressing& pressing, const ContactPolygon& polygon, const GroundView& view, const SlipField& field,
                double rounding, SlipLoad& load) {
    const double weight = pressing.weight;
    const BodySlip slip = body_slip(polygon.origin, view, field);
    if (field.planar && rounding == 0) return add_split(polygon, weight, view, ground_, slip, side_.data(), load);
    const Vector3 along = polygon.normal.unitOrthogonal(), across = polygon.normal.cross(along);
    for (int i = 0; i < polygon.count; ++i) {
      const Vector3& u = polygon.corners[i].position;
      plane_[i] = {along.dot(u), across.dot(u)};
    }
    const auto over_plane = [&](double value, const Vector3& slope) {
      return PlaneLinear{value, slope.dot(along), slope.dot(across)};
    };
    const Vector3 normal = view.normal(), rate_slope = normal.cross(view.angular_velocity);
    const double rate = -(view.vertical_speed + rate_slope.dot(polygon.origin));
    SlipPatch patch{plane_.data(),
                    polygon.count,
                    over_plane(pressing.depth, pressing.depth_slope),
                    over_plane(ground_.stiffness + ground_.damping * rate, -ground_.damping * rate_slope),
                    over_plane(slip.east, slip.east_slope),
                    over_plane(slip.north, slip.north_slope),
                    rounding,
                    field.digits};
    if (field.planar) patch.north = {};
    const SlipIntegrals here = field.rough ? rough_slip_integrals(patch) : slip_integrals(patch);
    const auto moment = [&](double value, double x, double y) -> Vector3 {
      return value * polygon.origin + x * along + y * across;
    };
    add_force(here.east, moment(here.east, here.east_x, here.east_y), weight, view.east, load.east, load);
    add_force(here.north, moment(here.north, here.north_x, here.north_y), weight, view.north, load.north, load);
  }

  [[nodiscard]] double rounding_of(const Pressing& pressing, const GroundView& view, const SlipField& field) const {
    if (field.floor == 0) return field.regularisation;
    SlipRange range;
    widen(body_slip(pressing.origin, view, field), polygon_of(pressing), field.planar, range);
    return range.width() > SlipField::alike * field.floor ? field.regularisation
                                                          : std::max(field.regularisation, field.floor);
  }

  void find_overhangs(const GroundView& view) {
    faces_.clear();
    for (const Pressing& pressing : pressing_) faces_.push_back({polygon_of(pressing), pressing.weight});
    overhangs_.find(faces_, view.normal());
    has_parts_ = true;
  }

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

}  // namespace

std::unique_ptr<ContactSurface> facet_surface(const Body& body, const Ground& ground, Footprint* footprint) {
  return std::make_unique<ContactLoader>(body, ground, footprint);
}

}  // namespace clatter::numeric
