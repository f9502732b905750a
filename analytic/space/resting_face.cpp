// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/resting_face.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::infinite;
namespace {

/// A face of the hull, as the ground would see it.
struct LowestFace {
  std::vector<int> corners;     ///< in order around it
  Vector3 normal;               ///< outward, world frame
  double depth = 0, least = 0;  ///< of the face and of the other vertices inside it, from the centre of mass [m]
};

/// The face of the lowest three vertices; nothing if they are not of one.
std::optional<LowestFace> lowest_face(const Body& body, const State& now) {
  std::vector<Vector3> arms;
  std::vector<int> order;
  for (const Vector3& vertex : body.vertices) {
    order.push_back(static_cast<int>(arms.size()));
    arms.push_back(now.attitude * vertex);
  }
  const auto arm = [&](int i) -> const Vector3& { return arms[static_cast<std::size_t>(i)]; };
  std::ranges::sort(order, {}, [&](int i) { return arm(i).z(); });
  if (order.size() < 4 || !body.rims.empty() || !body.ellipsoids.empty()) return {};
  const Vector3& first = arm(order[0]);
  LowestFace face;
  for (std::size_t k = 2; k < order.size(); ++k) {
    face.normal = (arm(order[1]) - first).cross(arm(order[k]) - first);
    if (face.normal.norm() > 1e-9 * body.reach() * body.reach()) break;
  }
  face.normal = std::copysign(1 / face.normal.norm(), -face.normal.z()) * face.normal;
  face.depth = face.normal.dot(first);
  face.least = -body.reach();
  for (const int i : order) {
    const double depth = face.normal.dot(arm(i));
    if (std::fabs(depth - face.depth) <= 1e-9 * body.reach()) face.corners.push_back(i);
    else face.least = std::fmax(face.least, depth);
  }
  if (!(face.least < face.depth)) return {};
  Vector3 middle = Vector3::Zero();
  for (const int i : face.corners) middle += arm(i) / static_cast<double>(face.corners.size());
  const Vector3 axis = (first - middle).normalized();
  std::ranges::sort(face.corners, {}, [&](int i) {
    const Vector3 from_middle = arm(i) - middle;
    return std::atan2(face.normal.dot(axis.cross(from_middle)), axis.dot(from_middle));
  });
  return face;
}

/// Least distance inside the face of the foot of the perpendicular from the centre of mass.
double room_around_centre(const Body& body, const State& now, const LowestFace& face) {
  double room = body.reach();
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const auto next = static_cast<std::size_t>(face.corners[(k + 1) % face.corners.size()]);
    const Vector3 from = now.attitude * body.vertices[static_cast<std::size_t>(face.corners[k])];
    const Vector3 edge = (now.attitude * body.vertices[next] - from).normalized();
    room = std::fmin(room, face.normal.dot(edge.cross(-from)));
  }
  return room;
}

/// The heights over which a body rolls from face to face: (2).
class RollingBody {
 public:
  explicit RollingBody(const Body& body) : places_(body.vertices), reach_(body.reach()) {}

  struct Face {
    Vector3 down;              ///< outward normal, unit, body frame
    double depth;              ///< from the centre of mass [m]
    std::vector<int> corners;  ///< in order around it, counter-clockwise seen from outside
  };
  /// The face on which it comes to rest without energy from this direction down; nothing if none is found.
  [[nodiscard]] std::optional<Face> rolled_down(Vector3 down) const;
  /// Height of the centre of mass on the lowest way from that face to another on which it can rest [m].
  [[nodiscard]] double barrier(const Face& rest) const;

