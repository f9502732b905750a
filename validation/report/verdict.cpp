// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/verdict.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/assumed_inertia.hpp"
#include "validation/scene/floors.hpp"
#include "validation/scene/pad.hpp"
#include "validation/scene/probes.hpp"

namespace clatter::validation {

double response_in_g(const FragilePart& part, double margin) { return part.response_at(margin) / standard_gravity; }

double Ranking::value_of(const ShockRow& row) const {
  if (by == By::margin) return margin_of(row, *part, has_peaks).value;
  if (by == By::response) return response_in_g(*part, margin_of(row, *part, has_peaks).value);
  return by == By::peak ? row.value.peak_size / standard_gravity : row.value.delta_v_size;
}

bool is_lossless(const Scene& scene, Model model) {
  if (model == Model::continuous) return !scene.world.ground.is_damped();
  const analytic::ImpactLaw law = discrete_law(scene).law;
  return law.law == analytic::RestitutionLaw::viscoelastic ? !(law.damping_per_stiffness > 0) : law.restitution == 1;
}

std::optional<Blow> worst_blow(const std::vector<ShockRow>& rows, const Run& run, const Scene& scene,
                               const Ranking& ranking) {
  if (run.impacts.empty()) return std::nullopt;
  const double end = landing_end(scene, run.impacts.front().value.approach_speed);
  const ShockRow* worst = nullptr;
  for (const ShockRow& row : rows) {
    if (row.probe != ranking.probe || (ranking.landing_alone && !(row.start <= end))) continue;
    if (!worst || ranking.is_worse(ranking.value_of(row), ranking.value_of(*worst))) worst = &row;
  }
  if (!worst) return std::nullopt;
  Blow blow{.impact = worst->impact,
            .predictable = worst->predictable,
            .peak_g = worst->value.peak_size / standard_gravity,
            .velocity = worst->value.delta_v_size,
            .peak_g_error = worst->error.peak_size / standard_gravity,
            .velocity_error = worst->error.delta_v_size,
            .width = worst->value.width,
            .value = ranking.value_of(*worst)};
  if (ranking.part) {
    const BlowMargin margin = blow_margin(*worst, *ranking.part, ranking.has_peaks);
    if (ranking.part->has_limit()) blow.margin = margin;
    else blow.response_g = response_in_g(*ranking.part, margin.value);
    blow.margin_error = margin_of(*worst, *ranking.part, ranking.has_peaks).error;
  }
  if (ranking.has_peaks) blow.depth = run.impacts.at(static_cast<std::size_t>(blow.impact) - 1).value.indentation;
  return blow;
}

Column pulse_column() {
  return {"pulse_ms", "pulse", "ms", "how long the half sine of this peak and change of velocity is"};
}

std::string said(double value, int digits) {
  const double unit = value > 0 ? std::pow(10.0, std::floor(std::log10(value)) - digits + 1) : 1;
  return shortest(unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit);
}

Cell said_cell(double value, double error) {
  const int known = known_cell({value, error}, {3, 0}).digits;
  return known > 0 ? Cell(value, said(value, known)) : Cell(value, 0);
}

Cell deciding_cell(BlowMargin::By by) {
  const auto place = static_cast<std::size_t>(by);
  return {std::array{"delta_v", "peak", "history"}[place], std::array{"|ΔV|", "peak", "humps"}[place]};
}

namespace {

std::string deciding_words(const BlowMargin& margin) {
  switch (margin.by) {
    case BlowMargin::By::velocity: return "the change of velocity decides";
    case BlowMargin::By::peak: return "the peak decides";
    case BlowMargin::By::history: return "its humps decide, which ring it more than one pulse does";
  }
  return "";
}

}  // namespace

std::string blow_words(const Blow& blow, const std::string& probe, const Ranking& ranking) {
  const auto half_sine = [&] { return equivalent_pulse(blow.velocity, blow.peak_g * standard_gravity); };
  std::string words =
      ranking.has_peaks
          ? fmt::format("{} takes {} g in impact {}, {} m/s, as a half sine of {} ms has", probe, said(blow.peak_g),
                        blow.impact, said(blow.velocity), said(1e3 * half_sine().duration))
          : fmt::format("{} is changed by {} m/s in impact {}", probe, said(blow.velocity), blow.impact);
  if (blow.response_g)
    return words + fmt::format("; the part of {} Hz answers with {} g: no limit was given",
                               said(ranking.part->frequency), said(*blow.response_g));
  if (!blow.margin) return words;
  const FragilePart& part = *ranking.part;
  const double bears = part.fragility / standard_gravity;
  const std::string decides = deciding_words(*blow.margin);
  switch (part.kind) {
    case FragilePart::Kind::oscillator:
      return words + fmt::format("; the part of {} Hz answers with {} g and bears {} g: {}", said(part.frequency),
                                 said(bears / blow.margin->value), said(bears), decides);
    case FragilePart::Kind::unlimited: return words;
    case FragilePart::Kind::at_place: return words + fmt::format("; the part bears {} g there", said(bears));
    case FragilePart::Kind::tested:
      return words + fmt::format("; the part bore a half sine of {} g and {} ms, {} m/s: {}", said(bears),
                                 said(1e3 * part.duration),
                                 said(damage_boundary(part, PulseShape::half_sine).critical_velocity), decides);
  }
  return words;
}

std::string depth_words(const Scene& scene, double depth) {
  if (!scene.world.ground.is_pad() && !scene.pad.thickness) return "";
  const std::string words = fmt::format("{} mm deep", said(1e3 * depth));
  if (!scene.pad.thickness) return words;
  return fmt::format("{}, {} % of the pad{}", words, said(100 * depth / *scene.pad.thickness),
                     is_too_deep_for_springs(scene, depth)
                         ? ", too deep for a bed of springs: its curve on a floor (--curve) is the model"
                         : "");
}

std::vector<std::string> assumed_words(const Scene& scene, Model model, const Blow& blow) {
  std::vector<std::string> items;
  const numeric::Ground& ground = scene.world.ground;
  const bool is_continuous = model == Model::continuous;
  if (is_lossless(scene, model)) {
    const char* const what = !is_continuous           ? "Impacts without loss (e = 1)"
                             : ground.is_pad()        ? "Undamped pad (e = 1): a curve gives no restitution"
                             : scene.half_space.floor ? "Undamped floor (e = 1): no source gives a restitution"
                                                      : "Undamped ground (e = 1)";
    items.push_back(fmt::format(
        "{}; changes of velocity are up to twice those without rebound, and later impacts are too hard{}. {} gives one",
        what, blow.impact > 1 ? fmt::format(", as impact {} here is", blow.impact) : "",
        is_continuous ? "--floor-restitution E" : "--restitution E"));
  } else if (!is_continuous) {
    items.push_back("Impact law: " + law_words(scene, std::nullopt));
  } else if (scene.ground_restitution) {
    items.push_back(fmt::format("Restitution of the first impact: {}, as given", shortest(*scene.ground_restitution)));
  } else {
    items.emplace_back("The ground's damping is as given, and gives the restitution");
  }
  if (is_continuous && !ground.has_friction())
    items.emplace_back(
        "No friction: the body slides freely over the ground, which makes some blows milder and others "
        "harder. --sliding-friction MU gives it");
  if (is_continuous)
    for (const auto& [key, words] : discrete_law_words(scene)) items.push_back(words);
  if (is_continuous && ground.is_half_space())
    items.emplace_back(
        "The half-space takes the ground under corners and edges for 11 to 31 % softer than it is, by energy (boundary "
        "elements; faces: 2 %), and their peaks for up to half of that too small: up to 15 %");
  if (const std::string uniform = uniform_inertia_words(scene); !uniform.empty())
    items.push_back("Moments of inertia: " + uniform);
  const HalfSpaceScene& half_space = scene.half_space;
  if (is_continuous && half_space.floor && !half_space.body_modulus) {
    items.push_back(
        half_space.body_material
            ? fmt::format("The body's surface: {}, as given", body_material_names()[*half_space.body_material])
            : fmt::format("The body's surface is taken as {}: --body-material names another",
                          body_materials().front().name));
  }
  return items;
}

}  // namespace clatter::validation
