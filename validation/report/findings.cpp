// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/output/bad_input.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/keys.hpp"
#include "validation/sequence/sequence_report.hpp"
#include "validation/simulate/simulation_report.hpp"

namespace clatter::validation {
namespace {

/// That the discrete model's hardest blow and the one beside it overlap on the scene's ground, whose first contact
/// lasts longer than the time between them; empty: they do not, or there is no ground.
std::string overlap_words(const Scene& scene, const ShockRun& run) {
  if (run.continuous || !scene.has_ground() || run.discrete_run->impacts.size() < 2) return "";
  const std::vector<Impact>& impacts = run.discrete_run->impacts;
  const auto hardest = std::ranges::max_element(run.rows(), {}, [](const ShockRow& r) { return r.value.delta_v_size; });
  const int second = hardest == run.rows().end() ? 2 : std::max(hardest->impact, 2);
  const auto start = [&](int impact) { return impacts[static_cast<std::size_t>(impact - 1)].value.start; };
  const double apart = start(second) - start(second - 1);
  const numeric::Body body = scene.make_body();
  const numeric::Simulation first =
      numeric::simulate(body, scene.world, scene.start(body),
                        {.impacts = 1, .error_estimates = false, .amplification = false}, {.digits = 3});
  if (first.impacts.empty() || !(first.impacts.front().value.duration > apart)) return "";
  return fmt::format(
      "impacts {} and {} are {} ms apart, but the first contact with this floor lasts {} ms: there they overlap",
      second - 1, second, said(1e3 * apart), said(1e3 * first.impacts.front().value.duration));
}

bool is_of_box(const ReportInput& input) {
  const SceneValues values = scene_values(input.scene.source);
  if (is_given(input.scene, "--mesh")) return false;
  const bool is_typed = is_given(input.scene, "--body");
  return (is_typed                   ? input.scene.texts.at("--body")
          : values.has("body.shape") ? values.text("body.shape")
                                     : "") == "box";
}

/// Whether flags say how the body is turned.
bool types_attitude(const ReportInput& input) {
  return std::ranges::any_of(all_keys(), [&](const Key& key) {
    return turns_body(key.name) && *key.flag != '\0' && is_given(input.scene, key.flag);
  });
}

Answer answer_of(const ShockRun& run, const Ranking& ranking) {
  Answer answer;
  const Run impacts = run.leading_run();
  if (run.probes.empty()) {
    if (!run.continuous) return {.blow = {}, .words = "no probe was named"};
    const double peak = totals(impacts).largest_peak.value;
    answer.words = fmt::format("the largest force is {} N", said(peak));
    answer.fields["peak_force"] = peak;
    return answer;
  }
  answer.blow = worst_blow(run.rows(), impacts, run.scene, ranking);
  if (!answer.blow) return {.blow = {}, .words = "nothing strikes"};
  const Blow& blow = *answer.blow;
  const std::string& probe = run.probes[ranking.probe].name;
  answer.words = blow_words(blow, probe, ranking);
  answer.fields = Value::Fields{{"probe", probe}, {"impact", blow.impact}, {"delta_v", blow.velocity}};
  const auto add_error = [&](const char* name, double value, double error) {
    answer.fields[name] = error_or_nothing({value, error});
  };
  add_error("delta_v_error", blow.velocity, blow.velocity_error);
  if (ranking.has_peaks) {
    answer.fields["peak_g"] = blow.peak_g;
    add_error("peak_g_error", blow.peak_g, blow.peak_g_error);
    answer.fields["width"] = blow.width;
    answer.fields["pulse_duration"] = equivalent_pulse(blow.velocity, blow.peak_g * standard_gravity).duration;
    answer.fields["depth"] = *blow.depth;
    if (const std::string deep = depth_words(run.scene, *blow.depth); !deep.empty()) answer.words += "; " + deep;
  }
  if (blow.response_g) answer.fields["response_g"] = *blow.response_g;
  if (!blow.margin) return answer;
  answer.fields["verdict"] = blow.margin->verdict();
  answer.fields["margin"] = blow.margin->value;
  add_error("margin_error", blow.margin->value, blow.margin_error);
  answer.fields["decided_by"] = deciding_cell(blow.margin->by).value;
  if (ranking.part->kind == FragilePart::Kind::oscillator)
    answer.fields["response_g"] = ranking.part->fragility / standard_gravity / blow.margin->value;
  return answer;
}

/// "In 257 of 260 drops the pad bottoms out"; empty without a pad.
std::string bottoming_words(const AllAttitudes& all, const Ranking& ranking) {
  if (!all.scene.world.ground.is_pad() || !ranking.has_peaks) return "";
  const auto bottoming = all.count([](const SweptDrop& drop) { return drop.curve_depth > 1; });
  const double deepest = std::ranges::max(all.drops, {}, &SweptDrop::curve_depth).curve_depth;
  const Scene& scene = all.scene;
  return fmt::format("The pad bottoms out in {} of {} drops{}", bottoming, all.drops.size(),
                     bottoming == 0
                         ? ""
                         : fmt::format(", going to {} times its curve's depth, {}", said(deepest),
                                       scene.half_space.floor
                                           ? "onto the floor, of E*/h of what is left of it, which is rather too hard"
                                       : scene.pad.under ? "onto the stiffness of --under"
                                                         : "where its last slope goes on, which is too soft: "
                                                           "--floor NAME or --under PA/M says what is below"));
}

/// The worst of all drops in a sentence: with a part in how many it survives, and the least margin of all.
std::string worst_words(const AllAttitudes& all, const Answer& answer, const Ranking& ranking) {
  if (!answer.blow || !answer.blow->margin || ranking.by != Ranking::By::margin) {
    const std::string words = answer.blow ? answer.words
                                          : fmt::format("its {} is {} {}", all.column.name,
                                                        said(all.drops[all.worst].value), all.column.unit);
    return fmt::format("Worst of {}: {}: {}", all.drops_words(), all.name, words);
  }
  return fmt::format("{} survives in {} of {}; least margin {}: {}, where {}", answer.fields.find("probe")->text(),
                     all.count([](const SweptDrop& drop) { return drop.value > 1; }), all.drops_words(),
                     said(answer.blow->margin->value), all.name, answer.words);
}

/// Three digits with the unit of what is ranked by.
std::string in_unit(const AllAttitudes& all, double value) {
  return said(value) + (all.column.unit.empty() ? "" : " " + all.column.unit);
}

/// What the answer leaves out of all drops, and how far it is known.
std::vector<std::string> notes_of_all(const AllAttitudes& all, const Answer& answer, const Ranking& ranking) {
  std::vector<std::string> notes;
  const SweptDrop& worst = all.drops[all.worst];
  const auto beyond = std::ranges::max_element(all.drops, [&](const SweptDrop& one, const SweptDrop& other) {
    return all.is_worse(other.beyond_value, one.beyond_value);
  });
  if (ranking.landing_alone && all.is_worse(beyond->beyond_value, worst.value)) {
    notes.push_back(fmt::format(
        "Impacts after the first landing follow bounces without loss and are left out; with them the {} is {} ({}, "
        "impact {})",
        all.is_least_worst() ? "least margin" : "largest", in_unit(all, beyond->beyond_value),
        name_of_drop(all.scene, beyond->attitude, beyond->down), beyond->beyond_impact));
  }
  const double of_rest = all.worst_of_other_half();
  if (all.is_sample && of_rest != worst.value) {
    std::string words = std::isfinite(of_rest) ? fmt::format(": the worst of one half has {}, of the other {}",
                                                             in_unit(all, worst.value), in_unit(all, of_rest))
                                               : ", one of each face, edge and corner";
    const SweptDrop* next = nullptr;  // the worst of the other faces, edges and corners
    for (const std::size_t i : all.worst_of) {
      if (i != all.worst && (!next || all.is_worse(all.drops[i].value, next->value))) next = &all.drops[i];
    }
    if (next && std::fabs(std::log(worst.value / next->value)) < all.spread())
      words += fmt::format("; less apart from the worst is {}, with {}, which may be as bad",
                           name_of_drop(all.scene, next->attitude, next->down), in_unit(all, next->value));
    notes.push_back(
        fmt::format("{} drops are a sample{}; more of them (--drops) can find a worse one", all.drops.size(), words));
  }
  constexpr double close = 0.02;  // of numbers to three digits whose errors were not looked for
  const auto place = std::ranges::find(all.worst_of, all.worst) - all.worst_of.begin();
  const std::optional<Blow>& swept = all.blows[static_cast<std::size_t>(place)];
  if (answer.blow && swept && all.is_of_blow && !(std::fabs(answer.blow->value / worst.value - 1) <= close)) {
    notes.push_back(fmt::format("To three digits this drop has {} in place of {}: {}", in_unit(all, worst.value),
                                in_unit(all, answer.blow->value),
                                answer.blow->predictable
                                    ? "small differences of the start decide which blows follow"
                                    : fmt::format("impact {} depends on digits that nobody has", answer.blow->impact)));
  }
  return notes;
}

/// That the drops were followed for so many impacts, and in how many of them the last was the hardest, so that harder
/// ones may follow; empty: they ended by themselves.
std::string limit_words(const Findings& found) {
  const int limit = found.scene.request.impacts;
  const auto& all = found.all;
  const bool is_told = all && all->drops[all->worst].impact > 0;
  const auto at_limit = is_told ? all->count([&](const SweptDrop& drop) { return drop.impact == limit; })
                                : found.answer.blow && found.answer.blow->impact == limit;
  if (at_limit > 0)
    return fmt::format("{} hardest blow is the last one followed, impact {}: later ones may be harder (--impacts)",
                       is_told ? fmt::format("In {} of {} drops the", at_limit, all->drops.size()) : "The", limit);
  if (!found.run.ends_at_limit()) return "";
  return is_told ? fmt::format("In none of {} drops is the hardest blow the last one followed, impact {} (--impacts)",
                               all->drops.size(), limit)
                 : fmt::format("Impacts after the {} followed may be harder (--impacts)", limit);
}

/// What to read of a blow that is short against the part's period, or shorter than a shock machine's; empty: any of it.
std::string reading_words(const Blow& blow, const Ranking& ranking) {
  const auto part = ranking.part ? ranking.part->oscillator() : std::nullopt;
  const double most = part ? 1 / (4 * part->frequency) : service_conditions().front().pulse.duration;
  if (!ranking.has_peaks || !(equivalent_pulse(blow.velocity, blow.peak_g * standard_gravity).duration < most))
    return "";
  return fmt::format(
      "The worst pulse is short{}: read the change of velocity and the spectrum{}, not the peak, which no "
      "housing passes on",
      part ? " against the part's period" : ", shorter than any of JESD22-B110B",
      part ? " at the part's frequency" : "");
}

/// Shows how deep each impact goes, and in a pad of known thickness which part of that it is.
void show_depths(const Scene& scene, const numeric::Simulation& run, Grid& grid) {
  for (Column& column : grid.columns) {
    if (column.name == "indentation") column.shown = true;
  }
  const auto& pad = scene.pad.thickness;
  if (!pad || run.impacts.size() != grid.rows.size()) return;
  grid.columns.push_back({"depth_percent", "of pad", "%", "depth in parts of the pad's thickness"});
  for (std::size_t i = 0; i < grid.rows.size(); ++i)
    grid.rows[i].emplace_back(100 * run.impacts[i].value.indentation / *pad, 3);
}

/// What --format json has, by the names of the commands that give it.
void add_fields(const ReportInput& input, const ShockView& view, Findings& found) {
  const Scene& scene = found.scene;
  Value& fields = found.report.fields;
  if (found.all) {
    fields["attitudes"] = found.all->report.fields.at("attitudes");
    fields["summary"] = row_objects(found.all->report.grid);
  }
  const std::string words = scene_words(input, found.all ? scene.attitude : std::vector<double>{});
  if (found.all && !found.all->command.empty()) found.commands.push_back(found.all->command);
  if (!found.run.probes.empty()) {
    found.commands.push_back("clatter shock" + words + probe_words(input));
    fields["shock"] = shock_report(found.run, view).fields;
  }
  const bool is_continuous = found.run.continuous.has_value();
  if (is_continuous) {
    found.impacts = simulation_report(scene, found.run.continuous->planned);
    show_depths(scene, found.run.continuous->planned.run, found.impacts.grid);
  } else {
    const PreparedScene drop = prepared(scene);
    found.impacts = sequence_report(drop, run_discrete(drop));
  }
  fields[is_continuous ? "simulation" : "sequence"] = found.impacts.fields;
  found.commands.push_back((is_continuous ? "clatter simulate" : "clatter sequence") + words);
  fields["commands"] = found.commands;
  found.report.head = {scene.summary(model_of(input), found.all ? attitude_keys : KeyNames{})};
  found.report.grid = found.all ? attitudes_grid(*found.all) : found.impacts.grid;
  found.report.notes = {found.lead};
  found.report.notes.insert(found.report.notes.end(), found.notes.begin(), found.notes.end());
}

}  // namespace

void require_worst_attitudes(const ReportInput& input, const Scene& scene) {
  const bool is_box = scene.body.shape == BodyScene::Shape::box, has_none = input.drops == 0;
  const auto refuse = [&](const char* name, const auto& given, bool is_count) {
    if (!given) return;
    if (!is_box) throw BadInput(fmt::format("{} {}: is for a box, whose worst attitudes are looked for", name, *given));
    if (has_none && !is_count) throw BadInput(fmt::format("{} {}: changes nothing with --drops 0", name, *given));
  };
  refuse("--drops", input.drops, true);
  refuse("--scatter", input.scatter, false);
  refuse("--threads", input.threads, false);
  refuse("--rank-by", input.rank_by.empty() ? std::nullopt : std::optional(input.rank_by), false);
}

bool gives_attitude(const ReportInput& input) {
  const SceneValues values = scene_values(input.scene.source);
  return types_attitude(input) ||
         std::ranges::any_of(all_keys(), [&](const Key& key) { return turns_body(key.name) && values.has(key.name); });
}

bool looks_at_all(const ReportInput& input) { return is_of_box(input) && input.drops != 0; }

std::optional<Findings> findings_of(const ReportInput& input, const Scene& given, bool is_turned,
                                    const AttitudeSweep* swept, const ShockView& view,
                                    const CooperativeInterrupt& interrupt) {
  const std::vector<Probe> probes = probes_of(input);
  const Model model = model_of(input);
  std::string rank_by = input.rank_by;
  if (rank_by.empty() && !probes.empty()) {
    RowLayout layout{.model = model, .probes = probes};
    for (const Probe& probe : probes)
      layout.part_at.push_back(input.part() && input.part()->is_at(probe.name) ? input.part() : std::nullopt);
    rank_by = ranking_column(layout, layout.first_ranked(), is_lossless(given, model));
  }
  Findings found;
  found.ranking = ranking_of(rank_by, probes, input);
  const Ranking& ranking = found.ranking;
  if (swept) found.all = all_attitudes(input, given, *swept, rank_by);
  found.scene = found.all ? found.all->scene : given;
  const Scene& scene = found.scene;
  found.run = run_shock(scene, probes, request_of(input),
                        {.progress = watched(interrupt, found.all ? "the worst drop" : "the drop", scene)});
  if (interrupt.requested()) return {};

  found.report = begun_report("report", fmt::format("{}{}{}",
                                                    !input.title.empty()         ? input.title
                                                    : input.scene.source.empty() ? "a drop"
                                                                                 : input.scene.source,
                                                    input.date.empty() ? "" : ", ", input.date));
  Value& fields = found.report.fields;
  fields["model"] = name_of(model);
  fields["scene"] = scene_value(scene, model);
  found.answer = answer_of(found.run, ranking);
  fields["answer"] = found.answer.fields;
  found.lead = found.answer.words;
  say_doubts(scene, model, probes);
  found.notes = doubts_of(scene, model, probes);
  if (const auto& all = found.all) {
    const SweptDrop& worst = all->drops[all->worst];
    Value& answer = fields["answer"];
    answer["attitude"] = all->name;
    answer["ranked_by"] = all->column.name;
    answer[all->is_least_worst() ? "least" : "largest"] = worst.value;
    answer["drops"] = static_cast<long long>(all->drops.size());
    if (all->is_least_worst())
      answer["failing"] = static_cast<long long>(all->count([](const SweptDrop& drop) { return !(drop.value > 1); }));
    if (scene.world.ground.is_pad() && ranking.has_peaks)
      answer["bottoming"] =
          static_cast<long long>(all->count([](const SweptDrop& drop) { return drop.curve_depth > 1; }));
    found.lead = worst_words(*all, found.answer, ranking);
    if (const std::string bottoming = bottoming_words(*all, ranking); !bottoming.empty())
      found.lead += ". " + bottoming;
    for (const std::string& note : notes_of_all(*all, found.answer, ranking)) found.notes.push_back(note);
    if (is_turned && !probes.empty()) {
      ShockRequest plain = request_of(input);
      plain.sensitivity = false;
      const Answer own = answer_of(
          run_shock(given, probes, plain, {.progress = watched(interrupt, "the drop as given", given)}), ranking);
      const bool is_worse = own.blow && found.answer.blow &&
                            ranking.is_worse(own.blow->value, found.answer.blow->value) &&
                            said(own.blow->value) != said(found.answer.blow->value);
      // An angle of the file is there for other commands, too.
      if (is_worse || types_attitude(input))
        found.lead += fmt::format(". The drop as given{}: {}", is_worse ? " is worse" : "", own.words);
      fields["as_given"] = own.fields;
    }
  } else if (found.answer.blow && found.answer.blow->margin) {
    const BlowMargin& margin = *found.answer.blow->margin;
    found.lead = fmt::format("{} {}, margin {}: {}", probes[ranking.probe].name, margin.verdict(), said(margin.value),
                             found.answer.words);
  }
  if (const std::string overlap = overlap_words(scene, found.run); !overlap.empty()) {
    found.lead += "; " + overlap;
    fields["overlap"] = overlap;
  }
  found.notes.push_back(limit_words(found));
  if (found.answer.blow) found.notes.push_back(reading_words(*found.answer.blow, ranking));
  std::erase(found.notes, "");
  for (const std::string& note : assumed_words(scene, model, found.answer.blow.value_or(Blow{.impact = 1})))
    found.notes.push_back(note);
  fields["answer"]["notes"] = found.notes;
  fields["message"] = found.lead;
  add_fields(input, view, found);
  return found;
}

}  // namespace clatter::validation
