// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/reports/derivation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"
#include "validation/output/version.hpp"
#include "validation/record/names.hpp"
#include "validation/reports/explanation_latex.hpp"
#include "validation/reports/space_derivation.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/scene_value.hpp"
#include "validation/scene/shortfall.hpp"

namespace clatter::validation::inline reports {
namespace {

using analytic::degrees_per_radian;
using analytic::ImpactRow;

/// Writes the equations of one sequence with its number of digits.
class Derivation {
 public:
  Derivation(const Scene& scene, const analytic::Drop& drop, const analytic::Sequence& sequence)
      : scene_(scene), drop_(drop), sequence_(sequence) {}

  std::vector<Step> impact(int n) {
    const auto index = static_cast<std::size_t>(n - 1);
    const ImpactRow& row = sequence_.rows[index];
    error_ = row.error;
    if (n == 1) first_touch(row);
    else flight(sequence_.rows[index - 1], row, n);
    if (std::popcount(row.vertices) > 1) flat_landing(row);
    else point_impact(row);
    energy(row);
    set_errors();
    return std::move(steps_);
  }

 private:
  [[nodiscard]] std::string num(double value) const {
    const std::string text =
        known_text({value, error_.relative * std::fabs(value)}, {.digits = scene_.accuracy.digits});
    return value < 0 ? "(" + text + ")" : text;
  }

  /// Every number of the steps follows from the row's: relatively, none is known better.  Residuals have errors of
  /// their own already.
  void set_errors() {
    for (Step& step : steps_) {
      for (Equation& equation : step.equations) {
        if (equation.error == 0) equation.error = error_.relative * std::fabs(equation.value);
      }
    }
  }

  Step& open(std::string title, std::string text) {
    return steps_.emplace_back(Step{std::move(title), std::move(text), {}});
  }

  void first_touch(const ImpactRow& row) {
    Step& step = open("The first touch",
                      fmt::format("End {} touches the ground at an inclination of {}°.",
                                  analytic::PlanarBody::vertex_set_name(row.vertices), num(scene_.angle_deg)));
    step.equations = {{"v_n", "−speed", "", row.before.normal, "m/s"},
                      {"v_t", "tangential velocity", "", row.before.tangential, "m/s"},
                      {"ω", "spin", "", row.before.angular, "rad/s"}};
  }

  void flight(const ImpactRow& from, const ImpactRow& row, int n) {
    const analytic::Departure& d = row.departure;
    Step& step = open(fmt::format("The flight to impact {}", n),
                      fmt::format("After impact {} the body flies freely. Earliest contact: end {}.", n - 1,
                                  analytic::PlanarBody::vertex_set_name(row.vertices)));
    step.equations = {{"V_n", "after the last impact", "", from.impact.after.normal, "m/s"},
                      {"Ω", "after the last impact", "", from.impact.after.angular, "rad/s"}};
    const bool rod = drop_.body.uniform_thin_rod && d.angular != 0 && row.flight.arrival.vertex != d.reference;
    if (rod) rod_equation(step, row);
    else height_equation(step, row);
    root(step, row);
  }

  /// Eq. 12 with the gravity term.
  void rod_equation(Step& step, const ImpactRow& row) {
    const analytic::Departure& d = row.departure;
    const double rate = std::fabs(d.angular);
    const double length = scene_.body.length;
    const double k = 2 * d.normal / (length * rate);
    const double gamma = d.gravity / (length * rate * rate);
    const double start = std::fabs(d.inclination);
    step.text +=
        " Eq. 12 for the angle φ that the rod turns: sin θ + K φ − Γ φ² − sin(φ − θ) = 0, "
        "θ the contact angle that it leaves from.";
    step.equations.push_back({"θ", "contact angle before", "", start * degrees_per_radian, "°"});
    step.equations.push_back(
        {"K", "2 V_n/(L |Ω|)", fmt::format("2·{}/({}·{})", num(d.normal), num(length), num(rate)), k, ""});
    if (d.gravity > 0) {
      step.equations.push_back(
          {"Γ", "g/(L Ω²)", fmt::format("{}/({}·{}²)", num(d.gravity), num(length), num(rate)), gamma, ""});
    }
    const double turned = rate * row.flight.arrival.time;
    const double left = std::sin(start) + k * turned - gamma * turned * turned - std::sin(turned - start);
    step.equations.push_back(
        {"left side", "at the root φ",
         fmt::format("{} + {}·{} − {} − {}", num(std::sin(start)), num(k), num(turned), num(gamma * turned * turned),
                     num(std::sin(turned - start))),
         left, "", residual_error(std::fabs(std::sin(start)) + std::fabs(k * turned) + 1 + gamma * turned * turned),
         1});
  }

  /// Of a sum of terms that cancel, from their sizes: the row's relative error in each.
  [[nodiscard]] double residual_error(double terms) const { return error_.relative * terms; }

