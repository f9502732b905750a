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

#include "validation/sweep/rows.hpp"

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

/// Where a scene, a mesh or a list of attitudes lay is left out: what is in it has lines of its own.
std::string without_paths(const std::string& line) {
  const std::size_t cut = line.find(": ");
  if (line.starts_with("# set: drop.attitude = @")) return line.substr(0, line.find('@'));
  if (!line.starts_with("# scene: ")) return line;
  nlohmann::ordered_json scene = nlohmann::ordered_json::parse(line.substr(cut + 2), nullptr, false);
  if (!scene.is_object()) return line;
  scene.erase("file");
  const nlohmann::ordered_json::json_pointer mesh("/body/mesh");
  if (scene.contains(mesh) && scene.at(mesh).is_object()) scene.at(mesh).erase("file");
  return line.substr(0, cut + 2) + scene.dump();
}

/// A line of a head, under what it tells of: "scene", "set: drop.angle_deg"; the names of the columns under "".
struct NamedLine {
  std::string name, line;
  bool operator==(const NamedLine&) const = default;
  /// Whether it follows from the other lines.
  [[nodiscard]] bool follows() const { return name.empty() || name == "units"; }
  [[nodiscard]] std::string value() const { return line.substr(std::min(name.size() + 4, line.size())); }
};

std::vector<NamedLine> named_lines(const std::string& head) {
  std::vector<NamedLine> lines;
  std::istringstream text(head);
  for (std::string line; std::getline(text, line);) {
    const std::size_t end = std::min(line.find(line.starts_with("# set: ") ? " = " : ": "), line.size());
    const std::string name = !line.starts_with("# ") ? "" : lines.empty() ? "title" : line.substr(2, end - 2);
    lines.push_back({name, without_paths(line)});
  }
  return lines;
}

/// In what two heads differ, in words; empty: in nothing.
std::string difference_of_heads(const std::string& there, const std::string& here) {
  std::vector<NamedLine> others = named_lines(there), own = named_lines(here);
  std::erase_if(own, [&](const NamedLine& line) {
    const auto same = std::ranges::find(others, line);
    const bool is_there = same != others.end();
    if (is_there) others.erase(same);
    return is_there;
  });
  const auto follow_last = [](std::vector<NamedLine>& lines) {
    std::ranges::stable_partition(lines, [](const NamedLine& line) { return !line.follows(); });
  };
  follow_last(own), follow_last(others);
  for (const NamedLine& line : own) {
    const auto other = std::ranges::find(others, line.name, &NamedLine::name);
    if (other != others.end() && !line.follows()) return difference(other->line, line.line);
  }
  if (!own.empty() && !own.front().follows())
    return fmt::format("{} is nothing there, {} here", own.front().name, own.front().value());
  if (!others.empty() && !others.front().follows())
    return fmt::format("{} is {} there, nothing here", others.front().name, others.front().value());
  if (own.empty() && others.empty()) return "";
  return difference(others.empty() ? "" : others.front().line, own.empty() ? "" : own.front().line);
}

/// What a file has in the place of a head.
struct HeadThere {
  std::string text{};        ///< all its lines of comments and the next one
  std::string difference{};  ///< in words; empty: it says the same, or ends within it
  bool is_whole = false;     ///< and is followed by rows, if any
};

HeadThere read_head(std::istream& file, const std::string& head) {
  HeadThere found;
  const bool has_columns = !std::string_view(head).substr(head.rfind('\n', head.size() - 2) + 1).starts_with("# ");
  bool is_comment = true;
  for (std::string line; is_comment && std::getline(file, line);) {
    is_comment = line.starts_with("# ");
    found.text += line + (file.eof() ? "" : "\n");
  }
  const bool is_cut = found.text.empty() || found.text.back() != '\n' || is_comment == has_columns;
  if (is_cut && head.starts_with(found.text)) return found;
  found.difference = difference_of_heads(found.text, head);
  found.is_whole = found.difference.empty() && !is_cut;
  return found;
}

/// A whole number; 0: it is none.
long long whole_of(std::string_view cell) {
  long long number = 0;
  std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return number;
}

bool truncate_to(int file, long long bytes) {
  return ftruncate(file, bytes) == 0 && lseek(file, bytes, SEEK_SET) == bytes;
}

}  // namespace

bool is_own_file(const std::string& path, std::istream& there, const std::string& head) {
  const HeadThere found = read_head(there, head);
  if (found.difference.empty()) return found.is_whole;
  const std::string_view kind = head.find(", map: ") < head.find('\n') ? "map" : "sweep";
  const std::size_t title = found.text.find(fmt::format(", {}: ", kind));
  const bool is_of_its_kind = found.text.starts_with("# clatter ") && title < found.text.find('\n');
  throw OtherFileThere(path, is_of_its_kind ? fmt::format("of another {} ({})", kind, found.difference)
                                            : fmt::format("and is not of this {}", kind));
}

std::string scene_run(long long first, long long last) {
  return first == last ? std::to_string(first) : fmt::format("{} to {}", first, last);
}

