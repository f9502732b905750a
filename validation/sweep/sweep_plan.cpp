// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/sweep_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/report.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/orientation.hpp"
#include "validation/shock/shock_options.hpp"
#include "validation/sweep/sweep_file.hpp"

namespace clatter::validation {
namespace {

const char* const static_friction = "ground.static_friction";
const char* const sliding_friction = "ground.sliding_friction";
const char* const box_size = "body.size";
const char* const attitude_key = "drop.attitude";
const char* const any_attitude = "uniform";
const char* const numbered_attitudes = "26";
const std::vector<std::string> box_sides{"body.size.length", "body.size.width", "body.size.thickness"};

/// The sides of the box, each a number where the file has one list.
const std::vector<Key>& side_keys() {
  const auto side = [](const char* name, void (*put)(Scene&, double)) {
    return Key{name, Use::both, "", "M", "m", "", {.put = put}};
  };
  static const std::vector<Key> keys{
      side("body.size.length", [](Scene& s, double size) { s.body.size.x() = size; }),
      side("body.size.width", [](Scene& s, double size) { s.body.size.y() = size; }),
      side("body.size.thickness", [](Scene& s, double size) { s.body.size.z() = size; })};
  return keys;
}

/// The key of that name, or none if its value is no number, as "body.shape".
const Key* find_number_key(const std::string& name) {
  for (const std::vector<Key>* keys : {&side_keys(), &all_keys()}) {
    for (const Key& key : *keys) {
      if (key.name == name && key.is_number()) return &key;
    }
  }
  return nullptr;
}

const std::vector<std::string> row_names{"scene", "impact"};

/// One --set KEY=TEXT.
struct Setting {
  std::string key, text;
  const Key* number = nullptr;
  std::optional<SweepAxis> axis;  ///< none: one value
};

std::vector<std::string> settable_keys() {
  std::vector<std::string> keys = box_sides;
  for (const std::string& key : scene_keys()) {
    if (!key.starts_with("sweep.") && key != "run.history") keys.push_back(key);
  }
  return keys;
}

bool is_of_kind(KeyValue::Kind kind, const std::string& name) {
  return std::any_of(all_keys().begin(), all_keys().end(),
                     [&](const Key& key) { return key.name == name && key.value.kind == kind; });
}

/// How values are drawn.
struct Drawing {
  bool random = false;
  std::optional<double> scatter{};  ///< of attitudes about listed ones [rad]
};

Drawing read_drawing(const SweepRequest& request) {
  Drawing drawing{.random = request.random.has_value()};
  if (!request.scatter) return drawing;
  if (!drawing.random) throw BadInput(fmt::format("--scatter {}: needs --random N", *request.scatter));
  drawing.scatter = *request.scatter * std::numbers::pi / 180;
  return drawing;
}

/// The attitudes that a --set drop.attitude=TEXT asks for; none if that is a single one.  Numbered ones wait for the
/// size of the box.
std::optional<SweepAxis> read_attitudes(const std::string& text, const Drawing& drawing) {
  const bool random = drawing.random;
  const bool any = text == any_attitude,
             listed = text == numbered_attitudes || text.starts_with('[') || text.starts_with('@');
  if (any && !random) throw BadInput(fmt::format("--set {}={}: needs --random N", attitude_key, text));
  if (listed && random && !drawing.scatter) {
    throw BadInput(fmt::format("--set {}={}: must be {} or one attitude with --random, or give --scatter DEG",
                               attitude_key, text, any_attitude));
  }
  if (drawing.scatter && !listed)
    throw BadInput(fmt::format("--scatter: needs --set {}=26, [q0,q1,q2,q3],... or @FILE", attitude_key));
  const double scatter = drawing.scatter.value_or(0);
  if (any) return SweepAxis{.key = attitude_key, .any_attitude = true};
  if (text == numbered_attitudes)
    return SweepAxis{.key = attitude_key, .count = orientation_count, .attitudes = {{1, 0, 0, 0}}, .scatter = scatter};
  if (!listed) return {};
  SweepAxis axis = read_attitude_axis(attitude_key, text);
  axis.scatter = scatter;
  return axis;
}

Setting read_setting(const std::string& given, const Drawing& drawing) {
  const std::size_t equal = given.find('=');
  if (equal == std::string::npos)
    throw BadInput(fmt::format("--set '{}': must be KEY=VALUE, KEY=A,B,... or KEY=FROM:TO:STEP", given));
  Setting setting{.key = given.substr(0, equal), .text = given.substr(equal + 1), .axis = {}};
  const std::vector<std::string> keys = settable_keys();
  if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) {
    throw BadInput(fmt::format("--set {}: unknown key{}", setting.key, suggestion(setting.key, keys)));
  }
  if (setting.text.empty()) throw BadInput(fmt::format("--set {}: the value is empty", setting.key));
  if (setting.key == attitude_key) {
    setting.axis = read_attitudes(setting.text, drawing);
    if (setting.axis) return setting;
  }
  setting.number = find_number_key(setting.key);
  if (setting.text.find(':') != std::string::npos && is_of_kind(KeyValue::Kind::list, setting.key))
    throw BadInput(fmt::format("--set {}={}: a list cannot be swept; give one value", setting.key, setting.text));
  if (setting.text.find(',') != std::string::npos && is_of_kind(KeyValue::Kind::name, setting.key))
    throw BadInput(fmt::format("--set {}={}: names cannot be swept; a sweep for each", setting.key, setting.text));
  if (setting.number == nullptr || setting.text.find_first_of(":,") == std::string::npos) return setting;
  setting.axis = drawing.random ? read_random_axis(setting.key, setting.text, setting.number->is_whole())
                                : read_grid_axis(setting.key, setting.text, setting.number->is_whole());
  return setting;
}

bool sets(const std::vector<Setting>& settings, const std::string& key) {
  return std::any_of(settings.begin(), settings.end(), [&](const Setting& setting) { return setting.key == key; });
}

std::vector<Setting> read_settings(const std::vector<std::string>& given, const Drawing& drawing) {
  std::vector<Setting> settings;
  for (const std::string& text : given) {
    Setting setting = read_setting(text, drawing);
    if (sets(settings, setting.key)) throw BadInput(fmt::format("--set {}: given twice", setting.key));
    settings.push_back(std::move(setting));
  }
  for (const std::string& side : box_sides) {
    if (sets(settings, side) && sets(settings, box_size))
      throw BadInput(fmt::format("--set {} and --set {}: give one of them, not both", box_size, side));
  }
  return settings;
}

/// The text of a scene's key at one end of the axis.
std::string end_text(const SweepAxis& axis, double SweepAxis::*end) {
  if (axis.any_attitude) return "1,0,0,0";
  if (!axis.is_attitude()) return axis.whole ? fmt::format("{:.0f}", axis.*end) : shortest(axis.*end);
  std::string text;
  for (const double parameter : axis.attitudes.front()) text += (text.empty() ? "" : ",") + shortest(parameter);
  return text;
}

/// The sides of the box as one value of body.size; those that are not set are the file's.
SceneOverride size_override(const SceneValues& values, const std::array<std::string, 3>& sides) {
  std::array<std::string, 3> texts = sides;
  if (std::any_of(sides.begin(), sides.end(), [](const std::string& side) { return side.empty(); })) {
    values.require(box_size, "as not all of its sides are set");
    const std::vector<double> given = values.numbers(box_size, {3}, any_number, "three lengths in m");
    for (std::size_t i = 0; i < 3; ++i) texts[i] = sides[i].empty() ? shortest(given[i]) : sides[i];
  }
  return {box_size, "--set body.size", fmt::format("{}", fmt::join(texts, "x"))};
}

/// The settings at one end of their axes, as flags that override the file.
std::vector<SceneOverride> overrides_at(const SceneValues& values, const std::vector<Setting>& settings,
                                        double SweepAxis::*end) {
  std::vector<SceneOverride> overrides;
  std::array<std::string, 3> sides;
  for (const Setting& setting : settings) {
    const std::string text = setting.axis ? end_text(*setting.axis, end) : setting.text;
    const auto side = std::find(box_sides.begin(), box_sides.end(), setting.key);
    if (side == box_sides.end()) overrides.push_back({setting.key, "--set " + setting.key, text});
    else sides[static_cast<std::size_t>(side - box_sides.begin())] = text;
  }
  if (sides != std::array<std::string, 3>{}) overrides.push_back(size_override(values, sides));
  return overrides;
}

/// What a setting replaces in the file beyond its own key.
void make_room(SceneValues& values, const std::vector<Setting>& settings) {
  if (!sets(settings, sliding_friction)) return;
  if (!sets(settings, static_friction)) values.drop(static_friction);
  for (const char* key : {".from", ".to", ".step"}) values.drop(std::string("sweep.sliding_friction") + key);
}

void put_both_frictions(Scene& scene, double value) {
  scene.world.ground.static_friction = scene.world.ground.sliding_friction = value;
}

bool is_both_frictions(const Setting& setting, const SceneValues& values, const std::vector<Setting>& settings) {
  if (setting.key == sliding_friction) return !sets(settings, static_friction);
  return setting.key == static_friction && !sets(settings, sliding_friction) && !values.has(sliding_friction);
}

Model read_model(const SweepRequest& request, const SceneValues& values, const std::vector<Setting>& settings) {
  if (request.model) return *request.model;
  const bool ground =
      values.has_table("ground") ||
      std::any_of(settings.begin(), settings.end(), [](const Setting& one) { return one.key.starts_with("ground."); });
  return ground ? Model::continuous : Model::discrete;
}

/// What the discrete model takes from [impact] and [ground], the settings at one end of their axes; none: no law.
std::optional<analytic::ImpactLaw> law_at(const SceneValues& values, const std::vector<Setting>& settings,
                                          double SweepAxis::*end) {
  try {
    return discrete_law(read_scene(values, overrides_at(values, settings, end), Model::discrete)).law;
  } catch (const std::exception&) {  // which the rows, or the reading of the scene, will tell
    return {};
  }
}

bool are_same(const analytic::ImpactLaw& one, const analytic::ImpactLaw& other) {
  const auto numbers = [](const analytic::ImpactLaw& law) {
    return std::tie(law.law, law.restitution, law.friction, law.friction_value, law.damping_per_stiffness);
  };
  return numbers(one) == numbers(other);
}

/// Whether the law at one end of some axis of the others depends on the key.
bool changes_law(const std::string& key, const SceneValues& values, std::vector<Setting> settings) {
  const std::vector<Setting> given = settings;
  SweepAxis& axis = *std::ranges::find(settings, key, &Setting::key)->axis;
  std::swap(axis.first, axis.last);
  return std::ranges::any_of(std::array{&SweepAxis::first, &SweepAxis::last}, [&](double SweepAxis::*end) {
    const auto one = law_at(values, given, end), other = law_at(values, settings, end);
    return !one || !other || !are_same(*one, *other);
  });
}

/// The keys of the scene that go before a key in the discrete law: without any of them it would change the law.
std::vector<std::string> hiding_keys(const std::string& key, const SceneValues& values,
                                     const std::vector<Setting>& settings) {
  std::vector<std::string> hiding;
  for (const Key& other : all_keys()) {
    const std::string name = other.name;
    const bool is_of_law = name.starts_with("impact.") || name.starts_with("ground.");
    if (is_of_law && name != key && (values.has(name) || sets(settings, name))) hiding.push_back(name);
  }
  const auto changes_without = [&](const std::vector<std::string>& left_out) {
    SceneValues others = values;
    std::vector<Setting> kept = settings;
    for (const std::string& name : left_out) {
      others.drop(name);
      std::erase_if(kept, [&](const Setting& setting) { return setting.key == name; });
    }
    const auto law = law_at(others, kept, &SweepAxis::first);
    return law && changes_law(key, others, kept);
  };
  for (const std::string& name : hiding) {
    if (changes_without({name})) return {name};
  }
  std::erase_if(hiding, [](const std::string& name) { return !name.starts_with("impact."); });
  if (!changes_without(hiding)) return {};
  const std::vector<std::string> all = hiding;
  for (const std::string& name : all) {
    std::vector<std::string> fewer = hiding;
    std::erase(fewer, name);
    if (changes_without(fewer)) hiding = fewer;
  }
  return hiding;
}

/// Refuses to vary what changes nothing: all scenes would be one.  The discrete model knows [impact] and [ground] by
/// its law alone, in which keys go before others.
/// @throws BadInput
void require_effects(const SweepRequest& request, const SceneValues& values, const std::vector<Setting>& settings,
                     Model model) {
  for (const Setting& setting : settings) {
    if (!setting.axis || setting.number == nullptr || setting.axis->first == setting.axis->last) continue;
    const bool is_of_law = setting.key.starts_with("impact.") || setting.key.starts_with("ground.");
    const bool is_read =
        model == Model::continuous ? !setting.key.starts_with("impact.") : setting.number->is_for(model);
    const bool is_hidden =
        is_read && model == Model::discrete && is_of_law && !changes_law(setting.key, values, settings);
    if (is_read && !is_hidden) continue;
    const std::vector<std::string> hiding =
        is_hidden ? hiding_keys(setting.key, values, settings) : std::vector<std::string>{};
    std::string way_out = hiding.empty() ? "" : fmt::format("leave out {}", fmt::join(hiding, " and "));
    if (request.takes_other_model) {
      way_out += fmt::format("{}give --model {}", way_out.empty() ? "" : ", or ",
                             name_of(model == Model::continuous ? Model::discrete : Model::continuous));
    }
    throw BadInput(
        fmt::format("--set {}={}: changes nothing in the {} model{}{}", setting.key, setting.text, name_of(model),
                    hiding.empty() ? "" : fmt::format(", where {} goes before it", fmt::join(hiding, " with ")),
                    way_out.empty() ? "" : "; " + way_out));
  }
}

/// Gives the numbered attitudes those of the scene's box.
void number_attitudes(const Scene& scene, std::vector<Setting>& settings) {
  const auto is_numbered = [](const Setting& one) { return one.key == attitude_key && one.text == numbered_attitudes; };
  const auto setting = std::find_if(settings.begin(), settings.end(), is_numbered);
  if (setting == settings.end()) return;
  if (scene.body.shape != BodyScene::Shape::box)
    throw BadInput(fmt::format("--set {}={}: is for a box", attitude_key, numbered_attitudes));
  for (const Setting& other : settings) {
    if (!other.axis || !other.key.starts_with(box_size)) continue;
    throw BadInput(
        fmt::format("--set {}={} and --set {}={}: the attitudes depend on the size; give drop.orientation=1:26:1",
                    attitude_key, numbered_attitudes, other.key, other.text));
  }
  std::vector<SweptAttitude>& attitudes = setting->axis->attitudes;
  attitudes.resize(orientation_count);
  for (int n = 1; n <= orientation_count; ++n)
    std::ranges::copy(orientation_attitude(n, scene.body.size), attitudes[static_cast<std::size_t>(n - 1)].begin());
}

void read_scene(const SweepRequest& request, std::vector<Setting>& settings, SceneValues& values, SweepPlan& plan) {
  make_room(values, settings);
  const Model model = plan.layout.model = read_model(request, values, settings);
  require_effects(request, values, settings, model);
  plan.has_own_limit = values.has("run.impacts") || sets(settings, "run.impacts");
  plan.scene = read_scene_of_any_motion(values, overrides_at(values, settings, &SweepAxis::first), model);
  static_cast<void>(read_scene_of_any_motion(values, overrides_at(values, settings, &SweepAxis::last), model));
  if (model == Model::continuous) {
    for (const auto& [key, words] : discrete_law_words(plan.scene))
      if (sets(settings, key)) plan.in_vain.push_back("warning: " + words);
  }
  number_attitudes(plan.scene, settings);
  if (plan.scene.sweep) {
    throw BadInput(
        fmt::format("{}: sweep: must be left out here; give --set drop.angle_deg=FROM:TO:STEP", request.file));
  }
  if (!plan.scene.history.empty()) values.refuse("run.history", "left out in a sweep");
  for (const char* const key : {"run.at", "run.rate"}) {
    if (key_named(key).is_given(plan.scene) && plan.scene.has_times()) values.refuse(key, "left out in a sweep");
  }
  if (plan.scene.require_digits && !plan.scene.request.error_estimates)
    throw BadInput("run.require_digits: needs run.errors, without which no digit is known");
}

void choose_range(const SweepRequest& request, SweepPlan& plan) {
  plan.range = {.count = plan.points.count()};
  if (request.scenes.empty()) return;
  plan.range = read_scenes(request.scenes, plan.points.count());
  plan.words.push_back(fmt::format("here: scenes {} to {}{}", plan.range.first, plan.range.last(),
                                   plan.range.step > 1 ? fmt::format(" by {}", plan.range.step) : ""));
}

void read_points(const SweepRequest& request, const std::vector<Setting>& settings, SweepPlan& plan) {
  std::vector<SweepAxis> axes;
  for (const Setting& setting : settings) {
    if (!setting.axis) continue;
    axes.push_back(*setting.axis);
    for (const std::string& name : setting.axis->names()) plan.layout.swept.push_back(name);
  }
  if (!request.random) {
    if (request.seed) throw BadInput(fmt::format("--seed {}: is for --random N", *request.seed));
    plan.points = SweepPoints(std::move(axes));
    plan.words.push_back(fmt::format("scenes: {}", plan.points.count()));
    return choose_range(request, plan);
  }
  if (axes.empty()) throw BadInput(fmt::format("--random {}: needs a --set KEY=LOW:HIGH", *request.random));
  const int seed = request.seed.value_or(1);
  plan.points = SweepPoints(std::move(axes), *request.random, static_cast<std::uint64_t>(seed));
  plan.words.push_back(fmt::format("scenes: {} random ones, seed {}", *request.random, seed));
  choose_range(request, plan);
  if (request.scatter) {
    plan.words.push_back(
        fmt::format("scatter: each attitude in its turn, turned about each axis by a normally "
                    "distributed angle with a standard deviation of {}°",
                    *request.scatter));
  }
}

void put_attitude(Scene& scene, std::span<const double> parameters) {
  scene.attitude.assign(parameters.begin(), parameters.end());
  scene.settle();
}

void choose_setters(const SceneValues& values, const std::vector<Setting>& settings, SweepPlan& plan) {
  std::size_t place = 0;
  if (plan.scene.height) plan.unsettled.emplace_back("drop.speed");  // of the fall: each scene's own
  for (const Setting& setting : settings) {
    if (!setting.axis) continue;
    plan.unsettled.push_back(setting.key);
    if (setting.key.starts_with("body.")) plan.body_values.push_back(place);
    place += setting.axis->width();
    if (setting.axis->is_attitude()) {
      plan.numbered_attitudes = setting.text == numbered_attitudes;
      plan.put.emplace_back(put_attitude);
      if (setting.text.starts_with('@'))
        plan.attitude_files.push_back({"--set " + setting.key, setting.text.substr(1)});
    } else if (is_both_frictions(setting, values, settings)) {
      plan.unsettled.insert(plan.unsettled.end(), {static_friction, sliding_friction});
      plan.put.emplace_back([](Scene& scene, std::span<const double> value) { put_both_frictions(scene, value[0]); });
    } else {
      plan.put.emplace_back([key = setting.number](Scene& scene, std::span<const double> value) {
        key->put_number(scene, value[0]);
        scene.settle();
      });
    }
  }
}

bool may_leave_its_plane(const SweepPlan& plan) {
  if (plan.scene.body.is_polyhedron() || !reason_in_space(plan.scene).empty()) return true;
  const std::vector<SweepAxis>& axes = plan.points.axes();
  return std::any_of(axes.begin(), axes.end(), [](const SweepAxis& axis) {
    return axis.key == "drop.tilt_deg" || axis.key == "drop.orientation" || axis.is_attitude();
  });
}

void choose_rows(const SweepRequest& request, SweepPlan& plan) {
  RowLayout& layout = plan.layout;
  layout.rows = request.rows.value_or(layout.rows);
  layout.in_space = layout.model == Model::discrete && may_leave_its_plane(plan);
  layout.warns = layout.model == Model::discrete;
}

void choose_columns(const SweepRequest& request, SweepPlan& plan) {
  RowLayout& layout = plan.layout;
  std::string columns = request.columns;
  const std::vector<SweepAxis>& axes = plan.points.axes();
  const bool attitudes =
      std::any_of(axes.begin(), axes.end(), [](const SweepAxis& axis) { return axis.is_attitude(); });
  if (columns.empty() && request.summary && attitudes && layout.rows == RowKind::scene)
    columns = layout.in_space ? "hardest,hardest_impulse_normal,hardest_corners" : "hardest,hardest_impulse_normal";
  // The face of rest is told where the drops are followed to it, or where it is asked for.
  const bool follows = layout.model == Model::discrete && plan.scene.until_rest;
  layout.rests = layout.rows == RowKind::scene && (follows || columns.find("rest_") != std::string::npos);
  if (columns.empty()) return;
  if (layout.rows == RowKind::impact)
    throw BadInput(fmt::format("--columns {}: is for --rows scene; rows of impacts have every column", columns));
  int impacts = plan.scene.request.impacts;
  for (const SweepAxis& axis : plan.points.axes()) {
    if (axis.key == "run.impacts") impacts = static_cast<int>(std::max(axis.first, axis.last));
  }
  read_impact_columns(columns, impacts, layout);
  plan.words.push_back(fmt::format("columns: {}", columns));
}

/// @throws BadInput for a column that is none, or holds no numbers
void choose_ranking(const SweepRequest& request, SweepPlan& plan) {
  if (request.rank_by.empty()) return;
  if (!request.summary)
    throw BadInput(
        fmt::format("--rank-by {}: ranks the listed attitudes of --summary, or its scenes", request.rank_by));
  std::vector<std::string> names;
  for (const Column& column : sweep_columns(plan.layout)) {
    if (!column.words && !column.name.ends_with("_error")) names.push_back(column.name);
  }
  if (std::ranges::find(names, request.rank_by) == names.end())
    throw BadInput(fmt::format("--rank-by {}: must be a column of numbers{}", request.rank_by,
                               suggestion(request.rank_by, names)));
  plan.layout.rank_by = request.rank_by;
}

/// A summary of many scenes by the continuous model asks for no more than statistics need, unless it is told: three
/// digits, and no second run for the growth of errors.
void spare(const SweepRequest& request, const SceneValues& values, const Drawing& drawing,
           std::vector<Setting>& settings) {
  if (!request.summary || read_model(request, values, settings) == Model::discrete) return;
  const auto is_given = [&](const char* key) { return values.has(key) || sets(settings, key); };
  if (!is_given("run.digits") && !is_given("run.tolerance") && !is_given("run.step"))
    settings.push_back(read_setting("run.digits=3", drawing));
  if (!is_given("run.amplification")) settings.push_back(read_setting("run.amplification=false", drawing));
}

/// The points of flags, else of the scene's file, where rows have columns for them.
void choose_probes(const SweepRequest& request, const SceneValues& values, SweepPlan& plan) {
  RowLayout& layout = plan.layout;
  if (layout.rows == RowKind::impact && !request.probes.empty()) {
    throw BadInput(fmt::format("--probe {}: is for --rows scene; clatter shock has a point's numbers of each impact",
                               request.probes.front()));
  }
  if (layout.rows == RowKind::scene) layout.probes = read_probes("--probe", request.probes, read_probes(values));
  for (const Probe& probe : layout.probes)
    plan.words.push_back(fmt::format("probe: {}, body frame", place_words(probe)));
  layout.has_curve = layout.model == Model::continuous && plan.scene.world.ground.is_pad();
  if (!request.parts.empty() && layout.probes.empty())
    throw BadInput(
        fmt::format("--part {}: needs --probe NAME:X,Y,Z with rows of scenes, or [[probe]], where the part is",
                    part_text(request.parts.front())));
  const std::vector<FragilePart> parts = parts_of(request.parts, layout.probes);
  layout.part_at.resize(layout.probes.size());
  for (const FragilePart& part : parts) {
    const std::string given = "--part " + part_text(part);
    if (layout.model == Model::discrete && part.kind == FragilePart::Kind::at_place)
      throw BadInput(given + ": needs peaks, which the continuous model has: a scene with a ground");
    for (std::size_t i = 0; i < layout.probes.size(); ++i) {
      std::optional<FragilePart>& here = layout.part_at[i];
      if (!part.is_at(layout.probes[i].name)) continue;
      if (here)
        throw BadInput(fmt::format("{}: {} has one already, {}; clatter shock and report take several at one probe",
                                   given, layout.probes[i].name, part_text(*here)));
      here = part;
    }
    plan.words.push_back("part: " + words_of(part));
  }
}

/// @throws BadInput for a probe whose columns have the names of others
void require_distinct_columns(const RowLayout& layout) {
  std::set<std::string> names;
  for (const Column& column : sweep_columns(layout)) {
    if (names.insert(column.name).second) continue;
    throw BadInput(fmt::format("--probe: column {} would be there twice; name the points otherwise", column.name));
  }
}

/// Nothing in the place of each key.
void forget(const std::vector<std::string>& keys, Value& scene) {
  for (const std::string& key : keys) {
    const std::string name = key.starts_with(box_size) ? box_size : key;
    const std::size_t dot = name.find('.');
    scene[name.substr(0, dot)][name.substr(dot + 1)] = nullptr;
  }
}

/// Puts the scene's own attitude, that attitudes may scatter about it, in the place of the keys that say it.
/// @throws BadInput where these are varied
void name_own_attitude(const SweepRequest& request, const SceneValues& values, std::vector<std::string>& sets) {
  const auto gives = [](const std::string& set, const char* key) { return set.starts_with(std::string(key) + "="); };
  if (std::any_of(sets.begin(), sets.end(), [&](const auto& set) { return gives(set, attitude_key); })) return;
  const std::vector<Setting> settings = read_settings(sets, {.random = true});
  std::vector<std::string> others;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const std::string& key = settings[i].key;
    const bool says_it = are_alternatives(key, attitude_key);
    if (says_it && settings[i].axis) {
      throw BadInput(
          fmt::format("--scatter {} and --set {}: attitudes scatter about those of --set {}=26, about a "
                      "list, or about the scene's own",
                      *request.scatter, sets[i], attitude_key));
    }
    if (!says_it) others.push_back(sets[i]);
  }
  SceneValues own = values;
  make_room(own, settings);
  const Model model = read_model(request, own, settings);
  const Eigen::Quaterniond q =
      read_scene_of_any_motion(own, overrides_at(own, settings, &SweepAxis::first), model).touch_attitude();
  others.push_back(fmt::format("{}=[{},{},{},{}]", attitude_key, shortest(q.w()), shortest(q.x()), shortest(q.y()),
                               shortest(q.z())));
  sets = std::move(others);
}

}  // namespace

