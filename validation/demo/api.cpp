// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/demo/api.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "validation/demo/scene_exchange.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/plan/sequence_method.hpp"
#include "validation/record/history_file.hpp"
#include "validation/reports/angles_report.hpp"
#include "validation/reports/comparison_report.hpp"
#include "validation/reports/explanation_report.hpp"
#include "validation/reports/sequence_report.hpp"
#include "validation/reports/simulation_report.hpp"
#include "validation/scene/discrete_scene.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/named_texts.hpp"
#include "validation/scene/scene_value.hpp"

namespace clatter::validation::inline demo {
namespace {

// A page shows no more than this, and nobody is to keep the server busy for long.
constexpr long long most_impacts = 200, most_angles = 5000, most_evaluations = 3'000'000;

std::string text_of(const std::string& name, const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return shortest(value.get<double>());
  if (!value.is_array()) throw BadInput(name + ": must be a number, a text, true, false or a list of numbers");
  std::string text;
  for (const Json& part : value) {
    if (!part.is_number()) throw BadInput(name + ": must be a list of numbers");
    text += (text.empty() ? "" : "x") + text_of(name, part);
  }
  return text;
}

NamedTexts texts_of(const std::string& body) {
  const Json json = Json::parse(body, nullptr, false);
  if (!json.is_object()) throw BadInput("the body: must be a JSON object of arguments");
  NamedTexts texts;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_null()) texts[name] = text_of(name, value);
  }
  return texts;
}

/// The argument, taken out; "" if it is not given.
std::string taken(NamedTexts& texts, const std::string& name) {
  const auto node = texts.extract(name);
  return node ? node.mapped() : "";
}

void limit(const char* what, long long count, long long most) {
  if (count <= most) return;
  throw BadInput(fmt::format("{} {}: at most {} here; the command line has no such limit", what, count, most));
}

/// The case that is named, taken out of the arguments; nothing if none is.
std::optional<SceneValues> case_values(NamedTexts& texts) {
  const std::string name = taken(texts, "case");
  if (name.empty()) return std::nullopt;
  return SceneValues("scene", case_text(name), scene_keys());
}

/// @throws BadInput for what a page cannot show
void require_drawable(const Scene& scene) {
  if (scene.body.shape == BodyScene::Shape::mesh)
    throw BadInput("body 'mesh': must be rod or box; a page can name no file");
  if (scene.body.is_round()) throw BadInput("body: must be rod or box; the page draws no other shape");
  if (scene.sweep) throw BadInput("case: sweeps a quantity; give another");
  limit("impacts", scene.request.impacts, most_impacts);
}

/// The case or flags alone, with the arguments in it; in the plane or in space.
PreparedScene discrete_scene(NamedTexts texts) {
  const std::optional<SceneValues> given = case_values(texts);
  PreparedScene prepared = read_discrete_scene(given ? *given : scene_values(""), scene_overrides(texts));
  require_drawable(prepared.scene);
  return prepared;
}

Value sequence(NamedTexts texts) {
  const PreparedScene prepared = discrete_scene(std::move(texts));
  return sequence_report(prepared, run_discrete(prepared, SequenceMethod::automatic)).fields;
}

Value explain(NamedTexts texts) {
  const int n = read_integer_option("impact", taken(texts, "impact"), 1, most_impacts);
  return explanation_fields(explain_impact(discrete_scene(std::move(texts)), n));
}

Value angles(NamedTexts texts) {
  const AnglesRequest request = angles_request(texts);
  limit("count", request.count, most_angles);
  return angles_report(request).fields;
}

/// The case or an empty scene, with the arguments in it.
Scene continuous_scene(NamedTexts texts) {
  const std::optional<SceneValues> given = case_values(texts);
  Scene scene =
      read_scene(given ? *given : SceneValues("scene", "", scene_keys()), scene_overrides(texts), Model::continuous);
  require_drawable(scene);
  scene.accuracy.evaluation_limit = std::min<long>(scene.accuracy.evaluation_limit, most_evaluations);
  return scene;
}

