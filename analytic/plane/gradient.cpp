// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/gradient.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/plane/error_growth.hpp"
#include "analytic/plane/sequence.hpp"

namespace clatter::analytic {

namespace {

using detail::epsilon;

constexpr double shift = 0x1p-24;    ///< of a neighbour's angle, speed, tangential velocity or spin, relative
constexpr double state_error = 16;   ///< of the state beside that of a number of the drop, in units of the last place
constexpr double step_rounding = 8;  ///< of an entry of a Jacobian, in units of the last place

/// A derivative of the state, and a bound on what rounding has added to it.
struct Carried {
  StateVector value{}, rounding{};

  void advance(const StateMatrix& jacobian) {
    StateVector size{}, carried{};
    for (std::size_t i = 0; i < state_size; ++i) {
      for (std::size_t k = 0; k < state_size; ++k) {
        size[i] += std::fabs(jacobian[i][k] * value[k]);
        carried[i] += std::fabs(jacobian[i][k]) * rounding[k];
      }
    }
    value = analytic::product(jacobian, value);
    for (std::size_t i = 0; i < state_size; ++i) rounding[i] = carried[i] + step_rounding * epsilon * size[i];
  }
  void add(const LawColumn& of_law) {
    for (std::size_t i = 0; i < state_size; ++i) {
      value[i] += of_law.state[i];
      rounding[i] += step_rounding * epsilon * of_law.parts[i];
    }
  }
};

/// What a gradient along the state gives of a derivative, and its rounding.
struct Taken {
  double value = 0, rounding = 0;

  Taken(const StateVector& gradient, const Carried& of, double of_law = 0, double part = 0)
      : value(of_law), rounding(step_rounding * epsilon * part) {
    for (std::size_t i = 0; i < state_size; ++i) {
      value += gradient[i] * of.value[i];
      rounding += std::fabs(gradient[i]) * (of.rounding[i] + step_rounding * epsilon * std::fabs(of.value[i]));
    }
  }
};

StateVector unit(StateIndex index) {
  StateVector one{};
  one[index] = 1;
  return one;
}

/// The derivatives of one drop.
struct Trace {
  std::vector<GradientRow> rows;  ///< `error` holds the rounding alone
  std::vector<ImpactMode> modes;
  std::array<GradientRefusal, drop_parameters> refused;
};

class Tracer {
 public:
  explicit Tracer(const Drop& drop)
      : law_(drop.law), motion_(drop.body, drop.inclination, drop.velocity, drop.gravity, drop.gravity_along) {
    const ContactPoint d = motion_.contact_point(std::countr_zero(motion_.lowest_vertices()));
    const PlanarVelocity v = motion_.velocity();
    Carried& angle = of(DropParameter::angle);
    angle.value[at_angle] = 1;
    angle.value[at_normal] = v.angular * d.normal;
    angle.value[at_slip] = v.angular * d.tangential;
    of(DropParameter::speed).value[at_normal] = -1;
    if (law_.law == RestitutionLaw::viscoelastic)
      refuse(DropParameter::restitution, refusals::ground_gives_restitution);
  }

  Trace run(std::size_t count) {
    VertexSet arriving = motion_.lowest_vertices();
    for (std::size_t n = 0; n < count; ++n) {
      if (n > 0) {
        const auto next = fly();
        if (!next) break;
        arriving = *next;
      }
      strike(arriving);
    }
    for (GradientRefusal& one : trace_.refused) {
      if (one.reason.empty()) one.from = trace_.rows.size();
    }
    return std::move(trace_);
  }

 private:
  static constexpr std::size_t index(DropParameter parameter) { return static_cast<std::size_t>(parameter); }
  Carried& of(DropParameter parameter) { return carried_[index(parameter)]; }

  void refuse(DropParameter parameter, const std::string& reason) {
    GradientRefusal& one = trace_.refused[index(parameter)];
    if (one.reason.empty()) one = {trace_.rows.size(), reason};
  }

  std::optional<VertexSet> fly() {
    FlownState flown{.body = motion_.turned_body(), .departure = motion_.local_departure(), .arrival = {}};
    const Flight flight = motion_.fly();
    if (flight.end != FlightEnd::contact) return std::nullopt;
    flown.arrival = flight.arrival;
    const FlightDerivatives f = flight_derivatives(flown, Moment(flown.departure, flight.arrival.time));
    for (Carried& one : carried_) one.advance(f.state);
    return flight.arrival.vertices;
  }

  /// Where the law or the touch has another branch on one side of the drop.
  void check_branches(const ImpactRow& row, bool is_flat) {
    const Impact& impact = row.impact;
    const bool slips_from_rest = impact.slip_before == 0 && impact.mode == ImpactMode::slip;
    for (std::size_t i = 0; i < drop_parameters; ++i) {
      const auto parameter = static_cast<DropParameter>(i);
      const StateVector& g = carried_[i].value;
      if (is_flat && g[at_angle] != 0) refuse(parameter, "the body lands flat: any other angle has another sequence");
      if (slips_from_rest && g[at_slip] != 0) refuse(parameter, refusals::slip_from_rest);
    }
  }

