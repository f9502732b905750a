// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of so many rows that they are made one at a time, as often as the form needs them, and not kept.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "validation/output/report.hpp"

namespace clatter::validation {

/// Rows by their number, from 0.  A row is valid until the next one is asked for.
struct RowSource {
  std::size_t count = 0;
  std::function<const Row&(std::size_t)> row;
};

/// Takes the pieces of a text, in order.
using WriteText = std::function<void(std::string_view)>;

/// The text of report_text() in any form but JSON, with these rows in place of the report's: each is asked for once by
/// CSV, Markdown and LaTeX, by a table once for the widths and once for each block.
void write_rows(const Report& report, const RowSource& rows, const TextStyle& style, const WriteText& write);

/// The text of json_text() of fields whose list of that name, there empty, has so many items.
/// @throws std::invalid_argument if the fields have no such list
void write_json(const Value& fields, const std::string& list, std::size_t count,
                const std::function<Value(std::size_t)>& item, const WriteText& write);

}  // namespace clatter::validation
