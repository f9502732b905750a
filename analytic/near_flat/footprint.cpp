// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/near_flat/footprint.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "analytic/base/errors.hpp"

namespace clatter::analytic::near_flat {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;
/// A function of the place in the footprint, c + r·d: heights (z, q), velocities (V, w).
using Plane = std::array<Wide, 3>;

constexpr double full_turn = 2 * std::numbers::pi;

/// The footprint in 50 digits, velocities in units of |v|.
class Billiard {
 public:
  Billiard(const Footprint& footprint, Wide restitution) : e_(std::move(restitution)) {
    const Eigen::Matrix2d& n = footprint.mobility;
    for (const Eigen::Vector2d& r : footprint.corners) {
      const Wide x = r.x(), y = r.y();
      const Plane push{1, n(0, 0) * x + n(0, 1) * y, n(1, 0) * x + n(1, 1) * y};
      place_.push_back({1, x, y});
      gain_.push_back(push);
      self_.push_back(at(push, place_.size() - 1));
    }
    speeds_.resize(size());
  }
  [[nodiscard]] std::size_t size() const { return place_.size(); }
  [[nodiscard]] Wide at(const Plane& plane, std::size_t i) const {
    return plane[0] + plane[1] * place_[i][1] + plane[2] * place_[i][2];
  }
  /// Speeds at which the corners approach; 0: not, to rounding of the velocity.
  [[nodiscard]] const std::vector<Wide>& approaches(const Plane& velocity) {
    Wide most = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      speeds_[i] = -at(velocity, i);
      most = std::max(most, Wide(abs(speeds_[i])));
    }
    for (Wide& speed : speeds_) {
      if (!(speed > 1e-40 * most)) speed = 0;
    }
    return speeds_;
  }
  /// P/m of a strike, which changes the velocity.
  Wide strike(Plane& velocity, std::size_t i) const {
    const Wide impulse = -(1 + e_) * at(velocity, i) / self_[i];
    for (std::size_t k = 0; k < 3; ++k) velocity[k] += gain_[i][k] * impulse;
    return impulse;
  }

 private:
  Wide e_;
  std::vector<Plane> place_, gain_;  ///< (1, r), (1, N r)
  std::vector<Wide> self_;           ///< G_ii
  std::vector<Wide> speeds_;
};

/// Heights at a tilt's direction with one corner on the ground.
void put_down(const Billiard& billiard, std::size_t corner, Plane& heights) {
  const Wide height = billiard.at(heights, corner);
  heights[0] -= height;
}

void fly(const Billiard& billiard, const Plane& velocity, const Wide& time, std::size_t corner, Plane& heights) {
  for (std::size_t k = 0; k < 3; ++k) heights[k] += velocity[k] * time;
  put_down(billiard, corner, heights);
}

Plane mixed(const Plane& a, const Plane& b, const Wide& s) {
  Plane sum;
  for (std::size_t k = 0; k < 3; ++k) sum[k] = (1 - s) * a[k] + s * b[k];
  return sum;
}

/// Tilts between two that have given the same strikes so far; (q of) their first heights are the directions.
struct Course {
  std::array<Plane, 2> tilt;     ///< counter-clockwise, less than half a turn apart
  std::array<Plane, 2> heights;  ///< now
  Plane velocity;
  std::vector<CornerStrike> strikes;

  [[nodiscard]] double width() const {
    const Plane &a = tilt[0], &b = tilt[1];
    return std::atan2(static_cast<double>(Wide(a[1] * b[2] - a[2] * b[1])),
                      static_cast<double>(Wide(a[1] * b[1] + a[2] * b[2])));
  }
};

/// When a corner arrives, at both ends of a course.
struct Arrival {
  std::size_t corner;
  std::array<Wide, 2> time;
  Wide speed;
};

bool same_order(const TiltSector& a, const TiltSector& b) {
  return a.goes_on == b.goes_on &&
         std::ranges::equal(a.strikes, b.strikes, {}, &CornerStrike::corner, &CornerStrike::corner);
}

