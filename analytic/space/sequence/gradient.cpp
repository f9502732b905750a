// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/sequence/gradient.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "analytic/base/errors.hpp"
#include "analytic/base/limits.hpp"
#include "analytic/space/flight/flight_derivatives.hpp"
#include "analytic/space/sequence/impact_rows.hpp"
#include "analytic/space/sequence/sequence.hpp"

namespace clatter::analytic::space {

namespace {

using detail::epsilon;
using detail::infinite;

using Struck = Eigen::Matrix<double, 9, 1>;      ///< P, V′, ω′
using Deviation = Eigen::Matrix<double, 10, 1>;  ///< t, θ, V, ω
/// The state_parts of a deviation: where each begins, and how long it is.
constexpr std::array<std::array<int, 2>, 4> state_parts{{{0, 1}, {1, 3}, {4, 3}, {7, 3}}};

constexpr double neighbour_step = 0x1p-24;  ///< of a neighbour's attitude [rad] or velocities, relative
constexpr double state_error = 16;     ///< of the state beside that of a number of the drop, in units of the last place
constexpr double block_error = 1e-10;  ///< of a Jacobian's block, relative, as its headers promise
constexpr double impulse_rounding = 1e-13;  ///< of an impulse, relative, as impact.hpp promises
const char* const other_path = "another path of slip begins next to the drop";

/// A derivative of the state, and bounds on the errors of its state_parts.
struct Carried {
  Deviation value = Deviation::Zero();
  std::array<double, 4> error{};

  /// Bound on the error of the part `rows` × the value.
  [[nodiscard]] double error_of(const auto& rows) const {
    double sum = 0;
    for (std::size_t k = 0; k < state_parts.size(); ++k) {
      const auto [from, size] = state_parts[k];
      const double block = rows.middleCols(from, size).norm();
      if (block > 0) sum += block * (error[k] + block_error * value.segment(from, size).norm());
    }
    return sum;
  }
  void advance(const Eigen::Matrix<double, 10, 10>& jacobian) {
    std::array<double, 4> after{};
    for (std::size_t i = 0; i < state_parts.size(); ++i)
      after[i] = error_of(jacobian.middleRows(state_parts[i][0], state_parts[i][1]));
    value = (jacobian * value).eval();
    error = after;
  }
};

/// A derivative along a line, and bounds on the errors of P, V′ and ω′; nothing where there is none.
struct Slope {
  Struck value = Struck::Zero();
  std::array<double, 3> error{};
};

std::array<double, 3> sizes(const Struck& s) {
  return {s.head<3>().norm(), s.segment<3>(3).norm(), s.tail<3>().norm()};
}

/// Differences of an impact at steps that halve, extrapolated.
class Differences {
 public:
  /// The impact as a function of the step; nothing where it is not computed or takes another path.
  using Along = std::function<std::optional<Struck>(double)>;

  /// @param side  0: central; 1 or −1: the impact is known on this side alone
  Differences(Along along, const Struck& here, int side, const std::array<double, 3>& rounding)
      : along_(std::move(along)), here_(here), side_(side), rounding_(rounding) {}

  [[nodiscard]] std::optional<Slope> limit(double step) {
    for (int i = 0; i < 20 && table_.size() < 7; ++i, step /= 2) {
      const std::optional<Struck> difference = at(step);
      if (difference) add(*difference, step);
      else table_.clear();
    }
    if (table_.size() < 2) return {};
    return best_;
  }

 private:
  std::optional<Struck> at(double step) const {
    const auto ahead = along_(side_ == 0 ? step : side_ * step);
    if (!ahead) return {};
    if (side_ != 0) return Struck((*ahead - here_) / (side_ * step));
    const auto behind = along_(-step);
    if (!behind) return {};
    return Struck((*ahead - *behind) / (2 * step));
  }

  void add(const Struck& difference, double step) {
    if (table_.empty()) best_.error.fill(infinite);
    std::vector<Struck> row{difference};
    const double base = side_ == 0 ? 4 : 2;  // each halving takes this from the error's leading term
    double power = base;
    for (const Struck& above : table_) {
      row.push_back(row.back() + (row.back() - above) / (power - 1));
      power *= base;
      const auto change = sizes(row.back() - above), beside = sizes(row.back() - row[row.size() - 2]);
      for (std::size_t k = 0; k < 3; ++k) {
        const double error = std::fmax(change[k], beside[k]) + rounding_[k] / step;
        if (!(error < best_.error[k])) continue;
        best_.error[k] = error;
        best_.value.segment<3>(3 * static_cast<int>(k)) = row.back().segment<3>(3 * static_cast<int>(k));
      }
    }
    table_ = std::move(row);
  }

