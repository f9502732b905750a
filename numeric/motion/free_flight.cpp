// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/free_flight.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace clatter::numeric {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A body in flight, seen from its body frame.
struct View {
  GroundPlane plane;
  Vector3 rate_slope;  ///< height rate of the point u: vertical_speed + rate_slope·u
  double vertical_speed;

  explicit View(const MotionState& state) {
    plane = {state.attitude.conjugate() * Vector3::UnitZ(), state.centre.z()};
    vertical_speed = state.velocity.z();
    rate_slope = plane.normal.cross(state.angular_velocity);
  }
};

/// Height and its rate, of a point or a lower bound over a box.
struct Approach {
  double height;
  double rate;
  double acceleration;  ///< bound
};

/// The time for which the bound keeps the height positive.
double safe_time(const Approach& at) {
  const double height = std::max(at.height, 0.0);
  const double root = std::sqrt(at.rate * at.rate + 2 * at.acceleration * height);
  if (at.rate > 0)
    return at.acceleration > 0 ? (at.rate + root) / at.acceleration : std::numeric_limits<double>::infinity();
  const double speed = root - at.rate;
  return speed > 0 ? 2 * height / speed : std::numeric_limits<double>::infinity();
}

void for_each_vertex(const Body& body, int facet, auto&& visit) {
  const Facets& facets = body.facets();
  facets.for_each_corner(facet, [&](int vertex) { visit(facets.vertices[vertex]); });
}

/// The smallest safe time of all vertices, and whether one of them touches now.
struct Search {
  double time = std::numeric_limits<double>::infinity();
  bool touches = false;
};

/// The earliest time at which an end may touch: of a ball by its centre, of an ellipsoid by
///     |S(n + τ ṅ)| <= |S n| + τ (S n·S ṅ)/|S n| + τ²/2 |S ṅ|²/|S n|,
/// with which its lowest point stays above the height that its present one leads to by a bounded acceleration.
Search search_ends(const SmoothShape& shape, const FreeFlight& flight, const View& view, double resolution) {
  Search result;
  const double turning = flight.turning_acceleration();
  for (int end = 0; end < shape.ends(); ++end) {
    const Vector3 centre = shape.end_centre(end), stretched = shape.semiaxes.cwiseProduct(view.plane.normal);
    const double size = stretched.norm(), lean = shape.semiaxes.cwiseProduct(view.rate_slope).squaredNorm() / size;
    const Vector3 lowest = shape.lowest(end, view.plane.normal);
    Approach at{view.plane.height(centre) - size, view.vertical_speed + view.rate_slope.dot(lowest),
                flight.gravity() + turning * shape.reach() + lean};
    if (shape.is_ball()) at.acceleration = flight.gravity() + turning * centre.norm();
    if (at.height <= resolution && !(at.rate > 0)) result.touches = true;
    result.time = std::min(result.time, safe_time(at));
  }
  return result;
}

Search search(const Body& body, const FreeFlight& flight, const View& view, double resolution) {
  if (body.smooth()) return search_ends(*body.smooth(), flight, view, resolution);
  Search result;
  const double turning = flight.turning_acceleration();
  const auto box_may_matter = [&](const Vector3& centre, const Vector3& half) {
    const double reach = half.norm();
    const Approach lowest{view.plane.height(centre) - view.plane.normal.cwiseAbs().dot(half),
                          view.vertical_speed + view.rate_slope.dot(centre) - view.rate_slope.cwiseAbs().dot(half),
                          flight.gravity() + turning * (centre.norm() + reach)};
    return lowest.height <= resolution || safe_time(lowest) < result.time;
  };
  body.hierarchy().visit_if(box_may_matter, [&](int facet) {
    for_each_vertex(body, facet, [&](const Vector3& u) {
      const Approach at{view.plane.height(u), view.vertical_speed + view.rate_slope.dot(u),
                        flight.gravity() + turning * u.norm()};
      if (at.height <= resolution && !(at.rate > 0)) result.touches = true;
      result.time = std::min(result.time, safe_time(at));
    });
  });
  return result;
}

/// Time until the sphere around the body can reach the ground; infinite if it never does.
double sphere_time(double clearance, double vertical_speed, double gravity) {
  const double bound = safe_time({clearance, vertical_speed, gravity});
  return bound * (1 - 4 * epsilon);
}

}  // namespace

FreeFlight::FreeFlight(const Body& body, const MotionState& start, const Gravity& gravity, bool planar)
    : start_(start), gravity_(gravity),
      rotation_(planar ? Matrix3(Matrix3::Identity()) : body.inertia(), {start.attitude, start.angular_velocity}) {}

MotionState FreeFlight::at(double time) const {
  const Rotation rotation = rotation_.at(time);
  MotionState state;
  state.centre = start_.centre + time * start_.velocity +
                 Vector3(gravity_.along / 2 * time * time, 0, -(gravity_.down / 2 * time * time));
  state.velocity = start_.velocity + time * gravity_.acceleration();
  state.attitude = rotation.attitude;
  state.angular_velocity = rotation.angular_velocity;
  return state;
}

