// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/floors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

std::vector<std::string> names_of(const std::vector<Material>& materials) {
  std::vector<std::string> names;
  for (const Material& material : materials) names.emplace_back(material.name);
  return names;
}

const Material* floor_of(const HalfSpaceScene& given) { return given.floor ? &floors()[*given.floor] : nullptr; }

const Material* body_of(const HalfSpaceScene& given) {
  if (given.body_material) return &body_materials()[*given.body_material];
  return given.floor && !given.body_modulus ? &body_materials().front() : nullptr;
}

/// E/(1 − ν²), which grows with either.
double plane_modulus(double modulus, double poisson) { return modulus / (1 - poisson * poisson); }

}  // namespace

const std::vector<Material>& floors() {
  constexpr const char* joinery = "Advances in Difference Equations (2019), doi 10.1186/s13662-019-2158-5, Table 1";
  constexpr const char* joinery_and_plate =
      "Advances in Difference Equations (2019), doi 10.1186/s13662-019-2158-5, Table 1, after Murray (2007) and Luecke "
      "et al. (2005); Acta Acustica (2021), aacus200084, Table 1";
  static const std::vector<Material> all{
      {"concrete", 10e9, 23e9, 0.15, 0.33, joinery_and_plate},
      {"steel", 200e9, 205e9, 0.288, 0.33, joinery_and_plate},
      {"asphalt", 0.698e9, 2.17e9, 0.4, 0.4, joinery},
      {"wood", 0.403e9, 1.037e9, 0.029, 0.438, "Acta Acustica (2025), aacus240113, Table 5: spruce across its grain"}};
  return all;
}

const std::vector<Material>& body_materials() {
  constexpr const char* dowling = "Dowling, Mechanical Behavior of Materials, Table 5.2";
  static const std::vector<Material> all{
      {"abs", 2.4e9, 2.4e9, 0.35, 0.35, dowling},           {"polycarbonate", 2.4e9, 2.4e9, 0.38, 0.38, dowling},
      {"nylon", 2.7e9, 2.7e9, 0.41, 0.41, dowling},         {"polyethylene", 1.08e9, 1.08e9, 0.42, 0.42, dowling},
      {"aluminium", 70.3e9, 70.3e9, 0.345, 0.345, dowling}, {"magnesium", 44.7e9, 44.7e9, 0.291, 0.291, dowling},
      {"steel", 212e9, 212e9, 0.293, 0.293, dowling},       {"glass", 69e9, 69e9, 0.2, 0.2, dowling}};
  return all;
}

const std::vector<std::string>& floor_names() {
  static const std::vector<std::string> names = names_of(floors());
  return names;
}

const std::vector<std::string>& body_material_names() {
  static const std::vector<std::string> names = names_of(body_materials());
  return names;
}

ModulusRange reduced_modulus(const HalfSpaceScene& given) {
  const Material *const floor = floor_of(given), *const body = body_of(given);
  const auto end = [&](bool largest) {
    const auto of = [&](const Material* material, double instead) {
      if (!material) return instead;
      return largest ? plane_modulus(material->largest_modulus, material->largest_poisson)
                     : plane_modulus(material->least_modulus, material->least_poisson);
    };
    const double ground = of(floor, given.modulus);
    const double of_body = of(body, given.body_modulus.value_or(std::numeric_limits<double>::infinity()));
    return std::isfinite(of_body) && ground > 0 ? 1 / (1 / ground + 1 / of_body) : ground;
  };
  const double least = end(false), largest = end(true);
  return {least, least == largest ? least : std::sqrt(least * largest), largest};
}

void settle_half_space(const HalfSpaceScene& given, numeric::Ground& ground) {
  if (const double modulus = reduced_modulus(given).middle; modulus > 0) ground.modulus = modulus;
}

std::string material_words(const HalfSpaceScene& given) {
  const Material *const floor = floor_of(given), *const body = body_of(given);
  const std::string under = body ? body->name : given.body_modulus ? "the body" : "";
  if (!floor) return body || given.body_modulus ? fmt::format("{} on the ground", under) : "";
  const ModulusRange range = reduced_modulus(given);
  return fmt::format("{} under {}: {} to {} Pa by their sources", floor->name, under, significant(range.least, 3),
                     significant(range.largest, 3));
}

std::vector<std::string> material_sources(const HalfSpaceScene& given) {
  std::vector<std::string> sources;
  for (const Material* const material : {body_of(given), floor_of(given)}) {
    if (material && std::find(sources.begin(), sources.end(), material->source) == sources.end())
      sources.emplace_back(material->source);
  }
  return sources;
}

}  // namespace clatter::validation
