// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/scene_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/floors.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/pad.hpp"

namespace clatter::validation {
namespace {

using numeric::FrictionLaw;

/// What a head says of a scene, part by part with commas between them; what unsettled keys say is left out.
class Phrases {
 public:
  explicit Phrases(const KeyNames& unsettled) : unsettled_(unsettled) {}

  /// Adds the words, unless one of the keys that they speak of is unsettled.
  Phrases& add(const std::string& words, std::initializer_list<std::string_view> keys = {}) {
    const auto is_open = [&](std::string_view key) { return is_unsettled(key); };
    if (words.empty() || std::any_of(keys.begin(), keys.end(), is_open)) return *this;
    text_ += (text_.empty() ? "" : ", ") + words;
    return *this;
  }
  /// Whether a key, or a part of the list that it is, is unsettled.
  [[nodiscard]] bool is_unsettled(std::string_view key) const {
    return std::any_of(unsettled_.begin(), unsettled_.end(), [&](const std::string& name) {
      return name == key || (name.starts_with(key) && name[key.size()] == '.');
    });
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const KeyNames& unsettled_;
  std::string text_;
};

/// "NAME WORDS", or one of them where the other is empty.
std::string after(const std::string& name, const std::string& words) {
  return name.empty() || words.empty() ? name + words : name + " " + words;
}

/// By its sizes and mass.
std::string shape_words(const BodyScene& body, Model model, const KeyNames& unsettled) {
  if (body.shape == BodyScene::Shape::mesh) return fmt::format("mesh {}", body.file);
  const bool is_rod = body.shape == BodyScene::Shape::rod;
  Phrases words(unsettled);
  if (body.has_length()) words.add(fmt::format("{} m", shortest(body.length)), {"body.length"});
  const bool is_thin = body.is_thin_rod(), has_mesh = model == Model::continuous;
  const std::string radius = fmt::format("radius {} m", shortest(body.meshed_radius()));
  if (body.has_radius() && !is_thin) words.add(radius, {"body.radius"});
  else if (is_rod && has_mesh) words.add(radius + " (thin: 0.01 of the length)", {"body.radius", "body.length"});
  const numeric::Vector3& size = body.size;
  if (body.has_size())
    words.add(fmt::format("{} × {} × {} m", shortest(size.x()), shortest(size.y()), shortest(size.z())), {"body.size"});
  words.add(fmt::format("{} kg", shortest(body.mass)), {"body.mass"});
  const bool says_thin = is_thin && !has_mesh && !words.is_unsettled("body.radius");
  return after(says_thin ? "thin rod" : shape_names()[static_cast<std::size_t>(body.shape)], words.text());
}

std::string body_words(const BodyScene& body, const KeyNames& unsettled) {
  Phrases mesh(unsettled);
  if (body.shape == BodyScene::Shape::rod) {
    const int sectors = body.meshed_sectors();
    mesh.add(fmt::format("{} elements ({} sectors, {} rings, {} layers)",
                         static_cast<long long>(sectors) * body.meshed_rings() * body.layers, sectors,
                         body.meshed_rings(), body.layers),
             {"body.mesh.sectors", "body.mesh.rings", "body.mesh.layers"});
  } else if (body.shape == BodyScene::Shape::box) {
    mesh.add(fmt::format("{} × {} × {} elements", body.nx, body.ny, body.nz),
             {"body.mesh.nx", "body.mesh.ny", "body.mesh.nz"});
  } else if (body.is_smooth()) {
    mesh.add("smooth", {"body.mesh.sectors", "body.mesh.rings"});
  } else if (body.is_round()) {
    mesh.add(fmt::format("a mesh of {} sectors, {} rings to the equator", body.meshed_sectors(), body.meshed_rings()),
             {"body.mesh.sectors", "body.mesh.rings"});
  }
  return shape_words(body, Model::continuous, unsettled) + (mesh.text().empty() ? "" : "; " + mesh.text());
}

/// 1e11 instead of 100000000000.
std::string in_powers(double value) {
  if (value != 0 && (value >= 1e6 || value < 1e-4)) {
    const std::string digits = shortest(value / std::pow(10, std::floor(std::log10(value))));
    const int exponent = static_cast<int>(std::floor(std::log10(value)));
    double back = 0;
    if (read_number(fmt::format("{}e{}", digits, exponent), back) && back == value)
      return fmt::format("{}e{}", digits, exponent);
  }
  return shortest(value);
}

std::string friction_words(const numeric::Ground& ground) {
  if (!ground.has_friction()) return "no friction";
  std::string law;
  if (ground.friction == FrictionLaw::regularised)
    law = fmt::format(", regularised at {} m/s", shortest(ground.regularisation_speed));
  if (ground.friction == FrictionLaw::local) law = ", each place by its own slip";
  if (ground.static_friction == ground.sliding_friction)
    return fmt::format("friction μ = {}{}", shortest(ground.sliding_friction), law);
  return fmt::format("friction μₛ = {}, μₖ = {}{}", shortest(ground.static_friction), shortest(ground.sliding_friction),
                     law);
}

std::string in_brackets(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "(" : ", ") + shortest(number);
  return text + ")";
}

std::string clearance_words(const Scene& scene) {
  return fmt::format("from a clearance of {} m", shortest(*scene.clearance));
}

std::string tilt_words(const Scene& scene) {
  return scene.tilt_deg != 0 ? fmt::format("tilted by {}°", shortest(scene.tilt_deg)) : "";
}

/// How the body comes to the ground, without vectors: zeros, too, and the speed of a fall, which is computed.
std::string plain_drop_words(const Scene& scene, const KeyNames& unsettled) {
  const double fallen = scene.clearance ? -scene.touch_velocity().z() : scene.speed;
  const std::string speed = scene.falls() ? significant(fallen, 6) : shortest(scene.speed);
  const std::string angle = Phrases(unsettled)
                                .add(fmt::format("{}°", shortest(scene.angle_deg)), {"drop.angle_deg"})
                                .add(tilt_words(scene), {"drop.tilt_deg"})
                                .text();
  const std::string fall = Phrases(unsettled)
                               .add(fmt::format("at {} m/s", speed), {"drop.speed", "drop.height", "drop.clearance",
                                                                      scene.falls() ? "world.gravity" : "drop.speed"})
                               .text();
  Phrases height(unsettled);
  if (scene.height) height.add(fmt::format("from {} m", shortest(*scene.height)), {"drop.height"});
  if (scene.clearance) height.add(clearance_words(scene), {"drop.clearance"});
  const bool has_both = !fall.empty() && !height.text().empty();
  return Phrases(unsettled)
      .add(after(after(angle, fall), has_both ? "(" + height.text() + ")" : height.text()))
      .add(fmt::format("tangential {} m/s", shortest(scene.tangential_velocity)), {"drop.tangential_velocity"})
      .add(fmt::format("spin {} rad/s", shortest(scene.spin)), {"drop.spin"})
      .text();
}

void add_gravity(const Scene& scene, Phrases& words) {
  words.add(fmt::format("gravity {} m/s²", shortest(scene.world.gravity)), {"world.gravity"});
  const double slope = scene.world.incline_deg;
  if (slope == 0) return;
  words.add(
      fmt::format("ground that slopes {}° down to the {}", shortest(std::fabs(slope)), slope > 0 ? "right" : "left"),
      {"world.incline_deg"});
}

std::vector<std::string> discrete_summary(const Scene& scene, const KeyNames& unsettled) {
  Phrases drop(unsettled);
  drop.add(scene.has_vectors() ? scene.drop_words(unsettled) : plain_drop_words(scene, unsettled));
  add_gravity(scene, drop);
  return {shape_words(scene.body, Model::discrete, unsettled), "drop: " + drop.text()};
}

}  // namespace

const char* method_name(numeric::Method method) { return method_names()[static_cast<std::size_t>(method)].c_str(); }

std::string Scene::drop_words(const KeyNames& unsettled) const {
  const bool sweeps_angle = sweep && sweep->quantity == SceneSweep::Quantity::angle_deg;
  std::string turn = sweeps_angle ? fmt::format("{}° to {}°", shortest(sweep->from), shortest(sweep->to))
                                  : fmt::format("{}°", shortest(angle_deg));
  if (!attitude.empty()) turn = "attitude " + in_brackets(attitude);
  Phrases turns(unsettled), way(unsettled), words(unsettled);
  turns.add(turn, {"drop.angle_deg", "drop.attitude", "drop.orientation"});
  turns.add(tilt_words(*this), {"drop.tilt_deg"});
  if (is_released()) {
    way.add(fmt::format("at the release, {} {} m above the ground",
                        release.clearance ? "the lowest point" : "the centre of mass",
                        shortest(release.clearance ? *release.clearance : *release.height)),
            {"drop.release.clearance", "drop.release.height"});
  }
  if (request.starts_on_ground) way.add("at rest on the ground", {"drop.start"});
  else if (topple) way.add(fmt::format("toppled from {} m", shortest(*topple)), {"drop.topple"});
  else if (height) way.add(fmt::format("from {} m", shortest(*height)), {"drop.height"});
  else if (clearance) way.add(clearance_words(*this), {"drop.clearance"});
  else if (velocity.empty()) way.add(fmt::format("at {} m/s", shortest(speed)), {"drop.speed"});
  words.add(after(turns.text(), way.text()));
  if (!velocity.empty()) words.add(fmt::format("velocity {} m/s", in_brackets(velocity)), {"drop.velocity"});
  if (tangential_velocity != 0)
    words.add(fmt::format("tangential {} m/s", shortest(tangential_velocity)), {"drop.tangential_velocity"});
  if (spin != 0) words.add(fmt::format("spin {} rad/s", shortest(spin)), {"drop.spin"});
  if (!angular_velocity.empty())
    words.add(fmt::format("angular velocity {} rad/s", in_brackets(angular_velocity)), {"drop.angular_velocity"});
  return words.text();
}

std::vector<std::string> Scene::summary(Model model, const KeyNames& unsettled) const {
  if (model == Model::discrete) return discrete_summary(*this, unsettled);
  const bool sweeps_friction = sweep && sweep->quantity == SceneSweep::Quantity::friction;
  const numeric::Ground& ground = world.ground;
  Phrases drop(unsettled), springs(unsettled), contact(unsettled);
  add_gravity(*this, drop.add(drop_words(unsettled)));
  drop.add(world.planar ? "kept in its plane" : "");
  if (ground.is_half_space()) {
    const std::string materials = material_words(half_space);
    contact.add(materials.empty()
                    ? fmt::format("elastic half-space of E* = {} Pa", in_powers(ground.modulus))
                    : fmt::format("elastic half-space of E* = {} Pa ({})", significant(ground.modulus, 4), materials),
                {"ground.modulus", "ground.floor", "ground.body_modulus", "ground.body_material"});
  } else if (ground.is_pad()) {
    springs.add(pad_words(*this), {"ground.curve", "ground.thickness", "ground.under"});
  } else {
    if (pad.thickness) springs.add(fmt::format("pad {} m thick,", shortest(*pad.thickness)), {"ground.thickness"});
    springs.add(fmt::format("k = {} N/m³", in_powers(ground.stiffness)), {"ground.stiffness"});
    if (!ground_restitution) springs.add(fmt::format("c = {} N·s/m⁴", in_powers(ground.damping)), {"ground.damping"});
  }
  if (!ground.is_half_space())
    contact.add(
        after(springs.text(), fmt::format("over the {} area", area_names()[static_cast<std::size_t>(ground.area)])));
  if (half_space.floor && !ground.is_damped())
    contact.add("undamped, e = 1: from 0 to 1 no source gives a restitution",
                {"ground.dissipation", "ground.restitution"});
  else if (ground_restitution)
    contact.add(fmt::format("e = {} in the first impact ({} {})", shortest(*ground_restitution),
                            ground.has_dissipation() ? "dissipation" : "c =",
                            ground.has_dissipation() ? significant(ground.dissipation, 4) + " s/m"
                                                     : significant(ground.damping, 4) + " N·s/m⁴"),
                {"ground.restitution"});
  else if (ground.has_dissipation())
    contact.add(fmt::format("dissipation {} s/m", in_powers(ground.dissipation)), {"ground.dissipation"});
  contact.add(sweeps_friction ? fmt::format("friction μ = {} to {}", shortest(sweep->from), shortest(sweep->to))
                              : friction_words(ground),
              {"ground.static_friction", "ground.sliding_friction", "ground.regularisation_speed"});
  return {body_words(body, unsettled), "drop: " + drop.text(), "ground: " + contact.text()};
}

Value scene_value(const Scene& scene, Model model, std::optional<double> approach) {
  Value fields;
  if (!scene.path.empty()) fields["file"] = scene.path;
  add_keys(scene, model, fields);
  if (!material_words(scene.half_space).empty()) {
    const ModulusRange range = reduced_modulus(scene.half_space);
    fields["ground"]["reduced_modulus"] = Value::Fields{{"value", range.middle},
                                                        {"least", range.least},
                                                        {"largest", range.largest},
                                                        {"sources", material_sources(scene.half_space)}};
  }
  if (scene.sweep) fields["sweep"][scene.sweep->name()] = scene.sweep->fields();
  if (model == Model::discrete || approach) fields["discrete_law"] = law_fields(scene, approach);
  return fields;
}

std::string scene_line(const Scene& scene, Model model) { return "scene: " + compact_json(scene_value(scene, model)); }

std::vector<std::string> scene_head(const Scene& scene, Model model, std::optional<double> approach,
                                    const KeyNames& unsettled) {
  const auto is_settled = [&](std::string_view key) {
    return std::find(unsettled.begin(), unsettled.end(), key) == unsettled.end();
  };
  std::vector<std::string> head = scene.summary(model, unsettled);
  const bool is_one_body =
      std::none_of(unsettled.begin(), unsettled.end(), [](const std::string& key) { return key.starts_with("body."); });
  if (is_one_body) {
    head.insert(head.begin() + 1, body_words(scene, model));
    if (const std::string words = mesh_words(scene); !words.empty()) head.insert(head.begin() + 2, words);
    if (const std::string doubts = unit_doubts(scene, body_properties(scene, model)); !doubts.empty())
      head.insert(head.begin(), doubts);
    if (const std::string doubts = pad_doubts(scene); !doubts.empty() && is_settled("ground.thickness"))
      head.insert(head.begin(), "!: warning: " + doubts);
  }
  if (model == Model::discrete) {
    std::string words = "impact: " + law_words(scene, approach, unsettled);
    if (is_settled("run.impacts")) words += fmt::format("; at most {} impacts", scene.most_impacts());
    if (is_settled("run.digits")) words += fmt::format(", {} digits", scene.accuracy.digits);
    head.push_back(words);
  } else if (approach) {
    head.push_back("discrete model: " + law_words(scene, approach));
  }
  return head;
}

Report scene_report(const std::string& command, const std::string& what, const char* model_name, const Scene& scene,
                    Model model, std::optional<double> approach) {
  Report report = begun_report(command, what);
  report.head = scene_head(scene, model, approach);
  report.fields["model"] = model_name;
  report.fields["scene"] = scene_value(scene, model, approach);
  report.fields["body"] = body_value(scene, model);
  return report;
}

Column swept_column(const SceneSweep& sweep) {
  const bool over_angle = sweep.quantity == SceneSweep::Quantity::angle_deg;
  return {.name = sweep.name(),
          .heading = over_angle ? "angle" : "μₖ",
          .unit = over_angle ? "°" : "",
          .meaning = "swept: " + swept_words(sweep)};
}

std::string swept_words(const SceneSweep& sweep) {
  return sweep.quantity == SceneSweep::Quantity::angle_deg ? "contact angle θ" : "friction coefficient μ";
}

Range2 swept_range(double first, double last) {
  return first < last ? Range2{first, last} : Range2{first - 0.5, last + 0.5};
}

void add_interruption(const SceneSweep& sweep, std::size_t done, Report& report) {
  const std::size_t values = sweep.values().size();
  if (done < values) report.notes.push_back(fmt::format("interrupted: {} of {} values", done, values));
}

}  // namespace clatter::validation
