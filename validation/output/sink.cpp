// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/sink.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"

namespace clatter::validation::inline output {

Sink::Sink(const std::string& path, const std::string& option) : path_(path), option_(option) {
  if (path_.empty()) {
    stream_ = stdout;
    return;
  }
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
  if (path_.empty()) throw std::runtime_error(fmt::format("standard output: {} ({})", what, std::strerror(error)));
  throw BadInput(fmt::format("{} {}: {} ({})", option_, path_, what, std::strerror(error)));
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

}  // namespace clatter::validation::inline output
