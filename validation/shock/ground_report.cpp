// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/ground_report.hpp"

#include <fmt/format.h>

#include "analytic/law/viscoelastic.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

constexpr const char* units[] = {"", " s", " N", " m"};

std::string words_of(const MeasuredNumber& measured) {
  return fmt::format("{} {}{}", measure_name(measured.measure), shortest(measured.value),
                     units[static_cast<std::size_t>(measured.measure)]);
}

/// "surface" or "projected", and what it means for a body that lands flat.
const char* area_words(numeric::AreaMeasure area) {
  return area == numeric::AreaMeasure::surface
             ? "area = surface: the load is taken over all of the body's surface below the ground, as the paper has "
               "it.  Side faces push, too, so that a flat body feels slightly more than its footprint.  A k_G found "
               "so belongs to this measure: with projected the same numbers give another."
             : "area = projected: the load is taken over the ground's area, a bed of upright springs.  Side faces do "
               "not push, and a flat body feels its footprint alone.  A k_G found so belongs to this measure: with "
               "surface, the paper's, the same numbers give another.";
}

Row row_of(const FittedGround& ground) {
  Row row;
  const Estimated stiffness{ground.stiffness, ground.stiffness_error}, damping{ground.damping, ground.damping_error};
  row.push_back(known_cell(stiffness, {6, 0}));
  row.push_back(known_cell(damping, {6, ground.stiffness}));
  for (const double predicted : ground.predicted) row.emplace_back(predicted, 6);
  for (const double by : ground.stiffness_by) row.emplace_back(by, 3);
  for (const double by : ground.damping_by) row.emplace_back(by, 3);
  row.emplace_back(error_or_nothing(stiffness));
  row.emplace_back(error_or_nothing(damping));
  return row;
}

}  // namespace

std::vector<Column> ground_columns() {
  std::vector<Column> columns{
      {"stiffness", "k_G", "N/m³", "of the ground"},
      {"damping", "c_G", "N·s/m⁴", "of the ground"},
      {"restitution", "e", "", "by the model: separation over approach speed of the first impact"},
      {"contact_time", "contact", "s", "by the model: how long the first impact lasts"},
      {"peak_force", "peak Fₙ", "N", "by the model: largest normal force of the first impact"},
      {"indentation", "δ", "m",
       "by the model: depth at which the ground carries the body at rest, in the attitude of the drop"},
      {"stiffness_by_first", "∂k/∂1", "", "∂ ln k_G/∂ ln of the first measured number, the second held"},
      {"stiffness_by_second", "∂k/∂2", "", "∂ ln k_G/∂ ln of the second measured number, the first held"},
      {"damping_by_first", "", "N·s/m⁴", "∂ c_G/∂ ln of the first measured number, the second held", false},
      {"damping_by_second", "", "N·s/m⁴", "∂ c_G/∂ ln of the second measured number, the first held", false}};
  columns.push_back(error_column(columns[0]));
  columns.push_back(error_column(columns[1]));
  return columns;
}

Report ground_report(const Scene& scene, const MeasuredNumber& first, const MeasuredNumber& second,
                     const GroundFit& fit) {
  Report report = begun_report("ground", "the ground from what was measured");
  KeyNames unsettled{"ground.stiffness", "ground.damping"};
  report.head = scene_head(scene, Model::continuous, {}, unsettled);
  report.head.push_back(fmt::format("measured: {}; {}", words_of(first), words_of(second)));
  report.grid.columns = ground_columns();
  for (const FittedGround& ground : fit.solutions) report.grid.rows.push_back(row_of(ground));
  if (fit.solutions.empty()) {
    report.notes.push_back(fmt::format("no ground gives both: with the one, the other number goes from {} to {}",
                                       significant(fit.least, 4), significant(fit.largest, 4)));
  } else if (fit.solutions.size() > 1) {
    report.notes.push_back(fmt::format("{} grounds give both numbers", fit.solutions.size()));
  }
  report.notes.emplace_back(
      "δ: depth under the body at rest; ∂k/∂1, ∂k/∂2: by how many per cent k_G changes with one per cent of the first "
      "or the second measured number");
  report.notes.emplace_back(area_words(scene.world.ground.area));
  report.fields["scene"] = scene_value(scene);
  report.fields["body"] = body_value(scene);
  report.fields["measured"] =
      Value::List{Value(Value::Fields{{"name", measure_name(first.measure)}, {"value", first.value}}),
                  Value(Value::Fields{{"name", measure_name(second.measure)}, {"value", second.value}})};
  report.fields["solutions"] = row_objects(report.grid);
  report.fields["cost"] = Value::Fields{{"runs", fit.runs}};
  return report;
}

std::vector<Column> material_columns() {
  return {{"stiffness", "k_G", "N/m³", "of the ground"},
          {"modulus", "E", "Pa", "Young's modulus"},
          {"poisson", "ν", "", "Poisson's ratio"},
          {"damping", "c_G", "N·s/m⁴", "of the ground, with a measured restitution"}};
}

Report material_report(const std::vector<MaterialGround>& grounds, const std::string& approximation,
                       const std::string& source, const std::optional<MaterialLoss>& loss) {
  Report report = begun_report("ground", "the ground from a material");
  report.grid.columns = material_columns();
  if (!loss) report.grid.columns.pop_back();
  const double damping_per_stiffness =
      loss ? analytic::damping_of_restitution(loss->restitution) / loss->approach_speed : 0;
  for (const MaterialGround& ground : grounds) {
    Row row{Cell(ground.stiffness, 6), Cell(ground.modulus, 6), Cell(ground.poisson, 6)};
    if (loss) row.emplace_back(ground.stiffness * damping_per_stiffness, 6);
    report.grid.rows.push_back(std::move(row));
  }
  report.notes = {
      approximation,
      loss ? fmt::format("c_G gives e = {} where the first contact approaches at {} m/s, exact for a flat or "
                         "upright landing without friction",
                         shortest(loss->restitution), significant(loss->approach_speed, 6))
           : "c_G does not follow from a material: --measured-e beside it gives c_G, of the scene's drop"};
  if (!source.empty()) report.notes.push_back("least and largest numbers of the floor's material: " + source);
  report.fields["solutions"] = row_objects(report.grid);
  report.fields["approximation"] = approximation;
  report.fields["source"] = text_or_nothing(source);
  return report;
}

}  // namespace clatter::validation