  Along along_;
  Struck here_;
  int side_;
  std::array<double, 3> rounding_;
  std::vector<Struck> table_;  ///< the last row
  Slope best_;
};

Struck struck_of(const Impact& impact) {
  Struck all;
  all << impact.impulse, impact.velocity_after, impact.angular_velocity_after;
  return all;
}

/// Slip along a line has neighbours whose direction turns.
PathKind without_turn(PathKind path) { return path == PathKind::turning_slip ? PathKind::slip : path; }

/// The derivatives of one drop's rows.
class Tracer {
 public:
  Tracer(const Drop& drop, const std::vector<ImpactRow>& rows)
      : drop_(drop), body_(drop.body), principal_(drop.body.inertia), reach_(drop.body.reach()), rows_(rows) {
    for (const SpaceParameter p : {SpaceParameter::angle, SpaceParameter::tilt})
      of(p).value.segment<3>(1) = turn_of(drop, p);
    of(SpaceParameter::speed).value[6] = -1;
    if (law().law == RestitutionLaw::viscoelastic)
      refuse(SpaceParameter::restitution, refusals::ground_gives_restitution);
  }

  void run(std::size_t count, SpaceGradient& gradient) {
    for (row_ = 0; row_ < count; ++row_) {
      if (row_ > 0) fly();
      SpaceGradientRow& made = gradient.rows.emplace_back();
      made.corners = now().corners;
      strike(made);
      if (law().restitution == 0) refuse(SpaceParameter::restitution, refusals::contact_stays);
    }
    for (GradientRefusal& one : refused_) {
      if (one.reason.empty()) one.from = count;
    }
    gradient.refused = refused_;
  }

 private:
  static constexpr std::size_t index(SpaceParameter p) { return static_cast<std::size_t>(p); }
  Carried& of(SpaceParameter p) { return carried_[index(p)]; }
  [[nodiscard]] const ImpactRow& now() const { return rows_[row_]; }
  [[nodiscard]] const ImpactLaw& law() const { return drop_.law; }
  [[nodiscard]] bool is_refused(std::size_t i) const { return !refused_[i].reason.empty(); }

  void refuse(SpaceParameter p, const char* reason) {
    if (!is_refused(index(p))) refused_[index(p)] = {row_, reason};
  }

  void fly() {
    const ImpactRow& last = rows_[row_ - 1];
    const FirstContact& contact = now().flight;
    if (!(contact.time > 0)) return;
    const FreeFlight flight(principal_, state_after(last), drop_.gravity, drop_.gravity_along);
    const State arrived = flight.at(contact.time);
    const Vector3 &from = last.corners.front().place, &to = now().corners.front().place;
    const auto j = arrival_derivatives(body_, flight, contact, arrived, from, to);
    for (Carried& one : carried_) one.advance(j.of_state);
  }

  void strike(SpaceGradientRow& made) {
    const bool is_point = now().corners.size() == 1 && now().corners.front().radius == 0;
    StrikeDerivatives closed;
    closed.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (is_point) {
      ImpactRow again = now();
      strike_row(body_, drop_.law, again, &closed);
    }
    for (std::size_t i = 0; i < space_parameters; ++i) {
      const auto p = static_cast<SpaceParameter>(i);
      Carried& carried = carried_[i];
      if (!is_point && carried.value.segment<2>(1).norm() > 0)
        refuse(p, "points that land together land one by one after any other turn");
      if (is_refused(i)) continue;
      std::optional<Slope> change = closed.allFinite() ? closed_slope(closed, carried) : slope_along(p, carried);
      const std::optional<Slope> by_law = change ? law_slope(p) : std::nullopt;
      if (!by_law) {
        refuse(p, other_path);
        continue;
      }
      change->value += by_law->value;
      for (std::size_t k = 0; k < 3; ++k) change->error[k] += by_law->error[k];
      emit(*change, carried, made.of[i], made.error[i]);
    }
  }

  static Slope closed_slope(const StrikeDerivatives& closed, const Carried& carried) {
    Slope slope;
    Eigen::Matrix<double, 9, 10> wide = Eigen::Matrix<double, 9, 10>::Zero();
    wide.rightCols<9>() = closed;
    slope.value = wide * carried.value;
    for (int k = 0; k < 3; ++k) slope.error[k] = carried.error_of(wide.middleRows<3>(3 * k));
    return slope;
  }

  /// Rounding of P, V′ and ω′.
  [[nodiscard]] std::array<double, 3> rounding() const {
    const ImpactRow& row = now();
    const double speed = row.before.velocity.norm() + row.before.angular_velocity.norm() * reach_;
    const double impulse = impulse_rounding * row.impact.impulse.norm() + 8 * epsilon * body_.mass * speed;
    return {impulse, impulse / body_.mass, impulse * reach_ / static_cast<double>(principal_.moments[0])};
  }

