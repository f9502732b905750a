// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "validation/cli/command.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/progress.hpp"
#include "validation/demo/offline_page.hpp"
#include "validation/demo/page.hpp"
#include "validation/demo/page_address.hpp"
#include "validation/demo/server.hpp"
#include "validation/demo/story.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation::inline cli {
namespace {

constexpr int usual_port = 8318;
constexpr double usual_seconds = 10;

struct DemoInput {
  std::optional<std::string> port, seconds, file;
  std::vector<std::string> scenes;
  SceneFlags scene;
};

bool has_scene(const SceneFlags& given) {
  const auto typed = [](const auto& text) { return text.second.has_value(); };
  return !given.source.empty() || std::any_of(given.texts.begin(), given.texts.end(), typed);
}

/// What the address of the page ends with: nothing, or the scene given.
std::string query_of(const SceneFlags& given) {
  if (!has_scene(given)) return "";
  // Flags alone describe a drop of the discrete model, unless they give a ground.
  const bool is_discrete = given.source.empty() && !is_given(given, "--stiffness");
  return page_query(is_discrete ? read_discrete_flags(given).scene : read_scene_flags(given));
}

void require_page() {
  if (!demo_page().empty()) return;
  throw BadInput(
      "demo: this build has no page; install nodejs and npm and build again (the log of the build says more)");
}

/// The port asked for; without one the usual port, so that links go on working, or any free one.
void bind(DemoServer& server, const std::optional<std::string>& port) {
  if (!port) {
    if (server.bind(usual_port) || server.bind(0)) return;
    throw std::runtime_error("no port is free");
  }
  const int number = read_integer_option("--port", *port, 1, 65535);
  if (!server.bind(number)) throw BadInput(fmt::format("--port {}: is in use or not allowed", number));
}

int serve(const DemoInput& input) {
  const double seconds =
      input.seconds ? read_number_option("--seconds", *input.seconds, {0, 86400, true, "greater than 0, at most 86400"})
                    : usual_seconds;
  const std::string query = query_of(input.scene);
  DemoServer server(page_with_story(), std::chrono::milliseconds(std::llround(std::ceil(1000 * seconds))));
  bind(server, input.port);
  {
    Sink address("");
    address.write(fmt::format("clatter demo: http://127.0.0.1:{}/{}  (Ctrl-C ends it)\n", server.port(), query));
    address.commit();
  }
  server.run();
  return interrupted_status;
}

int export_page(const DemoInput& input) {
  const std::vector<std::string> known = offline_scenes();
  for (const std::string& name : input.scenes) static_cast<void>(read_name_option("--scene", name, known));
  Sink sink(*input.file, "--export");
  const CooperativeInterrupt interrupt;
  std::string page;
  {
    Progress progress;
    page = offline_page(input.scenes.empty() ? known : input.scenes, [&](std::size_t done, std::size_t of) {
      progress.show(progress_bar(done, of));
      return !interrupt.requested();
    });
  }
  if (interrupt.requested()) return interrupted_status;
  sink.write(page);
  sink.commit();
  return 0;
}

int run_demo(const DemoInput& input) {
  require_page();
  if (!input.file) {
    if (!input.scenes.empty()) throw BadInput(fmt::format("--scene {}: only with --export", input.scenes[0]));
    return serve(input);
  }
  if (has_scene(input.scene)) throw BadInput("SCENE: not with --export; --scene chooses those of the copy");
  if (input.port) throw BadInput(fmt::format("--port {}: not with --export, which serves nothing", *input.port));
  if (input.seconds)
    throw BadInput(fmt::format("--seconds {}: not with --export, which serves nothing", *input.seconds));
  return export_page(input);
}

}  // namespace

Command demo_command() {
  auto input = std::make_shared<DemoInput>();
  Command command{.name = "demo", .help = "a page to play with, in the browser"};
  command.add_text("--port", input->port, "N", fmt::format("of 127.0.0.1 ({}, or a free one)", usual_port));
  command.add_text("--seconds", input->seconds, "S", fmt::format("that an answer may take ({})", usual_seconds));
  command.add_text("--export", input->file, "FILE", "write a copy of the page that needs no program (HTML), and end");
  command.add_list("--scene", input->scenes, "NAME", "scenes of the copy (all)");
  add_scene_flags(command, input->scene);
  command.footer =
      "Example: clatter demo phone-damped\nThe address that is printed shows the scene, or the page's own. It serves "
      "the page to this machine alone, until Ctrl-C.";
  command.run = [input] { return run_demo(*input); };
  return command;
}

}  // namespace clatter::validation::inline cli
