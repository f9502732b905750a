// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "analytic/law/viscoelastic.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/number.hpp"
#include "validation/output/report.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/floors.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/pad.hpp"
#include "validation/scene/scene.hpp"
#include "validation/shock/damage_boundary.hpp"
#include "validation/shock/ground_fit.hpp"

namespace clatter::validation {
namespace {

/// k_G of a material under a layer's or a half-space's approximation.
struct MaterialGround {
  double modulus = 0, poisson = 0, stiffness = 0;
};
/// A restitution that was measured beside the material, which says nothing of damping.
struct MaterialLoss {
  double restitution = 1, approach_speed = 0;  ///< of the first contact [m/s]
};

constexpr const char* units[] = {"", " s", " N", " m"};
constexpr const char* measure_flags[] = {"--measured-e", "--contact-time", "--peak-force", "--indentation"};

std::string words_of(const MeasuredNumber& measured) {
  return fmt::format("{} {}{}", measure_name(measured.measure), shortest(measured.value),
                     units[static_cast<std::size_t>(measured.measure)]);
}

/// "surface" or "projected", and what it means for a body that lands flat.
const char* area_words(numeric::AreaMeasure area) {
  return area == numeric::AreaMeasure::surface
             ? "area = surface: the load is taken over all of the body's surface below the ground, as the paper has "
               "it.  Side faces push, too, so that a flat body feels slightly more than its footprint.  A k_G found "
               "so belongs to this measure: with projected the same numbers give another."
             : "area = projected: the load is taken over the ground's area, a bed of upright springs.  Side faces do "
               "not push, and a flat body feels its footprint alone.  A k_G found so belongs to this measure: with "
               "surface, the paper's, the same numbers give another.";
}

/// @param depth  of the first impact [m]
/// @param thickness  of the pad, where it is known [m]
Row row_of(const FittedGround& ground, double depth, const std::optional<double>& thickness) {
  Row row;
  const Estimated stiffness{ground.stiffness, ground.stiffness_error}, damping{ground.damping, ground.damping_error};
  row.push_back(known_cell(stiffness, {6, 0}));
  row.push_back(known_cell(damping, {6, ground.stiffness}));
  for (const double predicted : ground.predicted) row.emplace_back(predicted, 6);
  row.emplace_back(depth, 4);
  row.push_back(thickness ? Cell(100 * depth / *thickness, 3) : Cell());
  for (const double by : ground.stiffness_by) row.emplace_back(by, 3);
  for (const double by : ground.damping_by) row.emplace_back(by, 3);
  row.emplace_back(error_or_nothing(stiffness));
  row.emplace_back(error_or_nothing(damping));
  return row;
}

/// Notes that a scene file can take, and the flags that say the same.
void add_ground_block(const std::vector<SceneOverride>& keys, Report& report) {
  report.notes.emplace_back("[ground]");
  for (const SceneOverride& key : keys) {
    const std::string name = key.key.substr(key.key.find('.') + 1);
    const bool is_name = key_named(key.key).value.kind == KeyValue::Kind::name;
    report.notes.push_back(is_name ? fmt::format("{} = \"{}\"", name, key.text)
                                   : fmt::format("{} = {}", name, key.text));
    double number = 0;
    report.fields["ground"][name] = read_number(key.text, number) ? Value(number) : Value(key.text);
  }
  report.notes.push_back("or as flags:" + flag_words(keys));
}

/// A row for the ground that is known by its modulus or its curve, or for each end of a floor's range.
std::vector<Column> dissipative_columns() {
  return {{"reduced_modulus", "E*", "Pa", "of an elastic half-space: 1/E* = (1 - ν²)/E of ground and body added"},
          {"dissipation", "τ", "s/m", "of a half-space or a pad, with a measured restitution"}};
}

/// A row for each ground that gives two measured numbers.
std::vector<Column> ground_columns(bool is_half_space) {
  std::vector<Column> columns = dissipative_columns();
  if (!is_half_space)
    columns = {{"stiffness", "k_G", "N/m³", "of the ground"}, {"damping", "c_G", "N·s/m⁴", "of the ground"}};
  const std::vector<Column> sought = columns;
  columns.insert(columns.end(),
                 {{"restitution", "e", "", "by the model: separation over approach speed of the first impact"},
                  {"contact_time", "contact", "s", "by the model: how long the first impact lasts"},
                  {"peak_force", "peak Fₙ", "N", "by the model: largest normal force of the first impact"},
                  {"indentation", "δ", "m",
                   "by the model: depth at which the ground carries the body at rest, in the attitude of the drop"},
                  {"depth", "depth", "m", "by the model: greatest depth of the first impact"},
                  {"depth_percent", "of pad", "%", "the same in parts of --thickness"}});
  for (std::size_t i = 0; i < sought.size(); ++i) {
    const auto add = [&](const char* measured, const char* place, const char* other) {
      columns.push_back({sought[i].name + "_by_" + measured,
                         i == 0 ? fmt::format("∂{}/∂{}", is_half_space ? "E" : "k", place) : "",
                         i == 0 ? "" : sought[i].unit,
                         fmt::format("∂ {}{}/∂ ln of the {} number, the {} held", i == 0 ? "ln " : "",
                                     sought[i].heading, measured, other),
                         i == 0});
    };
    add("first", "1", "second");
    add("second", "2", "first");
  }
  for (const Column& column : sought) columns.push_back(error_column(column));
  return columns;
}

/// How deep the body goes in the first impact [m].
double depth_on(const FittedGround& ground, const MeasuredDrop& drop) {
  const numeric::Simulation run =
      numeric::simulate(*drop.body, world_on(drop, ground.stiffness, ground.damping), drop.start,
                        {.impacts = 1, .error_estimates = false, .amplification = false}, {.digits = 5});
  return run.impacts.empty() ? std::nan("") : run.impacts.front().value.indentation;
}

/// Notes that say where springs serve for a pad, and the curve that has their stiffness as far as that.
void add_pad_curve(const Scene& scene, const FittedGround& ground, double depth, Report& report) {
  const double thickness = *scene.pad.thickness;
  const std::string deep = springs_warning(scene, depth);
  report.notes.push_back(
      deep.empty() ? fmt::format("the drop goes to {} % of the pad: these springs serve for it, and for milder ones",
                                 significant(100 * depth / thickness, 3))
                   : "!: warning: " + deep);
  constexpr double strain = 0.5;
  report.notes.push_back(fmt::format(
      "for harder drops: the same stiffness as a curve up to half the thickness, on a floor (another --floor NAME, or "
      "`under`); the data sheet's own curve is better, since a pad hardens on the way there"));
  report.notes.emplace_back("[ground]");
  const std::vector<std::pair<std::string, std::string>> lines{
      {"curve", fmt::format("[[0, 0], [{}, {}]]", strain, significant(ground.stiffness * thickness * strain, 6))},
      {"thickness", shortest(thickness)},
      {"floor", "\"concrete\""},
      {"restitution", significant(ground.predicted[static_cast<std::size_t>(DropMeasure::restitution)], 4)},
      {"area", fmt::format("\"{}\"", area_names()[static_cast<std::size_t>(scene.world.ground.area)])}};
  for (const auto& [name, text] : lines) {
    report.notes.push_back(fmt::format("{} = {}", name, text));
    report.fields["pad"][name] = text;
  }
}

/// The report on the ground that a drop and two measured numbers give.
Report ground_report(const Scene& scene, const MeasuredDrop& drop, const MeasuredNumber& first,
                     const MeasuredNumber& second, const GroundFit& fit) {
  Report report = begun_report("ground", "the ground from what was measured");
  const bool is_half_space = scene.world.ground.is_half_space();
  report.head =
      scene_head(scene, Model::continuous, {},
                 {"ground.stiffness", "ground.damping", "ground.modulus", "ground.dissipation", "ground.restitution"});
  report.head.push_back(fmt::format("measured: {}; {}", words_of(first), words_of(second)));
  const std::string materials = material_words(scene.half_space);
  report.head.push_back(!is_half_space ? "sought: k_G and c_G of springs"
                                       : "sought: E* and τ of an elastic half-space" +
                                             (materials.empty() ? "" : ", in place of " + materials));
  report.grid.columns = ground_columns(is_half_space);
  for (Column& column : report.grid.columns) {
    if (column.name == "depth_percent") column.shown = scene.pad.thickness.has_value();
  }
  double depth = 0;  // of the last
  for (const FittedGround& ground : fit.solutions) {
    depth = depth_on(ground, drop);
    report.grid.rows.push_back(row_of(ground, depth, scene.pad.thickness));
  }
  if (fit.solutions.empty()) {
    report.notes.push_back(fmt::format("no ground gives both: with the one, the other number goes from {} to {}",
                                       significant(fit.least, 4), significant(fit.largest, 4)));
  } else if (fit.solutions.size() > 1) {
    report.notes.push_back(fmt::format("{} grounds give both numbers", fit.solutions.size()));
  }
  report.notes.push_back(fmt::format(
      "δ: depth under the body at rest; ∂{0}/∂1, ∂{0}/∂2: by how many per cent {1} changes with one per cent of the "
      "first or the second measured number",
      is_half_space ? "E" : "k", is_half_space ? "E*" : "k_G"));
  if (!is_half_space) report.notes.emplace_back(area_words(scene.world.ground.area));
  if (fit.solutions.size() == 1) {
    const FittedGround& ground = fit.solutions.front();
    std::vector<SceneOverride> keys{
        {is_half_space ? "ground.modulus" : "ground.stiffness", "", significant(ground.stiffness, 6)},
        {is_half_space ? "ground.dissipation" : "ground.damping", "", significant(ground.damping, 6)}};
    if (!is_half_space)
      keys.push_back({"ground.area", "", area_names()[static_cast<std::size_t>(scene.world.ground.area)]});
    add_ground_block(keys, report);
    if (scene.pad.thickness) add_pad_curve(scene, ground, depth, report);
  }
  report.fields["scene"] = scene_value(scene);
  report.fields["body"] = body_value(scene);
  report.fields["measured"] =
      Value::List{Value(Value::Fields{{"name", measure_name(first.measure)}, {"value", first.value}}),
                  Value(Value::Fields{{"name", measure_name(second.measure)}, {"value", second.value}})};
  report.fields["solutions"] = row_objects(report.grid);
  report.fields["cost"] = Value::Fields{{"runs", fit.runs}};
  return report;
}

/// A row for each material or end of a floor's range; the last column with a measured restitution alone.
std::vector<Column> material_columns() {
  return {{"stiffness", "k_G", "N/m³", "of the ground"},
          {"modulus", "E", "Pa", "Young's modulus"},
          {"poisson", "ν", "", "Poisson's ratio"},
          {"damping", "c_G", "N·s/m⁴", "of the ground, with a measured restitution"}};
}

/// A row for each; a named floor has two, the ends of its range.
Report material_report(const std::vector<MaterialGround>& grounds, const std::string& approximation,
                       const std::string& source, const std::optional<MaterialLoss>& loss) {
  Report report = begun_report("ground", "the ground from a material");
  report.grid.columns = material_columns();
  if (!loss) report.grid.columns.pop_back();
  const double damping_per_stiffness =
      loss ? analytic::damping_of_restitution(loss->restitution) / loss->approach_speed : 0;
  for (const MaterialGround& ground : grounds) {
    Row row{Cell(ground.stiffness, 6), Cell(ground.modulus, 6), Cell(ground.poisson, 6)};
    if (loss) row.emplace_back(ground.stiffness * damping_per_stiffness, 6);
    report.grid.rows.push_back(std::move(row));
  }
  report.notes = {
      approximation,
      loss ? fmt::format("c_G gives e = {} where the first contact approaches at {} m/s, exact for a flat or "
                         "upright landing without friction",
                         shortest(loss->restitution), significant(loss->approach_speed, 6))
           : "c_G does not follow from a material: --measured-e beside it gives c_G, of the scene's drop"};
  if (!source.empty()) report.notes.push_back("least and largest numbers of the floor's material: " + source);
  report.fields["solutions"] = row_objects(report.grid);
  if (grounds.size() == 1) {
    std::vector<SceneOverride> keys{{"ground.stiffness", "", significant(grounds.front().stiffness, 6)}};
    if (loss) keys.push_back({"ground.damping", "", significant(grounds.front().stiffness * damping_per_stiffness, 6)});
    add_ground_block(keys, report);
  }
  report.fields["approximation"] = approximation;
  report.fields["source"] = text_or_nothing(source);
  return report;
}

/// What a half-space by name or modulus, or a pad, is in numbers: E*, if it has one, and what gives a measured
/// restitution.
Report dissipative_report(const Scene& scene, const std::optional<MaterialLoss>& loss) {
  Report report =
      begun_report("ground", scene.world.ground.is_pad() ? "the dissipation of a pad" : "the ground as a half-space");
  if (const std::string materials = material_words(scene.half_space); !materials.empty()) report.head = {materials};
  const numeric::Ground& ground = scene.world.ground;
  const double dissipation =
      loss ? analytic::damping_of_restitution(loss->restitution) / loss->approach_speed : ground.dissipation;
  const ModulusRange range = reduced_modulus(scene.half_space);
  report.grid.columns = dissipative_columns();
  if (ground.is_pad()) report.grid.columns.erase(report.grid.columns.begin());
  if (!loss) report.grid.columns.pop_back();
  std::vector<double> moduli{range.middle};
  if (range.least < range.largest) moduli = {range.least, range.middle, range.largest};
  for (const double modulus : moduli) {
    Row row;
    if (ground.is_half_space()) row.emplace_back(modulus, 6);
    if (loss) row.emplace_back(dissipation, 6);
    report.grid.rows.push_back(std::move(row));
  }
  if (range.least < range.largest)
    report.notes.emplace_back("E*: least and largest by the sources, and their geometric mean, which a scene takes");
  report.notes.push_back(
      loss ? fmt::format("τ gives e = {} where the first contact approaches at {} m/s, exact for a flat or upright "
                         "landing without friction",
                         shortest(loss->restitution), significant(loss->approach_speed, 6))
           : "no source gives a restitution: e is 1 undamped, and anything from 0 to 1 may be true; --measured-e "
             "beside a drop gives τ");
  const std::vector<std::string> sources = material_sources(scene.half_space);
  for (const std::string& source : sources) report.notes.push_back("source: " + source);
  std::vector<SceneOverride> keys;
  const Scene bare;
  for (const Key& key : all_keys()) {
    const std::string_view name = key.name;
    if (ground.is_pad() || !name.starts_with("ground.") || name == "ground.dissipation" || name == "ground.restitution")
      continue;
    const Value value = key.get(scene);
    if (!value.is_nothing() && value.text() != key.get(bare).text()) keys.push_back({key.name, "", value.text()});
  }
  if (dissipation > 0) keys.push_back({"ground.dissipation", "", significant(dissipation, 6)});
  add_ground_block(keys, report);
  report.fields["solutions"] = row_objects(report.grid);
  report.fields["sources"] = sources;
  return report;
}

struct GroundInput {
  SceneFlags scene;
  std::array<std::optional<double>, measure_count> measured;  ///< in the order of DropMeasure
  std::optional<double> modulus, poisson, footprint;
  OutputChoice output;

