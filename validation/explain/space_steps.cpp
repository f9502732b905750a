// SPDX-License-Identifier: GPL-3.0-or-later
// How an impact in space came about: flight, the corner or corners, friction in impulse space, what the impulse does.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/base/angle.hpp"
#include "analytic/law/coulomb_path.hpp"
#include "analytic/space/flight/first_contact.hpp"
#include "analytic/space/flight/free_flight.hpp"
#include "analytic/space/impulse/slip_field.hpp"
#include "validation/explain/steps.hpp"
#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using space::ImpactRow;
using space::Vector3;

constexpr double degrees = analytic::degrees_per_radian;

const char* path_words(space::PathKind path) {
  switch (path) {
    case space::PathKind::frictionless: return "no tangential impulse";
    case space::PathKind::slip: return "slip keeps one direction throughout";
    case space::PathKind::turning_slip: return "slip turns throughout and does not stop";
    case space::PathKind::stick: return "the corner sticks from the start";
    case space::PathKind::slip_stick: return "slip stops, and the corner then sticks";
    case space::PathKind::slip_reslip: return "slip stops, and goes on along the one outgoing direction";
  }
  return "";
}

/// Largest error of the row's numbers, relative to their sizes; infinite where it cannot be predicted.
double relative_error(const ImpactRow& row, double reach) {
  const space::RowErrors& error = row.error;
  if (!error.predictable) return std::numeric_limits<double>::infinity();
  const space::Impact& struck = row.impact;
  const double speed = std::max({row.before.velocity.norm(), struck.velocity_after.norm(), struck.approach_speed});
  const double rate =
      std::max({row.before.angular_velocity.norm(), struck.angular_velocity_after.norm(), speed / reach});
  const double time = row.flight.time;
  return std::max({error.attitude, error.approach_speed / speed, error.velocity_after / speed,
                   error.angular_velocity_after / rate, time > 0 ? error.start / time : 0,
                   struck.impulse.norm() > 0 ? error.impulse / struck.impulse.norm() : 0});
}

/// The steps of one impact.  Vectors are in world axes, x, y along the ground and z up, but for those called b, which
/// are in the body's.  After the impact they have a prime, after an earlier one its number.
class SpatialImpact {
 public:
  SpatialImpact(const Scene& scene, const space::Drop& drop, const space::Sequence& sequence, int n)
      : scene_(scene), drop_(drop), n_(n), row_(sequence.rows[static_cast<std::size_t>(n - 1)]),
        departure_(departure_of(drop, sequence, n)), struck_(row_.impact), reach_(drop.body.reach()),
        writer_(relative_error(row_, reach_)), given_(write_body(writer_, drop.body.mass, drop.gravity)),
        speed_(std::max({row_.before.velocity.norm(), struck_.velocity_after.norm(), struck_.approach_speed})) {}

  std::vector<Step> steps() {
    inertia_b_ = writer_.given({"I_b", drop_.body.inertia, "kg·m²"}, {"inertia about the centre of mass, body axes"});
    normal_ = writer_.given({"n", Vector3::UnitZ(), ""}, {"the ground's normal"});
    write_law(writer_, scene_, drop_.law, given_);
    if (departure_) flight();
    else writer_.open("The first touch", {fmt::format("The body touches the ground with {}.", arrived())});
    touch();
    if (row_.group) {
      group();
      tilts();
    } else {
      corner();
    }
    return writer_.take();
  }

 private:
  /// Names of corners by their indices.
  [[nodiscard]] std::string names(const std::vector<int>& corners) const {
    std::string all;
    for (const int index : corners) {
      const Vector3 place = space::touching_place(drop_.body, row_.before.attitude, index);
      all += (all.empty() ? "" : ", ") + corner_name(scene_, {index, place});
    }
    return (corners.size() == 1 ? "corner " : "corners ") + all;
  }
  [[nodiscard]] std::string arrived() const {
    std::vector<int> corners;
    for (const space::Corner& corner : row_.corners) corners.push_back(corner.index);
    return names(corners);
  }
  /// Where the flight to impact n begins: after the impact before, or at the release; nothing if there is none.
  struct Departure {
    space::State state;
    double velocity_error = 0;
  };
  static std::optional<Departure> departure_of(const space::Drop& drop, const space::Sequence& sequence, int n) {
    if (n > 1) {
      const space::ImpactRow& last = sequence.rows[static_cast<std::size_t>(n - 2)];
      return Departure{state_after(last), last.error.velocity_after};
    }
    if (drop.release_height) return Departure{given_state(drop)};
    return {};
  }
  [[nodiscard]] Symbol after_last(const std::string& symbol) const { return symbol + "_" + std::to_string(n_ - 1); }
  [[nodiscard]] bool falls() const { return drop_.gravity > 0; }
  [[nodiscard]] Expression up(const Expression& vector) const { return dot(vector, normal_); }

