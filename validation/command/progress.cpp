// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/command/progress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "validation/output/interrupt.hpp"

namespace clatter::validation {

void Progress::show(const std::string& text) {
  if (!shows_progress()) return;
  shown_ = true;
  std::fputs(fmt::format("\r\033[Kclatter: {}", text).c_str(), stderr);
}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

std::string Progress::time_left(std::size_t done, std::size_t of) const {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  if (done == 0 || seconds < 2) return "";
  return ", " + validation::time_left(seconds * static_cast<double>(of - done) / static_cast<double>(done));
}

std::string time_left(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s left", std::ceil(seconds));
  if (seconds < 6000) return fmt::format("{:.0f} min left", std::ceil(seconds / 60));
  return fmt::format("{:.0f} h left", std::ceil(seconds / 3600));
}

std::string progress_bar(std::size_t done, std::size_t of) {
  constexpr std::size_t width = 30;
  const std::size_t filled = of > 0 ? width * done / of : 0;
  return std::string(filled, '#') + std::string(width - filled, '.') + fmt::format(" {} of {}", done, of);
}

}  // namespace clatter::validation
