// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/sweep_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "validation/output/bad_input.hpp"

namespace clatter::validation {

std::uint64_t file_digest(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw BadInput(path + ": cannot be read");
  Digest digest;
  std::vector<char> block(1 << 20);
  do {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    digest.add({block.data(), static_cast<std::size_t>(file.gcount())});
  } while (file);
  if (file.bad()) throw BadInput(path + ": cannot be read");
  return digest.value();
}

namespace {

constexpr std::size_t block_bytes = 1 << 20;
constexpr std::chrono::milliseconds block_time{500};

/// Writes all of it.  @returns false, and errno, if it cannot.
bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Adds bytes of a file to a digest.  @returns false if there are not so many.
bool add_bytes(int file, long long begin, long long end, Digest& digest) {
  std::string block;
  while (begin < end) {
    block.resize(std::min(block_bytes, static_cast<std::size_t>(end - begin)));
    const ssize_t count = pread(file, block.data(), block.size(), begin);
    if (count <= 0) return false;
    digest.add(std::string_view(block).substr(0, static_cast<std::size_t>(count)));
    begin += count;
  }
  return true;
}

/// A line of the digests: what the part was when rows had been written.
struct Record {
  long long bytes = 0, scenes = 0;
  std::uint64_t digest = 0;
};

/// @param rows digest of the part; that of a record is of its numbers, too.
Record record_of(long long bytes, long long scenes, Digest rows) {
  rows.add(fmt::format("{} {}", bytes, scenes));
  return {bytes, scenes, rows.value()};
}

std::string text_of(const Record& record) {
  return fmt::format("{} {} {:016x}\n", record.bytes, record.scenes, record.digest);
}

/// The records of a file, up to the first line that is none.
std::vector<Record> read_records(const std::string& path) {
  std::vector<Record> records;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    Record record;
    std::istringstream words(line);
    words >> record.bytes >> record.scenes >> std::hex >> record.digest;
    if (line + "\n" != text_of(record)) break;
    records.push_back(record);
  }
  return records;
}

/// "world.gravity is 9.81 there, 1.62 here": what two lines of heads differ in, "# NAME: VALUE".
std::string difference(const std::string& there, const std::string& here) {
  const auto cut = [](const std::string& line) { return std::min(line.find(": "), line.size()); };
  if (there.substr(0, cut(there)) != here.substr(0, cut(here)))
    return fmt::format("'{}' there, '{}' here", there.substr(0, 60), here.substr(0, 60));
  std::string name = here.substr(2, cut(here) - 2), one = there.substr(cut(there) + 2),
              other = here.substr(cut(here) + 2);
  using Json = nlohmann::ordered_json;
  const Json keys = Json::parse(one, nullptr, false), own_keys = Json::parse(other, nullptr, false);
  if (keys.is_object() && own_keys.is_object()) {
    const Json::json_pointer key(Json::diff(keys, own_keys).at(0).at("path").get<std::string>());
    const auto words = [&](const Json& of) { return of.contains(key) ? of.at(key).dump() : "nothing"; };
    name = (name == "scene" ? "" : name + ".") + key.to_string().substr(1), one = words(keys), other = words(own_keys);
    std::replace(name.begin(), name.end(), '/', '.');
  }
  return fmt::format("{} is {} there, {} here", name, one, other);
}

/// In what a file differs from the head that it should begin with; empty: it begins with it, or ends within it, and is
/// then at its end.
std::string difference(std::istream& file, const std::string& head) {
  std::istringstream lines(head);
  for (std::string there, here; std::getline(lines, here) && std::getline(file, there);)
    if (there != here && !(file.eof() && here.starts_with(there))) return difference(there, here);
  return "";
}

bool truncate_to(int file, long long bytes) {
  return ftruncate(file, bytes) == 0 && lseek(file, bytes, SEEK_SET) == bytes;
}

}  // namespace