Arguments sweep_arguments(SweepRequest& request) {
  const Argument::Reader take_part = [&parts = request.parts](const std::string& option, const std::string& text) {
    parts.push_back(read_part(option, text));
  };
  Argument part = part_argument(
      take_part,
      "columns margin_NAME, the least over the impacts, by which attitudes are ranked; again for other probes", "");
  part.repeats = true;
  return {
      whole_argument("--random", request.random, 1, static_cast<int>(most_scenes), "N",
                     "N scenes with random values, --set KEY=LOW:HIGH or LOW:HIGH:log"),
      whole_argument("--seed", request.seed, 0, std::numeric_limits<int>::max(), "S", "of the random values (1)"),
      number_argument("--scatter", request.scatter, {0, 180, false, "from 0 to 180 degrees"}, "DEG",
                      "with --random: attitudes about the scene's own, those of drop.attitude=26 or a list, each "
                      "in its turn, turned about each axis by a normally distributed angle with this standard "
                      "deviation"),
      choice_argument("--model", request.model, model_names, "(continuous if the scene has a ground)"),
      choice_argument("--rows", request.rows, row_names, "one row per scene or per impact (scene)"),
      {.name = "--columns",
       .target = &request.columns,
       .type = "NAME,...",
       .help = "more columns of rows of scenes: QUANTITY_N of impact N, QUANTITY of each, hardest, "
               "hardest_QUANTITY; rest_face, rest_known: each drop is followed to rest, at 40 to 500 times the cost"},
      part,
      {.name = "--rank-by",
       .target = &request.rank_by,
       .type = "COLUMN",
       .help = "of --summary: by which listed attitudes are ranked (the first probe's margin, else peak or change of "
               "velocity, else force or impulse); without them, the ten worst scenes by it"}};
}

