// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/story.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "analytic/plane/contact_angles.hpp"
#include "validation/demo/page.hpp"
#include "validation/demo/story_pictures.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/html.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/planned_run.hpp"

namespace clatter::validation::inline demo {
namespace {

using analytic::Angle;
using analytic::ContactAngles;
using analytic::degrees_per_radian;

constexpr double shown_angle = 10;  // of the page's first picture [°]

/// Of the elastic thin rod of 1 m and 1 kg at 1 m/s, so that the numbers are those in N·s and rad/s.
ContactAngles rod_at(double degrees) { return contact_angles(Angle::from_degrees(degrees), {}); }

double ratio(const ContactAngles& rod) { return rod.impulse[1] / rod.impulse[0]; }

/// Of the three impulses; as θ → 0 that of the flat landing.
double sum(const ContactAngles& rod) { return rod.impulse[0] + rod.impulse[1] + rod.impulse[2]; }

struct StoryStep {
  std::string title, picture, text, link;
};

std::string item(const StoryStep& step, std::size_t n) {
  return fmt::format(
      "<li id=\"story-{0}\"><h3>{0}. {1}</h3>\n{2}\n<p>{3}</p>\n<a class=\"show\" href=\"?predict=0&amp;{4}\">Show "
      "step {0} in the picture</a></li>\n",
      n, html_escaped(step.title), step.picture, html_escaped(step.text), step.link);
}

StoryStep first_blow(const ContactAngles& rod) {
  const std::string words = fmt::format("A rod that leans by {}° strikes with its left end", shown_angle);
  return {
      "It strikes at an angle",
      rod_picture({.angle = rod.theta,
                   .is_left = true,
                   .impulse = rod.impulse[0],
                   .strongest = rod.impulse[1],
                   .words = words}),
      fmt::format(
          "A thin rod of 1 m and 1 kg comes down at 1 m/s and leans by {}°. The end that strikes takes {} N·s; a "
          "rod that lands flat takes {} N·s. A soft blow, but it sets the rod turning, at {} rad/s.",
          shown_angle, significant(rod.impulse[0], 4), significant(sum(rod_at(0)), 4), significant(rod.angular[0], 4)),
      "impact=1"};
}

StoryStep second_blow(const ContactAngles& rod) {
  const Angle beta = Angle::from_radians(rod.beta.angle);
  // Eq. 8 of an elastic impact: P (1 + 3 cos² β) = 2 v of the end.
  const double speed = rod.impulse[1] * (1 + 3 * beta.cosine * beta.cosine) / 2;
  const std::string words =
      fmt::format("The rod has turned over its end and strikes with the right one, at {:.2f}°", beta.degrees);
  return {
      "The second blow is harder",
      rod_picture(
          {.angle = beta, .is_left = false, .impulse = rod.impulse[1], .strongest = rod.impulse[1], .words = words}),
      fmt::format(
          "The turning throws the other end down, at {} m/s instead of 1. It strikes {} s later with {} N·s, {} "
          "times the first blow: this is clattering.",
          significant(speed, 4), significant(rod.beta.time, 3), significant(rod.impulse[1], 4),
          significant(ratio(rod), 3)),
      "impact=2"};
}

StoryStep doubling(double fold) {
  Curve curve{.points = {}, .colour = "#0072b2", .name = "P₂/P₁"};
  for (int i = 0; i <= 100; ++i) {
    const double theta = 0.01 + (fold - 0.02) * i / 100;
    curve.points.push_back({theta, ratio(rod_at(theta))});
  }
  const ContactAngles flat = rod_at(0.1);
  return {
      "The flatter, the more: twice as hard",
      curve_picture(
          {.curves = {curve},
           .x_end = 90,
           .y_end = 2,
           .axes = {"first angle θ in °", "second blow over first"},
           .words = "The second blow over the first against the first angle: 2 for a flat rod, falling to 0"}),
      fmt::format(
          "At {}° the second blow is {} times the first, at 1° {}, at 0.1° {}. The three angles are then as 2 : {} : "
          "{}, and the three blows together make {} N·s, those of the flat landing.",
          shown_angle, significant(ratio(rod_at(shown_angle)), 4), significant(ratio(rod_at(1)), 5),
          significant(ratio(flat), 6), significant(2 * flat.beta.angle / flat.theta.radians, 5),
          significant(2 * flat.gamma.angle / flat.theta.radians, 5), significant(sum(flat), 6)),
      "angle=1&amp;impact=2"};
}

/// β or γ up to the fold.
Curve angles_up_to(const analytic::RegimeBoundary& end, bool third) {
  Curve curve{.points = {},
              .colour = third ? "#cc79a7" : "#0072b2",
              .is_dashed = third,
              .name = third ? "γ" : "β",
              .is_fold = true};
  for (int i = 1; i <= 100; ++i) {
    const double theta = end.theta * degrees_per_radian * i / 101;
    const ContactAngles rod = rod_at(theta);
    curve.points.push_back({theta, (third ? rod.gamma : rod.beta).angle * degrees_per_radian});
  }
  curve.points.push_back({end.theta * degrees_per_radian, (third ? end.gamma : end.beta) * degrees_per_radian});
  return curve;
}

StoryStep folds(const analytic::RegimeBoundary& second) {
  const analytic::RegimeBoundary third = regime_boundary(analytic::ImpactNumber::third, {});
  return {
      "The fold: where it ends",
      curve_picture(
          {.curves = {angles_up_to(second, false), angles_up_to(third, true)},
           .axes = {"first angle θ in °", "next angles in °"},
           .words =
               "Angles of the second and third impact against the first angle; each curve ends upright, at its fold"}),
      fmt::format(
          "The steeper it lands, the later the second blow, and beyond {}° there is none: at {}° the other end only "
          "grazes the ground, with no speed, and turns away. The third blow ends likewise at {}°.",
          significant(second.theta * degrees_per_radian, 6), significant(second.beta * degrees_per_radian, 4),
          significant(third.theta * degrees_per_radian, 6)),
      "angle=58&amp;impact=2"};
}

StoryStep phone() {
  Scene scene = case_scene("phone-elastic");
  scene.request.impacts = 2;
  const numeric::Body body = scene.make_body();
  const numeric::Simulation run =
      run_to_digits(body, scene.world, scene.start(body), scene.request, scene.accuracy).run;
  if (run.impacts.size() < 2) throw std::logic_error("the story: a phone strikes twice");
  const double first = run.impacts[0].value.peak_force, second = run.impacts[1].value.peak_force;
  return {"A phone does so, too",
          bar_picture({{first, "first blow"}, {second, "second blow"}},
                      "Peak forces of the first and the second blow of a phone"),
          fmt::format(
              "A phone falls from {} m at {}° on a springy floor. The other model follows it through each contact, as "
              "long as that lasts: its second peak of force is {} times the first.",
              shortest(scene.height.value_or(0)), shortest(scene.angle_deg), significant(second / first, 3)),
          "body=phone&amp;height=1&amp;gravity=9.81&amp;stiffness=1e8&amp;damping=0&amp;angle=10&amp;impact=2"};
}

}  // namespace

std::string story_html() {
  const ContactAngles rod = rod_at(shown_angle);
  const analytic::RegimeBoundary second = regime_boundary(analytic::ImpactNumber::second, {});
  const StoryStep steps[]{first_blow(rod), second_blow(rod), doubling(second.theta * degrees_per_radian), folds(second),
                          phone()};
  std::string html =
      "<section id=\"story\" aria-labelledby=\"story-title\">\n<details open><summary><h2 id=\"story-title\">The story "
      "in five steps</h2></summary>\n<ol>\n";
  std::size_t n = 0;
  for (const StoryStep& step : steps) html += item(step, ++n);
  return html + "</ol>\n</details>\n</section>\n";
}

std::string page_with_story() {
  std::string page(demo_page());
  if (page.empty()) return page;
  const std::string place = "<!--STORY-->";
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw std::logic_error("the page has no place for its story");
  return page.replace(at, place.size(), story_html());
}

}  // namespace clatter::validation::inline demo
