// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <string_view>
#include <variant>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/floors.hpp"
#include "validation/sweep/points.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t most_cases = 100;

/// The values of a flag that has several: 0.3:0.7:0.1 or 0.3,0.5, as in a sweep, or names, concrete,wood.  Empty: one.
std::vector<std::string> several_values(const Key& key, const std::string& text) {
  std::vector<std::string> values;
  if (key.value.kind == KeyValue::Kind::name && text.find(',') != std::string::npos) {
    for (const auto part : std::views::split(text, ',')) values.emplace_back(part.begin(), part.end());
  } else if (key.is_number() && text.find_first_of(":,") != std::string::npos) {
    const SweepAxis axis = read_grid_axis(key.flag, text, key.is_whole());
    if (axis.count > static_cast<long long>(most_cases))
      throw BadInput(fmt::format("{} {}: more than {} values", key.flag, text, most_cases));
    for (long long i = 0; i < axis.count; ++i) values.push_back(shortest(axis.at(i)));
  }
  return values;
}

/// Where the restitution that was given for the model that runs comes from: the ground, or impacts.
bool is_of_ground(const ReportCase& one) {
  return model_of(one.input) == Model::continuous ||
         restitution_law(one.given) == analytic::RestitutionLaw::viscoelastic;
}

/// Whether the column e has the key's value: the other model's restitution is a flag as others are.
bool is_restitution(const ReportCase& one, const Key& key) {
  return std::string_view(key.name) == (is_of_ground(one) ? "ground.restitution" : "impact.restitution");
}
bool is_floor(const Key& key) { return std::string_view(key.name) == "ground.floor"; }
bool is_friction(const Key& key) { return std::string_view(key.name) == "ground.sliding_friction"; }