  void flight() {
    writer_.open(fmt::format("The flight to impact {}", n_),
                 {fmt::format("After {} the body flies freely: its centre of mass along a parabola, its attitude "
                              "by a rotation without torque.",
                              n_ > 1 ? fmt::format("impact {}", n_ - 1) : "the release")});
    const space::State& from = departure_->state;
    z0_ = writer_.found(number(after_last("z"), from.position.z(), "m"), {"height of the centre of mass at departure"});
    v0_ = writer_.found({after_last("V"), from.velocity, "m/s", departure_->velocity_error, speed_}, {"its velocity"});
    const Vector3 rate = from.attitude.conjugate() * from.angular_velocity;
    rate_b_ = writer_.found({"ω_b", rate, "rad/s"}, {"angular velocity at departure, in body axes"});
    rotation();
    earliest();
  }

  void rotation() {
    const space::FreeRotation free(space::PrincipalAxes(drop_.body.inertia), departure_->state.attitude,
                                   departure_->state.angular_velocity);
    const Vector3 rate = free.angular_velocity(0), momentum_now = drop_.body.inertia * rate;
    // A wobble that may be rounding leaves λ and k² no digits.
    const bool steady =
        free.is_steady() || momentum_now.cross(rate).norm() <= 1e-10 * momentum_now.norm() * rate.norm();
    writer_.open("Rotation without torque",
                 {steady ? "The body turns about a fixed axis, ω constant."
                         : "Energy and angular momentum are constant. In principal axes, numbered so that the angular "
                           "momentum circles axis 3, ω follows Jacobi's elliptic functions of modulus k, and repeats "
                           "after a period of four complete elliptic integrals K."});
    const Quantity momentum =
        writer_.computed("L_b", "kg·m²/s", inertia_b_ * rate_b_, {"angular momentum at departure, body axes"});
    const Quantity length = writer_.computed("L", "kg·m²/s", absolute(momentum));
    const Quantity energy = writer_.computed("E_r", "J", dot(rate_b_, momentum) / 2, {"energy of the rotation"});
    if (steady) return;
    const space::ThetaRotation& theta = *free.theta();
    const Vector3& moments = theta.moments();
    const double size = moments.maxCoeff();
    const Quantity i1 = writer_.given(number("I_1", moments[0], "kg·m²", 0, size), {"principal moments"});
    const Quantity i2 = writer_.given(number("I_2", moments[1], "kg·m²", 0, size), {});
    const Quantity i3 = writer_.given(number("I_3", moments[2], "kg·m²", 0, size), {});
    const Expression a = i1, b = i2, c = i3, twice = 2 * energy, square_l = square(length);
    const Expression below = absolute(b - c) * absolute(square_l - twice * a);
    const Quantity modulus = writer_.found(number("k²", theta.modulus_square(), "", 0, 1),
                                           absolute(a - b) * absolute(twice * c - square_l) / below, {"modulus"});
    const Quantity lambda = writer_.computed("λ", "rad/s", function("√", below / (a * b * c)));
    period_ = writer_.found(number("T_p", theta.period(), "s"), 4 * function("K", modulus) / lambda,
                            {"period of ω in the body"});
  }

