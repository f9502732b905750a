// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "validation/output/number.hpp"
#include "validation/output/report.hpp"

namespace clatter::validation {

void CellWriter::pack(double value, char kind) {
  char bytes[1 + sizeof value] = {kind};
  std::memcpy(bytes + 1, &value, sizeof value);
  out_.append(bytes, sizeof bytes);
}

void CellWriter::number(double value) {
  if (packed_ && std::isfinite(value)) return pack(value + 0.0);
  out_ += packed_ ? '-' : ',';
  if (!packed_) append_number(out_, value);
}

void CellWriter::error(double value) {
  if (packed_) return number(rounded_up(value));
  out_ += ',';
  append_rounded_up(out_, value);
}

void CellWriter::whole(long long value) {
  if (packed_) return pack(static_cast<double>(value));
  out_ += ',';
  out_ += std::to_string(value);
}

void CellWriter::truth(bool value) {
  if (packed_) return pack(value ? 1 : 0, 't');
  out_ += value ? ",true" : ",false";
}

void CellWriter::word(std::string_view text) {
  if (text.empty()) return nothing();
  if (!packed_) {
    const auto is_plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == ' ';
    };
    out_ += ',';
    if (std::all_of(text.begin(), text.end(), is_plain)) out_ += text;
    else out_ += csv_text(std::string(text));
    return;
  }
  const auto size = static_cast<std::uint32_t>(text.size());
  char head[1 + sizeof size] = {'w'};
  std::memcpy(head + 1, &size, sizeof size);
  out_.append(head, sizeof head);
  out_ += text;
}

void CellWriter::nothing(std::size_t cells) { out_.append(cells, packed_ ? '-' : ','); }

bool PackedRows::read(PackedCell& cell, std::string_view& from) const {
  cell = {std::numeric_limits<double>::quiet_NaN(), {}};
  if (from.empty()) return false;
  const char kind = from.front();
  from.remove_prefix(1);
  if (kind == '-') return true;
  std::uint32_t size = 0;
  cell.is_text = kind == 'w';
  cell.is_truth = kind == 't';
  const std::size_t width = cell.is_text ? sizeof size : sizeof cell.number;
  if (from.size() < width) return false;
  std::memcpy(cell.is_text ? static_cast<void*>(&size) : &cell.number, from.data(), width);
  from.remove_prefix(width);
  if (from.size() < size) return false;
  cell.text = from.substr(0, size);
  from.remove_prefix(size);
  return true;
}

bool PackedRows::next(std::vector<PackedCell>& row) {
  std::string_view from = rest_;
  for (PackedCell& cell : row) {
    if (!read(cell, from)) return false;
  }
  rest_ = from;
  return true;
}

}  // namespace clatter::validation