/// "e", "floor" or "sliding friction": a key as one says it.
std::string words_of(const ReportCase& one, const Key& key) {
  if (is_restitution(one, key)) return "e";
  std::string name = key.argument();
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// "concrete", "pad on concrete", "half-space", "pad" or "springs"; empty without a ground.
std::string floor_of(const Scene& scene) {
  const numeric::Ground& ground = scene.world.ground;
  const auto& floor = scene.half_space.floor;
  const std::string name = floor ? floor_names()[*floor] : "";
  if (ground.is_pad()) return floor ? "pad on " + name : "pad";
  return floor ? name : ground.is_half_space() ? "half-space" : scene.has_ground() ? "springs" : "";
}

std::string part_text_of(const ReportCase& one) { return one.input.part() ? part_text(*one.input.part()) : ""; }

std::vector<Column> columns_of_case() {
  return {word_column("scene", "scene", "file or name of the drop"),
          word_column("floor", "floor", "its material, half-space, pad or springs"),
          {"restitution", "e", "", "that was given, of the ground or, without one, of impacts"},
          {"friction", "μ", "", "coefficient of sliding friction on the ground"},
          word_column("given", "with", "its values of other flags that have several"),
          word_column("part", "part", "what bears it, as --part takes it")};
}

/// What tells a case from others, in these columns.
Row cells_of_case(const ReportCase& one) {
  const auto text = [](const std::string& words) { return words.empty() ? Cell() : Cell(words); };
  const auto number = [](double value) { return Cell(value, shortest(value)); };
  const auto e = one.given_restitution();
  std::string given;
  for (const auto& [key, value] : one.varied) {
    if (!is_restitution(one, *key) && !is_floor(*key) && !is_friction(*key))
      given += fmt::format("{}{} {}", given.empty() ? "" : ", ", words_of(one, *key), value);
  }
  return {text(one.scene()),
          text(floor_of(one.given)),
          e ? number(*e) : Cell(),
          one.given.has_ground() ? number(one.given.world.ground.sliding_friction) : Cell(),
          text(given),
          text(part_text_of(one))};
}

/// Those that differ from case to case.
void show_columns_of_case(const std::vector<const ReportCase*>& cases, Grid& grid) {
  const std::size_t count = columns_of_case().size();
  std::vector<Row> rows;
  for (const ReportCase* one : cases) rows.push_back(cells_of_case(*one));
  for (std::size_t i = 0; i < count; ++i)
    grid.columns[i].shown =
        std::ranges::any_of(rows, [&](const Row& row) { return shown_text(row[i]) != shown_text(rows.front()[i]); });
}

/// The parts of a scene in groups that have no probe in common: each is one sweep.
std::vector<std::vector<FragilePart>> groups_of(const std::vector<FragilePart>& parts,
                                                const std::vector<Probe>& probes) {
  std::vector<std::vector<FragilePart>> groups;
  for (const FragilePart& part : parts) {
    const auto group = std::ranges::find_if(groups, [&](const std::vector<FragilePart>& others) {
      return std::ranges::none_of(probes, [&](const Probe& probe) {
        return part.is_at(probe.name) &&
               std::ranges::any_of(others, [&](const FragilePart& other) { return other.is_at(probe.name); });
      });
    });
    if (group == groups.end()) groups.push_back({part});
    else group->push_back(part);
  }
  return groups;
}

/// A drop is followed to a digit more than the page says, where nobody asks for others.
void settle_digits(ReportInput& input) {
  const SceneValues values = scene_values(input.scene.source);
  const auto is_said = [&](const Key& key) {
    const std::string name = key.name;
    return (name == "run.digits" || name == "run.tolerance" || name == "run.step") &&
           (is_given(input.scene, key.flag) || values.has(name));
  };
  if (model_of(input) == Model::continuous && std::ranges::none_of(all_keys(), is_said))
    input.scene.texts["--digits"] = "4";
}

/// Each part at its probe; one without a place at each, or where the ranking looks.
std::vector<FragilePart> placed_parts(const ReportInput& input, const std::vector<Probe>& probes) {
  const auto is_looked_at = [&](const Probe& probe) { return input.rank_by.ends_with("_" + probe.name); };
  std::vector<FragilePart> placed;
  for (FragilePart part : parts_of(input.parts, probes)) {
    if (!part.probe.empty() || probes.size() < 2) placed.push_back(part);
    else {
      for (const Probe& probe : probes) {
        part.probe = probe.name;
        const bool is_there =
            std::ranges::any_of(placed, [&](const auto& other) { return part_text(other) == part_text(part); });
        if (!is_there && (std::ranges::none_of(probes, is_looked_at) || is_looked_at(probe))) placed.push_back(part);
      }
    }
  }
  return placed;
}

}  // namespace

