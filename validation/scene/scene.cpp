// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "validation/output/number.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation::inline scene {
namespace {

using numeric::FrictionLaw;

std::string body_words(const BodyScene& body) {
  switch (body.shape) {
    case BodyScene::Shape::rod:
      return fmt::format(
          "rod {} m, radius {} m{}, {} kg; {} elements ({} sectors, {} rings, {} layers)", shortest(body.length),
          shortest(body.meshed_radius()), body.is_thin_rod() ? " (thin: 0.01 of the length)" : "", shortest(body.mass),
          static_cast<long long>(body.sectors) * body.rings * body.layers, body.sectors, body.rings, body.layers);
    case BodyScene::Shape::box:
      return fmt::format("box {} × {} × {} m, {} kg; {} × {} × {} elements", shortest(body.size.x()),
                         shortest(body.size.y()), shortest(body.size.z()), shortest(body.mass), body.nx, body.ny,
                         body.nz);
    case BodyScene::Shape::mesh: break;
  }
  return fmt::format("mesh {}", body.file);
}

/// 1e11 instead of 100000000000.
std::string in_powers(double value) {
  if (value != 0 && (value >= 1e6 || value < 1e-4)) {
    const std::string digits = shortest(value / std::pow(10, std::floor(std::log10(value))));
    const int exponent = static_cast<int>(std::floor(std::log10(value)));
    double back = 0;
    if (read_number(fmt::format("{}e{}", digits, exponent), back) && back == value) {
      return fmt::format("{}e{}", digits, exponent);
    }
  }
  return shortest(value);
}

std::string friction_words(const numeric::Ground& ground) {
  if (!ground.has_friction()) return "no friction";
  std::string law;
  if (ground.friction == FrictionLaw::regularised) {
    law = fmt::format(", regularised at {} m/s", shortest(ground.regularisation_speed));
  }
  if (ground.friction == FrictionLaw::local) law = ", each place by its own slip";
  if (ground.static_friction == ground.sliding_friction) {
    return fmt::format("friction μ = {}{}", shortest(ground.sliding_friction), law);
  }
  return fmt::format("friction μₛ = {}, μₖ = {}{}", shortest(ground.static_friction), shortest(ground.sliding_friction),
                     law);
}

std::string discrete_body_words(const BodyScene& body) {
  switch (body.shape) {
    case BodyScene::Shape::rod:
      if (!(body.radius > 0)) return fmt::format("thin rod {} m, {} kg", shortest(body.length), shortest(body.mass));
      return fmt::format("rod {} m, radius {} m, {} kg", shortest(body.length), shortest(body.radius),
                         shortest(body.mass));
    case BodyScene::Shape::box:
      return fmt::format("box {} × {} × {} m, {} kg", shortest(body.size.x()), shortest(body.size.y()),
                         shortest(body.size.z()), shortest(body.mass));
    case BodyScene::Shape::mesh: break;
  }
  return body_words(body);
}

std::string in_brackets(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "(" : ", ") + shortest(number);
  return text + ")";
}

std::vector<std::string> discrete_summary(const Scene& scene) {
  const std::string speed =
      scene.falls() ? significant(scene.speed, 6) : shortest(scene.speed);  // of the fall: computed
  std::string motion = fmt::format("drop: {}° at {} m/s", shortest(scene.angle_deg), speed);
  if (scene.height) motion += fmt::format(" (from {} m)", shortest(*scene.height));
  if (scene.clearance) motion += fmt::format(" ({} m clear of the ground)", shortest(*scene.clearance));
  motion +=
      fmt::format(", tangential {} m/s, spin {} rad/s", shortest(scene.tangential_velocity), shortest(scene.spin));
  if (scene.has_vectors()) motion = "drop: " + scene.drop_words();
  motion += fmt::format(", gravity {} m/s²", shortest(scene.world.gravity));
  return {discrete_body_words(scene.body), motion};
}

}  // namespace

const char* method_name(numeric::Method method) { return method_names()[static_cast<std::size_t>(method)].c_str(); }

const char* law_name(analytic::RestitutionLaw law) { return law_names()[static_cast<std::size_t>(law)].c_str(); }

Scene Scene::at(double value) const {
  Scene one = *this;
  if (sweep->quantity == SceneSweep::Quantity::angle_deg) one.angle_deg = value;
  else one.world.ground.static_friction = one.world.ground.sliding_friction = value;
  one.sweep.reset();
  return one;
}

Json Scene::json(Model model) const {
  Json json = Json::object();
  if (!path.empty()) json["file"] = text_json(path);
  json.update(keys_json(*this, model));
  if (sweep) {
    json["sweep"][sweep->name()] = sweep->json();
  }
  return json;
}

bool Scene::has_vectors() const { return !attitude.empty() || !velocity.empty() || !angular_velocity.empty(); }

std::string Scene::drop_words() const {
  const bool sweeps_angle = sweep && sweep->quantity == SceneSweep::Quantity::angle_deg;
  std::string words = sweeps_angle ? fmt::format("{}° to {}°", shortest(sweep->from), shortest(sweep->to))
                                   : fmt::format("{}°", shortest(angle_deg));
  if (!attitude.empty()) words = "attitude " + in_brackets(attitude);
  if (tilt_deg != 0) words += fmt::format(", tilted by {}°", shortest(tilt_deg));
  if (!velocity.empty()) words += fmt::format(", velocity {} m/s", in_brackets(velocity));
  else if (clearance) words += fmt::format(", {} m clear of the ground", shortest(*clearance));
  else words += height ? fmt::format(" from {} m", shortest(*height)) : fmt::format(" at {} m/s", shortest(speed));
  if (tangential_velocity != 0) words += fmt::format(", tangential {} m/s", shortest(tangential_velocity));
  if (spin != 0) words += fmt::format(", spin {} rad/s", shortest(spin));
  if (!angular_velocity.empty()) words += fmt::format(", angular velocity {} rad/s", in_brackets(angular_velocity));
  return words;
}

std::vector<std::string> Scene::summary(Model model) const {
  if (model == Model::discrete) return discrete_summary(*this);
  const bool sweeps_friction = sweep && sweep->quantity == SceneSweep::Quantity::friction;
  std::string drop = "drop: " + drop_words();
  drop += fmt::format(", gravity {} m/s²{}", shortest(world.gravity), world.planar ? ", kept in its plane" : "");
  const numeric::Ground& ground = world.ground;
  return {body_words(body), drop,
          fmt::format("ground: k = {} N/m³, c = {} N·s/m⁴ over the {} area, {}", in_powers(ground.stiffness),
                      in_powers(ground.damping), area_names()[static_cast<std::size_t>(ground.area)],
                      sweeps_friction ? fmt::format("friction μ = {} to {}", shortest(sweep->from), shortest(sweep->to))
                                      : friction_words(ground))};
}

}  // namespace clatter::validation::inline scene