FoundRows find_rows(std::istream& rows, const ExpectedRows& expected,
                    const std::function<void(std::string_view row)>& take) {
  const PickedScenes& scenes = expected.scenes;
  FoundRows found;
  long long before = -1;  // place of the scene of the row before
  const auto lack = [&](long long first, long long last) {
    if (first <= last) found.missing.push_back(scene_run(scenes.at(first), scenes.at(last)));
  };
  std::string begins;
  long long of_scene = 0, told = 0;  // rows that the scene has, and how many it should have
  bool is_cut = false;
  const auto end_scene = [&] {
    if (before < 0) return;
    if (is_cut || of_scene != told) found.cut.push_back(std::to_string(found.last));
    else if (!found.there.empty() && found.there.back().first + found.there.back().count == before)
      ++found.there.back().count;
    else found.there.push_back({before, 1});
  };
  for (std::string row; std::getline(rows, row);) {
    long long scene = -1;
    std::from_chars(row.data(), row.data() + std::min(row.find(','), row.size()), scene);
    const long long place = (scene - scenes.first) / scenes.step;
    const bool is_one = scene >= scenes.first && scenes.at(place) == scene && place < scenes.count;
    if (is_one && place > before) begins = expected.begins(scene) + ",";
    if (rows.eof()) found.amiss = "its last row is cut";
    else if (!is_one) found.amiss = fmt::format("'{}' is no row of it", row.substr(0, 40));
    else if (place < before || (place == before && !expected.scene_rows))
      found.amiss = fmt::format("a row of scene {} follows one of scene {}", scene, found.last);
    else if (!row.starts_with(begins)) found.amiss = fmt::format("scene {} has other values of its keys", scene);
    if (!found.amiss.empty()) {
      end_scene();
      return found;
    }
    lack(before + 1, place - 1);
    if (place > before) {
      end_scene();
      ++found.scenes;
      of_scene = told = 0, is_cut = false;
    }
    ++of_scene;
    const long long n = expected.scene_rows ? whole_of(csv_cell(std::string_view(row).substr(begins.size()), 0)) : 1;
    told = expected.scene_rows ? whole_of(csv_cell(row, *expected.scene_rows)) : 1;
    if (n > 0 && n < of_scene) found.amiss = fmt::format("impact {} of scene {} is there again, or late", n, scene);
    if (!found.amiss.empty()) return found;
    is_cut = is_cut || (n > 0 ? n : told) != of_scene;
    before = place;
    found.last = scene;
    take(row);
  }
  end_scene();
  lack(before + 1, scenes.count - 1);
  return found;
}

std::vector<RunFile> SweepFile::files_beside(const std::string& path) {
  const std::string part = destination_of({"--output", path}).path + ".part";
  return {{"--output's part", part}, {"--output's digests", part + ".digests"}, {"--output's columns", part + ".made"}};
}

std::optional<long long> SweepFile::begun_scenes(const std::string& part) {
  struct stat status {};
  std::optional<long long> scenes;
  if (stat(part.c_str(), &status) != 0) return scenes;
  for (const Record& record : read_records(part + ".digests"))
    if (record.bytes <= status.st_size) scenes = record.scenes;
  return scenes;
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

std::string SweepFile::own_head(const std::string& head) const {
  std::ifstream file(part_, std::ios::binary);
  const HeadThere found = read_head(file, head);
  if (!found.difference.empty())
    refuse(fmt::format("{} is of another sweep ({}); --restart begins anew", part_, found.difference));
  return found.is_whole ? found.text : "";
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
  struct stat status {};
  fstat(part_file_, &status);
  is_sound = is_sound && (scenes_ > 0 || status.st_size == bytes_);
  if (!is_sound)
    say(fmt::format("{}: rows after its first {} scenes are not as they were written, and are computed anew", part_,
                    scenes_));
  if (!truncate_to(part_file_, bytes_)) fail(part_, "cannot be written");
  if (!truncate_to(digests_file_, kept_records)) fail(digests_, "cannot be written");
}

void SweepFile::take_up(const SweepFileForm& form) {
  const std::string there = own_head(form.head), head = there.empty() ? form.head : there;
  struct stat status {};
  fstat(part_file_, &status);
  if (status.st_size > static_cast<off_t>(there.size()) && !there.empty() && access(digests_.c_str(), F_OK) != 0) {
    refuse(
        fmt::format("{} has rows, but {}, which tells how many of them are whole, is not there; --restart begins anew",
                    part_, digests_));
  }
  is_own_ = true;
  digests_file_ = ::open(digests_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (digests_file_ < 0) fail(digests_, "cannot be created");
  if (destination_.mode) fchmod(part_file_, *destination_.mode);
  digest_.add(head);
  bytes_ = head_bytes_ = static_cast<long long>(head.size());
  if (!there.empty()) return keep_whole_rows(form);
  if (!truncate_to(part_file_, 0) || !write_all(part_file_, head)) fail(part_, "cannot be written");
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