 private:
  struct Swing {
    int vertex = -1;  ///< that comes down
    double angle = 0;
  };
  [[nodiscard]] const Vector3& place(int i) const { return places_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Swing swing(const Vector3& down, const Vector3& towards, int on, int with) const;
  [[nodiscard]] Face face(const Vector3& down) const;
  /// Outward in the face, across the edge from its corner k to the next.
  [[nodiscard]] Vector3 outward(const Face& f, std::size_t k) const;
  [[nodiscard]] std::optional<std::size_t> edge_outside(const Face& f) const;

  const std::vector<Vector3>& places_;
  double reach_;
};

/// The first vertex to come down where `down` turns towards the direction `towards`, with the lowest ones on the
/// ground.
RollingBody::Swing RollingBody::swing(const Vector3& down, const Vector3& towards, int on, int with) const {
  Swing first{.angle = infinite};
  for (int i = 0; i < static_cast<int>(places_.size()); ++i) {
    if (i == on || i == with) continue;
    const Vector3 side = place(i) - place(on);
    const double rate = side.dot(towards), below = side.dot(down);
    if (!(std::hypot(rate, below) > 1e-9 * reach_)) continue;  // on the edge
    const double angle = std::atan2(std::fmax(-below, 0.0), rate);
    if (angle < first.angle) first = {i, angle};
  }
  return first;
}

RollingBody::Face RollingBody::face(const Vector3& down) const {
  Face f{.down = down, .depth = -infinite, .corners = {}};
  for (const Vector3& p : places_) f.depth = std::fmax(f.depth, down.dot(p));
  Vector3 middle = Vector3::Zero();
  for (int i = 0; i < static_cast<int>(places_.size()); ++i) {
    if (down.dot(place(i)) < f.depth - 1e-9 * reach_) continue;
    f.corners.push_back(i);
    middle += place(i);
  }
  middle /= static_cast<double>(f.corners.size());
  const Vector3 axis = (place(f.corners[0]) - middle).normalized(), across = down.cross(axis);
  std::ranges::sort(f.corners, {},
                    [&](int i) { return std::atan2((place(i) - middle).dot(across), (place(i) - middle).dot(axis)); });
  return f;
}

Vector3 RollingBody::outward(const Face& f, std::size_t k) const {
  return (place(f.corners[(k + 1) % f.corners.size()]) - place(f.corners[k])).cross(f.down).normalized();
}

/// The edge farthest on whose outer side the centre of mass is.
std::optional<std::size_t> RollingBody::edge_outside(const Face& f) const {
  std::optional<std::size_t> edge;
  double least = 0;
  for (std::size_t k = 0; k < f.corners.size(); ++k) {
    const double room = outward(f, k).dot(place(f.corners[k]));
    if (room < least) least = room, edge = k;
  }
  return edge;
}

std::optional<RollingBody::Face> RollingBody::rolled_down(Vector3 down) const {
  const auto on = static_cast<int>(
      std::ranges::max_element(places_, {}, [&](const Vector3& p) { return p.dot(down); }) - places_.begin());
  Vector3 towards = down.dot(place(on)) * down - place(on);  // away from the vertex
  towards = towards.norm() > 1e-9 * reach_ ? Vector3(towards.normalized()) : down.unitOrthogonal();
  Swing next = swing(down, towards, on, on);
  if (next.vertex < 0) return {};
  down = (std::cos(next.angle) * down + std::sin(next.angle) * towards).normalized();
  towards = (place(next.vertex) - place(on)).cross(down).normalized();
  if (towards.dot(place(on)) > 0) towards = -towards;
  next = swing(down, towards, on, next.vertex);
  for (std::size_t turn = 0; turn <= 3 * places_.size(); ++turn) {
    if (next.vertex < 0) return {};
    down = (std::cos(next.angle) * down + std::sin(next.angle) * towards).normalized();
    Face f = face(down);
    if (f.corners.size() < 3) return {};
    const auto edge = edge_outside(f);
    if (!edge) return f;
    towards = outward(f, *edge);
    next = swing(down, towards, f.corners[*edge], f.corners[(*edge + 1) % f.corners.size()]);
  }
  return {};
}

double RollingBody::barrier(const Face& rest) const {
  std::multimap<double, Face> open{{rest.depth, rest}};
  std::vector<std::vector<int>> seen;
  while (!open.empty()) {
    const auto [height, f] = *open.begin();
    open.erase(open.begin());
    auto sorted = f.corners;
    std::ranges::sort(sorted);
    if (std::ranges::count(seen, sorted) > 0) continue;
    if (!seen.empty() && !edge_outside(f)) return height;
    seen.push_back(std::move(sorted));
    for (std::size_t k = 0; k < f.corners.size(); ++k) {
      const int on = f.corners[k], with = f.corners[(k + 1) % f.corners.size()];
      const Vector3 towards = outward(f, k);
      const Swing next = swing(f.down, towards, on, with);
      if (next.vertex < 0) return height;
      const double room = towards.dot(place(on)), top = std::atan2(room, f.depth);
      Face other = face((std::cos(next.angle) * f.down + std::sin(next.angle) * towards).normalized());
      const double most = top > 0 && top < next.angle ? std::hypot(room, f.depth) : std::fmax(f.depth, other.depth);
      open.emplace(std::fmax(height, most), std::move(other));
    }
  }
  return infinite;  // of the only face
}

/// By (2).
std::optional<Rest> trapped(const Drop& drop, const State& now) {
  const ImpactLaw& law = drop.law.law;
  const Body& body = drop.body;
  const bool rubs = law.friction != FrictionKind::none;
  if (law.friction == FrictionKind::impulse_ratio) return {};
  if (body.vertices.size() < 4 || !body.rims.empty() || !body.ellipsoids.empty()) return {};
  const Vector3 w = now.attitude.conjugate() * now.angular_velocity;
  const double moving = rubs ? now.velocity.squaredNorm() : now.velocity.z() * now.velocity.z();
  const RollingBody rolling(body);
  const auto face = rolling.rolled_down(now.attitude.conjugate() * Vector3(0, 0, -1));
  if (!face) return {};
  const double above =
      body.mass * (moving / 2 + drop.gravity * (now.position.z() - face->depth)) + w.dot(body.inertia * w) / 2;
  const double margin = rubs && law.law == RestitutionLaw::newton ? 4 : 1 + 1e-9;
  if (!(margin * above < body.mass * drop.gravity * (rolling.barrier(*face) - face->depth))) return {};
  return Rest{.corners = face->corners, .latest = infinite};
}

}  // namespace