std::vector<RunFile> SweepFile::files_beside(const std::string& path) {
  const std::string part = destination_of({"--output", path}).path + ".part";
  return {{"--output's part", part}, {"--output's digests", part + ".digests"}, {"--output's columns", part + ".made"}};
}

SweepFile::SweepFile(const std::string& path, const SweepFileForm& form, bool restart)
    : path_(path), destination_(destination_of({"--output", path})), flushed_(std::chrono::steady_clock::now()) {
  part_ = destination_.path + ".part";
  digests_ = part_ + ".digests";
  try {
    open();
    if (restart && ftruncate(part_file_, 0) != 0) fail(part_, "cannot be written");
    take_up(form);
  } catch (...) {
    close_all();
    throw;
  }
}

SweepFile::~SweepFile() { close_all(); }

void SweepFile::close_all() {
  if (is_own_ && scenes_ == 0) {
    unlink(part_.c_str());
    unlink(digests_.c_str());
  }
  for (int* const file : {&digests_file_, &part_file_}) {  // the part last, for it is locked
    if (*file >= 0) close(*file);
    *file = -1;
  }
}

void SweepFile::open() {
  for (;;) {
    part_file_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (part_file_ < 0) fail(part_, "cannot be created");
    struct stat own {
    }, named{};
    fstat(part_file_, &own);
    if (!S_ISREG(own.st_mode)) refuse(fmt::format("{} is not a regular file", part_));
    if (flock(part_file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) refuse(fmt::format("{} is being written by another run", part_));
      fail(part_, "cannot be locked");
    }
    // Between opening and locking the run that had the lock may have given the part its name: then it is a finished
    // file.
    if (stat(part_.c_str(), &named) == 0 && own.st_dev == named.st_dev && own.st_ino == named.st_ino) break;
    close(part_file_);
  }
}

/// @returns whether the part begins with the whole head; false if it ends within it.  @throws BadInput at another one.
bool SweepFile::has_head(const std::string& head) {
  std::ifstream file(part_, std::ios::binary);
  if (const std::string words = difference(file, head); !words.empty())
    refuse(fmt::format("{} is of another sweep ({}); --restart begins anew", part_, words));
  return file.good();
}

void SweepFile::keep_whole_rows(const SweepFileForm& form) {
  long long kept_records = 0;
  Digest digest = digest_;
  bool is_sound = true;
  for (const Record& record : read_records(digests_)) {
    const bool grows = record.bytes > bytes_ && record.scenes > scenes_ && record.scenes <= form.scenes;
    is_sound = grows && add_bytes(part_file_, bytes_, record.bytes, digest) &&
               record.digest == record_of(record.bytes, record.scenes, digest).digest;
    if (!is_sound) break;
    digest_ = digest;
    bytes_ = record.bytes;
    scenes_ = record.scenes;
    kept_records += static_cast<long long>(text_of(record).size());
  }
  if (!is_sound)
    say(fmt::format("{}: rows after its first {} scenes are not as they were written, and are computed anew", part_,
                    scenes_));
  if (!truncate_to(part_file_, bytes_)) fail(part_, "cannot be written");
  if (!truncate_to(digests_file_, kept_records)) fail(digests_, "cannot be written");
}