  void earliest() {
    const space::FirstContact& flight = row_.flight;
    const Quantity t = number("t", 0, "s"), e{"e_z", Vector3::Zero(), ""}, place{"r_b", Vector3::Zero(), "m"},
                   h = number("h", 0, "m");
    writer_.open(
        "The earliest corner",
        {"The law below gives the height ", h, " of a corner at ", place,
         drop_.body.points() > static_cast<int>(drop_.body.vertices.size())
             ? " in the body (of a round part that of its lowest point then) after the time "
             : " in the body after the time ",
         t, ", where the rotation gives the vertical ", e,
         fmt::format(" in body axes. Certificate: the flight is cut into pieces, on each of which bounds on the height "
                     "and its second derivative hold; before the bracket no corner comes down, within it the height "
                     "of {} has one root.",
                     names(flight.together))});
    const Expression rising = z0_ + up(v0_) * t;
    writer_.law(h, (falls() ? rising - given_.gravity * square(t) / 2 : rising) + dot(e, place));
    if (flight.bracket_high < 1e300) {
      writer_.found(number("T_low", flight.bracket_low, "s"), {"left end of the certified bracket"});
      writer_.found(number("T_high", flight.bracket_high, "s"), {"its right end"});
    }
    time_ = writer_.found(
        number("T", flight.time, "s"),
        {fmt::format("the root, found numerically by {} evaluations of the rotation", flight.evaluations)});
    if (period_) writer_.computed("N", "", time_ / *period_, {"periods flown"});
    else writer_.computed("θ", "rad", absolute(rate_b_) * time_, {"angle turned"});
    const Expression line = z0_ + up(v0_) * time_;
    z_ = writer_.found(number("z", row_.before.position.z(), "m", 0, reach_),
                       falls() ? line - given_.gravity * square(time_) / 2 : line, {"height of the centre of mass"});
    next_corner();
    if (std::isfinite(flight.near_miss.clearance)) {
      writer_.found(number("h_miss", flight.near_miss.clearance, "m", flight.near_miss.margin),
                    {"near miss, the least height at a turning point before, of any corner"});
    }
  }

  /// The corner, not among those that arrive, that is lowest then.
  void next_corner() {
    double least = std::numeric_limits<double>::infinity();
    int next = 0;
    for (int point = 0; point < drop_.body.points(); ++point) {
      const auto is_it = [&](const space::Corner& corner) { return corner.index == point; };
      if (std::any_of(row_.corners.begin(), row_.corners.end(), is_it)) continue;
      const Vector3 place = space::touching_place(drop_.body, row_.before.attitude, point);
      const double height = row_.before.position.z() + (row_.before.attitude * place).z();
      if (height < least) least = height, next = point;
    }
    if (!std::isfinite(least)) return;
    writer_.found(number("h_next", least, "m", 0, reach_),
                  {fmt::format("height then of {}, the lowest of the others", names({next}))});
  }

  /// Attitude, velocities and inertia as the corner comes down.
  void touch() {
    const space::State& now = row_.before;
    if (departure_) writer_.open("At the touch", {"Attitude, velocities and inertia as the corner comes down."});
    const Eigen::Vector4d q(now.attitude.w(), now.attitude.x(), now.attitude.y(), now.attitude.z());
    writer_.found({"q", q, "", 0, 1}, {"Euler parameters of the attitude, body to world"});
    rotation_ = writer_.found({"R", now.attitude.toRotationMatrix(), "", 0, 1}, {"their rotation matrix"});
    inertia_ = writer_.computed("I", "kg·m²", rotation_ * inertia_b_ * power(rotation_, -1), {"inertia in world axes"});
    if (departure_) {
      velocity_ = writer_.found({"V", now.velocity, "m/s", 0, speed_},
                                falls() ? v0_ - given_.gravity * time_ * normal_ : Expression(v0_),
                                {"velocity of the centre of mass"});
      rate_ = writer_.found({"ω", now.angular_velocity, "rad/s"}, {"angular velocity, by the rotation without torque"});
      return;
    }
    velocity_ = writer_.found({"V", now.velocity, "m/s", 0, speed_}, {"velocity of the centre of mass"});
    rate_ = writer_.found({"ω", now.angular_velocity, "rad/s"}, {"angular velocity"});
  }

  /// r and v of a corner, with its number behind them where there are several.
  std::pair<Quantity, Quantity> contact(const space::Corner& corner, const std::string& number,
                                        const std::string& who) {
    const Quantity place =
        writer_.given({"r_b" + number, corner.place, "m"}, {who + " from the centre of mass, body axes"});
    const std::string index = number.empty() ? "" : "_" + number;
    const Quantity arm = writer_.computed("r" + index, "m", rotation_ * place, {"in world axes"}, reach_);
    const Quantity velocity =
        writer_.computed("v" + index, "m/s", velocity_ + cross(rate_, arm), {"velocity there, before"}, speed_);
    return {arm, velocity};
  }

  void heights(const Quantity& arm) {
    if (departure_) writer_.computed("h", "m", z_ + up(arm), {"height of the corner at the root"}, reach_);
    else
      z_ = writer_.found(number("z", row_.before.position.z(), "m", 0, reach_), -up(arm),
                         {"height of the centre of mass"});
  }

