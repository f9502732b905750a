// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <memory>

#include "validation/atlas/atlas_report.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"

namespace clatter::validation {
namespace {

struct AtlasInput {
  SceneFlags scene;
  bool in_plane = false;
  OutputChoice output;
  PlotChoice plot;
};

/// A body by its name: the flags that it stands for.
struct NamedBody {
  const char *name, *shape, *size;
};
constexpr std::array named_bodies{
    NamedBody{"rod", "rod", nullptr},          NamedBody{"box", "box", nullptr},
    NamedBody{"cube", "box", "1x1x1"},         NamedBody{"square", "box", "1x1x1e-6"},
    NamedBody{"rectangle", "box", "2x1x1e-6"}, NamedBody{"phone", "box", "0.15x0.075x0.008"}};
const char* const triangle = "triangle";

/// Takes the name of a body as flags; what is typed goes before it.  The drop lands flat where nothing says otherwise.
void take_name(SceneFlags& flags) {
  for (const NamedBody& body : named_bodies) {
    if (flags.source != body.name) continue;
    if (is_given(flags, "--body")) throw BadInput(fmt::format("--body: {} is the body already", body.name));
    flags.source.clear();
    flags.texts.at("--body") = body.shape;
    if (body.size && !is_given(flags, "--size")) flags.texts.at("--size") = body.size;
    break;
  }
  if (flags.source == triangle) {
    for (const char* const flag : {"--body", "--size", "--length", "--radius", "--inertia", "--centre", "--mass"}) {
      if (is_given(flags, flag)) throw BadInput(fmt::format("{}: a thin triangle has none that matters", flag));
    }
    flags.source.clear();
  }
  const bool is_turned =
      is_given(flags, "--angle") || is_given(flags, "--attitude") || is_given(flags, "--orientation");
  if (flags.source.empty() && !is_turned) flags.texts.at("--angle") = "0";
}

Atlas atlas_of(const AtlasInput& input) {
  SceneFlags flags = input.scene;
  const std::string name = flags.source;
  take_name(flags);
  const Scene scene = read_scene_flags(flags);
  if (name != triangle) return make_atlas(flat_body(scene, input.in_plane), name.empty() ? "body" : name, scene);
  if (input.in_plane) throw BadInput("--plane: a triangle has no outline in the plane");
  return make_atlas(flat_triangle(discrete_law(scene).law.restitution), name, {});
}

int run_atlas(const AtlasInput& input) {
  const Atlas atlas = atlas_of(input);
  check_files(input.output, plot_files(input.plot));
  PlotFile plot(input.plot);
  const Report report = atlas_report(atlas);
  write_report(input.output, report);
  if (plot.is_wanted()) {
    std::vector<std::string> head{report.title};
    head.insert(head.end(), report.head.begin(), report.head.end());
    plot.write(atlas_picture(atlas), head);
  }
  return 0;
}

}  // namespace

Command atlas_command() {
  auto input = std::make_shared<AtlasInput>();
  Command command;
  add_scene_flags(command, input->scene, Model::discrete);
  command.arguments.front().help =
      "rod, box, cube, square, rectangle, triangle, phone; or a scene file or the name of a case";
  command.add_flag("--plane", input->in_plane, "of a box or mesh, tilts in the plane y = 0 alone", "Scene");
  add_output_options(command, input->output);
  add_plot_options(command, input->plot);
  command.footer =
      "Example: clatter atlas phone --restitution 0.5 --plot atlas.svg\n"
      "Of a box or mesh that face lands which the drop's attitude brings down (--orientation 1 to 6 of a box).\n"
      "Gravity, friction and motion of the scene are left out: in the limit of no tilt they change nothing.";
  command.run = [input] { return run_atlas(*input); };
  return command;
}

}  // namespace clatter::validation
