#include "validation/output/sink.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "validation/output/interrupt.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {

Sink::Sink(const std::string& path, const std::string& option)
    : path_(path), option_(option), stream_(stdout) {
  if (path_.empty()) return;
  struct stat status{};
  if (stat(path_.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    throw BadInput(fmt::format("{} {}: not a regular file", option_, path_));
  }
  std::vector<char> name(path_.begin(), path_.end());
  for (const char c : std::string_view(".XXXXXX")) name.push_back(c);
  name.push_back('\0');
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) fail("cannot be created");
  temporary_ = name.data();
  remove_on_interrupt(temporary_);
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, 0666 & ~mask);
  stream_ = fdopen(descriptor, "wb");
}

Sink::~Sink() {
  if (temporary_.empty()) return;
  if (stream_ != nullptr) std::fclose(stream_);
  unlink(temporary_.c_str());
  keep_on_interrupt(temporary_);
}

void Sink::fail(const char* what) const {
  throw BadInput(fmt::format("{} {}: {} ({})", option_, path_, what, std::strerror(errno)));
}

void Sink::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream_) == text.size()) return;
  if (is_file()) fail("cannot be written");
  std::_Exit(errno == EPIPE ? 0 : 3);  // nobody reads any more
}

void Sink::commit() {
  if (std::fflush(stream_) != 0) {
    if (is_file()) fail("cannot be written");
    std::_Exit(errno == EPIPE ? 0 : 3);
  }
  if (!is_file()) return;
  if (fsync(fileno(stream_)) != 0) fail("cannot be written");
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be put in place");
  std::fclose(stream_);
  keep_on_interrupt(temporary_);
  temporary_.clear();
}

}  // namespace clatter::validation
