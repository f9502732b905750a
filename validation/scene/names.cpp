// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/names.hpp"

#include "validation/scene/keys.hpp"

namespace clatter::validation {

using analytic::ImpactMode;
using numeric::FrictionMode;
using numeric::Outcome;

const char* mode_name(analytic::ImpactMode mode) {
  switch (mode) {
    case analytic::ImpactMode::frictionless: return "frictionless";
    case analytic::ImpactMode::slip: return "slip";
    case analytic::ImpactMode::stick: return "stick";
    case analytic::ImpactMode::slip_stick: return "slip-stick";
    case analytic::ImpactMode::reverse_slip: return "reverse-slip";
  }
  return "";
}

/// Slip that turns is slip.
const char* mode_name(analytic::space::PathKind path) {
  using analytic::space::PathKind;
  switch (path) {
    case PathKind::frictionless: return "frictionless";
    case PathKind::slip:
    case PathKind::turning_slip: return "slip";
    case PathKind::stick: return "stick";
    case PathKind::slip_stick: return "slip-stick";
    case PathKind::slip_reslip: return "slip-reslip";
  }
  return "";
}

const char* outcome_name(analytic::Outcome outcome) {
  switch (outcome) {
    case analytic::Outcome::no_further_impact: return "no-further-impact";
    case analytic::Outcome::impact_limit: return "impact-limit";
    case analytic::Outcome::time_limit: return "time-limit";
    case analytic::Outcome::at_rest: return "at-rest";
    case analytic::Outcome::sustained_contact: return "sustained-contact";
    case analytic::Outcome::not_computed: return "not-computed";
    case analytic::Outcome::outside_model: return "outside-model";
  }
  return "";
}

const char* outcome_name(const numeric::Simulation& run) {
  if (run.outcome != Outcome::sustained_contact || !run.on_ground) return outcome_name(run.outcome);
  switch (run.on_ground->kind) {
    case numeric::GroundMotionKind::slides: return "slides-on";
    case numeric::GroundMotionKind::spins: return "spins-on";
    case numeric::GroundMotionKind::rolls: return "rolls-on";
    case numeric::GroundMotionKind::rests: return "at-rest";
  }
  return "";
}

const char* outcome_name(Outcome outcome) {
  switch (outcome) {
    case Outcome::no_further_impact: return "no-further-impact";
    case Outcome::impact_limit: return "impact-limit";
    case Outcome::at_rest: return "at-rest";
    case Outcome::sustained_contact: return "sustained-contact";
    case Outcome::evaluation_limit: return "evaluation-limit";
    case Outcome::step_too_small: return "step-too-small";
    case Outcome::not_representable: return "not-representable";
    case Outcome::flight_undecided: return "flight-undecided";
    case Outcome::interrupted: return "interrupted";
    case Outcome::time_limit: return "time-limit";
  }
  return "";
}

bool is_cut_short(analytic::Outcome outcome) {
  return outcome == analytic::Outcome::not_computed || outcome == analytic::Outcome::outside_model;
}

bool is_cut_short(Outcome outcome) {
  switch (outcome) {
    case Outcome::evaluation_limit:
    case Outcome::step_too_small:
    case Outcome::not_representable:
    case Outcome::flight_undecided: return true;
    case Outcome::no_further_impact:
    case Outcome::impact_limit:
    case Outcome::at_rest:
    case Outcome::sustained_contact:
    case Outcome::time_limit:
    case Outcome::interrupted: return false;
  }
  return false;
}

const char* mode_name(FrictionMode mode) {
  switch (mode) {
    case FrictionMode::frictionless: return "frictionless";
    case FrictionMode::slip: return "slip";
    case FrictionMode::stick: return "stick";
    case FrictionMode::slip_stick: return "slip-stick";
    case FrictionMode::stick_slip: return "stick-slip";
    case FrictionMode::slip_stick_slip: return "slip-stick-slip";
    case FrictionMode::stick_slip_stick: return "stick-slip-stick";
    case FrictionMode::alternating: return "alternating";
    case FrictionMode::reverse_slip: return "reverse-slip";
    case FrictionMode::regularised: return "regularised";
    case FrictionMode::local: return "local";
  }
  return "";
}

const char* end_name(numeric::ContactEnd end) {
  switch (end) {
    case numeric::ContactEnd::a: return "a";
    case numeric::ContactEnd::b: return "b";
    case numeric::ContactEnd::both: return "both";
    case numeric::ContactEnd::middle: return "middle";
  }
  return "";
}

namespace {

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
