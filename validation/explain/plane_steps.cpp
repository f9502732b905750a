// SPDX-License-Identifier: GPL-3.0-or-later
// How an impact in the plane came about: Eqs. 8 to 12 of Shan et al. (2005) with their numbers.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "analytic/base/angle.hpp"
#include "validation/explain/steps.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

using analytic::ImpactMode;
using analytic::ImpactRow;

constexpr double degrees = analytic::degrees_per_radian;

/// The steps of one impact.  Velocities before it are v_n, v_t, ω and after it V_n, V_t, Ω, as in the paper; those
/// after an earlier impact k have the index k.
class PlanarImpact {
 public:
  PlanarImpact(const Scene& scene, const analytic::Drop& drop, const analytic::Sequence& sequence, int n)
      : scene_(scene), drop_(drop), n_(n), row_(sequence.rows[static_cast<std::size_t>(n - 1)]),
        last_(n > 1 ? &sequence.rows[static_cast<std::size_t>(n - 2)] : nullptr), writer_(row_.error.relative),
        given_(write_body(writer_, drop.body.mass, drop.gravity)), reach_(drop.body.reach()),
        speed_(
            std::max({row_.impact.approach_speed, std::fabs(row_.before.normal), std::fabs(row_.before.tangential)})) {}

  std::vector<Step> steps() {
    body();
    if (last_) flight();
    else first_touch();
    if (std::popcount(row_.vertices) > 1) flat_landing();
    else point_impact();
    return writer_.take();
  }

 private:
  [[nodiscard]] static std::string ends(analytic::VertexSet vertices) {
    const bool several = std::popcount(vertices) > 1;
    return (several ? "vertices " : "end ") + analytic::PlanarBody::vertex_set_name(vertices);
  }
  /// The contact angle of impact k, as in the paper: θ, β, γ, and after these θ_4.
  [[nodiscard]] static Symbol contact_angle_name(int k) {
    const char* const paper[]{"θ", "β", "γ"};
    return k <= 3 ? Symbol(paper[k - 1]) : "θ_" + std::to_string(k);
  }
  /// "V_n" as "V_n1" after impact 1.
  [[nodiscard]] Symbol after_last(const std::string& symbol) const {
    return symbol + (symbol.find('_') == std::string::npos ? "_" : "") + std::to_string(n_ - 1);
  }
  void body() {
    const double k2 = drop_.body.gyration_square;
    if (drop_.body.uniform_thin_rod) {
      length_ = writer_.given(number("L", scene_.body.length, "m"), {"length of the rod"});
      k2_ = writer_.found(number("k²", k2, "m²"), square(*length_) / 12, {"moment of inertia over mass, I/m"});
    } else {
      k2_ = writer_.given(number("k²", k2, "m²"), {"moment of inertia over mass, I/m"});
    }
    write_law(writer_, scene_, drop_.law, given_);
  }

  void first_touch() {
    writer_.open("The first touch",
                 {fmt::format("{} {} the ground.", "With " + ends(row_.vertices), "the body touches")});
    if (drop_.fall)
      writer_.found(number("T", drop_.fall->time, "s"),
                    {"time of the free flight since the release, the first root of the vertices' heights"});
    alpha_ = writer_.given(number("α", drop_.inclination.degrees, "°"), {"inclination, positive with end a low"});
    contact_point();
    vn_ = number("v_n", row_.before.normal, "m/s");
    write_fall(writer_, scene_, given_, z_, vn_);
    vt_ = writer_.given(number("v_t", row_.before.tangential, "m/s"), {"its velocity along the ground"});
    w_ = writer_.given(number("ω", row_.before.angular, "rad/s"), {"angular velocity, clockwise"});
  }