  /// The general height function of the vertex that arrives.
  void height_equation(Step& step, const ImpactRow& row) {
    const analytic::VertexHeight h = analytic::vertex_height(drop_.body, row.departure, row.flight.arrival.vertex);
    step.text += " Height of its vertex: h(t) = h₀ + v₀ t − g t²/2 + p (1 − cos ωt) + q (ωt − sin ωt).";
    step.equations.push_back({"h₀", "height at departure", "", h.height, "m"});
    step.equations.push_back({"v₀", "its normal velocity", "", h.velocity, "m/s"});
    step.equations.push_back({"p", "−d_n", "", h.versine, "m"});
    step.equations.push_back({"q", "±d_t, the sign of Ω", "", h.sine, "m"});
    const analytic::VertexHeight::Value at_root = h.at(row.flight.arrival.time);
    step.equations.push_back(
        {"h(T)", "at the root T", "", at_root.height, "m", residual_error(at_root.scale), at_root.scale});
  }

  void root(Step& step, const ImpactRow& row) {
    const analytic::Arrival& arrival = row.flight.arrival;
    const double rate = std::fabs(row.departure.angular);
    if (rate > 0 && arrival.bracket_high < 1e300) {
      step.equations.push_back({"φ low", "left end of the certified bracket", "", rate * arrival.bracket_low, "rad"});
      step.equations.push_back({"φ high", "right end", "", rate * arrival.bracket_high, "rad"});
      step.equations.push_back(
          {"φ", fmt::format("the root, after {} evaluations", row.flight.evaluations), "", rate * arrival.time, "rad"});
    }
    step.equations.push_back({"T", rate > 0 ? "φ/|Ω|" : "time of flight", "", arrival.time, "s"});
    step.equations.push_back(
        {"contact angle", "acute angle to the ground", "", row.contact_angle * degrees_per_radian, "°"});
    step.equations.push_back(
        {"v_n", "V_n − g T",
         fmt::format("{} − {}·{}", num(row.departure.normal), num(row.departure.gravity), num(arrival.time)),
         row.before.normal, "m/s"});
  }

  void point_impact(const ImpactRow& row) {
    const analytic::ImpactLaw& law = drop_.law;
    const double angle = row.inclination;
    const bool upright = steps_.size() == 1 && scene_.angle_deg == 90;
    const int vertex = std::countr_zero(row.vertices);
    const analytic::ContactPoint d = drop_.body.contact_point(vertex, std::sin(angle), upright ? 0 : std::cos(angle));
    const double k2 = drop_.body.gyration_square;
    const auto [a, b, c] = analytic::contact_inertia(k2, d);
    const double ratio = row.impact.impulse_ratio();
    Step& point = open("The contact point", "d from the centre of mass to the contact point; I = m k².");
    point.equations = {{"d_t", "x cos α − z sin α", "", d.tangential, "m"},
                       {"d_n", "x sin α + z cos α", "", d.normal, "m"},
                       {"k²", "I/m", "", k2, "m²"},
                       {"A", "1 + d_t²/k²", fmt::format("1 + {}²/{}", num(d.tangential), num(k2)), a, ""}};
    if (law.friction != analytic::FrictionKind::none) {
      point.equations.push_back({"B", "d_t d_n/k²", "", b, ""});
      point.equations.push_back({"C", "1 + d_n²/k²", "", c, ""});
      point.equations.push_back({"s", "v_t + ω d_n, slip before", "", row.impact.slip_before, "m/s"});
      point.equations.push_back({"μᵢ", fmt::format("P_t/P_n, mode {}", mode_name(row.impact.mode)), "", ratio, ""});
    }
    momentum(row, d, ratio);
  }

  /// Eq. 8 solved for the impulse and the velocities after.
  void momentum(const ImpactRow& row, const analytic::ContactPoint& d, double ratio) {
    const analytic::PlanarVelocity& v = row.before;
    const double k2 = drop_.body.gyration_square;
    const auto [a, b, c] = analytic::contact_inertia(k2, d);
    const double u = -row.impact.approach_speed;
    Step& step = open("Eq. 8",
                      "m (V_n − v_n) = P_n,  m (V_t − v_t) = μᵢ P_n,  I (Ω − ω) = μᵢ P_n d_n − P_n d_t,  "
                      "V_n − Ω d_t = −e (v_n − ω d_t)");
    const analytic::PlanarVelocity& after = row.impact.after;
    const double mass = drop_.body.mass;
    const double p = row.impact.normal_impulse;
    const std::string denominator = ratio == 0 ? num(a) : fmt::format("({} − {}·{})", num(a), num(ratio), num(b));
    const double e = row.impact.restitution();
    step.equations = {
        {"u", "v_n − ω d_t", fmt::format("{} − {}·{}", num(v.normal), num(v.angular), num(d.tangential)), u, "m/s"},
        {"P_n", "−(1+e) m u/(A − μᵢ B)", fmt::format("−(1+{})·{}·{}/{}", num(e), num(mass), num(u), denominator), p,
         "N·s"},
        {"V_n", "v_n + P_n/m", fmt::format("{} + {}/{}", num(v.normal), num(p), num(mass)), after.normal, "m/s"},
        {"V_t", "v_t + μᵢ P_n/m", fmt::format("{} + {}·{}/{}", num(v.tangential), num(ratio), num(p), num(mass)),
         after.tangential, "m/s"},
        {"Ω", "ω + P_n (μᵢ d_n − d_t)/(m k²)",
         fmt::format("{} + {}·({}·{} − {})/({}·{})", num(v.angular), num(p), num(ratio), num(d.normal),
                     num(d.tangential), num(mass), num(k2)),
         after.angular, "rad/s"},
        {"u′", "V_n − Ω d_t = −e u",
         fmt::format("{} − {}·{}", num(after.normal), num(after.angular), num(d.tangential)),
         row.impact.separation_speed, "m/s"}};
  }

