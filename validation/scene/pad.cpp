// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/pad.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/output/text_rows.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/floors.hpp"

namespace clatter::validation {
namespace {

const char* const curve_key = "ground.curve";
const char* const units_key = "ground.curve_units";
const char* const strain_curve = "1,Pa";
const char* const units_allowed =
    "two units: %, 1, m, cm, mm, um or in, and Pa, kPa, MPa, GPa, N/m2, N/cm2, N/mm2, bar or psi, as in %,kPa";

constexpr double most_strain_of_springs = 0.5;
constexpr double one_slope = 1e-12;  ///< relative distance of slopes that are one

constexpr UnitName strain_units[]{{"%", 1e-2}, {"percent", 1e-2}, {"1", 1}, {"-", 1}, {"m/m", 1}, {"mm/mm", 1}};
constexpr UnitName depth_units[]{{"m", 1},     {"cm", 1e-2}, {"mm", 1e-3},   {"um", 1e-6},
                                 {"µm", 1e-6}, {"μm", 1e-6}, {"in", 0.0254}, {"inch", 0.0254}};
constexpr UnitName pressure_units[]{
    {"pa", 1},      {"kpa", 1e3},   {"mpa", 1e6},    {"gpa", 1e9},   {"n/m2", 1},    {"n/m^2", 1},
    {"n/m²", 1},    {"kn/m2", 1e3}, {"kn/m^2", 1e3}, {"kn/m²", 1e3}, {"n/cm2", 1e4}, {"n/cm^2", 1e4},
    {"n/cm²", 1e4}, {"n/mm2", 1e6}, {"n/mm^2", 1e6}, {"n/mm²", 1e6}, {"bar", 1e5},   {"psi", 6894.757293168361}};
constexpr std::span<const UnitName> curve_units[]{strain_units, depth_units, pressure_units};

/// What the curve's numbers are in the SI's.
struct CurveUnits {
  bool is_strain = false;
  double x = 1, pressure = 1;
};

std::optional<CurveUnits> units_of(std::string_view x, std::string_view pressure) {
  const auto strain = factor_of(strain_units, x), depth = factor_of(depth_units, x);
  const auto of_pressure = factor_of(pressure_units, pressure);
  if (!(strain || depth) || !of_pressure) return std::nullopt;
  return CurveUnits{strain.has_value(), strain ? *strain : *depth, *of_pressure};
}

std::optional<CurveUnits> said_units(const SceneValues& values, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t comma = text.find(',');
  std::optional<CurveUnits> found;
  if (comma != std::string::npos)
    found =
        units_of(trimmed(std::string_view(text).substr(0, comma)), trimmed(std::string_view(text).substr(comma + 1)));
  if (!found) values.refuse(units_key, units_allowed);
  return found;
}

/// The curve as it was given, and who to blame for a point of it.
class GivenCurve {
 public:
  GivenCurve(const SceneValues& values, const PadScene& pad) : values_(values), points_(pad.curve) {
    std::optional<CurveUnits> units = said_units(values, pad.units);
    if (!pad.file.empty()) units = read(pad.file, units);
    units_ = units.value_or(CurveUnits{.is_strain = pad.thickness.has_value()});
    for (auto& [x, pressure] : points_) {
      x *= units_.x;
      pressure *= units_.pressure;
    }
  }
  [[nodiscard]] const PadScene::Points& points() const { return points_; }
  [[nodiscard]] bool is_strain() const { return units_.is_strain; }
  /// Blames point i.
  [[noreturn]] void refuse(std::size_t i, const std::string& allowed) const {
    if (rows_) rows_->refuse(i, "must be " + allowed);
    values_.refuse(curve_key, allowed);
  }

 private:
  /// @return the units, `said` in place of those of its header.
  CurveUnits read(const std::string& file, const std::optional<CurveUnits>& said) {
    rows_.emplace(file, curve_units, "two or more rows of strain or depth and pressure are needed");
    const std::vector<TextRows::Column>& columns = rows_->columns();
    std::vector<std::size_t> x, pressure;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (factor_of(pressure_units, columns[k].unit)) pressure.push_back(k);
      else if (factor_of(strain_units, columns[k].unit) || factor_of(depth_units, columns[k].unit)) x.push_back(k);
    }
    if (said && columns.size() == 2) x = {0}, pressure = {1};
    if (x.size() != 1 || pressure.size() != 1)
      rows_->refuse(fmt::format(
          "columns {}: one must have a unit of strain or depth and one a unit of pressure in the header, as in strain "
          "[%], stress [kPa]; or say the units of two columns: --curve-units %,kPa, {} in a file",
          rows_->names(), units_key));
    for (std::size_t i = 0; i < rows_->count(); ++i)
      points_.push_back({rows_->number(i, x[0]), rows_->number(i, pressure[0])});
    return said ? *said : *units_of(columns[x[0]].unit, columns[pressure[0]].unit);
  }