std::vector<ReportCase> cases_of(const ReportInput& given) {
  std::vector<ReportInput> inputs{given};
  const auto multiply = [&](std::size_t count, auto&& set) {
    std::vector<ReportInput> more;
    for (const ReportInput& input : inputs) {
      for (std::size_t i = 0; i < count; ++i) set(i, more.emplace_back(input));
    }
    if (count > 0) inputs = std::move(more);
  };
  multiply(given.scenes.size(), [&](std::size_t i, ReportInput& input) { input.scene.source = given.scenes[i]; });
  std::vector<const Key*> varied;
  for (const SceneOverride& flag : overrides_of(given.scene)) {
    const Key& key = key_named(flag.key);
    const std::vector<std::string> values = several_values(key, flag.text);
    if (values.empty()) continue;
    varied.push_back(&key);
    multiply(values.size(), [&](std::size_t i, ReportInput& input) { input.scene.texts[key.flag] = values[i]; });
  }
  std::vector<ReportCase> cases;
  const auto add = [&](ReportInput input, const std::vector<FragilePart>& group, bool is_first) {
    const bool is_turned = gives_attitude(input);
    settle_digits(input);
    if (!is_turned && looks_at_all(input)) input.scene.texts["--orientation"] = "1";  // some one: the sweep has its own
    const Scene scene = shock_scene(input);
    require_worst_attitudes(input, scene);
    if (!input.parts.empty() && probes_of(input).empty())
      throw BadInput("--part: needs --probe NAME:X,Y,Z, or [[probe]], where the part is");
    ReportCase& one = cases.emplace_back(
        ReportCase{.input = input, .varied = {}, .view = view_of(input), .is_turned = is_turned, .given = scene});
    one.names_scene = given.scenes.size() > 1;
    one.swept_with = group;
    one.begins_sweep = is_first;
    for (const Key* key : varied) one.varied.emplace_back(key, input.scene.texts.at(key->flag));
  };
  std::size_t count = 0;
  for (const ReportInput& input : inputs)
    count += std::max<std::size_t>(placed_parts(input, probes_of(input)).size(), 1);
  if (count > most_cases)
    throw BadInput(fmt::format("{} cases of scenes, values and parts: more than {}", count, most_cases));
  for (const ReportInput& input : inputs) {
    const std::vector<Probe> probes = probes_of(input);
    const std::vector<FragilePart> parts = placed_parts(input, probes);
    if (parts.empty()) add(input, {}, true);
    for (const std::vector<FragilePart>& group : groups_of(parts, probes)) {
      for (const FragilePart& part : group) {
        ReportInput of_part = input;
        of_part.parts = {part};
        add(of_part, group, part_text(part) == part_text(group.front()));
        const auto rivals = std::ranges::count(parts, part.probe, &FragilePart::probe);
        cases.back().part_name = !part.probe.empty() && rivals == 1 ? part.probe : words_of(part);
      }
    }
  }
  return cases;
}

std::string ReportCase::scene() const {
  const std::string& source = input.scene.source;
  return source.substr(0, source.size() - (source.ends_with(".toml") ? 5 : 0));
}

std::string ReportCase::name() const {
  std::string words = names_scene ? scene() : "";
  for (const auto& [key, value] : varied) {
    words += words.empty() ? "" : ", ";
    words += is_floor(*key)                ? value
             : is_restitution(*this, *key) ? "e = " + value
                                           : words_of(*this, *key) + " " + value;
  }
  return words;
}

std::string ReportCase::heading() const {
  std::string words = name();
  if (!input.part()) return words;
  const std::optional<Blow>& blow = found.answer.blow;
  words += (words.empty() ? "" : ": ") + words_of(*input.part());
  if (blow && blow->margin) words += fmt::format(" {}", blow->margin->verdict());
  if (words.starts_with("a part")) words.front() = 'A';
  return words;
}

std::optional<double> ReportCase::given_restitution() const {
  return is_of_ground(*this) ? given.ground_restitution : given.impact.restitution;
}