/// The time history, a column a name.
class HistoryColumns : public numeric::HistoryRecorder {
 public:
  void record(const numeric::HistorySample& sample) override {
    const std::vector<double> numbers = history_numbers(sample);
    for (std::size_t i = 0; i < numbers.size(); ++i) columns_[i].push_back(numbers[i]);
  }
  [[nodiscard]] Value fields() const {
    Value fields;
    for (std::size_t i = 0; i < columns_.size(); ++i) fields[history_names()[i]] = columns_[i];
    return fields;
  }

 private:
  std::vector<std::vector<double>> columns_{history_names().size()};
};

Value simulate(NamedTexts texts) {
  const bool with_history = taken(texts, "history") == "true";
  const Scene scene = continuous_scene(std::move(texts));
  const numeric::Body body = scene.make_body();
  const numeric::MotionState start = scene.start(body);
  HistoryColumns history;
  if (with_history && scene.height) record_fall(history, start, body.mass(), scene.world.gravity, 20);
  const PlannedRun planned = run_to_digits(body, scene.world, start, scene.request, scene.accuracy,
                                           {.history = with_history ? &history : nullptr});
  Value fields = simulation_report(scene, planned).fields;
  if (with_history) fields["history"] = history.fields();
  return fields;
}

/// A file's name in messages, which are one line.
std::string named_file(const std::string& name) {
  const bool is_plain = std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 127; });
  return name.empty() || !is_plain ? "scene file" : name;
}

Value opened(NamedTexts texts) {
  const std::string name = named_file(taken(texts, "name")), text = taken(texts, "text");
  const SceneArguments scene = opened_scene(name, text);
  return Value::Fields{{"arguments", scene.arguments}, {"notes", scene.notes}};
}

Value file(NamedTexts texts) { return Value::Fields{{"file", scene_file(std::move(texts))}}; }

Value compare(NamedTexts texts) {
  const Scene scene = continuous_scene(std::move(texts));
  return comparison_report(scene, compare_models(scene, scene.make_body())).fields;
}

using Answer = Value (*)(NamedTexts);
const std::map<std::string, Answer> answers{
    {"/api/sequence", sequence}, {"/api/angles", angles}, {"/api/explain", explain}, {"/api/simulate", simulate},
    {"/api/compare", compare},   {"/api/scene", opened},  {"/api/file", file}};

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/// Without the place "scene:1:2: ", since the text of a scene is not the user's.
std::string without_place(const std::string& words) {
  constexpr std::string_view name = "scene";
  const std::size_t end = words.find(": ");
  if (!words.starts_with(name) || end == std::string::npos) return words;
  const bool is_place = words.find_first_not_of(":0123456789", name.size()) == end + 1;
  return is_place ? words.substr(end + 2) : words;
}

/// Arguments as the page calls them: "tangential_velocity" for "--tangential-velocity".
std::string with_arguments(std::string words) {
  for (std::size_t at = 0; (at = words.find("--", at)) != std::string::npos;) {
    if (at + 2 >= words.size() || !is_lower(words[at + 2])) {
      at += 2;
      continue;
    }
    words.erase(at, 2);
    for (; at < words.size() && (is_lower(words[at]) || words[at] == '-'); ++at) {
      if (words[at] == '-') words[at] = '_';
    }
  }
  return words;
}

}  // namespace

std::string error_json(const std::string& words, int exit_status) {
  return json_text(Value::Fields{{"error", words}, {"status", exit_status}});
}

std::string cases_json() {
  Value cases;
  for (const std::string& name : case_names()) {
    const Scene scene = case_scene(name);
    if (!scene.sweep && !scene.body.is_round()) cases[name] = scene_value(scene);
  }
  return json_text(Value::Fields{{"cases", cases}});
}

ApiAnswer answer_request(const std::string& path, const std::string& body) {
  const auto found = answers.find(path);
  if (found == answers.end()) return {404, error_json("no such path: " + path, exit_status(FailureKind::bad_input))};
  try {
    return {200, json_text(found->second(texts_of(body)))};
  } catch (...) {
    const Failure failure = current_failure();
    const int http_status = failure.kind == FailureKind::bad_input ? 400
                            : failure.kind == FailureKind::defect  ? 500
                                                                   : 422;
    return {http_status, error_json(with_arguments(without_place(failure.message)), exit_status(failure.kind))};
  }
}

}  // namespace clatter::validation::inline demo
