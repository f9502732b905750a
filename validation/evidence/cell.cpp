// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/evidence/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "numeric/base/errors.hpp"
#include "validation/measured/track.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

using Values = std::vector<AxisValue>;

void refuse(ExtremeCell& cell, CellVerdict verdict, const std::string& reason) {
  cell.verdict = verdict;
  cell.reason = reason;
  std::replace(cell.reason.begin(), cell.reason.end(), '\n', ' ');
}

void run(const ExtremeCase& extreme, const CellClock& clock, ExtremeCell& cell) {
  try {
    cell.measure = extreme.work(clock);
    cell.verdict = CellVerdict::number;
    if (!std::isfinite(cell.measure.error)) refuse(cell, CellVerdict::broken, "a number that is none");
  } catch (const EndedEarly& ended) {
    refuse(cell, ended.verdict, ended.what());
    cell.measure.outcome = ended.outcome;
  } catch (const analytic::OutsideModelError& error) {
    refuse(cell, CellVerdict::outside_model, error.what());
  } catch (const analytic::NumericalError& error) {
    refuse(cell, CellVerdict::not_computed, error.what());
  } catch (const numeric::NumericalError& error) {
    refuse(cell, CellVerdict::not_computed, error.what());
  } catch (const numeric::MeshError& error) {
    refuse(cell, CellVerdict::bad_input, error.what());
  } catch (const std::domain_error& error) {
    refuse(cell, CellVerdict::bad_input, error.what());
  } catch (const std::invalid_argument& error) {
    refuse(cell, CellVerdict::bad_input, error.what());
  } catch (const std::exception& error) {
    refuse(cell, CellVerdict::broken, std::string("an error without a type: ") + error.what());
  }
}

std::string short_label(double value) {
  std::string text = shortest(value);
  for (std::size_t at = text.find("e+"); at != std::string::npos; at = text.find("e+")) text.erase(at + 1, 1);
  return text;
}

Values plain(const std::vector<double>& values) {
  Values out;
  for (const double value : values) out.push_back({value, short_label(value)});
  return out;
}

/// 10^k, read as text so that each is the double nearest to it.
double decade(int k) { return std::stod("1e" + std::to_string(k)); }

Values decades(const std::vector<int>& exponents) {
  Values out;
  for (const int k : exponents) out.push_back({decade(k), k == 0 ? "1" : "1e" + std::to_string(k)});
  return out;
}