/// Takes course after course and cuts it where the first corner changes.
class SectorCutter {
 public:
  SectorCutter(Billiard& billiard, int most) : billiard_(billiard), most_(static_cast<std::size_t>(most)) {
    const std::array<Plane, 5> quarters{Plane{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}, {0, 1, 0}};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::array<Plane, 2> ends{quarters[i], quarters[i + 1]};
      const Course course{ends, ends, {-1, 0, 0}, {}};
      std::vector<Arrival> heights;  // the lowest first: all fall alike
      for (std::size_t k = 0; k < billiard_.size(); ++k) {
        heights.push_back({k, {billiard_.at(ends[0], k), billiard_.at(ends[1], k)}, 1});
      }
      cut(course, heights, true);
    }
  }

  [[nodiscard]] TiltSectors found() {
    while (!waiting_.empty()) {
      Course course = std::move(waiting_.back());
      waiting_.pop_back();
      follow(std::move(course));
    }
    return merged();
  }

 private:
  static constexpr std::size_t most_strikes = 100'000;
  static constexpr double least_width = 1e-9;  // [rad]

  void follow(Course course) {
    std::vector<Arrival> arrivals;
    const std::vector<Wide>& speeds = billiard_.approaches(course.velocity);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (!(speeds[i] > 0)) continue;
      arrivals.push_back({i, {}, speeds[i]});
      for (std::size_t end = 0; end < 2; ++end) {
        const Wide height = billiard_.at(course.heights[end], i);
        arrivals.back().time[end] = height > 0 ? Wide(height / speeds[i]) : Wide(0);
      }
    }
    if (arrivals.empty()) return keep(course, false);
    if (course.strikes.size() >= most_ || strikes_ >= most_strikes) return keep(course, true);
    cut(course, arrivals, false);
  }

  /// The lower envelope of the times, linear from end to end, of those that arrive.
  void cut(const Course& course, const std::vector<Arrival>& arrivals, bool falls) {
    const auto order = [](const Arrival& a) { return std::tuple(a.time[0], a.time[1], Wide(-a.speed)); };
    const Arrival* first =
        &*std::ranges::min_element(arrivals, [&](const Arrival& a, const Arrival& b) { return order(a) < order(b); });
    for (Wide from = 0; first;) {
      const Arrival* next = nullptr;
      Wide to = 1;
      for (const Arrival& other : arrivals) {
        if (!(other.time[1] < first->time[1])) continue;
        const Wide lead = other.time[0] - first->time[0];
        const Wide at = std::max(Wide(lead / (lead + first->time[1] - other.time[1])), from);
        if (at < to || (at == to && next && other.time[1] < next->time[1])) {
          to = at;
          next = &other;
        }
      }
      Course part = course;
      for (std::size_t end = 0; end < 2; ++end) {
        const Wide& s = end == 0 ? from : to;
        part.tilt[end] = mixed(course.tilt[0], course.tilt[1], s);
        part.heights[end] = mixed(course.heights[0], course.heights[1], s);
      }
      strike(std::move(part), *first, falls);
      from = to;
      first = next;
    }
  }

  void strike(Course course, const Arrival& first, bool falls) {
    const double width = course.width();
    if (!(width >= least_width)) {
      result_.open_share += std::fmax(width, 0.0) / full_turn;
      return;
    }
    const std::size_t i = first.corner;
    for (Plane& heights : course.heights) {
      if (falls) put_down(billiard_, i, heights);
      else fly(billiard_, course.velocity, Wide(billiard_.at(heights, i) / first.speed), i, heights);
    }
    const Wide approach = -billiard_.at(course.velocity, i), impulse = billiard_.strike(course.velocity, i);
    course.strikes.push_back({static_cast<int>(i), static_cast<double>(approach), static_cast<double>(impulse)});
    ++strikes_;
    waiting_.push_back(std::move(course));
  }

  void keep(const Course& course, bool goes_on) {
    const Plane& tilt = course.tilt[0];
    const double from = std::atan2(static_cast<double>(tilt[2]), static_cast<double>(tilt[1]));
    result_.sectors.push_back({from, from + course.width(), course.strikes, goes_on});
  }

  /// Sectors that the beginning has cut are one again.
  [[nodiscard]] TiltSectors merged() {
    constexpr double gap = 1e-8;  // of what is left open between them
    std::vector<TiltSector>& all = result_.sectors;
    std::ranges::sort(all, {}, &TiltSector::from);
    std::vector<TiltSector> joined;
    for (TiltSector& sector : all) {
      if (!joined.empty() && same_order(joined.back(), sector) && sector.from - joined.back().to < gap) {
        joined.back().to = sector.to;
      } else {
        joined.push_back(std::move(sector));
      }
    }
    if (joined.size() > 1 && same_order(joined.back(), joined.front())) {
      joined.back().to = joined.front().to + full_turn;
      joined.erase(joined.begin());
    }
    return {std::move(joined), result_.open_share};
  }

  Billiard& billiard_;
  std::size_t most_;
  std::size_t strikes_ = 0;
  std::vector<Course> waiting_;
  TiltSectors result_;
};

