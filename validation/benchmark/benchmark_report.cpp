// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/benchmark/benchmark_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "validation/output/number.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/scene/body_properties.hpp"

namespace clatter::validation {
namespace {

constexpr int certain = 12;

std::vector<Column> truth_columns(bool in_space) {
  std::vector<Column> columns{{"n", "n", "", "number of the impact"},
                              {"t", "t", "s", "time since the first touch"},
                              word_column("place", "place", "what strikes: an end, a corner")};
  if (!in_space) {
    columns.insert(columns.end(), {{"Pn", "Pₙ", "N·s", "normal impulse"},
                                   {"Pt", "Pₜ", "N·s", "tangential impulse, to the right"},
                                   {"V", "Vₙ", "m/s", "of the centre of mass after it, up"},
                                   {"Vt", "Vₜ", "m/s", "of the centre of mass after it, to the right"},
                                   {"Omega", "Ω", "rad/s", "after it, positive clockwise on the page"}});
  } else {
    for (const auto& [name, unit, meaning] :
         {std::tuple{"P", "N·s", "impulse"}, std::tuple{"V", "m/s", "velocity of the centre of mass after it"},
          std::tuple{"W", "rad/s", "angular velocity after it"}}) {
      for (const char* axis : {"x", "y", "z"}) {
        columns.push_back({std::string(name) + axis, std::string(name) + axis, unit,
                           std::string(meaning) + ", world " + axis, name[0] != 'P'});
      }
    }
  }
  columns.push_back({"duration", "", "s", "of a contact of finite time", false});
  columns.push_back({"uncertainty", "", "", "of the printed truth, relative; doubles here add their rounding", false});
  return columns;
}

Grid truth_grid(const Problem& problem, const std::string& law) {
  const bool in_space = !problem.scene.attitude.empty();
  Grid grid{truth_columns(in_space), {}};
  int n = 0;
  for (const TruthRow& row : truth_of(problem, law)) {
    Row cells{Cell(++n), Cell(row.time, in_space ? 9 : certain), Cell(row.place)};
    const auto add = [&](double number) { cells.emplace_back(number, in_space ? 6 : 9); };
    if (in_space) {
      for (const auto* vector : {&row.impulse, &row.velocity, &row.angular_velocity}) {
        for (int i = 0; i < 3; ++i) add((*vector)[i]);
      }
    } else {
      for (const double number :
           {row.impulse.z(), row.impulse.x(), row.velocity.z(), row.velocity.x(), row.angular_velocity.y()}) {
        add(number);
      }
    }
    cells.emplace_back(row.duration);
    cells.emplace_back(row.uncertainty);
    grid.rows.push_back(std::move(cells));
  }
  return grid;
}

/// Where a run begins for each gap.
Value starts_value(const Problem& problem) {
  const Reference reference = reference_of(problem);
  Value list;
  for (const double gap : problem.gaps) {
    const auto [state, time] = reference.release(gap);
    const analytic::space::Quaternion& q = state.attitude;
    Value one;
    one["gap"] = gap;
    one["first_touch"] = time;
    one["position"] = parts(state.position);
    one["attitude"] = std::vector<double>{q.w(), q.x(), q.y(), q.z()};
    one["velocity"] = parts(state.velocity);
    one["angular_velocity"] = parts(state.angular_velocity);
    if (reference.is_planar) {
      one["phi"] = inclination_of(state);
      one["omega"] = 0 - state.angular_velocity.y();
    }
    list.push_back(std::move(one));
  }
  return list;
}

std::string start_words(const Problem& problem, double gap) {
  const Reference reference = reference_of(problem);
  const auto [state, time] = reference.release(gap);
  const analytic::space::Quaternion& q = state.attitude;
  if (reference.is_planar) {
    return fmt::format("start at gap {} m: z {} m, phi {} rad, vx {}, vz {} m/s, omega {} rad/s; first touch at {} s",
                       shortest(gap), shortest(state.position.z()), shortest(inclination_of(state)),
                       shortest(state.velocity.x()), shortest(state.velocity.z()),
                       shortest(0 - state.angular_velocity.y()), shortest(time));
  }
  return fmt::format(
      "start at gap {} m: z {} m, attitude {}, velocity {} m/s, angular velocity {} rad/s; first touch at {} s",
      shortest(gap), shortest(state.position.z()), fmt::join(std::vector<double>{q.w(), q.x(), q.y(), q.z()}, ", "),
      fmt::join(parts(state.velocity), ", "), fmt::join(parts(state.angular_velocity), ", "), shortest(time));
}

std::string law_words(const Problem& problem) {
  const std::vector<std::string> laws = truth_laws(problem);
  if (laws == std::vector<std::string>{"any"}) return "law: all laws of restitution and friction agree here";
  return fmt::format("laws, declared by \"# law:\" in a file: {}", fmt::join(laws, ", "));
}

std::string asked_words(const Problem& problem) {
  const std::size_t count = truth_of(problem, truth_laws(problem).front()).size();
  std::string words = fmt::format("asked: the first {} impact{}", count, count == 1 ? "" : "s");
  if (problem.energy_alone)
    words += fmt::format(", and the energy {} s after the first touch{}", shortest(*problem.until),
                         problem.at_rest ? ", of the body at rest" : "");
  else if (problem.until)
    words += fmt::format(", and none more until {} s after the first touch", shortest(*problem.until));
  return words + "; place, time, and V and Ω after each";
}

std::string equations_of(const Problem& problem) {
  const std::string flight = "between impacts a parabola and torque-free turning";
  if (problem.is_compliant) {
    return "pressure f = (k + c ddelta/dt) delta on each place at the depth delta below z = 0, over the body's "
           "projected area, k and c the ground's stiffness and damping; Newton's and Euler's equations with its "
           "resultant; " +
           flight;
  }
  const std::string contact = "an impulse P at the place r from the centre of mass: m dV = P, dL = r x P; ";
  if (!problem.scene.impact.friction) {
    return contact +
           "without friction P = -(1 + e) u/(1/m + (r x n) I^-1 (r x n)), n upward, u the place's normal "
           "velocity; " +
           flight;
  }
  return contact +
         "Coulomb's law |P_t| <= mu P_n, against the slip: at every instant of the impact (routh) or for the "
         "velocity at its end (moreau); e relates velocities (newton), impulses (poisson) or works (stronge) "
         "of compression and restitution; " +
         flight;
}

/// Inertia about the centre of mass, body axes, row by row [kg·m²].
std::vector<std::vector<double>> inertia_rows(const BodyProperties& body) {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < 3; ++i) rows.push_back(parts(body.mass * body.gyration_square.row(i).transpose()));
  return rows;
}

std::string body_words(const Problem& problem) {
  const BodyProperties body = body_properties(problem.scene, Model::discrete);
  std::vector<std::string> rows;
  for (const std::vector<double>& row : inertia_rows(body)) rows.push_back(fmt::format("({})", fmt::join(row, ", ")));
  return fmt::format(
      "body: mass {} kg, centre of mass at ({}) m in its axes, inertia about it {} kg m2; a body in the "
      "plane turns about y",
      shortest(body.mass), fmt::join(parts(body.centre), ", "), fmt::join(rows, ", "));
}

std::vector<std::string> data_lines(const Problem& problem) {
  std::vector<std::string> lines{
      "data: the scene below in the keys of scene files (clatter help keys); floor z = 0, x to the right, y into the "
      "page; "
      "the body has the speed given at the first touch, at t = 0 in the truth"};
  std::istringstream text(problem.scene_text);
  std::string table;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('[')) table = line.substr(1, line.find(']') - 1);
    else if (!line.empty()) lines.push_back("  " + table + "." + line);
  }
  lines.push_back(body_words(problem));
  if (problem.ground_end)
    lines.push_back(
        fmt::format("ground: it ends at x = {} m, the centre of mass is at x = 0 at the first touch; what "
                    "strikes there is the lower face, at the place called edge; there is none to the right",
                    shortest(*problem.ground_end)));
  lines.push_back(
      problem.gaps.size() > 1
          ? "starts: one of these, any will do; it is one drop, seen first at several heights of the lowest "
            "point, so that impacts fall elsewhere within a code's steps: best are runs from all of them, "
            "of which the worst counts"
          : "start: the only one");
  for (const double gap : problem.gaps) lines.push_back("  " + start_words(problem, gap));
  lines.push_back("equations: " + equations_of(problem));
  return lines;
}