Values operator+(Values left, const Values& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// Around a fold, from far below to far above it, one ulp on either side included.
Values around_fold(analytic::ImpactNumber impact, const std::string& name) {
  const double fold = analytic::regime_boundary(impact, {}).theta * analytic::degrees_per_radian;
  Values out;
  for (const int k : {-3, -6, -9, -12}) out.push_back({fold - decade(k), fmt::format("{}-1e{}", name, k)});
  out.push_back({std::nextafter(fold, 0.0), name + "-1ulp"});
  out.push_back({fold, name});
  out.push_back({std::nextafter(fold, 90.0), name + "+1ulp"});
  for (const int k : {-12, -9, -6, -3}) out.push_back({fold + decade(k), fmt::format("{}+1e{}", name, k)});
  return out;
}

Values angles() {
  return plain({0}) + decades({-300, -200, -100, -30, -15, -12, -9, -6, -3, -1}) + plain({1, 10, 20}) +
         around_fold(analytic::ImpactNumber::third, "F3") + plain({30, 45, 54.7356, 58}) +
         around_fold(analytic::ImpactNumber::second, "F2") + plain({60, 75, 89, 89.999}) +
         Values{{90 - 1e-6, "90-1e-6"}, {90 - 1e-9, "90-1e-9"}, {std::nextafter(90.0, 0.0), "90-1ulp"}, {90, "90"}};
}

Values restitutions() {
  return plain({0, 5e-324}) + decades({-300, -100, -30, -16, -12, -9, -6, -3, -1}) + plain({0.5, 0.9, 0.999}) +
         Values{{1 - 1e-6, "1-1e-6"},
                {1 - 1e-9, "1-1e-9"},
                {1 - 1e-12, "1-1e-12"},
                {std::nextafter(1.0, 0.0), "1-1ulp"},
                {1, "1"},
                {std::nextafter(1.0, 2.0), "1+1ulp"}};
}

/// Ratios of impulses at tan θ = 2, where the rod jams from 4/3 on.
Values ratios() {
  const double jam = 4.0 / 3;
  return plain({0}) + decades({-300, -100, -30, -15, -6, -3, -1}) + plain({0.5, 1, 1.3}) +
         Values{{jam - 1e-3, "4/3-1e-3"},  {jam - 1e-6, "4/3-1e-6"},  {jam - 1e-9, "4/3-1e-9"},
                {jam - 1e-12, "4/3-e-12"}, {jam - 4e-15, "4/3-ulps"}, {jam + 4e-15, "4/3+ulps"},
                {jam + 1e-12, "4/3+e-12"}, {jam + 1e-6, "4/3+1e-6"},  {2, "2"}} +
         decades({1, 3, 30, 300});
}

Values frictions() {
  return plain({0, 5e-324}) + decades({-300, -100, -30, -15, -9, -6, -3, -2, -1}) +
         plain({0.3, 0.5, 0.6, 0.75, 0.9, 1, 1.3333, 1.34, 2}) +
         decades({1, 2, 3, 6, 9, 12, 15, 20, 30, 60, 100, 200, 300});
}

/// Powers of two near decades: units that scale exactly.
Values powers_of_two(const std::vector<int>& exponents) {
  Values out;
  for (const int k : exponents) {
    const int power = static_cast<int>(std::lround(k * std::log2(10.0)));
    out.push_back({std::ldexp(1.0, power), power == 0 ? "1" : fmt::format("2^{}", power)});
  }
  return out;
}

std::vector<int> range(int from, int to, int step) {
  std::vector<int> out;
  for (int k = from; k <= to; k += step) out.push_back(k);
  return out;
}

/// Lower ends of the ranges of residual_bins().
Values arm_angles() {
  Values angles;
  for (std::size_t i = 1; i < std::size(arm_angle_edges); ++i)
    angles.push_back({arm_angle_edges[i - 1], fmt::format("{}-{}", arm_angle_edges[i - 1], arm_angle_edges[i])});
  return angles;
}

/// Angles from lying flat to standing upright [rad].
Values elevations() {
  constexpr double upright = std::numbers::pi / 2;
  return plain({0}) + decades({-300, -30, -16, -15, -12, -9, -6, -3, -2, -1}) + plain({0.5, 1, 1.5}) +
         Values{{upright - 1e-6, "up-1e-6"}, {upright - 1e-12, "up-1e-12"}, {upright, "upright"}};
}

std::vector<MapAxis> make_axes() {
  return {
      {"angle", "θ", "inclination at the first impact [°]; F2, F3: the folds at 58.488442288312° and 27.577809606636°",
       angles()},
      {"stiffness", "k_G", "stiffness of the ground [N/m³]",
       plain({0, 5e-324}) + decades({-300, -100, -30, -10}) + decades(range(-3, 21, 1)) +
           decades({25, 30, 40, 50, 100, 200, 300})},
      {"damping", "c_G", "damping of the ground [N·s/m⁴]",
       plain({0, 5e-324}) + decades({-300, -100, -30, -10}) + decades(range(-3, 21, 1)) +
           decades({25, 30, 40, 50, 100, 200, 300})},
      {"restitution", "e", "coefficient of restitution; the continuous models take the damping that gives it",
       restitutions()},
      {"ratio", "μ_i", "impulse ratio as given (Eq. 8), at tan θ = 2, where it jams from 4/3 on", ratios()},
      {"friction", "μ", "Coulomb's coefficient of friction", frictions()},
      {"speed", "v", "downward speed at the first touch [m/s]",
       plain({0, 5e-324}) + decades({-300, -200, -150, -100, -60, -30, -20, -15, -12, -9, -6, -3,  -2,  -1,  0,  1,
                                     2,    3,    4,    5,    6,   9,   12,  15,  20,  30, 60, 100, 150, 200, 300})},
      {"gravity", "g", "gravity [m/s²]",
       plain({0, 5e-324}) + decades({-300, -150, -100, -30, -15, -9, -6, -3, -2, -1, 0}) + plain({9.81}) +
           decades({2, 3, 4, 6, 9, 12, 15, 20, 30, 60, 100, 150, 200, 300})},
      {"size", "size", "lengths of the body, times of the unit scene unchanged",
       powers_of_two(
           {-300, -200, -160, -150, -120, -100, -60, -30, -9, -3, 0, 3, 9, 30, 60, 100, 120, 150, 160, 200, 300})},
      {"mass", "mass", "mass of the body and stiffness of the ground, as multiples",
       powers_of_two({-320, -308, -300, -200, -100, -30, -9, 0, 9, 30, 100, 200, 290, 300, 307})},
      {"turns", "turns", "turns of the body during one flight", decades(range(0, 18, 1))},
      {"impacts", "n", "impacts of an elastic body in one run",
       plain({1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000})},
      {"disc", "disc", "angle between the ground and the face of a spinning disc, a tenth as thick as wide [rad]",
       elevations()},
      {"needle", "needle", "angle between the ground and the axis of a spinning needle, 50 times as long as wide [rad]",
       elevations()},
      {"slenderness", "L/2R", "length over diameter of a spinning cylinder", decades(range(-9, 9, 1))},
      {"bounces", "e level", "coefficient of restitution of a disc that bounces level to its rest",
       plain({0}) + decades({-300, -100, -16, -9, -3, -1}) + plain({0.5, 0.9, 0.999}) +
           Values{{1 - 1e-6, "1-1e-6"}, {1 - 1e-9, "1-1e-9"}, {1 - 1e-12, "1-1e-12"}, {1, "1"}}},
      {"hops", "e rim", "coefficient of restitution of a tilted disc that rattles on its rim",
       decades({-16, -9, -3, -1}) + plain({0.3, 0.5, 0.7, 0.9, 0.95})},
      {"squares", "square", "tracked squares by the angle between arm and vertical at impact 1 [°]", arm_angles()},
      {"cubes", "cube", "tracked cubes by the angle between arm and vertical at impact 1 [°]", arm_angles()},
      {"long",
       "long",
       "runs of more than a second: very many impacts (hits), random scenes over the widest ranges (sc)",
       {}},
  };
}

}  // namespace

