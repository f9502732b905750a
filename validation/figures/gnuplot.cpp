// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/figures/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"

namespace clatter::validation::inline figures {
namespace {

std::filesystem::path temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  return error ? std::filesystem::path("/tmp") : folder;
}

/// A file in the folder for temporary files that goes when the object does.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) : path_((temporary_folder() / "clatter-XXXXXX").string()) {
    const int file = create();
    if (file < 0)
      throw std::runtime_error("no temporary file can be made in " + temporary_folder().string() + " (TMPDIR)");
    std::FILE* stream = fdopen(file, "w");
    const bool is_whole = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    if (std::fclose(stream) == 0 && is_whole) return;
    remove();
    throw std::runtime_error("a temporary file in " + temporary_folder().string() + " (TMPDIR) cannot be written");
  }
  ~TemporaryFile() { remove(); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  int create() {
    const SignalsWait no_signal;
    const int file = mkostemp(path_.data(), O_CLOEXEC);
    if (file >= 0) remove_on_interrupt(path_);
    return file;
  }
  void remove() {
    unlink(path_.c_str());
    keep_on_interrupt(path_);
  }

  std::string path_;
};

/// A word of the shell's, whatever is in it.
std::string shell_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

/// The first line that says something.
std::string first_line(const std::string& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t^") != std::string::npos) return line;
  }
  return "it said nothing";
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const TemporaryFile file(script), complaints("");
  const std::string command =
      fmt::format("gnuplot -d {} 2>{}", shell_quoted(file.path()), shell_quoted(complaints.path()));
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("gnuplot cannot be started");
  std::string text;
  std::array<char, 4096> buffer;
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
  const int status = pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw BadInput("gnuplot is not on PATH; install the package gnuplot-nox");
  }
  if (status != 0) throw std::runtime_error("gnuplot failed: " + first_line(complaints.path()));
  return text;
}

void require_gnuplot(const std::string& purpose, const std::string& terminal) {
  try {
    static_cast<void>(run_gnuplot(fmt::format("set terminal {}\n", terminal)));
  } catch (const BadInput& error) {
    throw BadInput(purpose + ": " + error.what());
  }
}

std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

}  // namespace clatter::validation::inline figures