SweepPlan read_sweep_plan(const SweepRequest& request) {
  SweepPlan plan;
  SceneValues values =
      request.text ? SceneValues(request.file, *request.text, scene_keys()) : scene_values(request.file);
  std::vector<std::string> sets = request.sets;
  if (request.no_errors) sets.emplace_back("run.errors=false");
  if (request.require_digits) sets.emplace_back("run.require_digits=true");
  const Drawing drawing = read_drawing(request);
  if (drawing.scatter) name_own_attitude(request, values, sets);
  std::vector<Setting> settings = read_settings(sets, drawing);
  spare(request, values, drawing, settings);
  read_scene(request, settings, values, plan);
  if (plan.layout.model == Model::discrete && plan.scene.until_rest) {
    plan.words.emplace_back(
        "impacts: of infinitely many those until the sum of the others is known to run.digits or lost in rounding");
  }
  plan.fixed_words =
      (request.file.empty() ? "" : shell_word(request.file) + " ") + "--model " + name_of(plan.layout.model);
  for (const Setting& setting : settings) {
    plan.words.push_back(fmt::format("set: {} = {}", setting.key, setting.text));
    if (!setting.axis) plan.fixed_words += " --set " + shell_word(setting.key + "=" + setting.text);
  }
  read_points(request, settings, plan);
  choose_setters(values, settings, plan);
  choose_rows(request, plan);
  choose_probes(request, values, plan);
  choose_columns(request, plan);
  require_distinct_columns(plan.layout);
  choose_ranking(request, plan);
  return plan;
}