  void corner() {
    writer_.open(
        "The corner",
        {"An impulse P at the corner, at r from the centre of mass, changes the velocity there by W times P."});
    const auto [arm, velocity] = contact(row_.corners.front(), "", arrived());
    arm_ = arm;
    contact_ = velocity;
    heights(arm);
    if (given_.has_friction()) {
      w_ = writer_.computed("W", "1/kg", 1 / given_.mass - cross_matrix(arm) * power(inertia_, -1) * cross_matrix(arm));
      b_ = writer_.given({"b", w_.value.block(0, 2, 2, 1), "1/kg", w_.error, w_.size},
                         {"its mixed part, along the ground and normal"});
      c_ = writer_.given(number("c", w_.value(2, 2), "1/kg", w_.error), {"its normal part"});
    } else {
      const Expression lever = cross(arm, normal_);
      c_ = writer_.computed("c", "1/kg", 1 / given_.mass + dot(lever, power(inertia_, -1) * lever),
                            {"normal part of W"});
    }
    if (given_.friction) path();
    given_.moreau ? impulse_by_end() : impulse();
    velocities();
  }

  [[nodiscard]] Quantity speed(const Symbol& symbol, double value) const {
    return number(symbol, value, "m/s", 0, speed_);
  }

  /// The path of Keller and Routh.
  void path() {
    const Quantity dv{"dv", Vector3::Zero(), "m/s"}, dp = number("dp", 0, "N·s"), s{"s", Eigen::Vector2d::Zero(), ""};
    Words words{
        "While the corner slips in the direction ",
        s,
        ", the law below gives the change ",
        dv,
        " of its velocity with the normal impulse ",
        dp,
        fmt::format(". Slip keeps its direction along an invariant one, where it grows at the rate f while the normal "
                    "velocity grows at the rate h. Kind of path ({}): {}.",
                    mode_name(struck_.path), path_words(struck_.path))};
    if (struck_.is_path_ambiguous) words.emplace_back(" Slip comes so close to zero that rounding decides this kind.");
    writer_.open("Friction in impulse space", words);
    writer_.law(dv / dp, w_ * (normal_ - *given_.friction * s));
    const Quantity a =
        writer_.given({"A", w_.value.topLeftCorner(2, 2), "1/kg", w_.error, w_.size}, {"part of W along the ground"});
    const Quantity slip = writer_.given({"v_h", contact_.value.topRows(2), "m/s", contact_.error, speed_},
                                        {"part of v along the ground, the slip"});
    writer_.computed("σ", "m/s", absolute(slip), {"its size"}, speed_);
    if (slip.value.norm() > 0) writer_.computed("φ", "°", function("angle", slip), {"its direction"}, 180);
    const double mu = given_.friction->value(0, 0);
    const bool sticks = evaluated(absolute(power(a, -1) * b_))(0, 0) <= mu;
    writer_.computed("ρ", "", absolute(power(a, -1) * b_),
                     {sticks ? "at most μ: the corner can stick" : "beyond μ: the corner cannot stick"}, mu);
    directions(a);
    if (std::isfinite(struck_.slip_stop_impulse))
      writer_.found(number("p_stop", struck_.slip_stop_impulse, "N·s"),
                    {"normal impulse where slip stops, on the path"});
    writer_.found(speed("σ_least", struck_.least_slip), {"smallest slip on the path"});
  }

  void directions(const Quantity& a) {
    const space::InvariantDirections all = space::invariant_directions(w_.value, given_.friction->value(0, 0));
    const Expression mu = *given_.friction;
    for (int i = 0; i < all.count; ++i) {
      const space::InvariantDirection& one = all.list[static_cast<std::size_t>(i)];
      const std::string index = "_" + std::to_string(i + 1);
      const Quantity phi =
          writer_.found(number("φ" + index, std::atan2(one.direction.y(), one.direction.x()) * degrees, "°", 0, 180),
                        {fmt::format("invariant direction, {}, {}", one.attracts ? "stable" : "unstable",
                                     one.slip_rate > 0 ? "outgoing" : "incoming")});
      const Quantity s = writer_.computed("s" + index, "", column(function("cos", phi), function("sin", phi)));
      writer_.found(number("f" + index, one.slip_rate, "1/kg", 0, w_.value.trace()), dot(s, b_ - mu * a * s));
      writer_.found(number("h" + index, one.normal_rate, "1/kg", 0, w_.value.trace()), c_ - mu * dot(b_, s));
    }
  }