std::string error_words(const Problem& problem) {
  return fmt::format(
      "error: the largest of: law (distance of an impact from the exact map at the code's own state, relative), V and "
      "Ω over the sequence's largest, t over the last impact's time, energy over the start's, way of each row off the "
      "free flight since the impact before over the body's reach; order and number of places must be right.  Classes: "
      "exact {}, sharp {}, good {}, coarse {}",
      shortest(problem.tolerances[0]), shortest(problem.tolerances[1]), shortest(problem.tolerances[2]),
      shortest(problem.tolerances[3]));
}

}  // namespace

std::vector<Column> benchmark_list_columns() {
  return {word_column("id", "problem", "a problem's name"),
          {"version", "version", "", "of the problem; another version has another truth"},
          word_column("class", "class", "rigid: impulses; compliant: contacts of finite time"),
          {"impacts", "impacts", "", "that are asked for"},
          {"until", "until", "s", "how long after the first touch a motion goes on at least"},
          word_column("title", "title", "the problem in a few words")};
}

std::vector<Column> benchmark_truth_columns() {
  std::vector<Column> columns = truth_columns(false);
  const std::vector<Column> in_space = truth_columns(true);
  columns.insert(columns.begin() + 8, in_space.begin() + 3, in_space.end() - 2);
  return columns;
}