  void flight() {
    const analytic::Departure& d = row_.departure;
    const analytic::RowErrors& e = last_->error;
    writer_.open(fmt::format("The flight to impact {}", n_),
                 {fmt::format("After impact {} the body flies freely: its centre of mass on a parabola, turning at a "
                              "constant rate. The earliest to arrive is {}.",
                              n_ - 1, ends(row_.flight.arrival.vertices))});
    alpha0_ = writer_.found(number(after_last("α"), d.inclination * degrees, "°", e.inclination * degrees),
                            {"inclination at departure, positive with end a low"});
    vn0_ = writer_.found(number(after_last("V_n"), d.normal, "m/s", e.normal_velocity_after, speed_),
                         {"velocity of the centre of mass along the normal, after that impact"});
    vt0_ = writer_.found(
        number(after_last("V_t"), last_->impact.after.tangential, "m/s", e.tangential_velocity_after, speed_),
        {"along the ground"});
    w0_ = writer_.found(number(after_last("Ω"), d.angular, "rad/s", e.angular_velocity_after),
                        {"angular velocity, clockwise"});
    const bool levels = d.inclination * d.angular > 0 && std::fabs(d.inclination) <= std::numbers::pi / 2;
    if (drop_.body.uniform_thin_rod && levels && row_.flight.arrival.vertex != d.reference) rod_equation();
    else height_equation();
    vn_ = velocity("v_n", row_.before.normal, "m/s",
                   given_.gravity.value(0, 0) > 0 ? vn0_ - given_.gravity * time_ : Expression(vn0_));
    vt_ = velocity("v_t", row_.before.tangential, "m/s", vt0_);
    w_ = velocity("ω", row_.before.angular, "rad/s", w0_);
    writer_.open("The contact point", {});
    contact_point();
  }

  Quantity velocity(const char* name, double value, const char* unit, const Expression& formula) {
    return writer_.found(number(name, value, unit, 0, unit[0] == 'm' ? speed_ : 0), formula);
  }

  [[nodiscard]] std::string departure_words() const {
    return fmt::format("contact angle of impact {}, in radians {}", n_ - 1,
                       significant(std::fabs(row_.departure.inclination), 6));
  }

  /// Eq. 12 with the gravity term.
  void rod_equation() {
    const analytic::Arrival& arrival = row_.flight.arrival;
    const Expression rate = absolute(w0_);
    Quantity phi = number("φ", std::fabs(row_.departure.angular) * arrival.time, "rad");
    Quantity theta = number(contact_angle_name(n_ - 1), std::fabs(row_.departure.inclination) * degrees, "°",
                            last_->error.contact_angle * degrees);
    const bool falls = given_.gravity.value(0, 0) > 0;
    const Quantity k_name = number("K", 0, ""), gamma_name = number("Γ", 0, "");
    const auto left = [&](const Quantity& k, const Quantity& gamma, const Quantity& turned) {
      const Expression sum = function("sin", theta) + k * phi;
      return (falls ? sum - gamma * square(phi) : sum) - function("sin", turned - theta);
    };
    writer_.law(left(k_name, gamma_name, phi), 0);
    Words words{" The law below is Eq. 12 of the paper for the angle ",
                phi,
                " that the rod turns, with the contact "
                "angle ",
                theta,
                " that it leaves from and the ratio ",
                k_name,
                " of rising to turning"};
    if (falls) words.insert(words.end(), {"; its term ", gamma_name, " for gravity is corrected"});
    words.emplace_back(".");
    writer_.say(words);
    theta = writer_.found(theta, absolute(alpha0_), {departure_words()});
    const Quantity k = writer_.computed("K", "", 2 * vn0_ / (*length_ * rate));
    const Quantity gamma = falls ? writer_.computed("Γ", "", given_.gravity / (*length_ * square(w0_))) : gamma_name;
    certified_bracket();
    phi = writer_.found(phi, {fmt::format("the root, found numerically by {} evaluations", row_.flight.evaluations)});
    const double angle = phi.value(0, 0),
                 terms = 2 + std::fabs(k.value(0, 0)) * angle + gamma.value(0, 0) * angle * angle;
    const Quantity turned = in_degrees(angle);
    writer_.computed("f", "", left(k, gamma, turned), {"left side of Eq. 12 at the root"}, terms);
    time_ = writer_.found(number("T", arrival.time, "s"), phi / rate, {"time of flight"});
    writer_.found(number(contact_angle_name(n_), row_.contact_angle * degrees, "°", row_.error.contact_angle * degrees),
                  absolute(turned - theta), {"contact angle now"});
    inclination(turned);
  }