  void strike(VertexSet arriving) {
    ImpactRow row;
    row.before = motion_.velocity();
    const BodyMotion::Strike strike = motion_.strike(arriving, law_);
    row.vertices = strike.vertices;
    row.impact = strike.impact;
    const StruckState struck = struck_state(motion_, law_, row);
    check_branches(row, struck.flat);
    const ImpactDerivatives d = impact_derivatives(struck, row.impact.mode);
    const LawDerivatives by_law = law_derivatives(struck, row.impact.mode);
    const MotionGradients moves(struck.body, struck.place, row.impact.after, motion_.local_departure().gravity);
    GradientRow gradient{.vertices = row.vertices, .of = {}, .error = {}};
    for (std::size_t i = 0; i < drop_parameters; ++i) {
      const auto parameter = static_cast<DropParameter>(i);
      const LawColumn* const column = parameter == DropParameter::restitution ? &by_law.restitution
                                      : parameter == DropParameter::friction  ? &by_law.friction
                                                                              : nullptr;
      emit({d, moves, column}, carried_[i], gradient.of[i], gradient.error[i]);
    }
    trace_.rows.push_back(gradient);
    trace_.modes.push_back(row.impact.mode);
    // A contact that stays for e = 0 bounces on for any other e.
    if (law_.restitution == 0) refuse(DropParameter::restitution, refusals::contact_stays);
  }

  /// An impact's derivatives; `by_law` of a parameter of the law.
  struct Struck {
    const ImpactDerivatives& d;
    const MotionGradients& moves;
    const LawColumn* by_law;
  };

  static void emit(const Struck& struck, Carried& carried, ImpactGradient& of, ImpactGradient& rounding) {
    const auto& [d, moves, by_law] = struck;
    const auto set = [&](double ImpactGradient::*number, const Taken& taken) {
      of.*number = taken.value;
      rounding.*number = taken.rounding;
    };
    const double part = by_law ? by_law->part : 0;
    set(&ImpactGradient::time, Taken(unit(at_time), carried));
    set(&ImpactGradient::inclination, Taken(unit(at_angle), carried));
    set(&ImpactGradient::normal_impulse, Taken(d.normal, carried, by_law ? by_law->normal : 0, part));
    set(&ImpactGradient::tangential_impulse, Taken(d.tangential, carried, by_law ? by_law->tangential : 0, part));
    carried.advance(d.state);
    if (by_law) carried.add(*by_law);
    set(&ImpactGradient::normal, Taken(moves.normal, carried));
    set(&ImpactGradient::tangential, Taken(moves.tangential, carried));
    set(&ImpactGradient::angular, Taken(unit(at_turn), carried));
  }

  ImpactLaw law_;
  BodyMotion motion_;
  std::array<Carried, drop_parameters> carried_{};
  Trace trace_;
};

constexpr std::array numbers{&ImpactGradient::time,
                             &ImpactGradient::inclination,
                             &ImpactGradient::normal,
                             &ImpactGradient::tangential,
                             &ImpactGradient::angular,
                             &ImpactGradient::normal_impulse,
                             &ImpactGradient::tangential_impulse};

/// The drop with one of its numbers moved.
std::vector<Drop> neighbours(const Drop& drop) {
  std::vector<Drop> all(4, drop);
  const bool is_level = drop.inclination.radians == 0 || drop.inclination.sine == 1;
  if (!is_level) all[0].inclination = Angle::from_radians(drop.inclination.radians * (1 + shift));
  all[1].velocity.normal *= 1 + shift;
  all[2].velocity.tangential *= 1 + shift;
  all[3].velocity.angular *= 1 + shift;
  return all;
}

/// Adds to the errors what an error of the state does, and refuses what the neighbour has not in common with the drop.
void compare(const Trace& other, SequenceGradient& gradient, const std::vector<ImpactMode>& modes) {
  std::size_t common = 0;
  while (common < gradient.rows.size() && common < other.rows.size() && modes[common] == other.modes[common] &&
         gradient.rows[common].vertices == other.rows[common].vertices) {
    ++common;
  }
  for (std::size_t n = 0; n < common; ++n) {
    for (std::size_t i = 0; i < drop_parameters; ++i) {
      for (const auto number : numbers) {
        const double change = other.rows[n].of[i].*number - gradient.rows[n].of[i].*number;
        gradient.rows[n].error[i].*number += state_error * epsilon / shift * std::fabs(change);
      }
    }
  }
  for (GradientRefusal& one : gradient.refused) {
    if (one.from > common) one = {common, refusals::other_neighbour};
  }
}

}  // namespace

SequenceGradient sequence_gradient(const Drop& drop, int impacts) {
  SequenceGradient gradient;
  gradient.sequence = impact_sequence(drop, {.impacts = impacts});
  const auto& rows = gradient.sequence.rows;
  const auto lost = std::find_if(rows.begin(), rows.end(), [](const ImpactRow& row) { return !row.error.predictable; });
  const auto count = static_cast<std::size_t>(lost - rows.begin());
  Trace trace = Tracer(drop).run(count);
  gradient.rows = std::move(trace.rows);
  gradient.refused = trace.refused;
  for (const Drop& one : neighbours(drop)) {
    try {
      compare(Tracer(one).run(count), gradient, trace.modes);
    } catch (const NumericalError&) {
      compare({}, gradient, trace.modes);
    }
  }
  return gradient;
}

}  // namespace clatter::analytic
