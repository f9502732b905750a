// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/resting_face.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <vector>

#include "analytic/base/limits.hpp"

namespace clatter::analytic::space {

using detail::infinite;
namespace {

/// A body whose hull has vertices only, its faces, and the heights over which it rolls from face to face: (2).  Body
/// frame.
class RollingBody {
 public:
  explicit RollingBody(const Body& body) : places_(body.vertices), reach_(body.reach()) {}

  struct Face {
    Vector3 down;              ///< outward normal, unit
    double depth;              ///< from the centre of mass [m]
    std::vector<int> corners;  ///< in order around it, counter-clockwise seen from outside
    double next = 0;           ///< depth of the deepest of the other vertices [m]
  };
  /// The face of the three vertices lowest in this direction; nothing if they are not of one.
  [[nodiscard]] std::optional<Face> lowest(const Vector3& down) const;
  /// Least distance inside the face of the foot of the perpendicular from the centre of mass [m].
  [[nodiscard]] double room(const Face& f) const { return distance(f, nearest_edge(f)); }
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
  /// From the foot of the perpendicular from the centre of mass to that edge.
  [[nodiscard]] double distance(const Face& f, std::size_t k) const { return outward(f, k).dot(place(f.corners[k])); }
  [[nodiscard]] std::size_t nearest_edge(const Face& f) const;
  [[nodiscard]] bool can_rest(const Face& f) const { return room(f) >= 0; }

  const std::vector<Vector3>& places_;
  double reach_;
};

std::optional<RollingBody::Face> RollingBody::lowest(const Vector3& down) const {
  std::vector<int> order(places_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, std::greater{}, [&](int i) { return place(i).dot(down); });
  Vector3 normal = down;
  for (std::size_t k = 2; k < order.size(); ++k) {
    normal = (place(order[1]) - place(order[0])).cross(place(order[k]) - place(order[0]));
    if (normal.norm() > 1e-9 * reach_ * reach_) break;
  }
  normal = std::copysign(1 / normal.norm(), normal.dot(down)) * normal;
  Face f = face(normal);
  const bool is_face = f.depth - normal.dot(place(order[0])) <= 1e-9 * reach_;
  return is_face && f.next < f.depth ? std::optional(std::move(f)) : std::nullopt;
}

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
  Face f{.down = down, .depth = -infinite, .corners = {}, .next = -reach_};
  for (const Vector3& p : places_) f.depth = std::fmax(f.depth, down.dot(p));
  Vector3 middle = Vector3::Zero();
  for (int i = 0; i < static_cast<int>(places_.size()); ++i) {
    const double depth = down.dot(place(i));
    if (depth < f.depth - 1e-9 * reach_) {
      f.next = std::fmax(f.next, depth);
      continue;
    }
    f.corners.push_back(i);
    middle += place(i);
  }
  middle /= static_cast<double>(f.corners.size());
  const Vector3 axis = (place(f.corners[0]) - middle).normalized(), across = down.cross(axis);
  std::ranges::sort(f.corners, {},
                    [&](int i) { return std::atan2((place(i) - middle).dot(across), (place(i) - middle).dot(axis)); });
  std::rotate(f.corners.begin(), std::ranges::max_element(f.corners),
              f.corners.end());  // rounding does not choose the first
  return f;
}

Vector3 RollingBody::outward(const Face& f, std::size_t k) const {
  return (place(f.corners[(k + 1) % f.corners.size()]) - place(f.corners[k])).cross(f.down).normalized();
}

std::size_t RollingBody::nearest_edge(const Face& f) const {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < f.corners.size(); ++k) {
    if (distance(f, k) < distance(f, nearest)) nearest = k;
  }
  return nearest;
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
    if (can_rest(f)) return f;
    const std::size_t edge = nearest_edge(f);
    towards = outward(f, edge);
    next = swing(down, towards, f.corners[edge], f.corners[(edge + 1) % f.corners.size()]);
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
    if (!seen.empty() && can_rest(f)) return height;
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

/// Down, in body axes.
Vector3 down(const State& now) { return now.attitude.conjugate() * Vector3(0, 0, -1); }

/// Whether it has faces.
bool is_polyhedron(const Body& body) {
  return body.vertices.size() >= 4 && body.rims.empty() && body.ellipsoids.empty();
}

/// A drop of an outline as one of a prism, so wide that it does not roll over its sides; vertex i becomes 2i and 2i
/// + 1.
Drop prism(const Drop& flat) {
  Drop wide = flat;
  wide.body.vertices.clear();
  for (const Vector3& vertex : flat.body.vertices) {
    for (const double side : {-1.0, 1.0})
      wide.body.vertices.push_back(vertex + side * 4 * flat.body.reach() * Vector3::UnitY());
  }
  return wide;
}

/// Whether it has two ends and nothing else, on which it lies in the end.
bool is_rod(const Body& body) { return body.vertices.size() == 2 && body.is_flat(); }

bool is_outline(const Body& body) { return body.vertices.size() > 2 && body.is_flat(); }

/// By (2).
std::optional<Rest> trapped(const Drop& drop, const State& now) {
  const ImpactLaw& law = drop.law;
  const Body& body = drop.body;
  const bool rubs = law.friction != FrictionKind::none;
  if (law.friction == FrictionKind::impulse_ratio || drop.gravity_along != 0) return {};
  const Vector3 w = now.attitude.conjugate() * now.angular_velocity;
  const double moving = rubs ? now.velocity.squaredNorm() : now.velocity.z() * now.velocity.z();
  const RollingBody rolling(body);
  const auto face = rolling.rolled_down(down(now));
  if (!face) return {};
  const double above =
      body.mass * (moving / 2 + drop.gravity * (now.position.z() - face->depth)) + w.dot(body.inertia * w) / 2;
  const double margin = rubs && may_gain_energy(law.law) ? 4 : 1 + 1e-9;
  if (!(margin * above < body.mass * drop.gravity * (rolling.barrier(*face) - face->depth))) return {};
  return Rest{.corners = face->corners, .latest = infinite};
}

}  // namespace