  void flat_landing(const ImpactRow& row) {
    Step& step = open("Eq. 10: vertices strike together (flat landing)",
                      "m (V_n − v_n) = P_n,  m (V_t − v_t) = μᵢ P_n,  V_n = −e v_n;  Ω = −e ω");
    const double mass = drop_.body.mass;
    const double e = drop_.law.restitution;
    step.equations = {
        {"P_n", "−(1+e) m v_n", fmt::format("−(1+{})·{}·{}", num(e), num(mass), num(row.before.normal)),
         row.impact.normal_impulse, "N·s"},
        {"P_t", fmt::format("μᵢ P_n, mode {}", mode_name(row.impact.mode)), "", row.impact.tangential_impulse, "N·s"},
        {"V_n", "−e v_n", fmt::format("−{}·{}", num(e), num(row.before.normal)), row.impact.after.normal, "m/s"},
        {"V_t", "v_t + P_t/m", "", row.impact.after.tangential, "m/s"},
        {"Ω", "−e ω", "", row.impact.after.angular, "rad/s"}};
  }

  void energy(const ImpactRow& row) {
    Step& step = open("Energy", "E = m (V_n² + V_t² + k² Ω²)/2 + m g z, z of the centre of mass above the ground.");
    step.equations = {{"E before", "", "", row.energy_before, "J"},
                      {"E after", "", "", row.energy_after, "J"},
                      {"loss", "−(P_n (u + u′) + P_t (s + s′))/2", "", row.impact.energy_loss, "J"}};
  }

  const Scene& scene_;
  const analytic::Drop& drop_;
  const analytic::Sequence& sequence_;
  std::vector<Step> steps_;
  analytic::RowErrors error_;
};

}  // namespace

std::string value_text(const Equation& equation, int digits) {
  const Shown shown{.digits = digits, .size = equation.size};
  return known_text({equation.value, equation.error}, shown) + (equation.unit.empty() ? "" : " " + equation.unit);
}

std::vector<Step> derive_impact(const Scene& scene, const analytic::Drop& drop, const analytic::Sequence& sequence,
                                int n) {
  return Derivation(scene, drop, sequence).impact(n);
}

Explanation explain_impact(Scene scene, int n) {
  scene.request.impacts = std::max(scene.request.impacts, n);
  const auto explained = [&](const auto& drop) -> Explanation {
    const auto sequence = impact_sequence(drop, {.impacts = n, .digits = scene.accuracy.digits});
    const std::size_t have = sequence.rows.size();
    const bool has_impact = static_cast<std::size_t>(n) <= have;
    const bool falls_short = scene.require_digits || !has_impact;
    return {.scene = scene,
            .impact = n,
            .approach_speed = first_approach_speed(drop),
            .steps = has_impact ? derive_impact(scene, drop, sequence, n)
                                : std::vector<Step>{missing_impact(
                                      n, {have, sequence.outcome, sequence.message, sequence.near_miss})},
            .warnings = sequence.warnings,
            .shortfall = falls_short ? shortfall(scene, sequence) : "",
            .shortfall_status = shortfall_status(sequence.outcome)};
  };
  return std::visit(explained, discrete_drop(scene));
}

Value explanation_fields(const Explanation& explanation) {
  const int digits = std::max(explanation.scene.accuracy.digits, 6);  // a drawing of few digits still tells its numbers
  Value::List steps;
  for (const Step& step : explanation.steps) {
    Value::List equations;
    for (const Equation& e : step.equations) {
      equations.push_back(Value::Fields{{"name", e.name},
                                        {"symbolic", e.formula},
                                        {"numeric", e.numbers},
                                        {"tex", equation_tex(e, digits, " \\\\ &= ")},
                                        {"words", equation_words(e)},
                                        {"value", e.value},
                                        {"error", e.error},
                                        {"unit", e.unit}});
    }
    steps.push_back(Value::Fields{{"title", step.title}, {"text", step.text}, {"equations", equations}});
  }
  return Value::Fields{{"clatter", version},
                       {"model", "discrete"},
                       {"scene", scene_value(explanation.scene, Model::discrete, explanation.approach_speed)},
                       {"body", body_value(explanation.scene, Model::discrete)},
                       {"impact", explanation.impact},
                       {"shortfall", text_or_nothing(explanation.shortfall)},
                       {"steps", steps}};
}

}  // namespace clatter::validation::inline reports