const char* verdict_name(CellVerdict verdict) {
  switch (verdict) {
    case CellVerdict::number: return "number";
    case CellVerdict::bad_input: return "bad-input";
    case CellVerdict::outside_model: return "outside-model";
    case CellVerdict::not_computed: return "not-computed";
    case CellVerdict::ended_early: return "ended-early";
    case CellVerdict::time_limit: return "time-limit";
    case CellVerdict::broken: return "BROKEN";
  }
  return "";
}

double ExtremeCell::digits() const {
  if (!has_number()) return 0;
  constexpr double most = 16;
  return measure.error > 0 ? std::fmax(0.0, std::fmin(-std::log10(measure.error), most)) + 0.0 : most;
}

void add_cases(std::vector<ExtremeCase>& cases, const MapAxis& axis, ModelLevel model,
               const std::function<CellMeasure(double, const CellClock&)>& work) {
  for (const AxisValue& at : axis.values) {
    cases.push_back({{axis.name, at.value, at.label, model},
                     [work, value = at.value](const CellClock& clock) { return work(value, clock); }});
  }
}

ExtremeCell fill_cell(const ExtremeCase& extreme, double seconds) {
  ExtremeCell cell{extreme};
  const CellClock clock(seconds);
  run(extreme, clock, cell);
  cell.seconds = clock.elapsed();
  return cell;
}

std::string cell_failure(const ExtremeCell& cell, double seconds) {
  if (cell.verdict == CellVerdict::broken) return cell.reason;
  if (!cell.has_number() && cell.reason.empty()) return "refused without a reason";
  if (cell.has_number() && !(cell.measure.error <= cell.measure.bound)) {
    return fmt::format("error {}, at most {} allowed", significant(cell.measure.error, 2),
                       significant(cell.measure.bound, 2));
  }
  if (!cell.long_run && !(cell.seconds <= seconds)) return fmt::format("took {} s", significant(cell.seconds, 3));
  return "";
}

const std::vector<MapAxis>& map_axes() {
  static const std::vector<MapAxis> axes = make_axes();
  return axes;
}

const MapAxis& map_axis(const std::string& name) {
  const auto found = std::ranges::find(map_axes(), name, &MapAxis::name);
  if (found == map_axes().end()) throw std::out_of_range("no axis " + name);
  return *found;
}

}  // namespace clatter::validation
