#include "validation/sweep/sweep_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>

#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t block_bytes = 1 << 20;
constexpr std::chrono::milliseconds block_time{500};

bool is_other_than_file(const std::string& path) {
  struct stat status{};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

/// The number of a row's scene.
std::optional<long long> index_of(const std::string& row) {
  long long index = 0;
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), index);
  if (error != std::errc() || end == row.data() + row.size() || *end != ',') return std::nullopt;
  return index;
}

/// Goes through the rows of a part.
class PartReader {
 public:
  PartReader(const std::string& path, const SweepFileForm& form) : file_(path, std::ios::binary), form_(form) {}

  /// Reads the head.  @returns false if the file ends within it; the number of the first other line is 0 if none is.
  bool read_head(long long& other_line) {
    std::string text(form_.head.size(), '\0');
    file_.read(text.data(), static_cast<std::streamsize>(text.size()));
    const auto size = static_cast<std::size_t>(file_.gcount());
    other_line = 0;
    std::size_t same = 0;
    while (same < size && text[same] == form_.head[same]) ++same;
    if (same < size) other_line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(same), '\n');
    kept_bytes_ = bytes_ = size;
    return size == text.size();
  }

  /// Reads as far as the rows are whole.  @returns false at one that is not the next.
  bool read_rows() {
    long long last = -1;
    for (std::string row; std::getline(file_, row) && !file_.eof();) {
      const std::optional<long long> index = index_of(row);
      const bool next = index == last + 1, same = index == last && last >= 0 && !form_.one_row_per_scene;
      if (!(next || same) || *index >= form_.scenes) return false;
      if (next) keep(*index);  // those before it are complete
      last = *index;
      ++rows_;
      bytes_ += row.size() + 1;
    }
    if (form_.one_row_per_scene) keep(last + 1);
    return true;
  }

  [[nodiscard]] long long scenes() const { return scenes_; }
  [[nodiscard]] long long rows() const { return rows_; }
  [[nodiscard]] std::size_t kept_bytes() const { return kept_bytes_; }

 private:
  void keep(long long scenes) {
    scenes_ = scenes;
    kept_bytes_ = bytes_;
  }

  std::ifstream file_;
  const SweepFileForm& form_;
  long long scenes_ = 0, rows_ = 0;
  std::size_t bytes_ = 0, kept_bytes_ = 0;
};

}  // namespace

SweepFile::SweepFile(const std::string& path, const SweepFileForm& form, bool restart)
    : path_(path), part_(path + ".part"), flushed_(std::chrono::steady_clock::now()) {
  if (is_other_than_file(path_) || is_other_than_file(part_)) refuse("not a regular file");
  open();
  try {
    if (restart && ftruncate(descriptor_, 0) != 0) fail("cannot be written");
    take_up(form);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

SweepFile::~SweepFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void SweepFile::open() {
  descriptor_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot be created");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  close(descriptor_);
  refuse(fmt::format("{} is being written by another run", part_));
}

void SweepFile::take_up(const SweepFileForm& form) {
  PartReader reader(part_, form);
  long long other_line = 0;
  const bool has_head = reader.read_head(other_line);
  if (other_line > 0) {
    refuse(fmt::format("{} is of another sweep (its line {} differs); --restart begins anew", part_, other_line));
  }
  if (has_head && !reader.read_rows()) {
    refuse(fmt::format("{} is damaged after {} rows; --restart begins anew", part_, reader.rows()));
  }
  scenes_ = reader.scenes();
  const auto kept = has_head ? static_cast<off_t>(reader.kept_bytes()) : off_t{0};
  if (ftruncate(descriptor_, kept) != 0 || lseek(descriptor_, kept, SEEK_SET) != kept) fail("cannot be written");
  if (has_head) return;
  pending_ = form.head;
  flush();
}

void SweepFile::write(std::string_view rows) {
  pending_ += rows;
  if (pending_.size() >= block_bytes || std::chrono::steady_clock::now() - flushed_ >= block_time) flush();
}

void SweepFile::flush() {
  for (std::string_view rest = pending_; !rest.empty();) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot be written");
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  pending_.clear();
  flushed_ = std::chrono::steady_clock::now();
}

void SweepFile::commit() {
  flush();
  if (fsync(descriptor_) != 0) fail("cannot be written");
  if (std::rename(part_.c_str(), path_.c_str()) != 0) fail("cannot be put in place");
}

void SweepFile::fail(const char* what) const {
  throw BadInput(fmt::format("--output {}: {} {} ({})", path_, part_, what, std::strerror(errno)));
}

void SweepFile::refuse(const std::string& why) const { throw BadInput(fmt::format("--output {}: {}", path_, why)); }

}  // namespace clatter::validation