  const SceneValues& values_;
  PadScene::Points points_;
  std::optional<TextRows> rows_;
  CurveUnits units_;
};

void check_curve(const GivenCurve& curve, const std::optional<double>& thickness) {
  const PadScene::Points& points = curve.points();
  if (points.size() < 2) curve.refuse(0, "a curve of at least two points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [x, pressure] = points[i];
    const std::string here = fmt::format("point {}, {}, {} Pa", i + 1, shortest(x), shortest(pressure));
    if (!std::isfinite(x) || !std::isfinite(pressure)) curve.refuse(i, "of finite numbers: " + here);
    if (i == 0 && !(x >= 0 && (x > 0 ? pressure > 0 : pressure == 0)))
      curve.refuse(i, "one that begins at 0, 0 or beyond: " + here);
    if (i > 0 && !(x > points[i - 1][0])) curve.refuse(i, "one whose strain or depth rises: " + here);
    if (i > 0 && !(pressure >= points[i - 1][1])) curve.refuse(i, "one whose pressure does not fall: " + here);
    if (i == 1 && !(pressure > 0)) curve.refuse(i, "one whose pressure rises from the first point on: " + here);
    if (curve.is_strain() && !(x < 1))
      curve.refuse(i, fmt::format("of strains below 1: {} (in per cent with {} = \"%,Pa\")", here, units_key));
    if (!curve.is_strain() && thickness && !(x <= *thickness))
      curve.refuse(i, fmt::format("of depths up to ground.thickness, {} m: {}", shortest(*thickness), here));
  }
}

/// What the curve's x is in m.
double depth_unit(const PadScene& pad) { return pad.units == strain_curve ? *pad.thickness : 1; }

/// The stiffness of a pad beyond its curve [Pa/m]: `pad.under`, or on a named floor that of what is left of it,
/// h = pad_left(), as a layer that bears as floor and body do:  E*/h  (floors.hpp).  That is an estimate on the hard
/// side: under patches wider than h floor and body yield, too.  None: the curve's last slope goes on.
std::optional<double> stiffness_under(const PadScene& pad, const HalfSpaceScene& floor) {
  return floor.floor ? reduced_modulus(floor).middle / pad_left(pad) : pad.under;
}

}  // namespace

void read_pad(const SceneValues& values, PadScene& pad) {
  const GivenCurve curve(values, pad);
  if (curve.is_strain()) values.require("ground.thickness", "in m, since the curve is over strain");
  check_curve(curve, pad.thickness);
  pad.curve = curve.points();
  pad.units = curve.is_strain() ? strain_curve : "m,Pa";
}

double pad_left(const PadScene& pad) {
  return pad.thickness ? *pad.thickness - pad.curve.back()[0] * depth_unit(pad) : std::nan("");
}

void settle_pad(const PadScene& pad, const HalfSpaceScene& floor, numeric::Ground& ground) {
  if (pad.curve.empty()) return;
  const double unit = depth_unit(pad);
  double depth = 0, pressure = 0, slope = 0;
  const auto turn_to = [&](double next) {
    if (depth == 0) ground.stiffness = next;
    else if (!(std::fabs(next - slope) <= one_slope * std::max(next, slope)))
      ground.kinks.push_back({depth, (next - slope) / ground.stiffness});
    else return;
    slope = next;
  };
  ground.kinks.clear();
  for (const auto& [x, p] : pad.curve) {
    if (x == 0) continue;
    turn_to((p - pressure) / (x * unit - depth));
    depth = x * unit;
    pressure = p;
  }
  if (const std::optional<double> under = stiffness_under(pad, floor)) turn_to(*under);
  if (ground.kinks.empty() || ground.kinks.back().depth < depth) ground.kinks.push_back({depth, 0});
}

std::string pad_words(const Scene& scene) {
  const PadScene& pad = scene.pad;
  const std::optional<std::size_t> floor = scene.half_space.floor;
  const double end = scene.world.ground.kinks.back().depth;
  const std::optional<double> under = stiffness_under(pad, scene.half_space);
  return fmt::format("pad{}{}, {} points up to {} m and {} Pa ({} beyond{}),",
                     pad.thickness ? fmt::format(" {} m thick", shortest(*pad.thickness)) : "",
                     pad.file.empty() ? "" : " by " + pad.file, pad.curve.size(), significant(end, 4),
                     shortest(pad.curve.back()[1]), under ? fmt::format("{:.4g} Pa/m", *under) : "its last slope",
                     floor ? ", by " + floor_names()[*floor] + " below" : "");
}

std::string pad_doubts(const Scene& scene) {
  if (!scene.world.ground.is_pad() || !scene.pad.thickness) return "";
  const double extent = body_properties(scene, Model::continuous).extents.maxCoeff();
  if (!(*scene.pad.thickness > extent)) return "";
  return fmt::format("a pad {} m thick under a body of {} m: lengths are in m; were mm meant?",
                     shortest(*scene.pad.thickness), significant(extent, 3));
}

std::string pad_remark(const Scene& scene, double depth) {
  const PadScene& pad = scene.pad;
  if (!scene.world.ground.is_pad()) return "";
  const bool is_through = pad.thickness && depth >= *pad.thickness;
  return fmt::format("{}: {}",
                     is_through ? fmt::format(", and further than it is thick, {} m", shortest(*pad.thickness)) : "",
                     scene.half_space.floor ? "peaks are those of its rest on ground.floor"
                     : pad.under            ? "peaks are those of ground.under"
                                            : "peaks are those of its last slope, where a pad bottoms out; --floor "
                                              "NAME or --under PA/M (ground.under) says on what");
}

bool is_too_deep_for_springs(const Scene& scene, double depth) {
  return !scene.world.ground.is_pad() && scene.pad.thickness &&
         !(depth <= most_strain_of_springs * *scene.pad.thickness);
}

std::string springs_warning(const Scene& scene, double depth) {
  if (!is_too_deep_for_springs(scene, depth)) return "";
  const double thickness = *scene.pad.thickness;
  return fmt::format(
      "an impact goes {} m deep, {} {} % of the pad's {} m: a bed of springs is no model beyond half of "
      "it, where a pad hardens and bottoms out; its curve (--curve) on a floor is",
      significant(depth, 3), depth >= thickness ? "through the pad," : "to", significant(100 * depth / thickness, 3),
      shortest(thickness));
}

}  // namespace clatter::validation
