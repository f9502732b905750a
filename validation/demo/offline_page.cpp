// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/offline_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "validation/demo/api.hpp"
#include "validation/demo/page.hpp"
#include "validation/demo/story.hpp"
#include "validation/output/json.hpp"
#include "validation/output/version.hpp"

namespace clatter::validation::inline demo {
namespace {

Json known_scenes() { return Json::parse(demo_requests()).at("scenes"); }

/// JSON that may stand inside a script element.
std::string embeddable(const Json& json) {
  std::string text = json.dump();
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

constexpr int kept_digits = 8;

/// What a picture needs of a time history: a copy has to be small.
void shorten_history(Json& answer) {
  if (!answer.contains("history")) return;
  for (const char* unread : {"point_vx", "point_vy", "point_vz", "energy_translation", "energy_potential"})
    answer["history"].erase(unread);
  for (auto& [name, column] : answer["history"].items()) {
    for (Json& number : column) {
      if (number.is_number_float()) number = std::stod(fmt::format("{:.{}g}", number.get<double>(), kept_digits));
    }
  }
}

/// The page draws contact angles without their errors.
void leave_out_errors(Json& answer) {
  if (!answer.contains("rows")) return;
  for (Json& row : answer["rows"]) row.erase("error_estimate");
}

/// The page shows equations as TeX alone.
void leave_out_texts(Json& answer) {
  if (!answer.contains("steps")) return;
  for (Json& step : answer["steps"]) {
    for (Json& equation : step["equations"]) {
      for (const char* name : {"symbolic", "numeric", "value", "error", "unit"}) equation.erase(name);
    }
  }
}

/// @throws std::logic_error if the page's own request is refused.
Json answered(const Json& request) {
  const ApiAnswer answer = answer_request("/api/" + request.at("path").get<std::string>(), request.at("body").dump());
  if (answer.status != 200) throw std::logic_error("the page's request for an offline copy: " + answer.body);
  Json json = Json::parse(answer.body);
  shorten_history(json);
  leave_out_errors(json);
  leave_out_texts(json);
  return json;
}

}  // namespace

std::vector<std::string> offline_scenes() {
  std::vector<std::string> names;
  for (const Json& scene : known_scenes()) names.push_back(scene.at("name"));
  return names;
}

std::string offline_page(const std::vector<std::string>& scenes,
                         const std::function<bool(std::size_t, std::size_t)>& progress) {
  Json chosen = Json::array();
  std::size_t count = 0, done = 0;
  for (const Json& scene : known_scenes()) {
    if (std::find(scenes.begin(), scenes.end(), scene.at("name")) == scenes.end()) continue;
    chosen.push_back(scene);
    count += scene.at("requests").size();
  }
  for (Json& scene : chosen) {
    scene["answers"] = Json::object();
    for (const Json& request : scene.at("requests")) {
      if (!progress(done++, count)) return "";
      scene["answers"][request.at("key").get<std::string>()] = answered(request);
    }
    scene.erase("requests");
  }
  std::string page = page_with_story();
  const std::string place = "id=\"precomputed\">{}<";
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw std::logic_error("the page has no place for precomputed scenes");
  return page.replace(at + place.size() - 3, 2, embeddable({{"clatter", version}, {"scenes", chosen}}));
}

}  // namespace clatter::validation::inline demo