void SweepPlan::put_point(const std::vector<double>& values, Scene& into) const {
  std::span<const double> rest(values);
  for (std::size_t i = 0; i < put.size(); ++i) {
    const std::size_t width = points.axes()[i].width();
    put[i](into, rest.first(width));
    rest = rest.subspan(width);
  }
  into.settle_restitution();
}

std::vector<std::string> SweepPlan::remarks(long long cut, std::optional<long long> warned) const {
  std::vector<std::string> said = in_vain;
  const long long count = warned.value_or(warning->count());
  if (const auto& found = warning->found()) {
    said.push_back(fmt::format("{} of {} scenes warn, column warning; scene {}: {}", count, range.count, found->first,
                               found->second));
  } else if (count > 0) {
    said.push_back(fmt::format("{} of {} scenes warn, column warning", count, range.count));
  }
  if (cut > 0 && !has_own_limit) {
    said.push_back(fmt::format("{} of {} scenes end at {} impacts, where more may follow: run.impacts is not given",
                               cut, range.count, scene.request.impacts));
  }
  return said;
}

std::string SweepPlan::command_of(long long index, const std::string& column) const {
  std::string command = "clatter sweep " + fixed_words;
  std::vector<double> values;
  points.at(index, values);
  std::span<const double> rest(values);
  for (const SweepAxis& axis : points.axes()) {
    const auto own = rest.first(axis.width());
    std::string text = shortest(own.front());
    for (const double value : own.subspan(1)) text += "," + shortest(value);
    command += " --set " + shell_word(axis.key + "=" + (own.size() > 1 ? "[" + text + "]" : text));
    rest = rest.subspan(axis.width());
  }
  const std::optional<std::size_t> probe = probe_of(column, layout.probes);
  if (!probe) return command + " --rows impact";
  const Probe& point = layout.probes[*probe];
  const FragilePart* const part = layout.part(*probe);
  return fmt::format("{} --probe {}:{},{},{}{}", command, point.name, shortest(point.place.x()),
                     shortest(point.place.y()), shortest(point.place.z()), part ? " --part " + part_text(*part) : "");
}

