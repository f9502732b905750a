// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/names.hpp"

#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

/// The name of an enumerator, of those of all up to the last one in their order.
template <auto last, std::size_t count>
const char* name_in(const char* const (&names)[count], decltype(last) value) {
  static_assert(count == static_cast<std::size_t>(last) + 1);
  return names[static_cast<std::size_t>(value)];
}

/// In the order of the enumerators.
constexpr RestitutionWords restitution_laws[]{
    {"newton", "Newton's coefficient of restitution",
     "Newton's law ends the impact where the normal velocity is −e times that before."},
    {"poisson", "Poisson's coefficient of restitution",
     "Poisson's law ends the impact at 1 + e times the impulse of compression."},
    {"stronge", "Stronge's coefficient of restitution",
     "Stronge's law ends the impact where the work given back is e² times that of compression."},
    {"viscoelastic", "", "The impact ends where the ground has given back what its dampers left."}};

}  // namespace

const char* mode_name(analytic::ImpactMode mode) {
  return name_in<analytic::ImpactMode::reverse_slip>({"frictionless", "slip", "stick", "slip-stick", "reverse-slip"},
                                                     mode);
}

/// Slip that turns is slip.
const char* mode_name(analytic::space::PathKind path) {
  return name_in<analytic::space::PathKind::slip_reslip>(
      {"frictionless", "slip", "slip", "stick", "slip-stick", "slip-reslip"}, path);
}

const char* mode_name(numeric::FrictionMode mode) {
  return name_in<numeric::FrictionMode::local>(
      {"frictionless", "slip", "stick", "slip-stick", "stick-slip", "slip-stick-slip", "stick-slip-stick",
       "alternating", "reverse-slip", "regularised", "local"},
      mode);
}

const char* outcome_name(analytic::Outcome outcome) {
  return name_in<analytic::Outcome::outside_model>({"no-further-impact", "impact-limit", "time-limit", "at-rest",
                                                    "sustained-contact", "not-computed", "outside-model"},
                                                   outcome);
}

const char* outcome_name(numeric::Outcome outcome) {
  return name_in<numeric::Outcome::time_limit>(
      {"no-further-impact", "impact-limit", "at-rest", "sustained-contact", "evaluation-limit", "step-too-small",
       "not-representable", "flight-undecided", "interrupted", "time-limit"},
      outcome);
}

const char* outcome_name(const numeric::Simulation& run) {
  if (run.outcome != numeric::Outcome::sustained_contact || !run.on_ground) return outcome_name(run.outcome);
  return name_in<numeric::GroundMotionKind::rolls>({"at-rest", "slides-on", "spins-on", "rolls-on"},
                                                   run.on_ground->kind);
}

const char* end_name(numeric::ContactEnd end) {
  return name_in<numeric::ContactEnd::middle>({"a", "b", "both", "middle"}, end);
}

bool is_cut_short(analytic::Outcome outcome) {
  return outcome == analytic::Outcome::not_computed || outcome == analytic::Outcome::outside_model;
}

bool is_cut_short(numeric::Outcome outcome) {
  using enum numeric::Outcome;
  return outcome == evaluation_limit || outcome == step_too_small || outcome == not_representable ||
         outcome == flight_undecided;
}

const RestitutionWords& words_of(analytic::RestitutionLaw law) {
  return restitution_laws[static_cast<std::size_t>(law)];
}

const char* law_name(analytic::RestitutionLaw law) { return words_of(law).name; }

const std::vector<std::string>& law_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const RestitutionWords& law : restitution_laws) all.emplace_back(law.name);
    return all;
  }();
  return names;
}

}  // namespace clatter::validation