double vertical_energy(const Drop& drop, const State& now) {
  if (is_outline(drop.body)) return vertical_energy(prism(drop), now);
  double depth = 0;
  if (!is_rod(drop.body)) {
    if (!is_polyhedron(drop.body)) return infinite;
    const auto face = RollingBody(drop.body).lowest(down(now));
    if (!face) return infinite;
    depth = face->depth;
  }
  const Matrix3 axes = now.attitude.toRotationMatrix();
  Vector3 turning = now.angular_velocity;
  turning.z() = 0;
  const Vector3 w = axes.transpose() * turning;
  return drop.body.mass *
             (now.velocity.z() * now.velocity.z() / 2 + drop.gravity * std::fmax(now.position.z() - depth, 0.0)) +
         w.dot(drop.body.inertia * w) / 2;
}

std::optional<Rest> settles(const Drop& drop, const State& now, double time) {
  const ImpactLaw& law = drop.law;
  if (!(drop.gravity > 0) || law.law == RestitutionLaw::viscoelastic || !(law.restitution < 1)) return {};
  const Body& body = drop.body;
  if (is_outline(body)) {
    auto rest = settles(prism(drop), now, time);
    if (!rest) return {};
    for (int& corner : rest->corners) corner /= 2;
    std::ranges::sort(rest->corners);
    rest->corners.erase(std::unique(rest->corners.begin(), rest->corners.end()), rest->corners.end());
    return rest;
  }
  if (!is_polyhedron(body)) return {};
  const RollingBody rolling(body);
  const auto face = rolling.lowest(down(now));
  if (!face) return trapped(drop, now);
  const Matrix3 axes = now.attitude.toRotationMatrix(), inertia = axes * body.inertia * axes.transpose();
  const double weight = body.mass * drop.gravity, spin = now.angular_velocity.z();
  const double now_tilted = (now.attitude * face->down).head<2>().norm();
  const double unbalanced = inertia.col(2).head<2>().norm() + now_tilted * inertia.norm();
  const double room = rolling.room(*face) - law.most_friction() * face->depth - spin * spin * unbalanced / weight;
  const double energy = vertical_energy(drop, now);
  // A tilt φ lowers other points by φ times their distance at most.
  const double tilt = energy / (weight * room), clear = face->depth - face->next;
  if (!(room > 0) || !(2 * std::fmax(tilt, now_tilted) * 2 * body.reach() < clear)) return trapped(drop, now);
  const double speed = std::sqrt(2 * energy / body.mass);
  return Rest{.corners = face->corners, .latest = time + 8 * speed / (drop.gravity * (1 - law.restitution))};
}

}  // namespace clatter::analytic::space
