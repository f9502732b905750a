// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/sink.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <vector>

#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"

namespace clatter::validation {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // as the kernel's own limit

[[noreturn]] void refuse(const RunFile& file, const std::string& why) {
  throw BadInput("{} {}: {}", file.option, file.path, why);
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

/// A file with what it was when it was noted.
struct Noted {
  RunFile file;
  Identity identity;
};

/// What the run that is under way reads and writes; several threads of it open files.
struct Notes {
  std::mutex mutex;
  bool is_kept = false;
  std::vector<Noted> read, written;
};

Notes& notes() {
  static Notes notes;
  return notes;
}

const Noted* same_file(const std::vector<Noted>& files, const Identity& identity) {
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const Noted& noted) { return noted.identity == identity; });
  return found == files.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_input(const RunFile& written, const std::string& read) {
  refuse(written, fmt::format("must be another file than {}, which is read", read));
}

}  // namespace

NotedFiles::NotedFiles() { notes().is_kept = true; }

NotedFiles::~NotedFiles() {
  notes().is_kept = false;
  notes().read.clear();
  notes().written.clear();
}

void note_read(const std::string& path) {
  const std::optional<Identity> identity = path.empty() ? std::nullopt : identity_of(path);
  const std::lock_guard lock(notes().mutex);
  if (!notes().is_kept || !identity) return;
  if (const Noted* const other = same_file(notes().written, *identity)) refuse_input(other->file, path);
  if (!same_file(notes().read, *identity)) notes().read.push_back({{"", path}, *identity});
}

void note_written(const RunFile& file) {
  const std::optional<Identity> identity = file.path.empty() ? std::nullopt : identity_of(file.path);
  const std::lock_guard lock(notes().mutex);
  if (!notes().is_kept || !identity) return;
  if (const Noted* const other = same_file(notes().read, *identity)) refuse_input(file, other->file.path);
  const Noted* const other = same_file(notes().written, *identity);
  if (other && (other->file.option != file.option || other->file.path != file.path))
    refuse(file, fmt::format("must be another file than {}", other->file.option));
  if (!other) notes().written.push_back({file, *identity});
}

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

Sink::Sink(const std::string& path, const std::string& option) : path_(path), option_(option) {
  if (path_.empty()) {
    stream_ = stdout;
    return;
  }
  note_written({option_, path_});
  destination_ = destination_of({option_, path_});
  if (destination_.is_stream) open_stream(destination_);
  else open_temporary();
}

Sink::~Sink() {
  if (stream_ != nullptr && stream_ != stdout) std::fclose(stream_);
  if (temporary_.empty()) return;
  unlink(temporary_.c_str());
  keep_on_interrupt(temporary_);
}

void Sink::open_stream(const Destination& destination) {
  const int descriptor = destination.open_file >= 0 ? fcntl(destination.open_file, F_DUPFD_CLOEXEC, 3)
                                                    : open(destination.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor >= 0) stream_ = fdopen(descriptor, "wb");
  if (stream_ == nullptr) fail("cannot be opened");
}

void Sink::open_temporary() {
  // Not named after the file, whose name may be as long as names can be.
  std::string name = (std::filesystem::path(destination_.path).parent_path() / ".clatter-XXXXXX").string();
  int descriptor = -1;
  {
    const SignalsWait no_signal;  // between the file's beginning and its entry among those to remove
    descriptor = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) fail("cannot be created");
    temporary_ = name;
    remove_on_interrupt(temporary_);
  }
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, destination_.mode.value_or(0666 & ~mask));
  stream_ = fdopen(descriptor, "wb");
}

void Sink::fail(const char* what) const {
  const int error = errno;
  if (path_.empty()) throw BadInput("standard output: {} ({})", what, std::strerror(error));
  throw BadInput("{} {}: {} ({})", option_, path_, what, std::strerror(error));
}

void Sink::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream_) == text.size()) return;
  if (errno == EPIPE && !is_file()) throw ReaderGone();
  fail("cannot be written");
}

void Sink::commit() {
  if (std::fflush(stream_) != 0) {
    if (errno == EPIPE && !is_file()) throw ReaderGone();
    fail("cannot be written");
  }
  if (!is_file()) return;
  if (fsync(fileno(stream_)) != 0) fail("cannot be written");
  if (std::rename(temporary_.c_str(), destination_.path.c_str()) != 0) fail("cannot be put in place");
  keep_on_interrupt(temporary_);
  temporary_.clear();
}

}  // namespace clatter::validation
