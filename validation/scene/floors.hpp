// SPDX-License-Identifier: GPL-3.0-or-later
// Floors and bodies by the names of their materials, and the elastic half-space that a scene makes of them.
#pragma once

#include <string>
#include <vector>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// A material by name: the range of its published numbers, and where they are from.
struct Material {
  const char* name;
  double least_modulus, largest_modulus;  ///< Young's [Pa]
  double least_poisson, largest_poisson;
  const char* source;
};
/// Floors for which published numbers were found; of vinyl, rubber and foam there are none.
[[nodiscard]] const std::vector<Material>& floors();
/// What housings are made of; the first is that of a body of which nothing is said.
[[nodiscard]] const std::vector<Material>& body_materials();
[[nodiscard]] const std::vector<std::string>& floor_names();
[[nodiscard]] const std::vector<std::string>& body_material_names();

/// A modulus as its sources leave it [Pa]; the middle is the geometric mean of E* at the ends, where they differ.
struct ModulusRange {
  double least = 0, middle = 0, largest = 0;
};
/// E* of a half-space by 1/E* = 1/(E/(1 − ν²))_ground + 1/(E/(1 − ν²))_body, of a body that is rigid where neither it
/// nor a floor is named; 0 without a ground.
[[nodiscard]] ModulusRange reduced_modulus(const HalfSpaceScene& given);

/// Gives the ground the middle of reduced_modulus().  Nothing where no half-space is given.
void settle_half_space(const HalfSpaceScene& given, numeric::Ground& ground);

/// "concrete under abs, 2.16e9 to 2.47e9 Pa by their sources", or "abs on it"; empty where no material is named.
[[nodiscard]] std::string material_words(const HalfSpaceScene& given);
/// Where the numbers of the named materials are from, each once; the body's first.
[[nodiscard]] std::vector<std::string> material_sources(const HalfSpaceScene& given);

}  // namespace clatter::validation
