// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of an impact of one corner in space.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analytic/law/coulomb_path.hpp"
#include "analytic/space/slip_field.hpp"
#include "validation/output/number.hpp"
#include "validation/record/names.hpp"
#include "validation/reports/space_derivation.hpp"

namespace clatter::validation::inline reports {
namespace {

namespace space = analytic::space;
using space::Matrix3;
using space::Vector2;
using space::Vector3;

constexpr double degrees = 180 / std::numbers::pi;

double angle_of(const Vector2& v) { return std::atan2(v.y(), v.x()) * degrees; }

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

/// The steps of one corner's impact.
class CornerImpact {
 public:
  CornerImpact(const ImpactInSpace& impact, StepWriter& writer)
      : impact_(impact), writer_(writer), law_(impact.drop.law.law), struck_(impact.row().impact) {
    const space::State& before = impact.row().before;
    const Matrix3 axes = before.attitude.toRotationMatrix();
    arm_ = axes * impact.row().corners.front().place;
    inverse_inertia_ = axes * impact.drop.body.inertia.inverse() * axes.transpose();
    w_ = space::inverse_contact_inertia(impact.drop.body.mass, inverse_inertia_, arm_);
  }

  void write() {
    write_contact();
    if (law_.friction == analytic::FrictionKind::coulomb && law_.friction_value > 0) write_path();
    write_restitution();
    write_velocities();
  }

 private:
  void write_contact() {
    writer_.open("The corner",
                 fmt::format("r from the centre of mass to {}, v = V + ω × r its velocity before.  An impulse P there "
                             "changes v by W P, W = 1/m − [r]× I⁻¹ [r]× with I in world axes; A = W_tt, b = W_tn, "
                             "c = W_nn are its parts along the ground, mixed and normal.",
                             impact_.corner_names({impact_.row().corners.front().index})));
    writer_.add_vector("r", "", "", arm_, "m");
    writer_.add_vector("v", "", "", struck_.contact_before, "m/s");
    const double size = w_.trace();
    const auto part = [&](const char* name, double value) {
      writer_.add({.name = name, .value = value, .unit = "1/kg", .size = size});
    };
    part("A₁₁", w_(0, 0));
    part("A₁₂", w_(0, 1));
    part("A₂₂", w_(1, 1));
    part("b₁", w_(0, 2));
    part("b₂", w_(1, 2));
    const Vector3 lever = arm_.cross(Vector3::UnitZ());
    writer_.add({.name = "c",
                 .formula = "1/m + (r × n)·I⁻¹ (r × n)",
                 .numbers = fmt::format("1/{} + {}", writer_.number(impact_.drop.body.mass),
                                        writer_.product(lever, inverse_inertia_ * lever)),
                 .value = w_(2, 2),
                 .unit = "1/kg"});
  }

  /// The path of Keller and Routh.
  void write_path() {
    const double mu = law_.friction_value;
    std::string text = fmt::format(
        "p is the normal impulse so far.  While the corner slips in direction s, dv/dp = W (n − μ s); slip keeps its "
        "direction along an invariant one.  Kind of path ({}): {}.",
        mode_name(struck_.path), path_words(struck_.path));
    if (struck_.is_path_ambiguous) text += "  Slip comes so close to zero that rounding decides this kind.";
    writer_.open("Friction in impulse space", text);
    const Vector2 slip = struck_.contact_before.head<2>(), after = struck_.contact_after.head<2>();
    const double size = struck_.contact_before.norm();
    const auto speed = [&](const char* name, const char* words, double value) {
      writer_.add({.name = name, .formula = words, .value = value, .unit = "m/s", .size = size});
    };
    speed("σ", "slip before", slip.norm());
    if (slip.norm() > 0)
      writer_.add({.name = "φ", .formula = "its angle", .value = angle_of(slip), .unit = "°", .size = 180});
    const Vector2 stick = w_.topLeftCorner<2, 2>().inverse() * w_.block<2, 1>(0, 2);
    const bool sticks = stick.norm() <= mu;
    writer_.add({.name = "μ", .formula = "Coulomb's coefficient", .value = mu});
    writer_.add({.name = "|A⁻¹ b|",
                 .formula = sticks ? "at most μ: the corner can stick" : "beyond μ: the corner cannot stick",
                 .value = stick.norm(),
                 .size = mu});
    write_directions(mu);
    if (std::isfinite(struck_.slip_stop_impulse)) {
      writer_.add({.name = "p stop", .formula = "where slip stops", .value = struck_.slip_stop_impulse, .unit = "N·s"});
    }
    speed("σ least", "smallest slip on the way", struck_.least_slip);
    speed("σ′", "slip after", after.norm());
    if (after.norm() > 0)
      writer_.add({.name = "φ′", .formula = "its angle", .value = angle_of(after), .unit = "°", .size = 180});
  }