std::vector<CornerStrike> followed(Billiard billiard, double direction, int most) {
  Plane velocity{-1, 0, 0}, heights{0, std::cos(direction), std::sin(direction)};
  std::size_t first = 0;
  for (std::size_t i = 1; i < billiard.size(); ++i) {
    if (billiard.at(heights, i) < billiard.at(heights, first)) first = i;
  }
  put_down(billiard, first, heights);
  std::vector<CornerStrike> found;
  while (static_cast<int>(found.size()) < most) {
    const std::vector<Wide>& speeds = billiard.approaches(velocity);
    std::optional<std::tuple<Wide, Wide, std::size_t>> next;  // time, −speed
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (!(speeds[i] > 0)) continue;
      const Wide height = billiard.at(heights, i);
      const std::tuple arrival(height > 0 ? Wide(height / speeds[i]) : Wide(0), Wide(-speeds[i]), i);
      if (!next || arrival < *next) next = arrival;
    }
    if (!next) return found;
    const auto& [time, opposite, i] = *next;
    fly(billiard, velocity, time, i, heights);
    const Wide impulse = billiard.strike(velocity, i);
    found.push_back({static_cast<int>(i), -static_cast<double>(opposite), static_cast<double>(impulse)});
  }
  return found;
}

// Restitution for which strikes go on.

constexpr int sampled_tilts = 16;

double sampled_direction(int i) { return 0.1234 + i * full_turn / sampled_tilts; }

/// Strikes of a direction that go on beyond `most`; empty: none.
std::vector<int> endless_order(const Footprint& footprint, double e, int most) {
  const Billiard billiard(footprint, e);
  for (int i = 0; i < sampled_tilts; ++i) {
    const auto strikes = followed(billiard, sampled_direction(i), most);
    if (static_cast<int>(strikes.size()) < most) continue;
    std::vector<int> order;
    for (const CornerStrike& strike : strikes) order.push_back(strike.corner);
    return order;
  }
  return {};
}

/// The shortest order that the last half repeats, at least four times; empty: none.
std::vector<int> cycle_of(const std::vector<int>& order) {
  const std::size_t half = order.size() / 2;
  for (std::size_t period = 2; 4 * period <= half; ++period) {
    if (std::equal(order.end() - static_cast<std::ptrdiff_t>(half - period), order.end(),
                   order.end() - static_cast<std::ptrdiff_t>(half)))
      return {order.end() - static_cast<std::ptrdiff_t>(period), order.end()};
  }
  return {};
}

/// Discriminant of the characteristic polynomial λ³ − t λ² + s λ − d of a cycle's product, which is positive while the
/// eigenvalues are real and apart.
Wide discriminant(const Footprint& footprint, const Wide& e, const std::vector<int>& cycle) {
  const Billiard billiard(footprint, e);
  std::array<Plane, 3> m{Plane{1, 0, 0}, Plane{0, 1, 0}, Plane{0, 0, 1}};  // columns
  for (const int corner : cycle) {
    for (Plane& column : m) billiard.strike(column, static_cast<std::size_t>(corner));
  }
  const auto minor = [&](std::size_t i, std::size_t j) { return Wide(m[i][i] * m[j][j] - m[i][j] * m[j][i]); };
  const Wide t = m[0][0] + m[1][1] + m[2][2], s = minor(0, 1) + minor(0, 2) + minor(1, 2);
  Wide d = 1;  // each strike has the determinant −e
  for (std::size_t i = 0; i < cycle.size(); ++i) d *= -e;
  return t * t * s * s - 4 * s * s * s - 4 * t * t * t * d + 18 * t * s * d - 27 * d * d;
}