double vertical_energy(const Drop& drop, const State& now) {
  const auto face = lowest_face(drop.body, now);
  if (!face) return infinite;
  const Matrix3 axes = now.attitude.toRotationMatrix();
  Vector3 turning = now.angular_velocity;
  turning.z() = 0;
  const Vector3 w = axes.transpose() * turning;
  return drop.body.mass *
             (now.velocity.z() * now.velocity.z() / 2 + drop.gravity * std::fmax(now.position.z() - face->depth, 0.0)) +
         w.dot(drop.body.inertia * w) / 2;
}

std::optional<Rest> settles(const Drop& drop, const State& now, double time) {
  const ImpactLaw& law = drop.law.law;
  if (!(drop.gravity > 0) || law.law == RestitutionLaw::viscoelastic || !(law.restitution < 1)) return {};
  const Body& body = drop.body;
  const auto face = lowest_face(body, now);
  if (!face) return trapped(drop, now);
  const Matrix3 axes = now.attitude.toRotationMatrix(), inertia = axes * body.inertia * axes.transpose();
  const double weight = body.mass * drop.gravity, spin = now.angular_velocity.z();
  const double friction = law.friction == FrictionKind::none ? 0 : std::fabs(law.friction_value);
  const double unbalanced = inertia.col(2).head<2>().norm() + face->normal.head<2>().norm() * inertia.norm();
  const double room = room_around_centre(body, now, *face) - friction * face->depth - spin * spin * unbalanced / weight;
  const double energy = vertical_energy(drop, now);
  // A tilt φ lowers other points by φ times their distance at most.
  const double tilt = energy / (weight * room), now_tilted = face->normal.head<2>().norm();
  const double clear = face->depth - face->least;
  if (!(room > 0) || !(2 * std::fmax(tilt, now_tilted) * 2 * body.reach() < clear)) return trapped(drop, now);
  const double speed = std::sqrt(2 * energy / body.mass);
  return Rest{.corners = face->corners, .latest = time + 8 * speed / (drop.gravity * (1 - law.restitution))};
}

}  // namespace clatter::analytic::space