  /// The angle turned [rad], as what is added to angles and subtracted from them.
  Quantity in_degrees(double angle) {
    return writer_.found(number("φ_deg", angle * degrees, "°"), {"the same in degrees"});
  }

  void certified_bracket() {
    const analytic::Arrival& arrival = row_.flight.arrival;
    const double rate = std::fabs(row_.departure.angular);
    if (!(arrival.bracket_high < 1e300)) return;
    writer_.found(number("φ_low", rate * arrival.bracket_low, "rad"), {"left end of the certified bracket"});
    writer_.found(number("φ_high", rate * arrival.bracket_high, "rad"), {"its right end"});
  }

  void inclination(const std::optional<Quantity>& turned) {
    const Quantity alpha =
        number("α", row_.flight.arrival.inclination * degrees, "°", row_.error.inclination * degrees);
    const Expression formula = !turned                      ? Expression(alpha0_)
                               : row_.departure.angular > 0 ? alpha0_ - *turned
                                                            : alpha0_ + *turned;
    alpha_ = writer_.found(alpha, formula, {"inclination at the touch"});
  }

  /// The height of the vertex that arrives.
  void height_equation() {
    const analytic::VertexHeight h = analytic::vertex_height(drop_.body, row_.departure, row_.flight.arrival.vertex);
    const bool falls = given_.gravity.value(0, 0) > 0, turns = h.rate > 0;
    place_of(row_.flight.arrival.vertex);
    const Quantity z0 = writer_.found(number(after_last("z_c"), last_->centre_height, "m", 0, reach_),
                                      {"height of the centre of mass at departure"});
    const Expression sine = function("sin", alpha0_), cosine = function("cos", alpha0_);
    const Quantity dt = writer_.computed(after_last("d_t"), "m", x_ * cosine - y_ * sine,
                                         {"from the centre of mass to the vertex, along the ground"}, reach_);
    const Quantity dn = writer_.computed(after_last("d_n"), "m", x_ * sine + y_ * cosine, {"upward"}, reach_);
    const Quantity h0 =
        writer_.found(number("h_0", h.height, "m", 0, reach_), z0 + dn, {"height of the vertex at departure"});
    const Quantity v0 =
        writer_.found(number("h_0′", h.velocity, "m/s", 0, speed_), vn0_ - w0_ * dt, {"its velocity, upward"});
    if (row_.flight.arrival.bracket_high < 1e300) {
      writer_.found(number("T_low", row_.flight.arrival.bracket_low, "s"), {"left end of the certified bracket"});
      writer_.found(number("T_high", row_.flight.arrival.bracket_high, "s"), {"its right end"});
    }
    time_ =
        writer_.found(number("T", row_.flight.arrival.time, "s"),
                      {fmt::format("time of flight, the first root of the height, found numerically by {} evaluations",
                                   row_.flight.evaluations)});
    Expression height = h0 + v0 * time_;
    std::optional<Quantity> turned;
    if (falls) height = height - given_.gravity * square(time_) / 2;
    if (turns) {
      const Quantity phi = writer_.computed("φ", "rad", absolute(w0_) * time_, {"angle turned"});
      turned = in_degrees(phi.value(0, 0));
      const Expression sideways = (phi - function("sin", phi)) * dt;
      height = height - dn * (1 - function("cos", phi));
      height = h.sine * dt.value(0, 0) < 0 ? height - sideways : height + sideways;
    }
    writer_.computed("h", "m", height, {"height of the vertex at the root"},
                     row_.flight.arrival.time > 0 ? h.at(row_.flight.arrival.time).scale : reach_);
    inclination(turned);
  }

  /// Gives the place of a vertex in the body, once.
  void place_of(int vertex) {
    if (vertex == vertex_) return;
    vertex_ = vertex;
    const analytic::Vertex place = drop_.body.vertices[static_cast<std::size_t>(vertex)];
    x_ = writer_.given(number("x", place.x, "m"), {"the vertex from the centre of mass, along the body"});
    y_ = writer_.given(number("z", place.z, "m"), {"and across it"});
  }

