// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/impact_quantities.hpp"

namespace clatter::validation {
namespace {

using Number = Entry (*)(const Numbers&);
using Fact = Entry (*)(const Impact&);

/// The models and the tail that know a quantity, in the order plane, space, continuous, tail.
struct KnownTo {
  Known in_plane, in_space, continuous, tail;
};
using enum Known;
constexpr KnownTo all_models{value_only, value_only, value_only, absent},
    all_with_errors{with_error, with_error, with_error, absent},
    all_and_tail{with_error, with_error, with_error, with_error}, force_of_contact{empty, empty, with_error, absent},
    simulator_with_errors{absent, absent, with_error, absent}, simulator_alone{absent, absent, value_only, absent};

template <auto Member>
constexpr Number number_at = [](const Numbers& numbers) { return Entry(numbers.*Member); };
template <auto Member>
constexpr Fact fact_at = [](const Impact& impact) { return Entry(impact.*Member); };

constexpr ImpactQuantity quantity(const char* name, const char* symbol, const char* unit, const char* meaning,
                                  Scale scale, const KnownTo& known, Number of_numbers, Fact of_impact = nullptr) {
  return {name,           symbol,           unit,       meaning,    scale,    known.in_plane,
          known.in_space, known.continuous, known.tail, of_numbers, of_impact};
}

constexpr ImpactQuantity quantity(const char* name, const char* symbol, const char* unit, const char* meaning,
                                  Scale scale, const KnownTo& known, Fact of_impact) {
  return quantity(name, symbol, unit, meaning, scale, known, nullptr, of_impact);
}

constexpr ImpactQuantity all[]{
    quantity("n", "n", "", "number of the impact, from 1", Scale::none,
             {value_only, value_only, value_only, value_only},
             [](const Impact& i) { return i.is_tail ? Entry(std::string("tail")) : Entry(i.n); }),
    quantity("end", "end", "", "which end of the body strikes, or its vertices", Scale::none,
             {value_only, value_only, value_only, value_only}, fact_at<&Impact::end>),
    quantity("corners", "corner", "", "which corners of the body strike", Scale::none,
             {absent, value_only, value_only, absent},
             [](const Impact& i) { return i.corners.empty() ? Entry(nullptr) : Entry(i.corners); }),
    quantity("place", "x y z", "m",
             "of the vertex that strikes, body frame, from the geometric centre; a mesh: in its file's frame",
             Scale::none, {absent, value_only, absent, absent}, fact_at<&Impact::place>),
    quantity("attitude", "q₀ q₁ q₂ q₃", "", "Euler parameters at touch-down, body to world, scalar first", Scale::none,
             {absent, with_error, value_only, absent}, number_at<&Numbers::attitude>),
    quantity("touches", "touches", "", "separate places that came down during the impact", Scale::none,
             {absent, value_only, value_only, absent}, fact_at<&Impact::touches>),
    quantity("start", "t", "s", "time of touch-down, after that of impact 1", Scale::time, all_and_tail,
             number_at<&Numbers::start>),
    quantity("duration", "contact", "s", "how long anything touches", Scale::time,
             {value_only, value_only, with_error, absent}, number_at<&Numbers::duration>),
    quantity("inclination_deg", "α", "°", "of the body's x axis at touch-down, positive with end a lower", Scale::angle,
             all_with_errors, number_at<&Numbers::inclination_deg>),
    quantity("contact_angle_deg", "angle", "°", "acute angle between body and ground at touch-down", Scale::angle,
             all_with_errors, number_at<&Numbers::contact_angle_deg>),
    quantity("approach_speed", "v", "m/s", "of the contact point, downward", Scale::speed, all_with_errors,
             number_at<&Numbers::approach_speed>),
    quantity("restitution", "e", "", "separation over approach speed that came out", Scale::ratio, all_with_errors,
             number_at<&Numbers::restitution>),
    quantity("impulse_normal", "Pₙ", "N·s", "normal impulse of the ground", Scale::impulse, all_and_tail,
             [](const Numbers& n) { return Entry(n.impulse[2]); }),
    quantity("impulse_tangential", "Pₜ", "N·s", "tangential impulse of the ground, along x", Scale::impulse,
             all_and_tail, [](const Numbers& n) { return Entry(n.impulse[0]); }),
    quantity("impulse_ratio", "Pₜ/Pₙ", "", "tangential over normal impulse", Scale::ratio, all_with_errors,
             number_at<&Numbers::impulse_ratio>),
    quantity("impulse", "Pₜ P_y Pₙ", "N·s", "impulse of the ground, world frame", Scale::impulse, all_and_tail,
             number_at<&Numbers::impulse>),
    quantity("peak_force", "peak Fₙ", "N", "largest normal force; the discrete model has none", Scale::none,
             force_of_contact, number_at<&Numbers::peak_force>),
    quantity("peak_time", "peak t", "s", "when, after touch-down", Scale::time, force_of_contact,
             number_at<&Numbers::peak_time>),
    quantity("indentation", "depth", "m", "greatest depth of a point of the body below the ground", Scale::none,
             simulator_with_errors, number_at<&Numbers::indentation>),
    quantity("velocity_after", "Vₜ V_y Vₙ", "m/s", "of the centre of mass after the impact, world frame", Scale::speed,
             all_and_tail, number_at<&Numbers::velocity_after>),
    quantity("angular_velocity_after", "ω_x Ω ω_z", "rad/s", "after the impact, world frame", Scale::rate, all_and_tail,
             number_at<&Numbers::angular_velocity_after>),
    quantity("energy_before", "", "J", "translational, rotational and potential, before", Scale::energy,
             all_with_errors, number_at<&Numbers::energy_before>),
    quantity("energy_after", "", "J", "the same after the impact", Scale::energy, all_with_errors,
             number_at<&Numbers::energy_after>),
    quantity("energy_loss", "loss", "J", "energy lost in the impact", Scale::energy, all_with_errors,
             number_at<&Numbers::energy_loss>),
    quantity("work_damping", "", "J", "dissipated by the ground's dampers", Scale::energy, simulator_with_errors,
             number_at<&Numbers::work_damping>),
    quantity("work_friction", "", "J", "dissipated by friction", Scale::energy, simulator_with_errors,
             number_at<&Numbers::work_friction>),
    quantity("work_released", "", "J", "elastic energy left in the ground where the clamp let go", Scale::energy,
             simulator_with_errors, number_at<&Numbers::work_released>),
    quantity("mode", "mode", "", "how friction acted", Scale::none, all_models,
             [](const Impact& i) { return Entry(std::string(i.mode)); }),
    quantity("submerged", "", "", "whether the whole body lay below the ground for a time", Scale::none,
             simulator_alone, fact_at<&Impact::submerged>),
    quantity("local_slip", "", "N·s", "what each place's own slip would change in the tangential impulse",
             Scale::impulse, simulator_alone, fact_at<&Impact::local_slip>),
    quantity("energy_stored", "", "J", "left in the ground's springs", Scale::energy, simulator_alone,
             fact_at<&Impact::energy_stored>),
    quantity("ledger_gap", "", "", "by how much the ledger of energy does not close", Scale::none, simulator_alone,
             fact_at<&Impact::ledger_gap>),
    quantity("amplification", "", "", "growth of a relative error of the start until the end of this impact",
             Scale::none, all_models, fact_at<&Impact::amplification>),
    quantity("predictable", "", "", "whether errors have not grown so far that another sequence may follow",
             Scale::none, all_models, fact_at<&Impact::predictable>)};

}  // namespace

Known ImpactQuantity::known_to(RunModel model) const {
  switch (model) {
    case RunModel::plane: return in_plane;
    case RunModel::space: return in_space;
    case RunModel::continuous: return continuous;
  }
  return absent;
}

Entry ImpactQuantity::kind() const {
  static const Impact some{};
  return value(some);
}

std::span<const ImpactQuantity> impact_quantities() { return all; }

}  // namespace clatter::validation
