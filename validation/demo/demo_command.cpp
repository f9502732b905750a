// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/demo/scene_exchange.hpp"
#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/html.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation {
namespace {

struct DemoInput {
  std::string file;
  SceneFlags scene;
};

/// A list as flags have it, numbers with commas between; in an address "+" means a blank.
std::string text_of(const Value& value) {
  const auto* const list = std::get_if<Value::List>(&value.content());
  std::string text = list ? "" : value.text();
  for (const Value& part : list ? *list : Value::List{}) text += (text.empty() ? "" : ",") + part.text();
  for (std::size_t at = 0; (at = text.find('+', at)) != std::string::npos;) text.replace(at, 1, "%2B");
  return text;
}

/// A file without a ground, like flags without one, is a drop of the discrete model, which the page then shows alone.
Scene scene_of(const SceneFlags& given) {
  const SceneValues values = scene_values(given.source);
  const bool has_ground = names_ground(given);
  const std::vector<SceneOverride> overrides = overrides_of(given);
  return has_ground ? read_scene(values, overrides, given.model) : read_discrete_scene(values, overrides).scene;
}

/// What the address of the page ends with: nothing, or the scene given: "given=1&body=box&angle=10…".
std::string fragment_of(const SceneFlags& given) {
  const auto typed = [](const auto& text) { return !text.second.empty(); };
  if (given.source.empty() && !std::any_of(given.texts.begin(), given.texts.end(), typed)) return "";
  std::string fragment = "given=1";
  for (const Field& argument : scene_arguments(scene_of(given)))
    fragment += "&" + argument.name + "=" + text_of(argument.value);
  return fragment;
}

/// The page with the scene written into it, for who opens it without a fragment.
std::string page_with(const std::string& fragment) {
  std::string page(embedded_text("validation/demo/page.html"));
  const std::string place = "name=\"clatter-scene\" content=\"";
  const std::size_t at = page.find(place);
  if (at == std::string::npos) throw std::logic_error("the page has no place for a scene");
  return page.insert(at + place.size(), html_escaped(fragment));
}

void write_page(const std::string& path, const char* option, const std::string& fragment) {
  Sink sink(path, option);
  sink.write(page_with(fragment));
  sink.commit();
}

/// The user's folder for files that can be made again.
std::filesystem::path cache_folder() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::filesystem::path(value == nullptr || *value != '/' ? "" : value);
  };
  const std::filesystem::path cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (cache.empty() && home.empty()) throw BadInput("demo: HOME names no folder to write the page to; use --export");
  const std::filesystem::path folder = (cache.empty() ? home / ".cache" : cache) / "clatter";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw BadInput(fmt::format("demo: cannot make {}: {}; use --export", folder.string(), error.message()));
  return folder;
}

/// As an address has it: all but letters, digits and "/._-~" as %XX.
std::string file_address(const std::string& path) {
  std::string text = "file://";
  for (const char c : path) {
    const bool is_plain =
        std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("/._-~").find(c) != std::string::npos;
    text += is_plain && static_cast<unsigned char>(c) < 128 ? std::string(1, c)
                                                            : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return text;
}

/// By the desktop's own choice of a browser; where there is no desktop, how to carry the page to one.
void open_in_browser(const std::string& path) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr)
    return say("no desktop here to open the page; --export FILE writes a copy to carry elsewhere");
  const pid_t process = fork();
  if (process == 0) {
    dup2(STDERR_FILENO, STDOUT_FILENO);
    execlp("xdg-open", "xdg-open", path.c_str(), nullptr);
    _exit(EXIT_FAILURE);
  }
  if (process > 0) waitpid(process, nullptr, 0);
}

int run_demo(const DemoInput& input) {
  const std::string fragment = fragment_of(input.scene);
  if (!input.file.empty()) {
    write_page(input.file, "--export", fragment);
    return 0;
  }
  const std::string path = cache_folder() / "demo.html";
  write_page(path, "demo:", fragment);
  Sink address("");
  address.write(fmt::format("{}{}{}\n", file_address(path), fragment.empty() ? "" : "#", fragment));
  address.commit();
  open_in_browser(path);
  return 0;
}

}  // namespace

Command demo_command() {
  return command_of<DemoInput>(run_demo, [](Command& command, DemoInput& input) {
    command.add_text("--export", input.file, "FILE",
                     "write the page there, with the scene in it (HTML), and open nothing");
    add_scene_flags(command, input.scene);
    command.footer =
        "Example: clatter demo phone-damped\nOpens the page, one file in which both models run, with the scene or the "
        "page's own, and prints its address.\nIt needs no program and no network: copy it to whoever is to have it.";
  });
}

}  // namespace clatter::validation
