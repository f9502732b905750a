// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/record/impact_quantities.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "validation/output/estimated.hpp"
#include "validation/record/names.hpp"

namespace clatter::validation::inline record {
namespace {

using analytic::ImpactRow;
using analytic::PlanarBody;
using analytic::RowErrors;
using analytic::Tail;
using SpaceTail = analytic::space::Tail;
using numeric::ImpactNumbers;

constexpr double degrees = 180 / std::numbers::pi;

Entry entry(double number) { return number; }
Entry entry(const numeric::Vector3& v) { return EntryVector{v.x(), v.y(), v.z()}; }
Entry entry(Entry value) { return value; }
Entry impulse(double tangential, double normal) { return EntryVector{tangential, 0, normal}; }
EntryVector velocity(const analytic::PlanarVelocity& v) { return {v.tangential, 0, v.normal}; }
EntryVector rotation(const analytic::PlanarVelocity& v) { return {0, v.angular, 0}; }

/// An angle in degrees; that of the first impact is the drop's, unless that was turned beyond the upright.
double degrees_of(double radians, const DiscreteRow& impact) {
  const bool is_drop = impact.n == 1 && std::fabs(impact.drop_deg) <= 90;
  return is_drop ? std::copysign(impact.drop_deg, radians) : radians * degrees;
}

/// Get takes it from the row, Error from the row's errors.
template <auto Get, auto Error>
constexpr Getter<DiscreteRow> discrete() {
  return {[](const DiscreteRow& i) { return entry(std::invoke(Get, i.row)); },
          [](const DiscreteRow& i) { return entry(std::invoke(Error, i.row.error)); }};
}

template <auto Get>
constexpr Getter<DiscreteRow> discrete() {
  return {[](const DiscreteRow& i) { return entry(std::invoke(Get, i.row)); }, nullptr};
}

/// Get takes it from the numbers of a row, and so its error from their errors.
template <auto Get>
constexpr Getter<ContinuousRow> number() {
  return {[](const ContinuousRow& i) { return entry(std::invoke(Get, i.row.value)); },
          [](const ContinuousRow& i) { return entry(std::invoke(Get, i.row.error)); }};
}

/// Get takes it from the row of the model in space, Error from the row's errors.
template <auto Get, auto Error>
constexpr Getter<SpaceRow> in_space() {
  return {[](const SpaceRow& i) { return entry(std::invoke(Get, i.row)); },
          [](const SpaceRow& i) { return entry(std::invoke(Error, i.row.error)); }};
}

template <auto Get>
constexpr Getter<SpaceRow> in_space() {
  return {[](const SpaceRow& i) { return entry(std::invoke(Get, i.row)); }, nullptr};
}

template <auto Get>
constexpr Getter<ContinuousRow> fact() {
  return {[](const ContinuousRow& i) { return entry(Entry(std::invoke(Get, i.row))); }, nullptr};
}

template <auto Get>
constexpr Getter<Tail> tail() {
  return {[](const Tail& t) { return entry(std::invoke(Get, t)); }, nullptr};
}

template <auto Get, auto Error>
constexpr Getter<Tail> tail() {
  return {[](const Tail& t) { return entry(std::invoke(Get, t)); },
          [](const Tail& t) { return entry(std::invoke(Error, t)); }};
}

template <auto Get>
constexpr Getter<SpaceTail> space_tail() {
  return {[](const SpaceTail& t) { return entry(std::invoke(Get, t)); }, nullptr};
}

template <auto Get, auto Error>
constexpr Getter<SpaceTail> space_tail() {
  return {[](const SpaceTail& t) { return entry(std::invoke(Get, t)); },
          [](const SpaceTail& t) { return entry(std::invoke(Error, t)); }};
}

/// The model has the quantity, and no value of it.
constexpr Getter<DiscreteRow> none{[](const DiscreteRow&) { return Entry(nullptr); }, nullptr};

double ratio_error(const numeric::ImpactRecord& row) {
  return row.error.impulse.norm() * (1 + std::fabs(impulse_ratio(row.value))) / std::fabs(row.value.impulse.z());
}

using PlanarRow = ImpactRow;
using Errors = RowErrors;
using Flown = analytic::space::ImpactRow;  // of the model in space
using Bars = analytic::space::RowErrors;
using Record = numeric::ImpactRecord;
using Numbers = ImpactNumbers;

constexpr Getter<DiscreteRow> inclination{
    [](const DiscreteRow& i) { return Entry(degrees_of(i.row.inclination, i)); },
    [](const DiscreteRow& i) { return Entry(i.row.error.inclination * degrees); }};
constexpr Getter<DiscreteRow> contact_angle{
    [](const DiscreteRow& i) { return Entry(degrees_of(i.row.contact_angle, i)); },
    [](const DiscreteRow& i) { return Entry(i.row.error.contact_angle * degrees); }};

constexpr Getter<SpaceRow> none_in_space{[](const SpaceRow&) { return Entry(nullptr); }, nullptr};

/// Of the body's x axis [rad], positive with end a lower.
double inclination_in_space(const Flown& row) {
  const analytic::space::Vector3 axis = row.before.attitude * analytic::space::Vector3::UnitX();
  return std::atan2(axis.z(), std::hypot(axis.x(), axis.y()));
}
Entry parameters_of(const Eigen::Quaterniond& q) { return EntryParameters{q.w(), q.x(), q.y(), q.z()}; }
/// A turn by a small angle changes the parameters by half of it.
Entry each_parameter(double bound) { return EntryParameters{bound, bound, bound, bound}; }
/// A vector's error is a bound on its length, and so on each of its parts.
EntryVector each(double bound) { return {bound, bound, bound}; }
double ratio_in_space(const Flown& row) { return row.impact.impulse.x() / row.impact.impulse.z(); }
double ratio_error_in_space(const SpaceRow& i) {
  return i.row.error.impulse * (1 + std::fabs(ratio_in_space(i.row))) / std::fabs(i.row.impact.impulse.z());
}
Entry summed_impulse(const SpaceTail& t) {
  return EntryVector{t.tangential_impulse.x(), t.tangential_impulse.y(), t.normal_impulse};
}
constexpr ImpactQuantity quantity(const char* name, const char* symbol, const char* unit, const char* meaning,
                                  Scale scale, Getter<DiscreteRow> of_discrete, Getter<SpaceRow> of_space,
                                  Getter<ContinuousRow> of_continuous, Getter<Tail> of_tail = {}, bool motion = false,
                                  Getter<SpaceTail> of_space_tail = {}) {
  return {name, symbol, unit, meaning, scale, of_discrete, of_space, of_continuous, of_tail, motion, of_space_tail};
}

constexpr ImpactQuantity all[]{
    quantity("n", "n", "", "number of the impact, from 1", Scale::none,
             {[](const DiscreteRow& i) { return Entry(i.n); }}, {[](const SpaceRow& i) { return Entry(i.n); }},
             {[](const ContinuousRow& i) { return Entry(i.n); }},
             tail<[](const Tail&) { return Entry(std::string("tail")); }>(), false,
             space_tail<[](const SpaceTail&) { return Entry(std::string("tail")); }>()),
    quantity("end", "end", "", "which end of the body strikes, or its vertices", Scale::none,
             discrete<[](const PlanarRow& r) { return Entry(PlanarBody::vertex_set_name(r.vertices)); }>(),
             {[](const SpaceRow& i) { return Entry(i.end); }},
             fact<[](const Record& r) { return std::string(end_name(r.end)); }>(),
             tail<[](const Tail& t) { return Entry(PlanarBody::vertex_set_name(t.vertices)); }>()),
    quantity("corners", "corner", "", "which corners of the body strike", Scale::none, {},
             {[](const SpaceRow& i) { return Entry(i.corners); }},
             {[](const ContinuousRow& i) { return i.corners.empty() ? Entry(nullptr) : Entry(i.corners); }}),
    quantity("place", "x y z", "m",
             "of the vertex that strikes, body frame, from the geometric centre; a mesh: in its file's frame",
             Scale::none, {}, {[](const SpaceRow& i) { return Entry(i.place); }}, {}),
    quantity("attitude", "q₀ q₁ q₂ q₃", "", "Euler parameters at touch-down, body to world, scalar first", Scale::none,
             {},
             in_space<[](const Flown& r) { return parameters_of(r.before.attitude); },
                      [](const Bars& e) { return each_parameter(e.attitude / 2); }>(),
             fact<[](const Record& r) { return parameters_of(r.attitude); }>()),
    quantity("touches", "touches", "", "separate places that came down during the impact", Scale::none, {},
             in_space<[](const Flown& r) { return Entry(static_cast<int>(r.corners.size())); }>(),
             fact<&Record::touches>()),
    quantity("start", "t", "s", "time of touch-down, after that of impact 1", Scale::time,
             discrete<&PlanarRow::start, &Errors::start>(), in_space<&Flown::start, &Bars::start>(),
             number<&Numbers::start>(), tail<&Tail::end_time, &Tail::end_time_error>(), true,
             space_tail<&SpaceTail::end_time, &SpaceTail::end_time_error>()),
    quantity("duration", "contact", "s", "how long anything touches", Scale::time,
             discrete<[](const PlanarRow&) { return 0.0; }>(), in_space<[](const Flown&) { return 0.0; }>(),
             number<&Numbers::duration>()),
    quantity("inclination_deg", "α", "°", "of the body's x axis at touch-down, positive with end a lower", Scale::angle,
             inclination,
             in_space<[](const Flown& r) { return inclination_in_space(r) * degrees; },
                      [](const Bars& e) { return e.attitude * degrees; }>(),
             number<[](const Numbers& n) { return n.inclination * degrees; }>()),
    quantity("contact_angle_deg", "angle", "°", "acute angle between body and ground at touch-down", Scale::angle,
             contact_angle,
             in_space<[](const Flown& r) { return std::fabs(inclination_in_space(r)) * degrees; },
                      [](const Bars& e) { return e.attitude * degrees; }>(),
             number<[](const Numbers& n) { return n.contact_angle * degrees; }>(), {}, true),
    quantity("approach_speed", "v", "m/s", "of the contact point, downward", Scale::speed,
             discrete<[](const PlanarRow& r) { return r.impact.approach_speed; }, &Errors::approach_speed>(),
             in_space<&Flown::approach_speed, &Bars::approach_speed>(), number<&Numbers::approach_speed>()),
    quantity(
        "restitution", "e", "", "separation over approach speed that came out", Scale::ratio,
        discrete<[](const PlanarRow& r) { return r.impact.restitution(); }, &Errors::restitution>(),
        in_space<[](const Flown& r) { return r.impact.restitution(); }, [](const Bars&) { return unknown_error; }>(),
        number<&Numbers::restitution>()),
    quantity("impulse_normal", "Pₙ", "N·s", "normal impulse of the ground", Scale::impulse,
             discrete<[](const PlanarRow& r) { return r.impact.normal_impulse; }, &Errors::normal_impulse>(),
             in_space<[](const Flown& r) { return r.impact.impulse.z(); }, &Bars::impulse>(),
             number<[](const Numbers& n) { return n.impulse.z(); }>(),
             tail<&Tail::normal_impulse, &Tail::normal_impulse_error>(), false,
             space_tail<&SpaceTail::normal_impulse, &SpaceTail::normal_impulse_error>()),
    quantity("impulse_tangential", "Pₜ", "N·s", "tangential impulse of the ground, along x", Scale::impulse,
             discrete<[](const PlanarRow& r) { return r.impact.tangential_impulse; }, &Errors::tangential_impulse>(),
             in_space<[](const Flown& r) { return r.impact.impulse.x(); }, &Bars::impulse>(),
             number<[](const Numbers& n) { return n.impulse.x(); }>(),
             tail<&Tail::tangential_impulse, &Tail::tangential_impulse_error>(), false,
             space_tail<[](const SpaceTail& t) { return t.tangential_impulse.x(); }>()),
    quantity("impulse_ratio", "Pₜ/Pₙ", "", "tangential over normal impulse", Scale::ratio,
             discrete<[](const PlanarRow& r) { return r.impact.impulse_ratio(); }, &Errors::impulse_ratio>(),
             {[](const SpaceRow& i) { return Entry(ratio_in_space(i.row)); },
              [](const SpaceRow& i) { return Entry(ratio_error_in_space(i)); }},
             {[](const ContinuousRow& i) { return Entry(impulse_ratio(i.row.value)); },
              [](const ContinuousRow& i) { return Entry(ratio_error(i.row)); }}),
    quantity("impulse", "Pₜ P_y Pₙ", "N·s", "impulse of the ground, world frame", Scale::impulse,
             discrete<[](const PlanarRow& r) { return impulse(r.impact.tangential_impulse, r.impact.normal_impulse); },
                      [](const Errors& e) { return impulse(e.tangential_impulse, e.normal_impulse); }>(),
             in_space<[](const Flown& r) { return r.impact.impulse; },
                      [](const Bars& e) { return Entry(each(e.impulse)); }>(),
             number<&Numbers::impulse>(), {}, true, space_tail<&summed_impulse>()),
    quantity("peak_force", "peak Fₙ", "N", "largest normal force; the discrete model has none", Scale::none, none,
             none_in_space, number<&Numbers::peak_force>()),
    quantity("peak_time", "peak t", "s", "when, after touch-down", Scale::time, none, none_in_space,
             number<&Numbers::peak_time>()),
    quantity("velocity_after", "Vₜ V_y Vₙ", "m/s", "of the centre of mass after the impact, world frame", Scale::speed,
             discrete<[](const PlanarRow& r) { return Entry(velocity(r.impact.after)); },
                      [](const Errors& e) { return Entry(velocity(e.after)); }>(),
             in_space<[](const Flown& r) { return r.impact.velocity_after; },
                      [](const Bars& e) { return Entry(each(e.velocity_after)); }>(),
             number<&Numbers::velocity_after>(),
             tail<[](const Tail& t) { return Entry(velocity(t.after)); },
                  [](const Tail& t) { return Entry(velocity(t.after_error)); }>(),
             true, space_tail<&SpaceTail::velocity_after>()),
    quantity("angular_velocity_after", "ω_x Ω ω_z", "rad/s", "after the impact, world frame", Scale::rate,
             discrete<[](const PlanarRow& r) { return Entry(rotation(r.impact.after)); },
                      [](const Errors& e) { return Entry(rotation(e.after)); }>(),
             in_space<[](const Flown& r) { return r.impact.angular_velocity_after; },
                      [](const Bars& e) { return Entry(each(e.angular_velocity_after)); }>(),
             number<&Numbers::angular_velocity_after>(),
             tail<[](const Tail& t) { return Entry(rotation(t.after)); },
                  [](const Tail& t) { return Entry(rotation(t.after_error)); }>(),
             true, space_tail<&SpaceTail::angular_velocity_after>()),
    quantity("energy_before", "", "J", "translational, rotational and potential, before", Scale::energy,
             discrete<&PlanarRow::energy_before, &Errors::energy_before>(),
             in_space<&Flown::energy_before, &Bars::energy_before>(), number<&Numbers::energy_before>()),
    quantity("energy_after", "", "J", "the same after the impact", Scale::energy,
             discrete<&PlanarRow::energy_after, &Errors::energy_after>(),
             in_space<&Flown::energy_after, &Bars::energy_after>(), number<&Numbers::energy_after>()),
    quantity("energy_loss", "loss", "J", "energy lost in the impact", Scale::energy,
             discrete<[](const PlanarRow& r) { return r.impact.energy_loss; }, &Errors::energy_loss>(),
             in_space<[](const Flown& r) { return r.impact.energy_loss; },
                      [](const Bars& e) { return e.energy_before + e.energy_after; }>(),
             number<&Numbers::energy_loss>()),
    quantity("work_damping", "", "J", "dissipated by the ground's dampers", Scale::energy, {}, {},
             number<&Numbers::work_damping>()),
    quantity("work_friction", "", "J", "dissipated by friction", Scale::energy, {}, {},
             number<&Numbers::work_friction>()),
    quantity("work_released", "", "J", "elastic energy left in the ground where the clamp let go", Scale::energy, {},
             {}, number<&Numbers::work_released>()),
    quantity("mode", "mode", "", "how friction acted", Scale::none,
             discrete<[](const PlanarRow& r) { return Entry(std::string(mode_name(r.impact.mode))); }>(),
             in_space<[](const Flown& r) { return Entry(std::string(mode_name(r.impact.path))); }>(),
             fact<[](const Record& r) { return std::string(mode_name(r.mode)); }>()),
    quantity("submerged", "", "", "whether the whole body lay below the ground for a time", Scale::none, {}, {},
             fact<&Record::submerged>()),
    quantity("local_slip", "", "N·s", "what each place's own slip would change in the tangential impulse",
             Scale::impulse, {}, {}, fact<&Record::local_slip>()),
    quantity("energy_stored", "", "J", "left in the ground's springs", Scale::energy, {}, {},
             fact<&Record::energy_stored>()),
    quantity("ledger_gap", "", "", "by how much the ledger of energy does not close", Scale::none, {}, {},
             fact<&Record::ledger_gap>()),
    quantity("amplification", "", "", "growth of a relative error of the start until the end of this impact",
             Scale::none, discrete<&PlanarRow::amplification>(), in_space<&Flown::amplification>(),
             fact<&Record::amplification>()),
    quantity("predictable", "", "", "whether errors have not grown so far that another sequence may follow",
             Scale::none, discrete<[](const PlanarRow& r) { return Entry(r.error.predictable); }>(),
             in_space<[](const Flown& r) { return Entry(r.error.predictable); }>(), fact<&Record::predictable>())};

}  // namespace

std::span<const ImpactQuantity> impact_quantities() { return all; }

double impulse_ratio(const numeric::ImpactNumbers& numbers) { return numbers.impulse.x() / numbers.impulse.z(); }

}  // namespace clatter::validation::inline record