Grid cases_grid(const std::vector<const ReportCase*>& cases) {
  Grid grid{case_columns(), {}, 3};
  show_columns_of_case(cases, grid);
  for (const ReportCase* one : cases) {
    const Value& answer = *one->found.report.fields.find("answer");
    const auto of = [&](const char* name, double unit = 1) {
      const Value* const value = answer.find(name);
      const double* const number = value ? value->number() : nullptr;
      const Value* const error = answer.find(std::string(name) + "_error");
      const double off = !error ? 0 : error->number() ? *error->number() : unknown_error;
      return !value ? Cell() : number ? said_cell(unit * *number, unit * off) : Cell(*value);
    };
    const auto& pad = one->found.scene.pad.thickness;
    Row row = cells_of_case(*one);
    for (const char* name :
         {"verdict", "margin", "failing", "drops", "attitude", "probe", "impact", "peak_g", "delta_v"})
      row.push_back(of(name));
    row.push_back(of("pulse_duration", 1e3));
    row.push_back(of("depth", 1e3));
    row.push_back(pad ? of("depth", 100 / *pad) : Cell());
    const auto& blow = one->found.answer.blow;
    row.push_back(blow && blow->margin ? deciding_cell(blow->margin->by) : Cell());
    row.push_back(blow && blow->response_g ? said_cell(*blow->response_g) : Cell());
    grid.rows.push_back(std::move(row));
  }
  const auto any = [&](auto&& holds) {
    return std::ranges::any_of(cases, [&](const ReportCase* one) { return holds(*one); });
  };
  const bool has_part =
      any([](const ReportCase& one) { return one.input.part().has_value() && one.input.part()->has_limit(); });
  for (Column& column : grid.columns) {
    if (column.name == "drops") column.shown = false;  // which the headings of others say
    if (const auto& all = cases.front()->found.all; all && column.name == "failing")
      column.heading = fmt::format("fail of {}", all->drops.size());
    if (column.name == "verdict" || column.name == "margin" || column.name == "decided_by" || column.name == "failing")
      column.shown = has_part;
    if (column.name == "response_g")
      column.shown =
          any([](const ReportCase& one) { return one.found.answer.blow && one.found.answer.blow->response_g; });
    if (column.name == pulse_column().name)
      column.shown = any([](const ReportCase& one) { return one.found.ranking.has_peaks; });
    if (column.name == "probe")
      column.shown = any([](const ReportCase& one) {
        return one.found.run.probes.size() > 1 && (!one.input.part() || one.input.part()->probe.empty());
      });
    if (column.name == "depth_mm")
      column.shown = any(
          [](const ReportCase& one) { return one.found.scene.world.ground.is_pad() || one.found.scene.pad.thickness; });
    if (column.name == "depth_percent")
      column.shown = any([](const ReportCase& one) { return one.found.scene.pad.thickness.has_value(); });
  }
  return grid;
}

std::vector<const ReportCase*> ranked(const std::vector<ReportCase>& cases) {
  std::vector<const ReportCase*> order;
  for (const ReportCase& one : cases) order.push_back(&one);
  std::ranges::stable_sort(order, [](const ReportCase* one, const ReportCase* other) {
    const Ranking &mine = one->found.ranking, &theirs = other->found.ranking;
    if (mine.by != theirs.by) return mine.by < theirs.by;
    const bool is_known = std::isfinite(one->value());
    return is_known && std::isfinite(other->value()) ? mine.is_worse(one->value(), other->value())
                                                     : is_known && !std::isfinite(other->value());
  });
  return order;
}

std::vector<const ReportCase*> worst_cases(const std::vector<const ReportCase*>& order) {
  std::vector<const ReportCase*> worst;
  const auto floor = [](const ReportCase* one) { return std::pair(one->scene(), floor_of(one->given)); };
  for (const ReportCase* one : order) {
    const auto is_known = [&](auto&& of) {
      return std::ranges::any_of(worst, [&](const ReportCase* other) { return of(other) == of(one); });
    };
    if (!is_known(floor) || !is_known([](const ReportCase* of) { return part_text_of(*of); })) worst.push_back(one);
  }
  return worst;
}