  /// The impact of the row's corners by a law from a state.
  [[nodiscard]] std::optional<Struck> struck(const ImpactLaw& law, const State& before) const {
    try {
      const Impact impact = struck_again(body_, law, now(), before);
      const PathKind path = now().impact.path;
      if (without_turn(impact.path) != without_turn(path) && path != PathKind::frictionless) return {};
      return struck_of(impact);
    } catch (const std::exception&) {  // a neighbour jams, or cannot be computed
      return {};
    }
  }

  /// Along the carried derivative of the state.
  [[nodiscard]] std::optional<Slope> slope_along(SpaceParameter p, const Carried& carried) {
    const Deviation& d = carried.value;
    const State& before = now().before;
    const double speed = before.velocity.norm() + before.angular_velocity.norm() * reach_;
    const double length = d.segment<3>(1).norm() + (d.segment<3>(4).norm() + reach_ * d.tail<3>().norm()) / speed;
    if (!(length > 0)) return Slope{};
    if (slips_from_rest(d)) {
      refuse(p, refusals::slip_from_rest);
      return {};
    }
    const auto along = [&](double step) {
      State s = before;
      s.attitude = (turn_by(step / length * d.segment<3>(1)) * s.attitude).normalized();
      s.velocity += step / length * d.segment<3>(4);
      s.angular_velocity += step / length * d.tail<3>();
      return struck(drop_.law, s);
    };
    auto slope = Differences(along, struck_of(now().impact), 0, rounding()).limit(0x1p-6);
    if (!slope) return {};
    slope->value *= length;
    // What errors of the derivative do is not known better than its own slope.
    const double share = (carried.error[1] + (carried.error[2] + reach_ * carried.error[3]) / speed) / length;
    const auto size = sizes(slope->value);
    for (std::size_t k = 0; k < 3; ++k) slope->error[k] = length * slope->error[k] + 10 * share * size[k];
    return slope;
  }

  [[nodiscard]] bool slips_from_rest(const Deviation& d) const {
    const Impact& impact = now().impact;
    const double scale = now().before.velocity.norm() + now().before.angular_velocity.norm() * reach_;
    if (impact.path == PathKind::frictionless || impact.path == PathKind::stick || now().group) return false;
    if (impact.contact_before.head<2>().norm() > 16 * epsilon * scale) return false;
    const Vector3 arm = now().before.attitude * now().corners.front().place;
    const Vector3 moved = d.segment<3>(4) + Vector3(d.tail<3>()).cross(arm) +
                          now().before.angular_velocity.cross(Vector3(d.segment<3>(1)).cross(arm));
    return moved.head<2>().norm() > 1e-12 * d.tail<9>().norm() * scale;
  }

  /// ∂(impact)/∂p; zero of a parameter that is none of the law.
  [[nodiscard]] std::optional<Slope> law_slope(SpaceParameter p) const {
    if (p != SpaceParameter::restitution && p != SpaceParameter::friction) return Slope{};
    const bool is_of_e = p == SpaceParameter::restitution;
    const bool is_without = law().friction == FrictionKind::none;
    const double value = is_of_e ? law().restitution : is_without ? 0 : law().friction_value;
    const double step = is_of_e || value == 0 ? 0x1p-5 : 0x1p-5 * std::fabs(value);
    const bool is_least = value == 0 && (is_of_e || law().friction != FrictionKind::impulse_ratio);
    const int side = is_least ? 1 : is_of_e && value + step > 1 ? -1 : 0;
    const auto along = [&](double by) {
      ImpactLaw other = drop_.law;
      (is_of_e ? other.restitution : other.friction_value) = value + by;
      if (!is_of_e && is_without) other.friction = FrictionKind::coulomb;
      return struck(other, now().before);
    };
    return Differences(along, struck_of(now().impact), side, rounding()).limit(step);
  }

  static void emit(const Slope& change, Carried& carried, SpaceImpactGradient& of, SpaceGradientError& error) {
    of = {.time = carried.value[0],
          .attitude = carried.value.segment<3>(1),
          .velocity = change.value.segment<3>(3),
          .angular_velocity = change.value.tail<3>(),
          .impulse = change.value.head<3>()};
    error = {.time = carried.error[0],
             .attitude = carried.error[1],
             .velocity = change.error[1],
             .angular_velocity = change.error[2],
             .impulse = change.error[0]};
    carried.value.tail<6>() = change.value.tail<6>();
    carried.error[2] = change.error[1];
    carried.error[3] = change.error[2];
  }

