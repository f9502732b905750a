// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/ground_fit.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "numeric/base/errors.hpp"
#include "numeric/contact/contact_system.hpp"
#include "numeric/motion/free_flight.hpp"

namespace clatter::validation {
namespace {

constexpr double fine = 1e-13;                           ///< of the simulator's steps: numbers are good to about 1e-12
constexpr double coarse = 1e-7;                          ///< likewise, to tell where roots lie
constexpr double least_loss = 1e-3, largest_loss = 1e2;  ///< s on the grid, behind 0
constexpr int grid_points = 21;

double at(const Measures& measures, DropMeasure which) { return measures[static_cast<std::size_t>(which)]; }

/// ∫δ dA when the body is pressed straight down by `depth` [m³], or a half-space's force over E* [m²].
double pressed_volume(const MeasuredDrop& drop, double depth) {
  numeric::ContactSystem system(*drop.body, world_on(drop, 1, 0).ground, 0, drop.world.planar);
  system.begin(drop.start);
  return system.pressed(depth).force;
}

/// The depth δ with k_G ∫δ dA = m g, or the half-space's force [m].
double indentation_of(const MeasuredDrop& drop, double stiffness) {
  const double volume = drop.weight / stiffness, size = drop.body->radius();
  double high = 1e-6 * size;
  while (!(pressed_volume(drop, high) >= volume)) {
    high *= 2;
    if (high > 2 * size) throw numeric::NumericalError("the ground is too soft to carry the body: it sinks in whole");
  }
  double low = high;
  while (pressed_volume(drop, low) >= volume && low > 1e-18 * size) low /= 2;
  std::uintmax_t iterations = 200;
  const auto root =
      boost::math::tools::toms748_solve([&](double depth) { return pressed_volume(drop, depth) / volume - 1; }, low,
                                        high, [](double a, double b) { return b - a <= 4e-16 * b; }, iterations);
  return (root.first + root.second) / 2;
}

/// Measures of the first impact; the indentation is left 0.
Measures impact_measures(const MeasuredDrop& drop, double stiffness, double damping, double tolerance) {
  const numeric::World world = world_on(drop, stiffness, damping);
  const numeric::Request request{.impacts = 1, .error_estimates = false, .amplification = false};
  const numeric::Accuracy accuracy{.method = numeric::Method::rk8pd, .tolerance = tolerance};
  const numeric::Simulation run = numeric::simulate(*drop.body, world, drop.start, request, accuracy);
  if (run.impacts.empty()) throw numeric::NumericalError("the first impact could not be computed: " + run.message);
  const numeric::ImpactRecord& row = run.impacts.front();
  if (run.outcome == numeric::Outcome::at_rest || run.outcome == numeric::Outcome::sustained_contact)
    throw numeric::NumericalError("the body does not lift off after the first impact: " + run.message);
  if (row.touches > 1) {
    throw numeric::NumericalError(
        "the first impact is not one touch but several: take a drop that lands flat or on one corner");
  }
  return {row.value.restitution, row.value.duration, row.value.peak_force, 0};
}

double approach_speed(const MeasuredDrop& drop) { return numeric::first_touch(*drop.body, drop.start).approach_speed; }

/// c_G, or τ, where the loss s is 1.
double unit_damping(const MeasuredDrop& drop, double stiffness, double speed) {
  return (drop.world.ground.is_half_space() ? 1 : stiffness) / speed;
}

/// A loss and how far the second number is off there.
struct GridPoint {
  double loss = 0, off = 0;
};

/// The second number along s, k_G following the first.
class Search {
 public:
  Search(const MeasuredDrop& drop, const MeasuredNumber& first, const MeasuredNumber& second)
      : drop_(drop), first_(first), second_(second), speed_(approach_speed(drop)) {
    // What gives k_G: the indentation does alone, the restitution hardly depends on it.
    if (first_.measure == DropMeasure::restitution || second_.measure == DropMeasure::indentation)
      std::swap(first_, second_);
    slope_ = first_.measure == DropMeasure::peak_force ? 0.4 : -0.4;
    log_stiffness_ = guess();
  }

  /// ln of the second number over what was measured, on the ground of loss s that gives the first.
  double off(double loss, double tolerance) {
    return std::log(at(measures(loss, stiffness_for(loss, tolerance), tolerance), second_.measure) / second_.value);
  }

  /// ln m = a − ln k_G/(p + 1) of a contact that grows like δ^p: almost straight, so that secants find it at once.
  double stiffness_for(double loss, double tolerance) {
    if (first_.measure == DropMeasure::indentation) return std::exp(log_stiffness_);
    const double enough = tolerance == fine ? 1e-10 : 1e-5;  // a last step so short leaves a thousandth of itself
    double x = log_stiffness_, y = deviation(loss, x, tolerance);
    for (int i = 0; i < 40; ++i) {
      const double next = x - std::clamp(y / slope_, -5.0, 5.0);
      if (std::fabs(next - x) <= enough) return std::exp(log_stiffness_ = next);
      const double there = deviation(loss, next, tolerance), found = (there - y) / (next - x);
      // Rounding makes slopes of the last, tiny steps; those of the model lie between a plane and a sharp corner.
      if (found * slope_ > 0 && std::fabs(next - x) > 1e-9) slope_ = found;
      x = next;
      y = there;
    }
    throw numeric::NumericalError("no stiffness was found that gives the first number");
  }

