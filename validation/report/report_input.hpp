// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of `clatter report`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/shock/shock_options.hpp"

namespace clatter::validation {

struct ReportInput : ShockInput {
  std::string output;
  enum class Form { html, table, csv, json, markdown } form = Form::html;
  std::optional<int> drops, threads;
  std::optional<double> scatter;    ///< [°]
  std::string rank_by;              ///< column of the sweep
  std::vector<std::string> scenes;  ///< SCENE, of which there may be several
  std::string title, date;
  std::vector<std::string> further;  ///< files beside --output, whose endings say what they have
  bool is_short = false;  ///< the page has headlines, the table of cases and a drawing of each worst drop alone
  bool is_bare = false;   ///< CSV without comments
  enum class RowForm { by_itself, attitude } row_form = RowForm::by_itself;

  /// The part of one case, which has no more than one.
  [[nodiscard]] std::optional<FragilePart> part() const {
    return parts.empty() ? std::nullopt : std::optional(parts.front());
  }
};

/// The drops of the sweep over attitudes.
struct Attitudes {
  int drops = 260;
  double scatter = 3;  ///< [°]
};

}  // namespace clatter::validation