  void contact_point() {
    place_of(std::countr_zero(row_.vertices));
    const Expression sine = function("sin", alpha_), cosine = function("cos", alpha_);
    dt_ = writer_.computed("d_t", "m", x_ * cosine - y_ * sine,
                           {"from the centre of mass to the contact, along the ground"}, reach_);
    dn_ = writer_.computed("d_n", "m", x_ * sine + y_ * cosine, {"upward"}, reach_);
    z_ = writer_.found(number("z_c", row_.centre_height, "m", 0, reach_), -dn_, {"height of the centre of mass"});
  }

  void point_impact() {
    writer_.open("The contact", {"An impulse at the contact changes the velocity there by A/m times the impulse: 1/m "
                                 "of it with the centre of mass, the rest by turning the body about that."});
    const Quantity a = writer_.computed("A", "", 1 + square(dt_) / k2_);
    Quantity b = a;
    u_ = writer_.found(number("u", -row_.impact.approach_speed, "m/s", row_.error.approach_speed), vn_ - w_ * dt_,
                       {"normal velocity of the contact, before"});
    const bool rubs = given_.has_friction();
    if (rubs) {
      b = writer_.computed("B", "", dt_ * dn_ / k2_);
      s_ = writer_.found(number("s", row_.impact.slip_before, "m/s", 0, speed_), vt_ + w_ * dn_,
                         {"slip of the contact, before"});
    }
    const bool is_single =
        given_.moreau || (row_.impact.mode != ImpactMode::slip_stick && row_.impact.mode != ImpactMode::reverse_slip);
    Quantity e = u_;
    if (is_single || drop_.law.law != analytic::RestitutionLaw::viscoelastic)
      e = write_restitution(writer_, given_, u_, row_.impact.restitution());
    if (given_.friction) {
      const Quantity c = coulomb_contact();
      coulomb(a, b, c, e, is_single);
    }
    if (given_.moreau) friction_at_end(a, b, e);
    eq8(a, b, e, is_single || drop_.law.law == analytic::RestitutionLaw::newton);
    const bool is_eq9 = drop_.body.uniform_thin_rod && given_.impulse_ratio && !last_ && row_.before.angular == 0 &&
                        drop_.inclination.degrees > 0 && drop_.inclination.degrees <= 90 && e.value(0, 0) == 1;
    if (is_eq9) eq9();
    const Expression work = *normal_ * (u_ + u_after_);
    energy(-((rubs ? work + *tangential_ * (*s_ + *s_after_) : work) / 2));
  }

  /// "μ = 0.1"
  [[nodiscard]] std::string mu_words() const { return "μ = " + shortest(given_.friction->value(0, 0)); }

  [[nodiscard]] bool sticks() const {
    return row_.impact.mode == ImpactMode::stick || row_.impact.mode == ImpactMode::slip_stick;
  }

  /// Moreau's: the impulse that holds the contact, or μ against the slip after it.
  void friction_at_end(const Quantity& a, const Quantity& b, const Quantity& e) {
    writer_.open("Friction by the slip after the impact",
                 {fmt::format("Moreau's condition: the contact sticks if the impulse that holds it lies in the cone of "
                              "friction, and else slips against it. The contact's mode is {}.",
                              mode_name(row_.impact.mode))});
    if (!sticks()) {
      const Expression mu = *given_.moreau;
      ratio_ = writer_.computed("μ_i", "", row_.impact.tangential_impulse < 0 ? -mu : mu,
                                {"impulse ratio, against the slip after"});
      return;
    }
    const Quantity c = writer_.computed("C", "", 1 + square(dn_) / k2_);
    const Quantity holding = writer_.computed("p", "m/s", -(((1 + e) * u_ + b * *s_ / c) / (a - b * b / c)),
                                              {"normal impulse of a contact that is held, over m"});
    ratio_ = writer_.found(number("μ_i", row_.impact.impulse_ratio(), "", row_.error.impulse_ratio, 1),
                           (b * holding - *s_) / (c * holding), {"impulse ratio that holds the contact, at most μ"});
  }