  /// The same at a point of the grid, which may be coarse: where the sign is close, it is looked at again.
  double settled(const GridPoint& point) { return std::fabs(point.off) > 1e-4 ? point.off : off(point.loss, fine); }

  Measures measures(double loss, double stiffness, double tolerance) {
    ++runs_;
    return impact_measures(drop_, stiffness, damping(loss, stiffness), tolerance);
  }

  [[nodiscard]] double damping(double loss, double stiffness) const {
    return loss * unit_damping(drop_, stiffness, speed_);
  }
  [[nodiscard]] const MeasuredNumber& second() const { return second_; }
  [[nodiscard]] long runs() const { return runs_; }

 private:
  double deviation(double loss, double log_stiffness, double tolerance) {
    return std::log(at(measures(loss, std::exp(log_stiffness), tolerance), first_.measure) / first_.value);
  }

  /// ln k_G at which the contact is as deep as its time or force tells.
  [[nodiscard]] double guess() const {
    if (first_.measure == DropMeasure::indentation) return std::log(drop_.weight / pressed_volume(drop_, first_.value));
    const double momentum = drop_.body->mass() * speed_, turn = std::numbers::pi;
    const bool by_time = first_.measure == DropMeasure::contact_time;
    const double depth = by_time ? speed_ * first_.value / turn : momentum * speed_ / first_.value;
    return std::log((by_time ? turn * momentum / first_.value : first_.value) / pressed_volume(drop_, depth));
  }

  const MeasuredDrop& drop_;
  MeasuredNumber first_, second_;
  double speed_, slope_ = 0, log_stiffness_ = 0;
  long runs_ = 0;
};

/// At 0 and at equal ratios, as far as the model goes; where the number turns, the turn too.
std::vector<GridPoint> grid_of(Search& search) {
  std::vector<GridPoint> grid{{0, search.off(0, fine)}};
  for (int i = 0; i < grid_points; ++i) {
    const double loss = least_loss * std::pow(largest_loss / least_loss, i / (grid_points - 1.0));
    try {
      grid.push_back({loss, search.off(loss, coarse)});
    } catch (const numeric::NumericalError&) {
      break;
    }
  }
  std::vector<GridPoint> all = grid;
  for (std::size_t i = 1; i + 1 < grid.size(); ++i) {
    const double side = grid[i].off > grid[i - 1].off ? -1 : 1;  // of the number whose least value is sought
    if (!(side * grid[i].off < side * grid[i - 1].off && side * grid[i].off < side * grid[i + 1].off)) continue;
    std::uintmax_t iterations = 40;
    constexpr int bits = 20;  // of the turn's place: its value is then known to twice as many
    const auto [loss, least] = boost::math::tools::brent_find_minima(
        [&](double at) { return side * search.off(at, fine); }, grid[i - 1].loss, grid[i + 1].loss, bits, iterations);
    all.push_back({loss, side * least});
  }
  std::sort(all.begin(), all.end(), [](const GridPoint& a, const GridPoint& b) { return a.loss < b.loss; });
  return all;
}

/// The losses at which the second number is met; its range goes into `fit`.
std::vector<double> roots_of(Search& search, GroundFit& fit) {
  constexpr double met = 1e-10;  // an elastic restitution is met where nothing is lost, at the very end of the grid
  const std::vector<GridPoint> grid = grid_of(search);
  std::vector<double> roots;
  if (std::fabs(grid.front().off) <= met) roots.push_back(0);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double value = search.second().value * std::exp(grid[i].off);
    fit.least = std::min(fit.least, value);
    fit.largest = std::max(fit.largest, value);
    if (i == 0 || std::fabs(grid[i - 1].off) <= met) continue;
    const GridPoint low{grid[i - 1].loss, search.settled(grid[i - 1])}, high{grid[i].loss, search.settled(grid[i])};
    if (low.off * high.off > 0) continue;
    std::uintmax_t iterations = 100;
    const auto root = boost::math::tools::toms748_solve(
        [&](double loss) { return search.off(loss, fine); }, low.loss, high.loss, low.off, high.off,
        [](double a, double b) { return b - a <= 1e-12 * b; }, iterations);
    roots.push_back((root.first + root.second) / 2);
  }
  return roots;
}

/// Sensitivities by central differences of the model in ln k_G and c_G, inverted.
void add_sensitivities(const MeasuredDrop& drop, const MeasuredNumber& first, const MeasuredNumber& second,
                       FittedGround& ground) {
  constexpr double step = 1e-4;
  const double unit = unit_damping(drop, ground.stiffness, approach_speed(drop));
  const double shift = step * std::max(ground.damping / unit, 1e-2);
  const bool at_zero = ground.damping < 2 * shift * unit;
  const auto logs = [&](double log_stiffness, double damping) {
    const Measures found = measures_of(drop, ground.stiffness * std::exp(log_stiffness), damping);
    return Eigen::Vector2d(std::log(at(found, first.measure)), std::log(at(found, second.measure)));
  };
  Eigen::Matrix2d by;  // ∂(ln m₁, ln m₂)/∂(ln k_G, c_G/unit)
  by.col(0) = (logs(step, ground.damping) - logs(-step, ground.damping)) / (2 * step);
  if (at_zero) {  // one-sided, second order
    by.col(1) = (-3 * logs(0, 0) + 4 * logs(0, shift * unit) - logs(0, 2 * shift * unit)) / (2 * shift);
  } else {
    by.col(1) = (logs(0, ground.damping + shift * unit) - logs(0, ground.damping - shift * unit)) / (2 * shift);
  }
  const Eigen::Matrix2d inverse = by.inverse();
  ground.stiffness_by = {inverse(0, 0), inverse(0, 1)};
  ground.damping_by = {unit * inverse(1, 0), unit * inverse(1, 1)};
  const double numbers = 20 * fine;
  ground.stiffness_error = ground.stiffness * numbers * (std::fabs(inverse(0, 0)) + std::fabs(inverse(0, 1)) + 1);
  ground.damping_error = unit * numbers * (std::fabs(inverse(1, 0)) + std::fabs(inverse(1, 1)) + 1);
}

void check(const MeasuredNumber& measured) {
  const bool is_restitution = measured.measure == DropMeasure::restitution;
  const bool holds = measured.value > 0 && std::isfinite(measured.value) && (!is_restitution || measured.value <= 1);
  if (holds) return;
  throw std::domain_error(fmt::format("{} = {}: must be greater than 0{}", measure_name(measured.measure),
                                      measured.value, is_restitution ? " and at most 1" : ""));
}

void require(bool holds, const char* what, double value, const char* allowed) {
  if (!holds) throw std::domain_error(fmt::format("{} = {}: must be {}", what, value, allowed));
}

}  // namespace