  /// e at the corner's speed, where slip of one direction lets it be known; then the impulse that ends the impact.
  void impulse() {
    const bool is_straight =
        !given_.friction || struck_.path == space::PathKind::slip || struck_.path == space::PathKind::stick;
    const Quantity approach = writer_.computed("v_z", "m/s", up(contact_), {"normal velocity of the corner, before"});
    std::optional<Quantity> e = given_.restitution;
    if (!e && is_straight)
      e = write_restitution(writer_, given_, approach, analytic::restitution_at(drop_.law, -approach.value(0, 0)));
    writer_.open("The impulse", {words_of(drop_.law.law).ends});
    const Quantity z = number("P_z", struck_.impulse.z(), "N·s", row_.error.impulse);
    const Quantity p = {"P", struck_.impulse, "N·s", row_.error.impulse};
    if (given_.friction) {
      const Quantity pc = writer_.found(number("p_c", struck_.compression_impulse, "N·s"),
                                        {"normal impulse where compression ends, on the path"});
      const bool is_poisson = drop_.law.law == analytic::RestitutionLaw::poisson;
      if (is_poisson) writer_.found(z, (1 + *e) * pc, {"normal impulse where the impact ends"});
      else writer_.found(z, {"normal impulse where the impact ends, on the path"});
      impulse_ = writer_.found(p, {"impulse, its tangential part the friction summed along the path"});
      return;
    }
    Expression rate = c_;
    if (given_.impulse_ratio) {
      const Quantity d =
          writer_.given({"d", drop_.law.ratio_direction, ""}, {"direction in which the impulse ratio acts"});
      rate = rate + *given_.impulse_ratio * dot(b_, d);
    }
    const Quantity end = writer_.found(z, -((1 + *e) * approach / rate), {"normal impulse"});
    if (given_.impulse_ratio) {
      const Vector3 d(drop_.law.ratio_direction.x(), drop_.law.ratio_direction.y(), 0);
      const Quantity along = writer_.given({"d_3", d, ""}, {"the same as a vector of three components"});
      impulse_ = writer_.found(p, end * (normal_ + *given_.impulse_ratio * along));
    } else {
      impulse_ = writer_.found(p, end * normal_);
    }
  }

  /// Moreau's: the impulse that holds the corner, or μ against the slip after it.
  void impulse_by_end() {
    const Quantity approach = writer_.computed("v_z", "m/s", up(contact_), {"normal velocity of the corner, before"});
    const Expression e = *given_.restitution;
    const bool sticks = struck_.path == space::PathKind::stick || struck_.path == space::PathKind::slip_stick;
    writer_.open("The impulse", {fmt::format("Newton's restitution, and Moreau's condition for the slip after the "
                                             "impact. Kind ({}): {}.",
                                             mode_name(struck_.path),
                                             sticks ? "the impulse that holds the corner lies in the cone of friction"
                                                    : "the corner slips, and friction acts against that slip")});
    const Quantity p = {"P", struck_.impulse, "N·s", row_.error.impulse};
    if (sticks) {
      impulse_ = writer_.found(p, -(power(w_, -1) * (contact_ + e * approach * normal_)));
      return;
    }
    const space::Vector2 slip = -struck_.impulse.head<2>().normalized();
    const Quantity s = writer_.given({"s", slip, ""}, {"direction of the slip after"}),
                   along = writer_.given({"s_3", Vector3(slip.x(), slip.y(), 0), ""},
                                         {"the same as a vector of three components"});
    const Expression mu = *given_.moreau;
    const Quantity z = writer_.found(number("P_z", struck_.impulse.z(), "N·s", row_.error.impulse),
                                     -((1 + e) * approach / (c_ - mu * dot(b_, s))), {"normal impulse"});
    impulse_ = writer_.found(p, z * (normal_ - mu * along));
  }