namespace {

/// The cases of each part, the worst part first.
std::vector<std::vector<const ReportCase*>> by_part(const std::vector<const ReportCase*>& order) {
  std::vector<std::vector<const ReportCase*>> parts;
  for (const ReportCase* one : order) {
    const auto part = std::ranges::find_if(
        parts, [&](const auto& cases) { return part_text_of(*cases.front()) == part_text_of(*one); });
    if (part == parts.end()) parts.push_back({one});
    else part->push_back(one);
  }
  return parts;
}

bool has_margin(const ReportCase* one) { return one->found.answer.blow && one->found.answer.blow->margin; }

bool has_response(const ReportCase* one) { return one->found.answer.blow && one->found.answer.blow->response_g; }

/// " 0.12 (concrete, e = 0.7: corner -x-y+z down, 3.2° off, impact 2) to 1.3 (wood, e = 0.3: face +z down, 1° off,
/// impact 1)": the worst case and the mildest, each with the drop that has it.
std::string range_words(const std::vector<const ReportCase*>& cases, const auto& number) {
  const auto end = [&](const ReportCase& one) {
    std::string words = one.name();
    if (const auto& all = one.found.all) words += (words.empty() ? "" : ": ") + all->name;
    words += (words.empty() ? "impact " : ", impact ") + std::to_string(one.found.answer.blow->impact);
    return fmt::format(" {} ({})", number(one), words);
  };
  const ReportCase &worst = *cases.front(), &mildest = *cases.back();
  return end(worst) + (number(mildest) != number(worst) ? " to" + end(mildest) : "");
}

/// ", of 260 drops on ..." where the drops of each case are as many.
std::string of_drops_words(const std::vector<const ReportCase*>& cases) {
  const auto& all = cases.front()->found.all;
  if (!all) return "";
  const auto is_other = [&](const ReportCase* one) {
    return !one->found.all || one->found.all->drops_words() != all->drops_words();
  };
  return std::ranges::any_of(cases, is_other) ? ", of all drops" : ", of " + all->drops_words();
}

/// "camera answers with at most 832 g (…) to 120 g (…)": of cases with a part without a limit.
std::string response_words(const std::vector<const ReportCase*>& cases) {
  const auto number = [](const ReportCase& one) { return said(*one.found.answer.blow->response_g) + " g"; };
  return fmt::format("{} answers with{}{}; no limit was given", cases.front()->part_name, range_words(cases, number),
                     of_drops_words(cases));
}

/// "camera fails in 3 of 4 cases, least margin 0.12 (concrete, e = 0.7: …) to 1.3 (wood, e = 0.3: …)": of cases with
/// margins.
std::string margin_words(const std::vector<const ReportCase*>& cases) {
  const ReportCase& worst = *cases.front();
  const auto margin = [](const ReportCase& one) { return said(one.found.answer.blow->margin->value); };
  const char* const which = worst.found.ranking.by == Ranking::By::margin ? "least margin" : "margin in its worst drop";
  const auto failing =
      std::ranges::count_if(cases, [](const ReportCase* one) { return !(one->found.answer.blow->margin->value > 1); });
  const auto count = static_cast<std::ptrdiff_t>(cases.size());
  const std::string words =
      count == 1 ? fmt::format("{} {}", worst.part_name, worst.found.answer.blow->margin->verdict())
      : failing == 0 || failing == count
          ? fmt::format("{} {} in all {} cases", worst.part_name, failing ? "fails" : "survives", count)
          : fmt::format("{} fails in {} of {} cases", worst.part_name, failing, count);
  return fmt::format("{}, {}{}{}", words, which, range_words(cases, margin), of_drops_words(cases));
}

/// The value of what is varied: a key of the case by its place, and behind them the scene.
std::string setting_of(const ReportCase& one, std::size_t place) {
  return place == one.varied.size() ? one.scene() : one.varied[place].second;
}
std::string name_of_setting(const ReportCase& one, std::size_t place) {
  return place == one.varied.size() ? "scene" : words_of(one, *one.varied[place].first);
}

/// How many times the value by which the cases of one part are ranked changes with each thing that is varied, all else
/// the same: the largest ratio of all, the most decisive first.  Nothing of cases without such a value.
std::vector<std::pair<std::string, double>> influences(const std::vector<const ReportCase*>& cases) {
  std::vector<std::pair<std::string, double>> times;
  if (std::ranges::none_of(cases, [](const ReportCase* one) { return std::isfinite(one->value()); })) return times;
  const std::size_t keys = cases.front()->varied.size();
  for (std::size_t place = 0; place <= keys; ++place) {
    if (place == keys && !cases.front()->names_scene) continue;
    double most = 1;
    for (const ReportCase* one : cases) {
      for (const ReportCase* other : cases) {
        bool is_same_else = true;
        for (std::size_t i = 0; i <= keys; ++i)
          is_same_else = is_same_else && (i == place || setting_of(*one, i) == setting_of(*other, i));
        if (is_same_else) most = std::fmax(most, one->value() / other->value());
      }
    }
    times.emplace_back(name_of_setting(*cases.front(), place), most);
  }
  std::ranges::stable_sort(times, std::ranges::greater{}, &std::pair<std::string, double>::second);
  return times;
}

/// Which first and next of what is ranked are less apart than the halves of their samples: values of what is varied, by
/// the worst case of each, and parts; empty: none.
std::string tie_words(const std::vector<std::vector<const ReportCase*>>& parts) {
  std::string words;
  const auto add = [&](const ReportCase& one, const ReportCase& next, const std::string& what, const auto& name) {
    const auto &all = one.found.all, &others = next.found.all;
    if (one.found.ranking.by != next.found.ranking.by || !all || !others) return;
    if (std::fabs(std::log(one.value() / next.value())) < std::fmax(all->spread(), others->spread()))
      words += fmt::format("{}{}{} ({}) and {} ({})", words.empty() ? "" : "; ", what, name(one), said(one.value()),
                           name(next), said(next.value()));
  };
  if (parts.size() > 1)
    add(*parts[0].front(), *parts[1].front(), "", [](const ReportCase& one) { return one.part_name; });
  for (const std::vector<const ReportCase*>& cases : parts) {
    const ReportCase& worst = *cases.front();
    const std::size_t keys = worst.varied.size();
    for (std::size_t place = 0; place < keys + (worst.names_scene ? 1 : 0); ++place) {
      const auto next = std::ranges::find_if(
          cases, [&](const ReportCase* one) { return setting_of(*one, place) != setting_of(worst, place); });
      if (next == cases.end()) continue;
      add(worst, **next, (parts.size() > 1 ? worst.part_name + ", " : "") + name_of_setting(worst, place) + " ",
          [&](const ReportCase& one) { return setting_of(one, place); });
    }
  }
  if (words.empty()) return "";
  return "Less apart than the halves of the sample, so that more --drops may change which is worse: " + words;
}

/// What of the ground stays though e is ranged over; empty: nothing.
std::string fixed_words(const std::vector<const ReportCase*>& cases) {
  const auto is_of_springs = [](const ReportCase* one) {
    const numeric::Ground& ground = one->given.world.ground;
    return std::ranges::any_of(one->varied, [&](const auto& of) { return is_restitution(*one, *of.first); }) &&
           one->given.ground_restitution && !ground.is_half_space() && !ground.is_pad();
  };
  if (std::ranges::none_of(cases, is_of_springs)) return "";
  return "k_G is the same at each e: where it was found from a contact time, that time is kept only at the e that was "
         "measured with it (clatter shock --ground --measured-e E gives k_G at another)";
}

}  // namespace

