// SPDX-License-Identifier: GPL-3.0-or-later
// The program's answers for the page of `clatter demo`, compiled to WebAssembly: functions from JSON to JSON.
//
// clatter_answer(path, body): `path` "sequence", "angles", "explain", "simulate", "compare"; "scene" reads the "text"
// of a scene file called "name" as {"arguments": {…}, "notes": […]}, "file" writes arguments as {"file": text}. `body`:
// a JSON object of texts, flags of the command without dashes, "_" for "-"; simulate also "history", explain "impact".
// What goes wrong is {"error": one line, "status": the program's exit status}.
#include <emscripten/emscripten.h>

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "validation/compare/comparison.hpp"
#include "validation/demo/scene_exchange.hpp"
#include "validation/explain/explanation_report.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/json.hpp"
#include "validation/output/version.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/rod/rod.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/history_file.hpp"
#include "validation/scene/argument.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/keys.hpp"
#include "validation/sequence/sequence_report.hpp"
#include "validation/simulate/simulation_report.hpp"

namespace clatter::validation {
namespace {

NamedTexts texts_of(const std::string& body) {
  const Json json = Json::parse(body, nullptr, false);
  NamedTexts texts;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_string()) throw BadInput(name + ": must be a text");
    texts[name] = value.get<std::string>();
  }
  return texts;
}

/// The argument, taken out; "" if it is not given.
std::string taken(NamedTexts& texts, const std::string& name) {
  const auto node = texts.extract(name);
  return node ? node.mapped() : "";
}

PreparedScene discrete_scene(const NamedTexts& texts) {
  PreparedScene prepared = read_discrete_scene(SceneValues("", "", scene_keys()), scene_overrides(texts));
  require_shown(prepared.scene);
  return prepared;
}

Value sequence(NamedTexts texts) {
  const PreparedScene prepared = discrete_scene(texts);
  return sequence_report(prepared, run_discrete(prepared)).fields;
}

Value explain(NamedTexts texts) {
  const int n = read_integer_option("impact", taken(texts, "impact"), 1, 1'000'000);
  return explanation_report(explain_impact(discrete_scene(texts), n)).fields;
}

Value angles(NamedTexts texts) {
  AnglesOptions options;
  take(angles_arguments(options), texts);
  return angles_report(angles_request(options)).fields;
}

Scene continuous_scene(const NamedTexts& texts) {
  Scene scene = read_scene(SceneValues("", "", scene_keys()), scene_overrides(texts), Model::continuous);
  require_shown(scene);
  return scene;
}

/// The time history, a column a name.
class HistoryColumns {
 public:
  void operator()(const numeric::HistorySample& sample) {
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
  const Scene scene = continuous_scene(texts);
  const numeric::Body body = scene.make_body();
  double fall = 0;
  const numeric::MotionState start = scene.start(body, &fall);
  HistoryColumns history;
  const numeric::HistoryRecorder recorder = with_history ? std::ref(history) : numeric::HistoryRecorder();
  if (with_history) record_fall(recorder, body, scene.world, start, fall, 20);
  const PlannedRun planned = run_to_digits(scene, body, {.history = recorder});
  Value fields = simulation_report(scene, planned).fields;
  if (with_history) fields["history"] = history.fields();
  return fields;
}

Value compare(NamedTexts texts) {
  const Scene scene = continuous_scene(texts);
  return comparison_report(scene, compare_models(scene, scene.make_body())).fields;
}

/// For the model that it is for: without a ground the discrete one.
Scene read_for_page(const SceneValues& values, const NamedTexts& texts) {
  const bool has_ground = std::any_of(ground_keys.begin(), ground_keys.end(), [&](const char* key) {
    return values.has(key) || texts.count(key_named(key).argument()) != 0;
  });
  return read_scene(values, scene_overrides(texts), has_ground ? Model::continuous : Model::discrete);
}

Value opened(NamedTexts texts) {
  const std::string name = taken(texts, "name"), text = taken(texts, "text");
  const Scene scene = read_for_page(SceneValues(name, text, scene_keys()), {});
  std::vector<std::string> notes;
  if (!scene.history.empty()) notes.emplace_back("run.history is left out: a page writes no file");
  return Value::Fields{{"arguments", scene_arguments(scene)}, {"notes", notes}};
}

/// Read again it gives the same arguments.
Value file(NamedTexts texts) {
  const Scene scene = read_for_page(SceneValues("", "", scene_keys()), texts);
  require_shown(scene);
  const auto line = [&](const Key& key, const std::string& name) {
    const std::string unit = *key.unit == '\0' ? "" : fmt::format(" [{}]", key.unit);
    return fmt::format("{} = {}  # {}{}", name, compact_json(key.get(scene)), key.help, unit);
  };
  const std::string head =
      fmt::format("# A scene of clatter {}: clatter sequence FILE, simulate FILE, compare FILE.", version);
  return Value::Fields{{"file", scene_text(head, said_keys(scene), line)}};
}

const std::map<std::string, Value (*)(NamedTexts)> answers{
    {"sequence", sequence}, {"angles", angles}, {"explain", explain}, {"simulate", simulate},
    {"compare", compare},   {"scene", opened},  {"file", file}};

std::string answer(const std::string& path, const std::string& body) {
  try {
    return json_text(answers.at(path)(texts_of(body)));
  } catch (...) {
    const Failure failure = current_failure();
    return json_text(Value::Fields{{"error", failure.message}, {"status", exit_status(failure.kind)}});
  }
}

}  // namespace
}  // namespace clatter::validation

/// The text lasts until the next call.
extern "C" EMSCRIPTEN_KEEPALIVE const char* clatter_answer(const char* path, const char* body) {
  static std::string text;
  text = clatter::validation::answer(path, body);
  return text.c_str();
}