  Quantity coulomb_contact() {
    writer_.open("Coulomb's friction",
                 {fmt::format("Routh's construction along the normal impulse p. The contact's mode is {}.",
                              mode_name(row_.impact.mode))});
    return writer_.computed("C", "", 1 + square(dn_) / k2_);
  }

  /// The path of Routh: m du/dp = A − B r, m ds/dp = C r − B, r = dP_t/dP_n.
  void coulomb(const Quantity& a, const Quantity& b, const Expression& c, const Quantity& e, bool is_single) {
    const ImpactMode mode = row_.impact.mode;
    const Expression drift = b;
    const Expression along = s_->value(0, 0) == 0 ? -drift : Expression(*s_);
    if (mode == ImpactMode::stick) {
      ratio_ = writer_.found(number("μ_i", row_.impact.impulse_ratio(), "", row_.error.impulse_ratio, 1), drift / c,
                             {"impulse ratio that keeps the contact from slipping, at most " + mu_words()});
      return;
    }
    const bool begins = s_->value(0, 0) == 0;
    if (begins) {
      writer_.computed("r_0", "", absolute(drift) / c,
                       {"impulse ratio that would keep the contact from slipping: more than " + mu_words() +
                        ", so that it slips, the other way than B"});
    }
    const Quantity r1 =
        writer_.computed(is_single ? "μ_i" : "r_1", "", -(*given_.friction * function("sgn", along)),
                         {is_single ? "impulse ratio, against the slip" : "ratio of impulses while slip lasts"});
    if (is_single) {
      ratio_ = r1;
      return;
    }
    const Expression m = given_.mass;
    const Quantity stop =
        writer_.computed("p_s", "N·s", m * *s_ / (drift - c * r1), {"normal impulse that stops the slip"});
    const bool sticks = mode == ImpactMode::slip_stick;
    writer_.computed("r_0", "", absolute(drift) / c,
                     {"impulse ratio that holds the contact then: " +
                      (sticks ? "at most " + mu_words() + ", so that it sticks"
                              : "more than " + mu_words() + ", so that slip goes on the other way")});
    const Quantity r2 = sticks ? writer_.computed("r_2", "", drift / c, {"ratio of impulses without slip"})
                               : writer_.computed("r_2", "", -r1, {"against the slip, which has turned"});
    two_phases({.before = writer_.computed("a_1", "", a - b * r1, {"m du/dp before"}),
                .after = writer_.computed("a_2", "", a - b * r2, {"and after slip stops"}),
                .stop = stop},
               e);
    const Expression tangential = r1 * stop + r2 * (*normal_ - stop);
    tangential_ = writer_.found(unknowns().pt, tangential);
    ratio_ = writer_.found(number("μ_i", row_.impact.impulse_ratio(), "", row_.error.impulse_ratio, 1),
                           *tangential_ / *normal_, {"impulse ratio"});
  }

  struct Phases {
    Quantity before, after, stop;
  };

  /// Normal impulse where the law of restitution ends the path, which has a corner where slip stops.
  void two_phases(const Phases& path, const Quantity& e) {
    const Expression m = given_.mass;
    const Quantity us = writer_.computed("u_s", "m/s", u_ + path.before * path.stop / m,
                                         {"normal velocity of the contact where slip stops"}, speed_);
    const Expression rest = path.stop;
    const auto rise = [&](const Expression& to) { return rest + m * (to - us) / path.after; };
    switch (drop_.law.law) {
      case analytic::RestitutionLaw::newton: return end(rise(-(e * u_)));
      case analytic::RestitutionLaw::poisson: return end((1 + e) * compression(path, us));
      case analytic::RestitutionLaw::stronge: return end(rise(stronge_speed(path, us, e)));
      case analytic::RestitutionLaw::viscoelastic: return end(rise(ground_speed(path, us)));
    }
  }

  void end(const Expression& formula) {
    normal_ = writer_.found(unknowns().p, formula, {"normal impulse, where the law of restitution ends the path"});
  }