void SweepFile::take_up(const SweepFileForm& form) {
  const bool goes_on = has_head(form.head);
  is_own_ = true;
  digests_file_ = ::open(digests_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (digests_file_ < 0) fail(digests_, "cannot be created");
  if (destination_.mode) fchmod(part_file_, *destination_.mode);
  digest_.add(form.head);
  bytes_ = head_bytes_ = static_cast<long long>(form.head.size());
  if (goes_on) return keep_whole_rows(form);
  if (!truncate_to(part_file_, 0) || !write_all(part_file_, form.head)) fail(part_, "cannot be written");
  if (!truncate_to(digests_file_, 0)) fail(digests_, "cannot be written");
}

void SweepFile::with_rows(const std::function<void(std::string_view rows)>& take) const {
  if (bytes_ == head_bytes_) return;
  const auto size = static_cast<std::size_t>(bytes_);
  void* const bytes = mmap(nullptr, size, PROT_READ, MAP_SHARED, part_file_, 0);
  if (bytes == MAP_FAILED) fail(part_, "cannot be read");
  const std::unique_ptr<void, std::function<void(void*)>> mapped(bytes, [size](void* one) { munmap(one, size); });
  take(std::string_view(static_cast<const char*>(bytes), size).substr(static_cast<std::size_t>(head_bytes_)));
}

bool SweepFile::is_own(std::istream& there, const std::string& head) const {
  std::string title;
  std::getline(there, title);
  const bool is_sweep = title.starts_with("# ") && title.find(", sweep: ") != std::string::npos;
  const std::string words = difference(there.seekg(0), head);
  if (is_sweep && !words.empty())
    refuse(fmt::format("is there already, of another sweep ({}); --restart overwrites it", words));
  return words.empty() && there.good();
}

bool SweepFile::is_complete(const std::string& head, long long first, long long last,
                            const std::function<void(std::string_view row)>& take) const {
  std::ifstream file(destination_.path, std::ios::binary);
  if (!is_own(file, head)) return false;
  long long scene = first - 1;  // of the row before
  bool is_whole = true;
  for (std::string row; is_whole && std::getline(file, row);) {
    long long here = -1;
    std::from_chars(row.data(), row.data() + std::min(row.find(','), row.size()), here);
    is_whole = !file.eof() && (here == scene + 1 || (here == scene && scene >= first));
    if (!is_whole) break;
    scene = here;
    take(row);
  }
  if (is_whole && scene == last) return true;
  say(fmt::format("{} is not whole after scene {}, and is computed anew", destination_.path, scene));
  return false;
}

void SweepFile::write(std::string_view rows, long long scenes) {
  pending_ += rows;
  pending_scenes_ += scenes;
  if (pending_.size() >= block_bytes || std::chrono::steady_clock::now() - flushed_ >= block_time) flush();
}

void SweepFile::flush() {
  flushed_ = std::chrono::steady_clock::now();
  if (pending_.empty()) return;
  if (!write_all(part_file_, pending_)) fail(part_, "cannot be written");
  digest_.add(pending_);
  bytes_ += static_cast<long long>(pending_.size());
  const Record record = record_of(bytes_, scenes_ + pending_scenes_, digest_);
  if (!write_all(digests_file_, text_of(record))) fail(digests_, "cannot be written");
  scenes_ = record.scenes;
  pending_.clear();
  pending_scenes_ = 0;
}

void SweepFile::put_in_place(const std::string& file) {
  if (std::rename(file.c_str(), destination_.path.c_str()) != 0) fail(file, "cannot be put in place");
  is_own_ = false;
  unlink(digests_.c_str());
}

void SweepFile::commit() {
  flush();
  if (fsync(part_file_) != 0) fail(part_, "cannot be written");
  put_in_place(part_);
}

void SweepFile::commit(const std::function<void(const std::string& path)>& make) {
  flush();
  const std::string made = part_ + ".made";
  try {
    make(made);
    if (destination_.mode) chmod(made.c_str(), *destination_.mode);
    put_in_place(made);
  } catch (...) {
    unlink(made.c_str());
    throw;
  }
  unlink(part_.c_str());
}

void SweepFile::discard() {
  is_own_ = false;
  unlink(part_.c_str());
  unlink(digests_.c_str());
}

void SweepFile::fail(const std::string& file, const char* what) const {
  const int error = errno;
  throw BadInput(fmt::format("--output {}: {} {} ({})", path_, file, what, std::strerror(error)));
}

void SweepFile::refuse(const std::string& why) const { throw BadInput(fmt::format("--output {}: {}", path_, why)); }

}  // namespace clatter::validation