  [[nodiscard]] bool has(const char* flag) const { return is_given(scene, flag); }
  [[nodiscard]] bool is_measured() const {
    return std::ranges::any_of(measured, [](const auto& number) { return number.has_value(); });
  }
  /// The thickness of a layer of a material, which has no curve; that of a pad beside measured numbers is the scene's.
  [[nodiscard]] std::optional<double> thickness() const {
    const bool is_of_material = modulus || poisson || footprint || has("--floor") || !is_measured();
    if (!has("--thickness") || has("--curve") || !is_of_material) return std::nullopt;
    return read_number_option("--thickness", scene.texts.at("--thickness"), positive_number);
  }
  [[nodiscard]] std::optional<std::size_t> floor() const {
    if (!has("--floor")) return std::nullopt;
    return read_name_option("--floor", scene.texts.at("--floor"), floor_names());
  }
};

/// A restitution that the drop has anyway, --restitution, stands for --measured-e beside another number.
std::vector<MeasuredNumber> measured_of(const GroundInput& input) {
  std::vector<MeasuredNumber> measured;
  for (std::size_t i = 0; i < measure_count; ++i) {
    if (input.measured[i]) measured.push_back({static_cast<DropMeasure>(i), *input.measured[i]});
  }
  if (measured.size() == 1 && !input.measured[0] && input.has("--restitution"))
    measured.insert(measured.begin(), {DropMeasure::restitution,
                                       read_number_option("--restitution", input.scene.texts.at("--restitution"),
                                                          {0, 1, true, "greater than 0 and at most 1"})});
  return measured;
}

/// The material that was given or named: one, or the ends of its range.
std::vector<MaterialGround> materials_of(const GroundInput& input) {
  if (const auto named = input.floor()) {
    if (input.modulus || input.poisson) throw BadInput("--floor: excludes --modulus and --poisson; it has its own");
    const Material& floor = floors()[*named];
    return {{floor.least_modulus, floor.least_poisson, 0}, {floor.largest_modulus, floor.largest_poisson, 0}};
  }
  if (!input.modulus) throw BadInput("--modulus: required with --poisson, --thickness and --footprint, or --floor");
  if (!input.poisson) throw BadInput("--poisson: required with --modulus");
  constexpr double of_layer = 0.4999;
  if (input.thickness() && !(*input.poisson <= of_layer))
    throw BadInput(fmt::format("--poisson '{}': must be from 0 to {}", shortest(*input.poisson), of_layer));
  return {{*input.modulus, *input.poisson, 0}};
}

/// The restitution beside a material, of the scene's drop; none: none was given.
/// @param with_ground  whether the scene's ground is that of the material
std::optional<MaterialLoss> loss_of(const GroundInput& input, const std::vector<MeasuredNumber>& measured,
                                    bool with_ground) {
  if (measured.empty()) return {};
  if (measured.size() > 1 || measured.front().measure != DropMeasure::restitution)
    throw BadInput("--contact-time and the like: exclude a material, beside which --measured-e alone may stand");
  SceneFlags drop = input.scene;
  for (const char* const of_material : {"--thickness", "--floor"}) {
    if (!with_ground) drop.texts.at(of_material).clear();
  }
  return MaterialLoss{measured.front().value, first_approach_speed(read_discrete_flags(drop).drop)};
}

Report material_report_of(const GroundInput& input, const std::optional<MaterialLoss>& loss) {
  std::vector<MaterialGround> grounds = materials_of(input);
  const std::optional<double> thickness = input.thickness();
  if (thickness.has_value() == input.footprint.has_value()) {
    throw BadInput(fmt::format("{}: takes --thickness H of a layer, or --footprint A on a half-space; give one of them",
                               input.floor() ? "--floor" : "--modulus"));
  }
  const double size = thickness ? *thickness : *input.footprint;
  for (MaterialGround& ground : grounds) {
    ground.stiffness = thickness ? layer_stiffness(ground.modulus, ground.poisson, size)
                                 : half_space_stiffness(ground.modulus, ground.poisson, size);
  }
  const std::string source = input.floor() ? floors()[*input.floor()].source : "";
  return material_report(grounds,
                         thickness
                             ? "a confined layer, E (1 - ν)/((1 + ν)(1 - 2 ν) h): wide beside its thickness, bonded to "
                               "a rigid base, unable to bulge"
                             : "a half-space under a rigid flat footprint, as under a disc of its area, 2 E/((1 - ν²) "
                               "π a): the pressure of a real one is least in the middle and grows towards the rim",
                         source, loss);
}

/// The scene whose ground is sought: its kind is that of the scene, a half-space or else springs of any stiffness.
Scene scene_of(const GroundInput& input) {
  SceneFlags flags = input.scene;
  flags.texts.at("--restitution").clear();  // which is what was measured
  for (const char* const flag : {"--stiffness", "--damping", "--dissipation", "--curve"}) {
    if (is_given(flags, flag)) throw BadInput(fmt::format("{}: must be left out: it is what is sought", flag));
  }
  const SceneValues values = scene_values(flags.source);
  const auto has = [&](const char* key) { return values.has(key) || is_given(flags, key_named(key).flag); };
  if (values.has("ground.curve") || !(has("ground.modulus") || has("ground.floor")))
    flags.texts.at("--stiffness") = "1e9";
  Scene scene = read_scene_flags(flags);
  require_level(scene, "ground");
  scene.world.ground.damping = scene.world.ground.dissipation = 0;
  if (scene.sweep) throw BadInput(fmt::format("{}: sweep: ground takes a scene that sweeps nothing", scene.path));
  return scene;
}

/// A half-space that flags name by themselves, without a drop.
Scene named_half_space(const GroundInput& input) {
  SceneFlags flags = input.scene;
  flags.source.clear();
  for (auto& [flag, text] : flags.texts) text.clear();
  for (const char* const flag : {"--floor", "--body-modulus", "--body-material"})
    flags.texts[flag] = input.scene.texts.at(flag);
  flags.texts.at("--angle") = "0";
  return read_scene_flags(flags);
}

/// The report on a ground that needs no search; none: two measured numbers are to give it.
std::optional<Report> known_ground_report(const GroundInput& input, const std::vector<MeasuredNumber>& measured) {
  if (input.modulus || input.poisson || input.thickness() || input.footprint)
    return material_report_of(input, loss_of(input, measured, false));
  if (measured.empty() && input.has("--floor")) return dissipative_report(named_half_space(input), {});
  if (measured.size() != 1 || measured.front().measure != DropMeasure::restitution || !names_ground(input.scene))
    return std::nullopt;
  const Scene scene = read_scene_flags(input.scene);
  if (!scene.world.ground.has_dissipation()) return std::nullopt;
  if (input.has("--dissipation")) throw BadInput("--dissipation: must be left out: it is what is sought");
  return dissipative_report(scene, loss_of(input, measured, true));
}

int run_ground(const GroundInput& input) {
  const OutputChoice& choice = input.output;
  const std::vector<MeasuredNumber> measured = measured_of(input);
  if (const auto report = known_ground_report(input, measured)) {
    check_files(choice);
    write_report(choice, *report);
    return 0;
  }
  if (measured.size() != 2) {
    if (measured.size() == 1)
      throw BadInput(fmt::format(
          "{} {}: needs a second number of the drop: {}; or leave it out and give --modulus of "
          "a material, or --floor",
          measure_flags[static_cast<std::size_t>(measured.front().measure)], shortest(measured.front().value),
          measured.front().measure == DropMeasure::restitution
              ? "--contact-time S, --peak-force N or --indentation M"
              : "its restitution, --measured-e E, or another of --contact-time, --peak-force "
                "and --indentation"));
    throw BadInput(
        fmt::format("two of --measured-e, --contact-time, --peak-force and --indentation must be given, not "
                    "{}; or --modulus of a material, or --floor",
                    measured.size()));
  }
  const Scene scene = scene_of(input);
  check_files(choice);
  const numeric::Body body = scene.make_body();
  // Where the scene has no gravity the body is weighed elsewhere.
  const double gravity = scene.world.gravity > 0 ? scene.world.gravity : standard_gravity;
  const MeasuredDrop drop{&body, scene.world, scene.start(body), body.mass() * gravity};
  const GroundFit fit = fit_ground(drop, measured[0], measured[1]);
  Report report = ground_report(scene, drop, measured[0], measured[1], fit);
  if (scene_values(input.scene.source).has("ground.curve")) report.head.back() += "; the scene's curve does not count";
  write_report(choice, report);
  if (!fit.solutions.empty()) return 0;
  say("no ground gives both numbers");
  return exit_status(FailureKind::not_computed);
}

}  // namespace

Command ground_command() {
  return command_of<GroundInput>(run_ground, [](Command& command, GroundInput& input) {
    const char *const measured = "Measured: two of them", *const material =
                                                              "Or the material, --measured-e beside it or not";
    add_scene_flags(command, input.scene);
    auto& [restitution, time, force, indentation] = input.measured;
    command.add(
        {number_argument("--measured-e", restitution, {0, 1, true, "greater than 0 and at most 1"}, "E",
                         "restitution of the drop's first impact", measured),
         number_argument("--contact-time", time, positive_number, "S", "how long that lasts", measured),
         number_argument("--peak-force", force, positive_number, "N", "its largest normal force", measured),
         number_argument("--indentation", indentation, positive_number, "M", "of the ground under the body at rest",
                         measured),
         number_argument("--modulus", input.modulus, positive_number, "PA", "Young's modulus of the ground", material),
         number_argument("--poisson", input.poisson, {0, 0.5, false, "from 0 to 0.5"}, "NU", "its Poisson's ratio",
                         material),
         number_argument("--footprint", input.footprint, positive_number, "M2",
                         "area on a half-space; or --thickness of a layer on a "
                         "rigid base, or --floor for --modulus and --poisson",
                         material)});
    add_output_options(command, input.output);
    command.footer =
        "Example: clatter shock --ground --body box --size 0.1057x0.0439x0.0191 --mass 0.088 --angle 0 --measured-e "
        "0.5 "
        "--contact-time 5e-4\n"
        "The drop is the scene's: flat, or on one corner, with the speed that was measured.\n"
        "Of a scene with --floor or --ground-modulus the two numbers give E* and dissipation in place of its own; of "
        "any "
        "other, springs.\n"
        "With --floor, --ground-modulus or --curve --measured-e alone gives the dissipation; --floor alone shows "
        "the numbers of its material.\n"
        "Exit status 3 if no ground gives both numbers.";
    command.columns = {{"ground", [] {
                          return with_more(with_more(ground_columns(false), material_columns()), ground_columns(true));
                        }}};
  });
}

}  // namespace clatter::validation