  Quantity compression(const Phases& path, const Quantity& us) {
    const Expression m = given_.mass;
    const bool is_first = us.value(0, 0) >= 0;
    return writer_.computed("p_c", "N·s", is_first ? -(m * u_ / path.before) : path.stop - m * us / path.after,
                            {"normal impulse at the end of compression"});
  }

  /// Separation speed for which the work given back is e² times that of compression.
  Quantity stronge_speed(const Phases& path, const Quantity& us, const Quantity& e) {
    const Quantity pc = compression(path, us);
    const Expression m = given_.mass, u = u_, s = us, ps = path.stop;
    const bool is_first = us.value(0, 0) >= 0;
    const Quantity work = writer_.computed("W_c", "J", is_first ? -(u * pc / 2) : -((u + s) * ps + s * (pc - ps)) / 2,
                                           {"work of compression"});
    const Expression square_of_speed = is_first
                                           ? square(us) + 2 * path.after * (square(e) * work - s * (ps - pc) / 2) / m
                                           : 2 * path.after * square(e) * work / m;
    return writer_.computed("w", "m/s", function("√", square_of_speed), {"separation speed by the work given back"});
  }

  /// Separation speed for which the damped ground has given back what it stored.
  Quantity ground_speed(const Phases& path, const Quantity& us) {
    const Quantity w = number("w", row_.impact.separation_speed, "m/s");
    const Expression tau = *given_.damping_time;
    const Expression share = path.after / path.before;
    if (given_.damping_time->value(0, 0) == 0) {
      return writer_.found(w, function("√", square(us) + share * (square(u_) - square(us))),
                           {"separation speed at which the ground has given back all that it stored"});
    }
    const auto psi = [&](const Symbol& name, const Expression& speed) {
      return writer_.computed(name, "", -(tau * speed) - function("ln", 1 - tau * speed), {}, 1e-6);
    };
    const Quantity begin = psi("ψ_1", u_), stop = psi("ψ_2", us);
    const Quantity end = writer_.computed("ψ_3", "", stop + share * (begin - stop),
                                          {"work of the ground, up to a factor: that of the end follows"}, 1e-6);
    return writer_.found(w,
                         {"separation speed, which makes ", -(tau * w) - function("ln", 1 - tau * w) - end, " zero"});
  }

  /// @param is_newton  the velocities are related by e, as Eq. 8 has it
  void eq8(const Quantity& a, const Quantity& b, const Quantity& e, bool is_newton) {
    const Expression m = given_.mass;
    const analytic::Impact& impact = row_.impact;
    const auto [p, pt, vn, vt, w] = unknowns();
    const std::optional<Quantity> ratio = ratio_ ? ratio_ : given_.impulse_ratio;
    state_eq8(ratio, is_newton ? &e : nullptr);
    if (!normal_) {
      const Expression below = ratio ? a - *ratio * b : Expression(a);
      normal_ = writer_.found(p, -((1 + e) * m * u_ / below), {"normal impulse"});
    }
    if (ratio && !tangential_) {
      tangential_ = writer_.found(pt, *ratio * *normal_, {"tangential impulse"});
    }
    const Expression pn = *normal_;
    vn_after_ = writer_.found(vn, vn_ + pn / m);
    vt_after_ = writer_.found(vt, ratio ? vt_ + *tangential_ / m : Expression(vt_));
    const Expression of_normal = pn * dt_, inertia = m * k2_;
    w_after_ = writer_.found(w, ratio ? w_ + (*tangential_ * dn_ - of_normal) / inertia : w_ - of_normal / inertia);
    contact_after(ratio.has_value());
    if (!is_newton)
      writer_.found(number("e_N", impact.restitution(), "", row_.error.restitution, 1), -(u_after_ / u_),
                    {"ratio of separation to approach speed"});
  }

