// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/run/time_window.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation {

std::string TimeWindow::text() const { return shortest(from) + ":" + shortest(to); }

TimeWindow read_window(const std::string& name, const std::string& text) {
  TimeWindow window;
  const std::size_t colon = std::min(text.find(':'), text.size());
  const bool reads = colon < text.size() && read_number(text.substr(0, colon), window.from) &&
                     read_number(text.substr(colon + 1), window.to);
  if (!reads) throw BadInput(fmt::format("{} '{}': must be FROM:TO, two times in s", name, text));
  if (!(window.from < window.to)) throw BadInput(fmt::format("{} '{}': FROM must be less than TO", name, text));
  return window;
}

namespace {

/// The row at `time` on the straight line between two others.
std::vector<double> between(const std::vector<double>& before, const std::vector<double>& after, double time) {
  const double part = (time - before[0]) / (after[0] - before[0]);
  std::vector<double> row(before.size());
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = before[i] * (1 - part) + after[i] * part;
  row[0] = time;
  return row;
}

}  // namespace

std::vector<std::vector<double>> clipped(const std::vector<std::vector<double>>& rows, const TimeWindow& window) {
  const auto is_before = [&](const std::vector<double>& row) { return row[0] < window.from; };
  const auto reaches = [&](const std::vector<double>& row) { return row[0] <= window.to; };
  const auto first = std::partition_point(rows.begin(), rows.end(), is_before);
  const auto last = std::partition_point(first, rows.end(), reaches);
  std::vector<std::vector<double>> kept;
  if (first != rows.begin() && first != rows.end()) kept.push_back(between(*(first - 1), *first, window.from));
  kept.insert(kept.end(), first, last);
  if (last != rows.end() && last != rows.begin()) kept.push_back(between(*(last - 1), *last, window.to));
  return kept;
}

}  // namespace clatter::validation