  void write_directions(double mu) {
    const space::InvariantDirections all = space::invariant_directions(w_, mu);
    const char* const digits[]{"₁", "₂", "₃", "₄"};
    for (int i = 0; i < all.count; ++i) {
      const space::InvariantDirection& one = all.list[static_cast<std::size_t>(i)];
      const std::string digit = digits[i];
      writer_.add({.name = "φ" + digit,
                   .formula = fmt::format("invariant direction, {}, {}", one.attracts ? "stable" : "unstable",
                                          one.slip_rate > 0 ? "outgoing" : "incoming"),
                   .value = angle_of(one.direction),
                   .unit = "°",
                   .size = 180});
      writer_.add({.name = "f" + digit,
                   .formula = "s·(b − μ A s)",
                   .value = one.slip_rate,
                   .unit = "1/kg",
                   .size = w_.trace()});
      writer_.add(
          {.name = "h" + digit, .formula = "c − μ b·s", .value = one.normal_rate, .unit = "1/kg", .size = w_.trace()});
    }
  }

  [[nodiscard]] std::string law_words() const {
    switch (law_.law) {
      case analytic::RestitutionLaw::newton: return "Newton: the impact ends where v_z′ = −e v_z.";
      case analytic::RestitutionLaw::poisson: return "Poisson: the impact ends at P_z = (1+e) p_c.";
      case analytic::RestitutionLaw::stronge:
        return "Stronge: the impact ends where the work given back is e² times that of compression.";
      case analytic::RestitutionLaw::viscoelastic: break;
    }
    return "Viscoelastic: the impact ends where the ground has given back what its dampers left.";
  }

  void write_restitution() {
    writer_.open("Restitution", law_words());
    const double v = struck_.contact_before.z(), p = struck_.impulse.z(), e = struck_.restitution();
    const bool rubs = law_.friction == analytic::FrictionKind::coulomb && law_.friction_value > 0;
    writer_.add(
        {.name = "p_c", .formula = "where compression ends", .value = struck_.compression_impulse, .unit = "N·s"});
    Equation end{.name = "P_z", .formula = "where the impact ends", .value = p, .unit = "N·s"};
    if (law_.law == analytic::RestitutionLaw::poisson) {
      end.formula = "(1+e) p_c";
      end.numbers = fmt::format("(1+{})·{}", shortest(law_.restitution), writer_.number(struck_.compression_impulse));
    } else if (!rubs) {
      const double ratio = law_.friction == analytic::FrictionKind::impulse_ratio ? law_.friction_value : 0;
      const Vector2& d = impact_.drop.law.ratio_direction;
      const double along = w_.block<2, 1>(0, 2).dot(d);
      end.formula = ratio == 0 ? "−(1+e) v_z/c" : "−(1+e) v_z/(c + μᵢ b·d)";
      const std::string below = ratio == 0 ? writer_.number(w_(2, 2))
                                           : fmt::format("({} + {}·{})", writer_.number(w_(2, 2)),
                                                         writer_.number(ratio), writer_.number(along));
      end.numbers = fmt::format("−(1+{})·{}/{}", writer_.number(e), writer_.number(v), below);
    }
    writer_.add(end);
    writer_.add({.name = "e", .formula = "−v_z′/v_z", .value = e, .size = 1});
  }

  void write_velocities() {
    const space::State& before = impact_.row().before;
    const double mass = impact_.drop.body.mass;
    writer_.open("What the impulse does", "V′ = V + P/m,  ω′ = ω + j with j = I⁻¹ (r × P),  v′ = V′ + ω′ × r.");
    writer_.add_vector("P", "", "", struck_.impulse, "N·s");
    for (int k = 0; k < 3; ++k) {
      const char axis = "xyz"[k];
      const double speed = std::max(before.velocity.norm(), struck_.velocity_after.norm());
      writer_.add(
          {.name = fmt::format("V_{}′", axis),
           .formula = fmt::format("V_{0} + P_{0}/m", axis),
           .numbers = fmt::format("{} + {}/{}", writer_.number(before.velocity[k], speed),
                                  writer_.number(struck_.impulse[k], struck_.impulse.norm()), writer_.number(mass)),
           .value = struck_.velocity_after[k],
           .unit = "m/s",
           .size = speed});
    }
    const Vector3 turn = inverse_inertia_ * arm_.cross(struck_.impulse);
    for (int k = 0; k < 3; ++k) {
      const char axis = "xyz"[k];
      const double rate = std::max(before.angular_velocity.norm(), turn.norm());
      writer_.add({.name = fmt::format("ω_{}′", axis),
                   .formula = fmt::format("ω_{0} + j_{0}", axis),
                   .numbers = fmt::format("{} + {}", writer_.number(before.angular_velocity[k], rate),
                                          writer_.number(turn[k], rate)),
                   .value = struck_.angular_velocity_after[k],
                   .unit = "rad/s",
                   .size = rate});
    }
    writer_.add_vector("v", "′", "", struck_.contact_after, "m/s");
  }

  const ImpactInSpace& impact_;
  StepWriter& writer_;
  const analytic::ImpactLaw& law_;
  const space::Impact& struck_;
  Vector3 arm_;
  Matrix3 inverse_inertia_, w_;
};

}  // namespace

void write_corner_impact(const ImpactInSpace& impact, StepWriter& writer) { CornerImpact(impact, writer).write(); }

}  // namespace clatter::validation::inline reports