/// Where the sign of the discriminant changes; nothing if it does not.
std::optional<CriticalRestitution> merging_eigenvalues(const Footprint& footprint, double low, double high,
                                                       const std::vector<int>& cycle) {
  if (cycle.empty() || !(discriminant(footprint, low, cycle) > 0) || !(discriminant(footprint, high, cycle) < 0)) {
    return std::nullopt;
  }
  Wide below = low, above = high;
  for (int i = 0; i < 60; ++i) {
    const Wide middle = (below + above) / 2;
    (discriminant(footprint, middle, cycle) > 0 ? below : above) = middle;
  }
  return CriticalRestitution{static_cast<double>(below), 1e-15, cycle};
}

}  // namespace

void Footprint::validate() const {
  detail::require(corners.size() >= 2 && corners.size() <= 256, "corners", static_cast<double>(corners.size()),
                  "from 2 to 256");
  for (const Eigen::Vector2d& corner : corners) detail::require(corner.allFinite(), "corner", corner.sum(), "finite");
  detail::require(mobility.allFinite() && mobility(0, 0) > 0 && mobility.determinant() > 0 &&
                      std::fabs(mobility(0, 1) - mobility(1, 0)) <= 1e-12 * mobility.norm(),
                  "mobility", mobility.determinant(), "symmetric and positive definite");
}

Eigen::Matrix2d slope_mobility(double mass, const Eigen::Matrix3d& inertia) {
  const Eigen::Matrix3d inverse = inertia.inverse();
  Eigen::Matrix2d n;  // of the turn −w_y about x and w_x about −y
  n << inverse(1, 1), -inverse(0, 1), -inverse(1, 0), inverse(0, 0);
  return mass * n;
}

double TiltSector::share() const { return (to - from) / full_turn; }

std::size_t TiltSector::hardest() const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < strikes.size(); ++i) {
    if (strikes[i].approach > strikes[best].approach * (1 + 1e-14)) best = i;
  }
  return best;
}

TiltSectors tilt_sectors(const Footprint& footprint, double restitution, int most) {
  footprint.validate();
  detail::require(restitution >= 0 && restitution <= 1, "restitution", restitution, "from 0 to 1");
  Billiard billiard(footprint, restitution);
  return SectorCutter(billiard, most).found();
}

std::vector<CornerStrike> strikes_of_tilt(const Footprint& footprint, double restitution, double direction, int most) {
  footprint.validate();
  detail::require(restitution >= 0 && restitution <= 1, "restitution", restitution, "from 0 to 1");
  return followed(Billiard(footprint, restitution), direction, most);
}

std::optional<CriticalRestitution> critical_restitution(const Footprint& footprint) {
  footprint.validate();
  constexpr int steps = 128, seen = 120, most = 400;
  const auto grid = [](int i) { return std::pow(static_cast<double>(i) / steps, 2); };  // finer near 0
  int last = steps - 1;
  while (last > 0 && endless_order(footprint, grid(last), seen).empty()) --last;
  if (last == 0) return std::nullopt;
  double low = grid(last), high = grid(last + 1);
  std::vector<int> order = endless_order(footprint, low, most);
  for (int i = 0; i < 16 && high - low > 1e-4 * low; ++i) {
    const double middle = (low + high) / 2;
    std::vector<int> found = endless_order(footprint, middle, most);
    (found.empty() ? high : low) = middle;
    if (!found.empty()) order = std::move(found);
  }
  const std::vector<int> cycle = cycle_of(order);
  if (const auto merged = merging_eigenvalues(footprint, 0.99 * low, std::fmin(1.01 * high, 1), cycle)) return merged;
  return CriticalRestitution{(low + high) / 2, 0.01 * high, cycle};
}

}  // namespace clatter::analytic::near_flat
