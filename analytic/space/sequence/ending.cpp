// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/ending.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <vector>

#include "analytic/base/limits.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/landing/face_friction.hpp"

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
  [[nodiscard]] std::optional<Face> lowest(const Vector3& down) const {
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

  /// Least distance inside the face of the foot of the perpendicular from the centre of mass [m].
  [[nodiscard]] double room(const Face& f) const { return distance(f, nearest_edge(f)); }
  /// The face on which it comes to rest without energy from this direction down; nothing if none is found.
  [[nodiscard]] std::optional<Face> rolled_down(Vector3 down) const {
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

  /// Height of the centre of mass on the lowest way from that face to another on which it can rest [m].
  [[nodiscard]] double barrier(const Face& rest) const {
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

 private:
  struct Swing {
    int vertex = -1;  ///< that comes down
    double angle = 0;
  };
  [[nodiscard]] const Vector3& place(int i) const { return places_[i]; }

  /// The first vertex to come down where `down` turns towards the direction `towards`, with the lowest ones on the
  /// ground.
  [[nodiscard]] Swing swing(const Vector3& down, const Vector3& towards, int on, int with) const {
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

  [[nodiscard]] Face face(const Vector3& down) const {
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
    std::ranges::sort(f.corners, {}, [&](int i) {
      return std::atan2((place(i) - middle).dot(across), (place(i) - middle).dot(axis));
    });
    std::rotate(f.corners.begin(), std::ranges::max_element(f.corners),
                f.corners.end());  // rounding does not choose the first
    return f;
  }

  /// Outward in the face, across the edge from its corner k to the next.
  [[nodiscard]] Vector3 outward(const Face& f, std::size_t k) const {
    return (place(f.corners[(k + 1) % f.corners.size()]) - place(f.corners[k])).cross(f.down).normalized();
  }

  /// From the foot of the perpendicular from the centre of mass to that edge.
  [[nodiscard]] double distance(const Face& f, std::size_t k) const { return outward(f, k).dot(place(f.corners[k])); }

  [[nodiscard]] std::size_t nearest_edge(const Face& f) const {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < f.corners.size(); ++k) {
      if (distance(f, k) < distance(f, nearest)) nearest = k;
    }
    return nearest;
  }

  [[nodiscard]] bool can_rest(const Face& f) const { return room(f) >= 0; }

  const std::vector<Vector3>& places_;
  double reach_;
};

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

namespace {

/// What is left of a number that is zero but for rounding, relative; of velocities, to a fall by the size of the body.
constexpr double nothing = 1e-12;

/// The turn that a rotation at ω₀ + α t makes, by Magnus's series to the fourth order in steps of a hundredth.
Quaternion turned(const Vector3& rate, const Vector3& change, double time) {
  constexpr double step = 0.01;
  const Vector3 all = time * (rate + time / 2 * change);
  if (rate.cross(change) == Vector3::Zero()) return turn_by(all);
  const int steps = 1 + static_cast<int>(std::fmin(1e6, time * (rate.norm() + time * change.norm()) / step));
  const double h = time / steps;
  Quaternion turn = Quaternion::Identity();
  for (int i = 0; i < steps; ++i) {
    const Vector3 now = rate + i * h * change;
    turn = turn_by(h * (now + h / 2 * change) + h * h * h / 12 * change.cross(now)) * turn;
  }
  return turn.normalized();
}

}  // namespace

GroundedMotion::GroundedMotion(const Drop& drop, const State& now, const std::vector<int>& touching)
    : drop_(drop), now_(now), friction_(drop.law.most_friction()) {
  const ImpactLaw& law = drop.law;
  const bool has_force = law.friction != FrictionKind::impulse_ratio || law.friction_value == 0;
  if (!(drop.gravity > 0) || !has_force || touching.empty()) return;
  const Body& body = drop.body;
  const double fall = std::sqrt(drop.gravity * body.reach());
  now_.velocity.z() = 0;
  if (now_.velocity.norm() <= nothing * fall) now_.velocity.setZero();
  if (std::fabs(now_.angular_velocity.z()) * body.reach() <= nothing * fall) now_.angular_velocity.z() = 0;
  if (body.is_ball()) {
    roll(now_.position.z(), body.inertia(0, 0));
  } else if (const auto radius = mantle()) {
    const Vector3 axis = body.round(0).axis;
    roll(*radius, axis.dot(body.inertia * axis));
  } else {
    lie(touching);
  }
}

/// The radius on which a body of revolution lies with its axis level, moving across that and turning about it.
std::optional<double> GroundedMotion::mantle() const {
  const Body& body = drop_.body;
  if (!body.transverse_moment() || body.points() < 2 || body.rims.empty()) return {};
  const Vector3 axis = now_.attitude * body.rims.front().axis;
  const Vector3 &v = now_.velocity, &w = now_.angular_velocity;
  const auto lies = [&](int i) {
    const Vector3 place = touching_place(body, now_.attitude, i);
    return std::fabs(now_.position.z() + (now_.attitude * place).z()) <= 1e-9 * body.reach();
  };
  for (int i = 0; i < 2; ++i) {
    if (!lies(i)) return {};
  }
  const bool moves_across = std::fabs(v.dot(axis)) <= nothing * v.norm() && w.cross(axis).norm() <= nothing * w.norm();
  return moves_across ? std::optional(now_.position.z()) : std::nullopt;
}

State GroundedMotion::after(const Piece& piece, double time) {
  State s = piece.state;
  s.position += time * (s.velocity + time / 2 * piece.acceleration);
  s.attitude = (turned(s.angular_velocity, piece.turning, time) * s.attitude).normalized();
  s.velocity += time * piece.acceleration;
  s.angular_velocity += time * piece.turning;
  return s;
}

std::optional<State> GroundedMotion::at(double time) const {
  if (!face_) {
    const auto later = std::ranges::find_if(pieces_, [&](const Piece& p) { return p.begin > time; });
    const Piece& piece = *std::prev(later);
    return after(piece, time - piece.begin);
  }
  const auto slid = slide_and_spin(*face_, area_, time);
  if (!slid) return {};
  State s = now_;
  s.position.head<2>() += slid->way;
  s.attitude = (turn_by(slid->turn * Vector3::UnitZ()) * s.attitude).normalized();
  s.velocity = {slid->slip.x(), slid->slip.y(), 0};
  s.angular_velocity = {0, 0, slid->spin};
  return s;
}

void GroundedMotion::summarise(LastMotion::Kind kind, double duration) {
  if (!face_ && pieces_.empty()) pieces_.push_back({.state = now_});
  summary_ = LastMotion{.kind = kind, .state = now_, .duration = duration};
  const auto end = duration < infinite ? at(duration) : std::optional(now_);
  if (!end) return summary_.reset();
  summary_->distance = duration < infinite ? (end->position - now_.position).norm() : infinite;
  summary_->velocity_after = end->velocity;
  summary_->angular_velocity_after = end->angular_velocity;
}

void GroundedMotion::roll(double radius, double moment) {
  if (drop_.gravity_along != 0) return;
  const double inverse = drop_.body.mass * radius * radius / moment;
  const Vector3 up = Vector3::UnitZ();
  Vector3 slip = now_.velocity - radius * now_.angular_velocity.cross(up);
  slip.z() = 0;
  const bool moves = now_.velocity.norm() > 0 || now_.angular_velocity.head<2>().norm() > 0;
  const bool slips = slip.norm() > nothing * (now_.velocity.norm() + radius * now_.angular_velocity.norm());
  pieces_.push_back({.state = now_});
  if (!moves && now_.angular_velocity.z() == 0) return summarise(LastMotion::Kind::rests, 0);
  if (!moves) return summarise(LastMotion::Kind::spins, infinite);
  if (slips && friction_ == 0) return summarise(LastMotion::Kind::slides, infinite);
  if (!slips) return summarise(LastMotion::Kind::rolls, 0);
  const Vector3 along = slip.normalized();
  const double time = slip.norm() / (friction_ * drop_.gravity * (1 + inverse));
  pieces_[0].acceleration = -friction_ * drop_.gravity * along;
  pieces_[0].turning = friction_ * drop_.gravity * inverse / radius * up.cross(along);
  pieces_.push_back({.begin = time, .state = after(pieces_[0], time)});
  summarise(LastMotion::Kind::rolls, time);
}

/// Whether the ground can push the body up at this point, from below the centre of mass.
bool GroundedMotion::carries(const Vector2& point) const {
  const double near = 1e-9 * drop_.body.reach();
  if (area_.radius > 0 || area_.corners.size() > 2) return area_.contains(point);
  if (area_.corners.size() < 2) return area_.corners.size() == 1 && (point - area_.corners[0]).norm() <= near;
  const Vector2 edge = area_.corners[1] - area_.corners[0], from = point - area_.corners[0];
  const double share = from.dot(edge) / edge.squaredNorm();
  return std::fabs(cross(edge, from)) <= near * edge.norm() && share >= 0 && share <= 1;
}

void GroundedMotion::lie(const std::vector<int>& touching) {
  const Body& body = drop_.body;
  const auto corner = touching_corner(body, now_.attitude, touching.front());
  const Vector3 middle = now_.attitude * corner.place;
  area_.radius = corner.radius;
  if (corner.radius > 0) {
    area_.corners = {Vector2(middle.head<2>())};
  } else {
    for (const int i : touching)
      area_.corners.push_back((now_.attitude * touching_place(body, now_.attitude, i)).head<2>());
    const Vector2 centre = area_.middle();
    std::ranges::sort(area_.corners, {},
                      [&](const Vector2& p) { return std::atan2(p.y() - centre.y(), p.x() - centre.x()); });
  }
  const Vector3& w = now_.angular_velocity;
  if (!(w.head<2>().norm() <= nothing * w.norm())) return;  // it does not lie still on them
  now_.angular_velocity = {0, 0, w.z()};
  if (drop_.gravity_along != 0) return slide_on_slope();
  if (w.z() != 0 && friction_ > 0) return slide_and_turn();
  slide_straight();
}

void GroundedMotion::slide_straight() {
  const double speed = now_.velocity.norm(), spin = now_.angular_velocity.z();
  const Vector3 along = speed > 0 ? Vector3(now_.velocity / speed) : Vector3::Zero();
  if (!carries(friction_ * now_.position.z() * along.head<2>())) return;
  if (speed == 0 && spin == 0) return summarise(LastMotion::Kind::rests, 0);
  if (friction_ == 0) return summarise(speed > 0 ? LastMotion::Kind::slides : LastMotion::Kind::spins, infinite);
  const double time = speed / (friction_ * drop_.gravity);
  pieces_.push_back({.state = now_, .acceleration = -friction_ * drop_.gravity * along});
  Piece rest{.begin = time, .state = after(pieces_[0], time)};
  rest.state.velocity.setZero();
  pieces_.push_back(rest);
  summarise(LastMotion::Kind::slides, time);
  summary_->distance = speed * time / 2;
}

void GroundedMotion::slide_on_slope() {
  const double pull = drop_.gravity_along, rub = friction_ * drop_.gravity, v = now_.velocity.x();
  const double held = pull / drop_.gravity * now_.position.z(), lead = friction_ * now_.position.z();
  if (now_.velocity.y() != 0 || now_.angular_velocity.z() != 0) return;
  Piece piece{.state = now_};
  double time = 0;
  if (v != 0) {
    if (!carries({std::copysign(lead, v), 0})) return;
    piece.acceleration.x() = pull - std::copysign(rub, v);
    pieces_.push_back(piece);
    if (!(piece.acceleration.x() * v < 0)) return summarise(LastMotion::Kind::slides, infinite);
    time = -v / piece.acceleration.x();
    piece = {.begin = time, .state = after(piece, time)};
    piece.state.velocity.setZero();
  }
  const bool is_held = std::fabs(pull) <= rub;
  if (!carries({is_held ? held : std::copysign(lead, pull), 0})) return;
  if (!is_held) piece.acceleration.x() = pull - std::copysign(rub, pull);
  pieces_.push_back(piece);
  if (!is_held) return summarise(LastMotion::Kind::slides, infinite);
  summarise(v != 0 ? LastMotion::Kind::slides : LastMotion::Kind::rests, time);
}

/// A spin about an axis that is no principal one rocks the body, which slide_and_spin() leaves out.
void GroundedMotion::slide_and_turn() {
  const Vector3 up = now_.attitude.conjugate() * Vector3::UnitZ(), momentum = drop_.body.inertia * up;
  const double moment = up.dot(momentum);
  if (!((momentum - moment * up).norm() <= nothing * moment)) return;
  if (area_.radius == 0 && area_.corners.size() < 3) return;
  face_ = SpinningFace{.mass = drop_.body.mass,
                       .moment = moment,
                       .depth = now_.position.z(),
                       .friction = friction_,
                       .gravity = drop_.gravity,
                       .slip = now_.velocity.head<2>(),
                       .spin = now_.angular_velocity.z()};
  const auto stop = slide_and_spin(*face_, area_, infinite);
  if (!stop || !stop->has_stopped) return face_.reset();
  summarise(now_.velocity == Vector3::Zero() ? LastMotion::Kind::spins : LastMotion::Kind::slides, stop->time);
}

}  // namespace clatter::analytic::space