const char* measure_name(DropMeasure measure) {
  switch (measure) {
    case DropMeasure::restitution: return "restitution";
    case DropMeasure::contact_time: return "contact time";
    case DropMeasure::peak_force: return "peak force";
    case DropMeasure::indentation: return "indentation";
  }
  return "";
}

numeric::World world_on(const MeasuredDrop& drop, double stiffness, double damping) {
  numeric::World world = drop.world;
  numeric::Ground& ground = world.ground;
  const bool is_half_space = ground.is_half_space();
  (is_half_space ? ground.modulus : ground.stiffness) = stiffness;
  (is_half_space ? ground.dissipation : ground.damping) = damping;
  return world;
}

Measures measures_of(const MeasuredDrop& drop, double stiffness, double damping) {
  Measures measures = impact_measures(drop, stiffness, damping, fine);
  measures.back() = indentation_of(drop, stiffness);
  return measures;
}

GroundFit fit_ground(const MeasuredDrop& drop, const MeasuredNumber& first, const MeasuredNumber& second) {
  check(first);
  check(second);
  Search search(drop, first, second);
  GroundFit fit{.solutions = {}, .least = std::numeric_limits<double>::infinity()};
  for (const double loss : roots_of(search, fit)) {
    FittedGround ground;
    ground.stiffness = search.stiffness_for(loss, fine);
    ground.damping = search.damping(loss, ground.stiffness);
    ground.predicted = measures_of(drop, ground.stiffness, ground.damping);
    add_sensitivities(drop, first, second, ground);
    fit.solutions.push_back(ground);
  }
  fit.runs = search.runs();
  return fit;
}

double layer_stiffness(double modulus, double poisson, double thickness) {
  require(modulus > 0 && std::isfinite(modulus), "modulus", modulus, "greater than 0");
  require(poisson >= 0 && poisson < 0.5, "Poisson's ratio", poisson, "from 0 to below 0.5");
  require(thickness > 0 && std::isfinite(thickness), "thickness", thickness, "greater than 0");
  return modulus * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson) * thickness);
}

double half_space_stiffness(double modulus, double poisson, double area) {
  require(modulus > 0 && std::isfinite(modulus), "modulus", modulus, "greater than 0");
  require(poisson >= 0 && poisson <= 0.5, "Poisson's ratio", poisson, "from 0 to 0.5");
  require(area > 0 && std::isfinite(area), "area", area, "greater than 0");
  return 2 * modulus / ((1 - poisson * poisson) * std::numbers::pi * std::sqrt(area / std::numbers::pi));
}

}  // namespace clatter::validation