std::vector<std::string> part_answers(const std::vector<const ReportCase*>& order) {
  std::vector<std::string> answers;
  for (const std::vector<const ReportCase*>& of_part : by_part(order)) {
    const ReportCase& one = *of_part.front();
    const std::string name = one.name();
    answers.push_back(std::ranges::all_of(of_part, has_margin) ? margin_words(of_part)
                      : std::ranges::all_of(of_part, has_response)
                          ? response_words(of_part)
                          : fmt::format("{}{}{}", name.empty() ? "" : "the worst is " + name + ": ",
                                        one.part_name.empty() ? "" : one.part_name + ": ",
                                        one.found.answer.blow ? one.found.lead : one.found.answer.words));
  }
  return answers;
}

Report joined_report(const std::vector<const ReportCase*>& order) {
  const Findings& worst = order.front()->found;
  const Grid cases = cases_grid(order);
  const std::vector<std::vector<const ReportCase*>> parts = by_part(order);
  Report report = worst.report;
  report.grid = cases;
  report.head.insert(report.head.begin(), "The worst case:");
  std::string words = parts.size() == order.size() ? ""
                      : parts.size() == 1          ? fmt::format("{} cases: ", order.size())
                                                   : fmt::format("{} parts: ", parts.size());
  words += fmt::format("{}", fmt::join(part_answers(order), "; "));
  report.notes = {words, worst.lead};
  Value::List moves;
  std::string influence;
  for (const std::vector<const ReportCase*>& of_part : parts) {
    const std::string& part = of_part.front()->part_name;
    const auto all = influences(of_part);
    std::string of_it;
    for (const auto& [name, times] : all) {
      moves.emplace_back(Value::Fields{{"name", name}, {"times", times}});
      if (!part.empty()) moves.back()["part"] = part;
      of_it += fmt::format("{}{} {} times", of_it.empty() ? "" : ", ", name, said(times));
    }
    if (all.size() > 1) influence += (influence.empty() ? "" : "; ") + (parts.size() > 1 ? part + ": " : "") + of_it;
  }
  if (!influence.empty())
    influence.insert(0, fmt::format("What moves the {} most, all else the same: ",
                                    worst.ranking.by == Ranking::By::margin ? "least margin" : "worst blow"));
  for (const std::string& note : {influence, tie_words(parts)}) {
    if (!note.empty()) report.notes.push_back(note);
  }
  if (const std::string fixed = fixed_words(order); !fixed.empty()) report.notes.push_back(fixed);
  report.fields["message"] = words;
  report.fields["moves"] = moves;
  report.fields["cases"] = row_objects(cases);
  return report;
}