Report benchmark_list_report() {
  Report report = begun_report("benchmark", "problems with certified answers");
  report.grid.columns = benchmark_list_columns();
  for (const Problem& problem : benchmark_problems()) {
    const auto count = static_cast<int>(truth_of(problem, truth_laws(problem).front()).size());
    report.grid.rows.push_back({Cell(problem.id), Cell(problem.version),
                                Cell(problem.is_compliant ? "compliant" : "rigid"), Cell(count),
                                Cell(enough_time(problem)), Cell(problem.title)});
  }
  report.fields["problems"] = row_objects(report.grid);
  return report;
}

std::string benchmark_list_text() {
  std::size_t width = 0;
  for (const Problem& problem : benchmark_problems()) width = std::max(width, problem.id.size());
  std::string text;
  for (const Problem& problem : benchmark_problems())
    text += fmt::format("{:{}}  {}\n", problem.id, width, problem.title);
  return text;
}

/// Axes and the turns that count as positive, with a picture.
std::vector<std::string> sign_lines(const Problem& problem) {
  if (!problem.scene.attitude.empty()) {
    return {
        "signs: x to the right, y into the page, z up; q turns the body to the world; wx, wy, wz in world axes, by the "
        "right hand",
        "  z |  / y      wx > 0: what is at +y rises", "    | /         wy > 0: what is at +x falls",
        "    +-----> x   wz > 0: counter-clockwise, seen from above"};
  }
  return {
      "signs: phi and omega of motions are positive counter-clockwise on the page; Omega of the truth below is "
      "positive clockwise, that of a list as its line \"# Omega: clockwise\" or \"# Omega: counter-clockwise\" says",
      "  z |        b      phi > 0: end b is the higher one", "    |     /         omega > 0: b rises, a falls",
      "    |  a            Omega > 0, clockwise: b falls, a rises", "    +-----------> x"};
}

/// Axes of sloping ground, with a picture; none of level ground.
std::vector<std::string> slope_lines(const Problem& problem) {
  const numeric::World& world = problem.scene.world;
  if (world.incline_deg == 0) return {};
  const std::string slope = shortest(world.incline_deg);
  return {fmt::format("slope: x points {}° below the horizontal, z is normal to the ground, and phi counts from x; "
                      "gravity is ({}, 0, {}) m/s2 in these axes",
                      slope, significant(world.pull().along, 12), significant(-world.pull().down, 12)),
          "     z            |",
          fmt::format("      \\  [box]    | g      g sin {}° along x,", slope),
          fmt::format("       \\ -._      v        -g cos {}° along z", slope),
          "            -._",
          "               -> x"};
}

/// Until when an answer must go, and what it must say beside its rows.
std::string ending_words(const Problem& problem) {
  if (!problem.until)
    return fmt::format("; a motion must go on beyond the last impact, {} s from the first touch are enough by any law",
                       shortest(enough_time(problem)));
  const std::string until = shortest(*problem.until);
  return problem.energy_alone
             ? fmt::format("; a motion must last {} s from the first touch, a list needs \"# energy: J\" then, with {}",
                           until,
                           problem.scene.world.incline_deg == 0 ? "m g z"
                                                                : "-m (g . way) along the slope and m g_n z across it")
             : fmt::format(
                   "; a motion must last {} s from the first touch or say \"# ended: nothing approaches\", as a list "
                   "must",
                   until);
}