  const Drop& drop_;
  const Body& body_;
  PrincipalAxes principal_;
  double reach_;
  const std::vector<ImpactRow>& rows_;
  std::size_t row_ = 0;
  std::array<Carried, space_parameters> carried_;
  std::array<GradientRefusal, space_parameters> refused_;
};

SpaceGradient traced(const Drop& drop, int impacts) {
  SpaceGradient gradient;
  gradient.sequence = impact_sequence(drop, {.impacts = impacts});
  const auto& rows = gradient.sequence.rows;
  const auto lost = std::find_if(rows.begin(), rows.end(), [](const ImpactRow& row) { return !row.error.predictable; });
  Tracer(drop, rows).run(static_cast<std::size_t>(lost - rows.begin()), gradient);
  return gradient;
}

/// The drop with one of its turns or velocities moved, and whether nothing of the motion out of its plane matters then.
struct Neighbour {
  Drop drop;
  bool leaves_plane = false;
};

/// Whether the rows' motion stays in the plane y = 0, to rounding.
bool is_planar(const std::vector<ImpactRow>& rows) {
  const auto is_in_plane = [](const ImpactRow& row) {
    const State after = state_after(row);
    const double along = std::fabs(after.velocity.y()) + std::fabs(row.impact.impulse.y());
    const double turning = std::hypot(after.angular_velocity.x(), after.angular_velocity.z());
    return along <= 1e-12 * (after.velocity.norm() + row.impact.impulse.norm()) &&
           turning <= 1e-12 * after.angular_velocity.norm();
  };
  return std::ranges::all_of(rows, is_in_plane);
}

std::vector<Neighbour> neighbours(const Drop& drop, const std::vector<ImpactRow>& rows) {
  std::vector<Neighbour> all(2, {.drop = drop});
  all[0].drop.velocity *= 1 + neighbour_step;
  all[1].drop.angular_velocity *= 1 + neighbour_step;
  if (!rows.empty() && rows.front().corners.size() > 1) return all;
  for (const SpaceParameter p : {SpaceParameter::angle, SpaceParameter::tilt}) {
    Neighbour one{.drop = drop, .leaves_plane = p == SpaceParameter::tilt && is_planar(rows)};
    one.drop.attitude = turn_by(neighbour_step * turn_of(drop, p)) * drop.attitude;
    all.push_back(std::move(one));
  }
  return all;
}

bool is_same_impact(const ImpactRow& a, const ImpactRow& b) {
  const auto same = [](const Corner& one, const Corner& other) { return one.index == other.index; };
  return without_turn(a.impact.path) == without_turn(b.impact.path) && std::ranges::equal(a.corners, b.corners, same);
}

/// Adds to the errors what an error of the state does, and refuses what the neighbour has not in common with the drop:
/// of a motion in its plane, one that leaves it has a say on the tilt alone.
void compare(const SpaceGradient& other, bool leaves_plane, SpaceGradient& gradient) {
  std::size_t common = 0;
  const std::size_t most = std::min(gradient.rows.size(), other.rows.size());
  while (common < most && is_same_impact(gradient.sequence.rows[common], other.sequence.rows[common])) ++common;
  constexpr double share = state_error * epsilon / neighbour_step;
  for (std::size_t n = 0; n < common; ++n) {
    for (std::size_t i = 0; i < space_parameters; ++i) {
      const SpaceImpactGradient &a = gradient.rows[n].of[i], &b = other.rows[n].of[i];
      SpaceGradientError& error = gradient.rows[n].error[i];
      error.time += share * std::fabs(b.time - a.time);
      error.attitude += share * (b.attitude - a.attitude).norm();
      error.velocity += share * (b.velocity - a.velocity).norm();
      error.angular_velocity += share * (b.angular_velocity - a.angular_velocity).norm();
      error.impulse += share * (b.impulse - a.impulse).norm();
    }
  }
  for (std::size_t i = 0; i < space_parameters; ++i) {
    if (leaves_plane && i != static_cast<std::size_t>(SpaceParameter::tilt)) continue;
    GradientRefusal& one = gradient.refused[i];
    if (one.from > common) one = {common, refusals::other_neighbour};
  }
}

}  // namespace

Vector3 turn_of(const Drop& drop, SpaceParameter parameter) {
  if (parameter == SpaceParameter::angle) return -Vector3::UnitY();
  if (parameter == SpaceParameter::tilt) return drop.attitude.normalized() * Vector3::UnitX();
  return Vector3::Zero();
}

SpaceGradient sequence_gradient(const Drop& drop, int impacts) {
  SpaceGradient gradient = traced(drop, impacts);
  for (const auto& [other, leaves_plane] : neighbours(drop, gradient.sequence.rows)) {
    try {
      compare(traced(other, impacts), leaves_plane, gradient);
    } catch (const NumericalError&) {
      compare({}, leaves_plane, gradient);
    }
  }
  return gradient;
}

}  // namespace clatter::analytic::space