std::string SweepPlan::attitude_name(long long place) const {
  const int number = static_cast<int>(place + 1);
  return numbered_attitudes ? fmt::format("{} ({})", number, orientation_name(number)) : std::to_string(number);
}

Report SweepPlan::report() const {
  const Model model = layout.model;
  const std::string& name = name_of(model);
  Report report = begun_report(
      "sweep", fmt::format("{} model, one row per {}", name, row_names[static_cast<std::size_t>(layout.rows)]));
  report.head = scene_head(scene, model, {}, unsettled);
  if (const std::string doubts = probe_doubts(scene, layout.probes); !doubts.empty())
    report.head.insert(report.head.begin(), doubts);
  report.fields["model"] = name;
  report.fields["scene"] = scene_value(scene);
  if (scene.until_rest) report.fields["scene"]["run"]["until_rest"] = true;  // else going on would mix two sweeps
  forget(unsettled, report.fields["scene"]);
  if (body_values.empty()) report.fields["body"] = body_value(scene, model);
  report.fields["sweep"] = words;
  if (!scene.body.file.empty())
    report.remarks.push_back(fmt::format("mesh: CRC-64/XZ {:016x}", file_digest(scene.body.file)));
  for (const RunFile& file : attitude_files)
    report.remarks.push_back(fmt::format("attitudes: CRC-64/XZ {:016x}", file_digest(file.path)));
  report.remarks.insert(report.remarks.end(), words.begin(), words.end());
  report.grid.columns = sweep_columns(layout);
  return report;
}

}  // namespace clatter::validation