  /// Eq. 9, which is Eq. 8 solved for the elastic rod that does not turn and strikes with end a, with m and L.
  void eq9() {
    writer_.open("Eq. 9: the same in closed form",
                 {"Eq. 8 solved for the elastic rod; the paper has m = L = 1, and prints Ω without the minus."});
    const Quantity theta = writer_.found(number("θ", row_.contact_angle * degrees, "°"), absolute(alpha_));
    const Expression c = function("cos", theta), s = function("sin", theta), mu = *given_.impulse_ratio,
                     m = given_.mass;
    const Quantity d = writer_.computed("D", "", 1 + 3 * square(c) - 3 * mu * s * c);
    writer_.computed("V_n", "m/s", -((1 - 3 * square(c) + 3 * mu * s * c) / d * vn_), {}, speed_);
    writer_.computed("V_t", "m/s", vt_ - 2 * mu / d * vn_, {}, speed_);
    writer_.computed("Ω", "rad/s", -(12 * (c - mu * s) / (d * *length_) * vn_));
    writer_.computed("P_n", "N·s", -(2 * m * vn_ / d));
  }

  /// Impulses and velocities after the impact.
  struct Unknowns {
    Quantity p, pt, vn, vt, w;
  };
  [[nodiscard]] Unknowns unknowns() const {
    const analytic::Impact& impact = row_.impact;
    const analytic::PlanarVelocity& after = impact.after;
    const analytic::RowErrors& error = row_.error;
    return {.p = number("P_n", impact.normal_impulse, "N·s", error.normal_impulse),
            .pt = number("P_t", impact.tangential_impulse, "N·s", error.tangential_impulse),
            .vn = number("V_n", after.normal, "m/s", error.normal_velocity_after, speed_),
            .vt = number("V_t", after.tangential, "m/s", error.tangential_velocity_after, speed_),
            .w = number("Ω", after.angular, "rad/s", error.angular_velocity_after)};
  }

  /// The lines of Eq. 8 with what they ask for.
  /// @param e  of Newton's law, whose line is the last; none: another law ends the impact
  void state_eq8(const std::optional<Quantity>& ratio, const Quantity* e) {
    const Unknowns of = unknowns();
    const Expression m = given_.mass, p = of.p, vn = of.vn, w = of.w;
    Words words{"Momentum along the normal and along the ground, angular momentum",
                e ? ", and restitution" : "",
                ". Unknown are the impulse ",
                of.p,
                " and the velocities after, ",
                of.vn,
                ", ",
                of.vt,
                " and ",
                of.w,
                "."};
    if (!ratio) words.emplace_back(" Without friction the impulse along the ground is zero.");
    writer_.open("Eq. 8", words);
    writer_.law(m * (vn - vn_), p);
    writer_.law(m * (of.vt - vt_), ratio ? *ratio * p : Expression(0));
    writer_.law(m * k2_ * (w - w_), ratio ? *ratio * p * dn_ - p * dt_ : -(p * dt_));
    if (e) writer_.law(vn - w * dt_, -(*e * (vn_ - w_ * dt_)));
  }

  /// The velocity of the contact after the impact.
  void contact_after(bool rubs) {
    const analytic::Impact& impact = row_.impact;
    u_after_ = writer_.found(number("u′", impact.separation_speed, "m/s", 0, speed_), vn_after_ - w_after_ * dt_,
                             {"normal velocity of the contact, after"});
    if (rubs) {
      s_after_ = writer_.found(number("s′", impact.slip_after, "m/s", 0, speed_), vt_after_ + w_after_ * dn_,
                               {"slip of the contact, after"});
    }
  }