/// What a statement says as JSON, but for the truth.
void add_statement_fields(const Problem& problem, Value& fields) {
  fields["problem"] = problem.id;
  fields["version"] = problem.version;
  fields["title"] = problem.title;
  fields["class"] = problem.is_compliant ? "compliant" : "rigid";
  fields["motivation"] = problem.motivation;
  fields["separates"] = problem.separates;
  fields["acceptance"] = problem.acceptance;
  fields["scene"] = scene_value(problem.scene, Model::discrete);
  fields["scene_toml"] = problem.scene_text;
  const BodyProperties body = body_properties(problem.scene, Model::discrete);
  Value::List inertia;
  for (const std::vector<double>& row : inertia_rows(body)) inertia.emplace_back(row);
  fields["body"] = Value::Fields{{"mass", body.mass}, {"centre", parts(body.centre)}, {"inertia", inertia}};
  fields["starts"] = starts_value(problem);
  fields["until"] = enough_time(problem);
  fields["until_is_asked"] = problem.until.has_value();
  fields["at_rest"] = problem.at_rest;
  fields["stays"] = problem.at_rest || problem.end_energy;
  fields["ground_end"] = problem.ground_end ? Value(*problem.ground_end) : Value();
  fields["tolerances"] = problem.tolerances;
  fields["laws"] = truth_laws(problem);
  fields["oracle"] = oracle_of(problem);
}

Report benchmark_statement(const Problem& problem) {
  Report report = begun_report("benchmark", problem.id + ", " + problem.title);
  report.head = {fmt::format("problem: {}", problem.id), fmt::format("version: {}", problem.version),
                 "motivation: " + problem.motivation, "separates: " + problem.separates};
  for (const std::vector<std::string>& lines : {data_lines(problem), sign_lines(problem), slope_lines(problem)})
    report.head.insert(report.head.end(), lines.begin(), lines.end());
  for (const std::string& line :
       {law_words(problem), asked_words(problem), error_words(problem), "acceptance: " + problem.acceptance,
        "results: as text, t,x,z,phi,vx,vz,omega of the centre of mass (in space "
        "t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz) or t,place,Pn,Pt,V,Omega, after a line # problem: " +
            problem.id + ending_words(problem),
        "truth by " + oracle_of(problem)}) {
    report.head.push_back(line);
  }
  for (std::string& line : report.head) std::replace(line.begin(), line.end(), '\n', ' ');
  const std::string law = truth_laws(problem).front();
  report.grid = truth_grid(problem, law);
  if (law != "any")
    report.notes.push_back("by " + law + "; clatter benchmark truth " + problem.id + " --law has the others");
  add_statement_fields(problem, report.fields);
  report.fields["truth"] = row_objects(report.grid);
  return report;
}

/// Paragraphs with their first words in bold; what is indented, the scene and pictures, in blocks.
Report markdown_statement(const Problem& problem) {
  Report report = benchmark_statement(problem);
  report.title = "# " + problem.id + ": " + problem.title;
  std::vector<std::string> lines;
  bool in_block = false;
  for (const std::string& line : report.head) {
    const bool is_indented = line.starts_with("  ");
    if (in_block && !is_indented) lines.emplace_back("```");
    if (!in_block || !is_indented) lines.emplace_back();
    if (!in_block && is_indented) lines.emplace_back("```");
    const std::size_t bold = line.find(':') < 40 ? line.find(':') + 1 : 0;
    lines.push_back(is_indented ? line.substr(2)
                    : bold == 0 ? line
                                : fmt::format("**{}**{}", line.substr(0, bold), line.substr(bold)));
    in_block = is_indented;
  }
  report.head = std::move(lines);
  return report;
}

/// What a list of the truth says of its signs and its end.
std::vector<std::string> ending_lines(const Problem& problem) {
  const Reference reference = reference_of(problem);
  std::vector<std::string> lines;
  if (reference.is_planar) lines.emplace_back("Omega: clockwise");
  if (problem.until && !problem.energy_alone) lines.emplace_back("ended: nothing approaches");
  if (problem.energy_alone) lines.push_back("energy: " + shortest(reference.last_energy(reference.sequences.front())));
  return lines;
}

Report benchmark_truth_report(const Problem& problem, const std::string& law) {
  Report report = begun_report("benchmark", "the truth of " + problem.id);
  report.head = {"problem: " + problem.id, "truth by " + oracle_of(problem)};
  report.remarks = {"problem: " + problem.id};  // as a file to score has them
  if (law != "any") {
    report.head.insert(report.head.begin() + 1, "law: " + law);
    report.remarks.push_back("law: " + law);
  }
  for (const std::string& line : ending_lines(problem)) report.remarks.push_back(line);
  report.grid = truth_grid(problem, law);
  report.fields["problem"] = problem.id;
  report.fields["version"] = problem.version;
  report.fields["law"] = law;
  report.fields["oracle"] = oracle_of(problem);
  report.fields["impacts"] = row_objects(report.grid);
  report.fields["digits"] = truth_digits(problem, law);
  return report;
}

std::vector<double> parts(const analytic::space::Vector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace clatter::validation