  void velocities() {
    writer_.open("What the impulse does", {});
    const Expression m = given_.mass;
    velocity_after_ = writer_.found({"V′", struck_.velocity_after, "m/s", row_.error.velocity_after, speed_},
                                    velocity_ + impulse_ / m, {"velocity of the centre of mass, after"});
    rate_after_ = writer_.found({"ω′", struck_.angular_velocity_after, "rad/s", row_.error.angular_velocity_after},
                                rate_ + power(inertia_, -1) * cross(arm_, impulse_), {"angular velocity, after"});
    const Quantity after = writer_.found({"v′", struck_.contact_after, "m/s", 0, speed_},
                                         velocity_after_ + cross(rate_after_, arm_), {"velocity of the corner, after"});
    if (given_.friction) {
      const Quantity slip = writer_.given({"v_h′", after.value.topRows(2), "m/s", after.error, speed_}, {"slip after"});
      writer_.computed("σ′", "m/s", absolute(slip), {"its size"}, speed_);
      if (struck_.contact_after.head<2>().norm() > 0)
        writer_.computed("φ′", "°", function("angle", slip), {"its direction"}, 180);
    }
    writer_.found(number("e_N", struck_.restitution(), "", 0, 1), -(up(after) / up(contact_)),
                  {"ratio of separation to approach speed"});
    energy(-(dot(impulse_, contact_ + after) / 2));
  }

  void energy(const Expression& loss) {
    const Expression m = given_.mass;
    const auto total = [&](const Quantity& v, const Quantity& w) {
      const Expression moving = m * dot(v, v) / 2 + dot(w, inertia_ * w) / 2;
      return falls() ? moving + m * given_.gravity * z_ : moving;
    };
    const double size = std::max(row_.energy_before, row_.energy_after);
    write_energy(writer_, {"Energy of the motion of the centre of mass, of turning and, with gravity, of height."},
                 {.before = total(velocity_, rate_),
                  .after = total(velocity_after_, rate_after_),
                  .loss = loss,
                  .before_value = number("E", row_.energy_before, "J", row_.error.energy_before),
                  .after_value = number("E′", row_.energy_after, "J", row_.error.energy_after),
                  .loss_value = number("ΔE", struck_.energy_loss, "J",
                                       row_.error.energy_before + row_.error.energy_after, size)});
  }

  [[nodiscard]] std::string order_words(const space::GroupImpact& group) const {
    std::string words;
    constexpr std::size_t most = 8;
    for (std::size_t i = 0; i < std::min(group.order.size(), most); ++i)
      words += (i > 0 ? ", then " : "") + names(group.order[i]);
    return group.order.size() > most ? fmt::format("{}, …, {} strikes in all", words, group.order.size()) : words;
  }

  /// How the corners of a group strike.
  [[nodiscard]] std::string rebound_words(const space::GroupImpact& group, bool is_rim) const {
    if (!group.is_whole) {
      return fmt::format(
          "Pushes alone cannot make the body rebound as a whole; they strike one after the other, the fastest first: "
          "{}.",
          order_words(group));
    }
    const bool is_face = is_rim || group.order.front().size() > 2;
    return std::string("Pushes alone can make the body rebound as a whole, each point at e times its approach.") +
           (given_.friction
                ? fmt::format(" Each point of the {} is rubbed against its slip, by μ times the pressure there.",
                              is_face ? "face" : "edge")
                : "");
  }

  /// Several corners at once, or a level rim.
  void group() {
    const space::GroupImpact& group = *row_.group;
    const bool is_rim = row_.corners.front().radius > 0;
    writer_.open("Corners at once", {fmt::format("At once: {}{}. {}", is_rim ? "all points of the rim of " : "",
                                                 arrived(), rebound_words(group, is_rim))});
    std::optional<Quantity> first;
    int count = 0;
    for (const space::Corner& corner : row_.corners) {
      const std::string index = std::to_string(++count);
      const auto [arm, velocity] =
          contact(corner, index, (is_rim ? "the centre of the rim of " : "") + names({corner.index}));
      writer_.computed("u_" + index, "m/s", -up(velocity), {"its speed of approach"}, struck_.approach_speed);
      if (!first) first = arm;
    }
    heights(*first);
    velocity_after_ = writer_.found({"V′", group.velocity_after, "m/s", row_.error.velocity_after, speed_},
                                    {"velocity of the centre of mass, after"});
    rate_after_ = writer_.found({"ω′", group.angular_velocity_after, "rad/s", row_.error.angular_velocity_after},
                                {"angular velocity, after"});
    impulse_ = writer_.found({"P", group.impulse, "N·s", row_.error.impulse},
                             given_.mass * (velocity_after_ - velocity_), {"impulse of all"});
    const Quantity moment = writer_.found({"M", group.moment, "N·m·s", 0, group.impulse.norm() * reach_},
                                          inertia_ * (rate_after_ - rate_), {"their moment about the centre of mass"});
    if (group.impulse.z() > 0) resultant(moment);
    energy(-((dot(impulse_, velocity_ + velocity_after_) + dot(moment, rate_ + rate_after_)) / 2));
  }