  void flat_landing() {
    const analytic::Impact& impact = row_.impact;
    const Quantity e = write_restitution(writer_, given_, vn_, impact.restitution());
    const Expression m = given_.mass;
    const auto [p, pt, vn, vt, w] = unknowns();
    writer_.open(
        "Eq. 10: vertices strike together (flat landing)",
        {"The body rebounds as a whole, its turning reversed like its fall. Unknown are the impulses ", p, " and ", pt,
         " and the velocities after, ", vn, ", ", vt, " and ", w, "; for e = 1 they are those of Eq. 11."});
    writer_.law(m * (vn - vn_), p);
    writer_.law(m * (vt - vt_), pt);
    writer_.law(vn, -(e * vn_));
    writer_.law(w, -(e * w_));
    normal_ = writer_.found(p, -((1 + e) * m * vn_), {"normal impulse"});
    vn_after_ = writer_.found(vn, -(e * vn_));
    w_after_ = writer_.found(w, -(e * w_));
    const bool rubs = given_.has_friction();
    if (rubs)
      tangential_ =
          writer_.found(pt, flat_friction(e), {fmt::format("tangential impulse, mode {}", mode_name(impact.mode))});
    vt_after_ = writer_.found(vt, rubs ? vt_ + *tangential_ / m : Expression(vt_));
    const Expression lost = (1 - square(e)) * m * (square(vn_) + k2_ * square(w_)) / 2;
    energy(rubs ? lost - *tangential_ * (vt_ + vt_after_) / 2 : lost);
  }

  /// Tangential impulse of a flat landing: the reversed turning moves the face along the ground by ω d_n.
  Expression flat_friction(const Quantity& e) {
    const Expression m = given_.mass, pn = *normal_;
    if (given_.impulse_ratio) return *given_.impulse_ratio * pn;
    s_ = writer_.found(number("s", row_.impact.slip_before, "m/s", 0, speed_), vt_ + w_ * dn_,
                       {"slip of the face, before"});
    if (sticks()) return m * (e * w_ * dn_ - vt_);
    if (given_.moreau) return (row_.impact.tangential_impulse < 0 ? -*given_.moreau : Expression(*given_.moreau)) * pn;
    const Quantity drift = writer_.computed("D", "", -(w_ * dn_ / vn_), {"drift of the face by its turning"});
    const Expression along = s_->value(0, 0) == 0 ? -drift : Expression(*s_);
    const Quantity r = writer_.computed("r_1", "", -(*given_.friction * function("sgn", along)), {"against the slip"});
    if (row_.impact.mode != ImpactMode::reverse_slip) return r * pn;
    const Quantity stop = writer_.computed("p_s", "N·s", m * *s_ / (drift - r), {"normal impulse that stops the slip"});
    return r * (2 * stop - pn);
  }

  void energy(const Expression& lost) {
    const Expression m = given_.mass;
    const auto total = [&](const Quantity& n, const Quantity& t, const Quantity& w) {
      const Expression moving = m * (square(n) + square(t) + k2_ * square(w)) / 2;
      return given_.gravity.value(0, 0) > 0 ? moving + m * given_.gravity * z_ : moving;
    };
    write_energy(
        writer_, {"Energy of the motion of the centre of mass, of turning and, with gravity, of height."},
        {.before = total(vn_, vt_, w_),
         .after = total(vn_after_, vt_after_, w_after_),
         .loss = lost,
         .before_value = number("E", row_.energy_before, "J", row_.error.energy_before),
         .after_value = number("E′", row_.energy_after, "J", row_.error.energy_after),
         .loss_value = number("ΔE", row_.impact.energy_loss, "J", row_.error.energy_loss, row_.energy_before)});
  }

  const Scene& scene_;
  const analytic::Drop& drop_;
  int n_, vertex_ = -1;
  const ImpactRow& row_;
  const ImpactRow* last_;
  StepWriter writer_;
  Given given_;
  double reach_, speed_;
  std::optional<Quantity> length_, s_, s_after_, ratio_, normal_, tangential_;
  Quantity k2_ = number("k²", 0, ""), alpha_ = k2_, alpha0_ = k2_, x_ = k2_, y_ = k2_, vn0_ = k2_, vt0_ = k2_,
           w0_ = k2_, time_ = k2_, vn_ = k2_, vt_ = k2_, w_ = k2_, dt_ = k2_, dn_ = k2_, z_ = k2_, u_ = k2_,
           u_after_ = k2_, vn_after_ = k2_, vt_after_ = k2_, w_after_ = k2_;
};

}  // namespace

std::vector<Step> impact_steps(const Scene& scene, const analytic::Drop& drop, const analytic::Sequence& sequence,
                               int n) {
  return PlanarImpact(scene, drop, sequence, n).steps();
}

}  // namespace clatter::validation