double FreeFlight::turning_acceleration() const {
  const double speed = rotation_.largest_speed();
  return speed * speed + rotation_.largest_acceleration();
}

TouchDown next_touch_down(const Body& body, const FreeFlight& flight, long evaluation_limit) {
  TouchDown result;
  while (result.evaluations < evaluation_limit) {
    const MotionState state = flight.at(result.time);
    ++result.evaluations;
    const double clearance = state.centre.z() - body.radius() * (1 + 4 * epsilon);
    double step = 0;
    if (clearance > 0) {
      step = sphere_time(clearance, state.velocity.z(), flight.gravity());
    } else {
      const double resolution = 4 * epsilon * (std::fabs(state.centre.z()) + body.radius());
      const Search found = search(body, flight, View(state), resolution);
      if (found.touches) {
        result.kind = TouchDown::Kind::touch;
        return result;
      }
      step = found.time;
    }
    if (!(step < std::numeric_limits<double>::infinity())) {
      result.kind = TouchDown::Kind::never;
      return result;
    }
    assert(step >= 0);
    // A step below the resolution of time cannot lead on: the vertex is as near as numbers tell.
    const double next = result.time + step;
    result.time = next > result.time ? next : std::nextafter(result.time, std::numeric_limits<double>::infinity());
  }
  result.kind = TouchDown::Kind::undecided;
  return result;
}

Vector3 lowest_vertex(const Body& body, const MotionState& state) {
  const View view(state);
  if (const auto& smooth = body.smooth()) {
    const Vector3& up = view.plane.normal;
    return smooth->lowest(up.dot(smooth->end_centre(0)) <= up.dot(smooth->end_centre(smooth->ends() - 1)) ? 0 : 1, up);
  }
  double lowest = std::numeric_limits<double>::infinity();
  Vector3 found = Vector3::Zero();
  body.hierarchy().visit_if(
      [&](const Vector3& centre, const Vector3& half) {
        return view.plane.height(centre) - view.plane.normal.cwiseAbs().dot(half) < lowest;
      },
      [&](int facet) {
        for_each_vertex(body, facet, [&](const Vector3& u) {
          const double height = view.plane.height(u);
          if (!(height < lowest)) return;
          lowest = height;
          found = u;
        });
      });
  return found;
}

double lowest_height(const Body& body, const MotionState& state) {
  return View(state).plane.height(lowest_vertex(body, state));
}

namespace {

/// The lowest vertices, or lowest points of a smooth shape's ends, each once.
std::vector<Vector3> touching_points(const Body& body, const MotionState& state) {
  // Heights over the centre of mass: over the ground those of a high flight would lose the body's size.
  MotionState level_with_centre = state;
  level_with_centre.centre.setZero();
  const double level = lowest_height(body, level_with_centre) + 1e-11 * body.radius();
  const GroundPlane plane{state.attitude.conjugate() * Vector3::UnitZ(), 0};
  std::vector<Vector3> points;
  if (const auto& smooth = body.smooth()) {
    for (int end = 0; end < smooth->ends(); ++end) {
      const Vector3 lowest = smooth->lowest(end, plane.normal);
      if (plane.height(lowest) <= level) points.push_back(lowest);
    }
    return points;
  }
  const Facets& facets = body.facets();
  std::vector<int> touching;
  body.hierarchy().visit_below(plane, level, [&](int facet) {
    facets.for_each_corner(facet, [&](int vertex) {
      if (plane.height(facets.vertices[vertex]) <= level) touching.push_back(vertex);
    });
  });
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  for (const int vertex : touching) points.push_back(facets.vertices[vertex]);
  return points;
}

}  // namespace

Vector3 touch_point(const Body& body, const MotionState& state) {
  const std::vector<Vector3> touching = touching_points(body, state);
  assert(!touching.empty());
  Vector3 sum = Vector3::Zero();
  for (const Vector3& point : touching) sum += point;
  return sum / static_cast<double>(touching.size());
}

FirstTouch first_touch(const Body& body, const MotionState& state) {
  FirstTouch touch{.approach_speed = -std::numeric_limits<double>::infinity()};
  bool a = false, b = false;
  for (const Vector3& u : touching_points(body, state)) {
    a = a || u.x() < -1e-9 * body.half_length();
    b = b || u.x() > 1e-9 * body.half_length();
    touch.approach_speed = std::max(touch.approach_speed, -point_velocity(state, u).z());
  }
  touch.end = contact_end(a, b);
  return touch;
}

double mechanical_energy(const Body& body, const MotionState& state, const Gravity& gravity) {
  const Vector3& omega = state.angular_velocity;
  return 0.5 * body.mass() * state.velocity.squaredNorm() + 0.5 * omega.dot(body.inertia() * omega) +
         gravity.potential(body.mass(), state.centre);
}

MotionState in_plane(const MotionState& state) {
  MotionState flat = state;
  const Vector3 north = state.attitude.conjugate() * Vector3::UnitY();
  flat.velocity.y() = 0;
  flat.angular_velocity = north * north.dot(state.angular_velocity);
  return flat;
}

}  // namespace clatter::numeric