  /// Where one impulse would have the same effect: x and y on the ground, from P × and M about the centre of mass.
  void resultant(const Quantity& moment) {
    const auto part = [&](const char* symbol, const Quantity& vector, int axis, const char* unit) {
      return writer_.given(number(symbol, vector.value(axis), unit, vector.error, vector.size), {});
    };
    const Quantity px = part("P_x", impulse_, 0, "N·s"), py = part("P_y", impulse_, 1, "N·s"),
                   pz = part("P_z", impulse_, 2, "N·s");
    const Quantity mx = part("M_x", moment, 0, "N·m·s"), my = part("M_y", moment, 1, "N·m·s");
    writer_.computed("x", "m", -((my + z_ * px) / pz), {"place of the resultant from the centre of mass"}, reach_);
    writer_.computed("y", "m", (mx - z_ * py) / pz, {}, reach_);
  }

  /// What small tilts would make of corners at once.
  void tilts() {
    const space::OutcomeSet set = tilted_outcomes(drop_.body, row_.before, row_.corners, drop_.law);
    const std::size_t count = set.outcomes.size();
    constexpr std::size_t most = 4;
    std::string outcomes = set.varies   ? "another outcome; those of eight follow"
                           : count == 1 ? "the same outcome"
                                        : fmt::format("one of {} outcomes", count);
    if (!set.varies && count > most)
      outcomes += fmt::format("; the {} commonest follow, JSON of sequence has all", most);
    if (!set.is_complete())
      outcomes += fmt::format("; {} % of the directions are not followed", significant(100 * set.open_share, 2));
    writer_.open("Small tilts",
                 {fmt::format("However small, a tilt makes the corners strike in some order. Each direction gives {}.",
                              outcomes)});
    writer_.found(number("ΔV", set.velocity_spread, "m/s", 0, speed_),
                  {"largest distance of two, that above included"});
    writer_.found(number("Δω", set.angular_velocity_spread, "rad/s", 0, speed_ / reach_),
                  {"the same of angular velocities"});
    const std::size_t step = set.varies ? std::max<std::size_t>(count / 8, 1) : 1;
    for (std::size_t i = 0; i < (set.varies ? count : std::min(count, most)); i += step) {
      const space::TiltedOutcome& outcome = set.outcomes[i];
      const std::string index = std::to_string(i + 1);
      writer_.open(fmt::format("Outcome {} of {}", index, count),
                   {fmt::format("{} % of the directions: the body is raised on the side of {}° from x, say: {}.",
                                significant(100 * outcome.share, 2), significant(outcome.tilt_direction * degrees, 4),
                                order_words(outcome.impact))});
      writer_.found({"V_" + index + "′", outcome.impact.velocity_after, "m/s", 0, speed_},
                    {"velocity of the centre of mass, after"});
      writer_.found({"ω_" + index + "′", outcome.impact.angular_velocity_after, "rad/s", 0, speed_ / reach_},
                    {"angular velocity, after"});
    }
  }

  const Scene& scene_;
  const space::Drop& drop_;
  int n_;
  const ImpactRow& row_;
  std::optional<Departure> departure_;
  const space::Impact& struck_;
  double reach_;
  StepWriter writer_;
  Given given_;
  double speed_;
  std::optional<Quantity> period_;
  Quantity normal_{"n", {}}, inertia_b_ = normal_, z0_ = normal_, v0_ = normal_, rate_b_ = normal_, time_ = normal_,
                             z_ = normal_, rotation_ = normal_, inertia_ = normal_, velocity_ = normal_,
                             rate_ = normal_, arm_ = normal_, contact_ = normal_, w_ = normal_, b_ = normal_,
                             c_ = normal_, impulse_ = normal_, velocity_after_ = normal_, rate_after_ = normal_;
};

}  // namespace

std::vector<Step> impact_steps(const Scene& scene, const space::Drop& drop, const space::Sequence& sequence, int n) {
  return SpatialImpact(scene, drop, sequence, n).steps();
}

}  // namespace clatter::validation
