// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/run_files.hpp"

#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <limits>

#include "validation/output/bad_input.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation::inline output {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // as the kernel's own limit

[[noreturn]] void refuse(const RunFile& file, const std::string& why) {
  throw BadInput(fmt::format("{} {}: {}", file.option, file.path, why));
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Whether the folder is one of the kernel's own, in which a link stands for an open file.
bool is_in_proc(const fs::path& path) {
  struct statfs status {};
  return statfs(folder_of(path).c_str(), &status) == 0 && status.f_type == PROC_SUPER_MAGIC;
}

/// The path that the links at its end lead to.  @returns nothing at links without end; a link in /proc stays.
std::optional<fs::path> followed(fs::path path) {
  for (int links = 0; links < most_links; ++links) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(path, error)) || is_in_proc(path)) return path;
    const fs::path target = fs::read_symlink(path, error);
    if (error) return std::nullopt;
    path = target.is_absolute() ? target : folder_of(path) / target;
  }
  return std::nullopt;
}

/// The descriptor that a link in /proc/self/fd means; -1: it means no open file of this process.
int open_file_of(const fs::path& link) {
  std::error_code error;
  if (fs::canonical(folder_of(link), error) != fs::canonical("/proc/self/fd", error)) return -1;
  const std::string name = link.filename().string();
  int number = -1;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
  return failure == std::errc() && end == name.data() + name.size() ? number : -1;
}

/// What makes a file this one and no other; with a name: the file is not there yet, and this is its folder.
struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
  std::string name;
  bool operator==(const Identity&) const = default;
};

std::optional<Identity> identity_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISCHR(status.st_mode)) return std::nullopt;
    return Identity{status.st_dev, status.st_ino, ""};
  }
  const std::optional<fs::path> end = followed(path);
  if (!end || stat(folder_of(*end).c_str(), &status) != 0) return std::nullopt;
  return Identity{status.st_dev, status.st_ino, end->filename().string()};
}

void refuse_same(const RunFile& file, const RunFile& other) {
  if (file.path.empty() || other.path.empty()) return;
  const std::optional<Identity> one = identity_of(file.path), another = identity_of(other.path);
  if (one && another && *one == *another) refuse(file, fmt::format("must be another file than {}", other.option));
}

}  // namespace

Destination destination_of(const RunFile& file) {
  if (file.path == "-") return {.path = file.path, .is_stream = true, .open_file = STDOUT_FILENO};
  struct stat status {};
  const bool is_there = stat(file.path.c_str(), &status) == 0;
  if (!is_there && errno != ENOENT) refuse(file, fmt::format("cannot be created ({})", std::strerror(errno)));
  if (is_there && S_ISDIR(status.st_mode)) refuse(file, "cannot be created (Is a directory)");
  const std::optional<fs::path> end = followed(file.path);
  if (!end) refuse(file, "cannot be created (Too many levels of symbolic links)");
  if (is_there && is_in_proc(*end)) return {.path = file.path, .is_stream = true, .open_file = open_file_of(*end)};
  if (is_there && !S_ISREG(status.st_mode)) return {.path = file.path, .is_stream = true};
  Destination destination{.path = end->string()};
  if (is_there) destination.mode = status.st_mode & ALLPERMS;
  if (!is_there && !end->has_filename()) refuse(file, "cannot be created (No such file or directory)");
  return destination;
}

void require_writable(const RunFile& file) {
  if (!file.path.empty() && !destination_of(file).is_stream) static_cast<void>(Sink(file.path, file.option));
}

void refuse_shared_files(const std::vector<RunFile>& written, const std::vector<RunFile>& read) {
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (const RunFile& file : read) refuse_same(written[i], file);
    for (std::size_t k = 0; k < i; ++k) refuse_same(written[i], written[k]);
  }
}

}  // namespace clatter::validation::inline output
