#include "validation/scene/scene.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analytic/body_motion.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

using analytic::FrictionKind;
using analytic::RestitutionLaw;

constexpr double largest = std::numeric_limits<double>::max();
constexpr Range any{-largest, largest, false, "a finite number"};
constexpr Range positive{0, largest, true, "greater than 0"};
constexpr Range not_negative{0, largest, false, "at least 0"};
// Squares of lengths must not overflow.
constexpr Range size_range{1e-150, 1e150, false, "from 1e-150 to 1e150"};
constexpr Range mass_range{1e-200, 1e200, false, "from 1e-200 to 1e200"};

const std::vector<std::string> law_names{"newton", "poisson", "stronge"};

using Text = std::optional<std::string>;

void exclude(const Text& first, const char* first_name, const Text& second, const char* second_name) {
  if (!first || !second) return;
  throw BadInput(fmt::format("{} {} and {} {}: give one of them, not both", first_name, *first,
                             second_name, *second));
}

void only_for(const Text& text, const char* option, const char* body) {
  if (text) throw BadInput(fmt::format("{} {}: only for --body {}", option, *text, body));
}

void read_into(double& value, const char* option, const Text& text, const Range& range) {
  if (text) value = read_number_option(option, *text, range);
}

/// "LxWxT" or "L,W,T".
std::array<double, 3> read_size(const std::string& text) {
  std::array<double, 3> size{};
  std::size_t begin = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? text.find_first_of("x,", begin) : text.size();
    if (end == std::string::npos) {
      throw BadInput(fmt::format("--size '{}': must be three lengths in m, as in 0.106x0.044x0.019", text));
    }
    size[static_cast<std::size_t>(i)] =
        read_number_option("--size", text.substr(begin, end - begin), size_range);
    begin = end + 1;
  }
  return size;
}

void read_body(const SceneTexts& texts, Scene& scene) {
  if (texts.body) scene.is_box = read_name_option("--body", *texts.body, {"rod", "box"}) == 1;
  double mass = 1;
  read_into(mass, "--mass", texts.mass, mass_range);
  scene.rod.mass = scene.box.mass = mass;
  if (!scene.is_box) {
    only_for(texts.size, "--size", "box");
    read_into(scene.rod.length, "--length", texts.length, size_range);
    read_into(scene.rod.radius, "--radius", texts.radius, {0, 1e150, false, "from 0 to 1e150"});
    return;
  }
  only_for(texts.length, "--length", "rod");
  only_for(texts.radius, "--radius", "rod");
  if (!texts.size) throw BadInput("--size: required with --body box, as in 0.106x0.044x0.019 (m)");
  const auto [length, width, thickness] = read_size(*texts.size);
  scene.box = {.mass = mass, .length = length, .width = width, .thickness = thickness};
}

void read_law(const SceneTexts& texts, Scene& scene) {
  exclude(texts.impulse_ratio, "--impulse-ratio", texts.friction, "--friction");
  read_into(scene.law.restitution, "--restitution", texts.restitution, {0, 1, false, "from 0 to 1"});
  if (texts.restitution_law) {
    scene.law.law = static_cast<RestitutionLaw>(
        read_name_option("--restitution-law", *texts.restitution_law, law_names));
  }
  if (texts.impulse_ratio) scene.law.friction = FrictionKind::impulse_ratio;
  read_into(scene.law.friction_value, "--impulse-ratio", texts.impulse_ratio, any);
  if (texts.friction) scene.law.friction = FrictionKind::coulomb;
  read_into(scene.law.friction_value, "--friction", texts.friction, not_negative);
}

/// Height of the centre of mass when the body first touches the ground.
double touch_height(const Scene& scene) {
  const analytic::PlanarBody body = scene.body();
  return analytic::BodyMotion(body, analytic::Angle::from_degrees(scene.angle_deg), {}, 0)
      .centre_height();
}

void read_speed(const SceneTexts& texts, Scene& scene) {
  exclude(texts.speed, "--speed", texts.height, "--height");
  read_into(scene.speed, "--speed", texts.speed, positive);
  if (!texts.height) return;
  const double height = read_number_option("--height", *texts.height, positive);
  if (!(scene.gravity > 0)) {
    throw BadInput(fmt::format("--height {}: needs --gravity greater than 0", *texts.height));
  }
  const double touch = touch_height(scene);
  if (!(height > touch)) {
    throw BadInput(fmt::format(
        "--height {}: must be greater than {} m, the height of the centre of mass at the first touch",
        *texts.height, significant(touch, 6)));
  }
  scene.height = height;
  scene.speed = std::sqrt(2 * scene.gravity * (height - touch));
}