std::vector<Column> case_attitude_columns() { return with_more(columns_of_case(), attitude_columns()); }

Grid attitudes_of_cases(const std::vector<const ReportCase*>& cases) {
  Grid grid{case_attitude_columns(), {}, columns_of_case().size() + 1};
  show_columns_of_case(cases, grid);
  const std::size_t first = columns_of_case().size();
  for (std::size_t i = first; i < grid.columns.size(); ++i) grid.columns[i].shown = false;
  for (const ReportCase* one : cases) {
    if (!one->found.all)
      throw BadInput("--rows attitude: is for a box, whose worst attitudes are looked for, and not with --drops 0");
    const Grid own = attitudes_grid(*one->found.all);
    for (std::size_t i = 0; i < own.columns.size(); ++i) {
      if (own.columns[i].shown) grid.columns[first + i] = own.columns[i];
    }
    for (const Row& attitude : own.rows) {
      Row row = cells_of_case(*one);
      row.insert(row.end(), attitude.begin(), attitude.end());
      grid.rows.push_back(std::move(row));
    }
  }
  return grid;
}

std::vector<Column> case_columns() {
  return with_more(
      columns_of_case(),
      {word_column("verdict", "verdict", "whether the part survives all drops, or fails in one: by the margin"),
       {"margin", "margin", "", "the least of all drops: at 1 and below the part fails"},
       {"failing", "failing", "", "drops that the part does not survive"},
       {"drops", "drops", "", "of the case"},
       word_column("attitude", "down", "how the body is turned in that drop"),
       word_column("probe", "at", "name of the point"),
       {"impact", "impact", "", "whose blow has it"},
       {"peak_g", "peak", "g", "largest specific force at the probe in that blow"},
       {"delta_v", "|ΔV|", "m/s", "change of the probe's velocity in it"},
       pulse_column(),
       {"depth_mm", "depth", "mm", "of the body's deepest point in it"},
       {"depth_percent", "of pad", "%", "the same in parts of the pad's thickness"},
       word_column("decided_by", "by", "what decides the margin: |ΔV|, peak, or the humps of its history"),
       {"response_g", "answer", "g", "of a part without a limit: its largest acceleration in that blow"}});
}

}  // namespace clatter::validation