std::string friction_summary(const analytic::ImpactLaw& law) {
  if (law.friction == FrictionKind::none) return "no friction";
  const char* name = law.friction == FrictionKind::coulomb ? "Coulomb friction μ" : "impulse ratio μᵢ";
  return fmt::format("{} = {}", name, shortest(law.friction_value));
}

}  // namespace

const char* law_name(RestitutionLaw law) { return law_names[static_cast<std::size_t>(law)].c_str(); }

double read_number_option(const std::string& option, const std::string& text, const Range& range) {
  double value = 0;
  const bool inside = read_number(text, value) && value >= range.low && value <= range.high &&
                      !(range.low_open && value == range.low);
  if (!inside) throw BadInput(fmt::format("{} '{}': must be {}", option, text, range.words));
  return value;
}

int read_integer_option(const std::string& option, const std::string& text, int low, int high) {
  long long value = 0;
  if (!read_integer(text, value) || value < low || value > high) {
    throw BadInput(
        fmt::format("{} '{}': must be a whole number from {} to {}", option, text, low, high));
  }
  return static_cast<int>(value);
}

std::size_t read_name_option(const std::string& option, const std::string& text,
                             const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return i;
  }
  throw BadInput(fmt::format("{} '{}': must be one of {}; did you mean {}?", option, text,
                             fmt::join(names, ", "), nearest_name(text, names)));
}

Scene read_scene(const SceneTexts& texts) {
  Scene scene;
  if (!texts.angle) throw BadInput("--angle: required, the inclination at the first impact in degrees");
  read_into(scene.angle_deg, "--angle", texts.angle, {0, 90, false, "from 0 to 90 degrees"});
  read_into(scene.gravity, "--gravity", texts.gravity, not_negative);
  read_into(scene.tangential_velocity, "--tangential-velocity", texts.tangential_velocity, any);
  read_into(scene.spin, "--spin", texts.spin, any);
  read_body(texts, scene);
  read_law(texts, scene);
  read_speed(texts, scene);
  if (texts.impacts) scene.impacts = read_integer_option("--impacts", *texts.impacts, 1, 1000000);
  if (texts.digits) scene.digits = read_integer_option("--digits", *texts.digits, 1, 15);
  scene.require_digits = texts.require_digits;
  return scene;
}

analytic::PlanarBody Scene::body() const {
  return is_box ? analytic::make_box(box) : analytic::make_rod(rod);
}

analytic::Drop Scene::drop() const {
  return {.body = body(),
          .inclination = analytic::Angle::from_degrees(angle_deg),
          .velocity = {.normal = -speed, .tangential = tangential_velocity, .angular = spin},
          .gravity = gravity,
          .law = law};
}

Json Scene::json() const {
  Json impact{{"restitution", law.restitution}, {"law", law_name(law.law)}};
  impact[law.friction == FrictionKind::coulomb ? "friction" : "impulse_ratio"] = law.friction_value;
  Json shape{{"shape", is_box ? "box" : "rod"}, {"mass", rod.mass}};
  if (is_box) {
    shape["size"] = Json::array({box.length, box.width, box.thickness});
  } else {
    shape["length"] = rod.length;
    shape["radius"] = rod.radius;
  }
  return Json{{"drop",
               {{"angle_deg", angle_deg},
                {"speed", number_or_null(speed)},
                {"height", height ? Json(*height) : Json(nullptr)},
                {"tangential_velocity", tangential_velocity},
                {"spin", spin}}},
              {"world", {{"gravity", gravity}}},
              {"impact", impact},
              {"body", shape},
              {"run", {{"impacts", impacts}, {"digits", digits}, {"require_digits", require_digits}}}};
}

std::vector<std::string> Scene::summary() const {
  const std::string what =
      is_box ? fmt::format("box {} × {} × {} m, {} kg", shortest(box.length), shortest(box.width),
                           shortest(box.thickness), shortest(box.mass))
      : rod.radius > 0
          ? fmt::format("rod {} m, radius {} m, {} kg", shortest(rod.length), shortest(rod.radius),
                        shortest(rod.mass))
          : fmt::format("thin rod {} m, {} kg", shortest(rod.length), shortest(rod.mass));
  std::string motion = fmt::format("drop: {}° at {} m/s", shortest(angle_deg), shortest(speed));
  if (height) motion += fmt::format(" (from {} m)", shortest(*height));
  motion += fmt::format(", tangential {} m/s, spin {} rad/s, gravity {} m/s²",
                        shortest(tangential_velocity), shortest(spin), shortest(gravity));
  return {what, motion,
          fmt::format("impact: e = {} ({}), {}; at most {} impacts, {} digits",
                      shortest(law.restitution), law_name(law.law), friction_summary(law), impacts,
                      digits)};
}

}  // namespace clatter::validation
