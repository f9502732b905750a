// SPDX-License-Identifier: GPL-3.0-or-later
// What a sweep says of all its rows together, where they are too many to be kept.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "validation/output/cells.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/report.hpp"
#include "validation/sweep/points.hpp"
#include "validation/sweep/rows.hpp"

namespace clatter::validation {

/// Counts numbers in bins of a relative width of 2⁻¹², each with the least and the largest of its numbers.
class Histogram {
 public:
  void add(double number);
  [[nodiscard]] long long count() const { return count_; }
  /// The number that a part of all numbers does not exceed, part in (0, 1]: the middle of what its bin holds.
  /// `error` bounds its distance from the exact one: half of what the bin spans, 0 where that is a single number.
  /// @throws std::invalid_argument without numbers
  [[nodiscard]] Estimated percentile(double part) const;

 private:
  struct Bin {
    long long count = 0;
    double least = 0, largest = 0;
  };
  std::unordered_map<long long, Bin> bins_;
  long long count_ = 0;
};

/// The interval in which the probability lies with 95 %, from `hits` of `samples`.  Source: Wilson, J. Am. Stat. Assoc.
/// 22 (1927) 209.
struct Wilson {
  double part, low, high;

  Wilson(long long hits, long long samples);
};

/// The percentiles that a summary lists.
inline constexpr double summary_percents[]{1, 5, 25, 50, 75, 95, 99};

/// Takes rows, keeps for each column of numbers their count, percentiles and extremes, for each column of texts or
/// truths how often each occurs.  The order of the rows changes nothing; of equal extremes the first row's is kept.
class Summary {
 public:
  /// @param points  their listed attitudes, if any, are told apart by the largest of each number, of margins the least
  /// @param layout  of the rows; its first probe, if any, says which blows are hard
  Summary(const RowLayout& layout, const SweepPoints& points);

  /// Takes whole packed rows, whose first cell is the scene's number.
  void add(std::string_view rows);
  /// Puts the summary into a report that has its head: a row for each number and `texts` in JSON.  A reader sees the
  /// rows that were asked for, the one by which attitudes are ranked first, all if none was; notes on what was asked,
  /// and up to three on what else is remarkable; and the commands of the scenes that these are about.
  /// @param command  the command that shows a number of a scene, of the scene's number and the column
  /// @param attitude  the name of a listed attitude, of its place from 0
  template <class Command, class Attitude>
  void fill(Report& report, const Command& command, const Attitude& attitude) const {
    report.grid.columns = columns();
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      if (numbers_[i].histogram.count() > 0 && !is_flag(i))
        add_number(report, i, command(numbers_[i].least.index, columns_[i].name),
                   command(numbers_[i].largest.index, columns_[i].name));
    }
    if (points_->attitudes() > 0) add_attitudes(report, attitude);
    if (!worst_scenes_.empty()) {
      Grid worst = worst_scenes();
      for (std::size_t i = 0; i < worst.rows.size(); ++i)
        worst.rows[i].emplace_back(command(worst_scenes_[i].index, rank_by_));
      report.fields["worst"] = row_objects(worst);
      report.further = std::move(worst);
    }
    add_texts(report);
    for (const std::size_t i : remarked(report)) {
      const Extreme& worst = is_worst_least(columns_[i].name) ? numbers_[i].least : numbers_[i].largest;
      report.commands.push_back(
          {fmt::format("{}, the {}", columns_[i].name, end_of(i)), command(worst.index, columns_[i].name)});
    }
  }
  /// Place, among the rows' columns, of the one by which attitudes are ranked; none if the rows have none that tells.
  [[nodiscard]] std::optional<std::size_t> ranking() const;
  /// The columns of fill()'s rows.
  [[nodiscard]] static std::vector<Column> columns();

 private:
  struct Extreme {
    double value = 0;
    long long index = 0;
  };
  struct Numbers {
    Histogram histogram;
    Extreme least, largest;
    std::map<double, long long> tally{};  ///< how often each value occurs, while they are few: numbers of impacts are
  };
  using Texts = std::unordered_map<std::string, long long>;

  void add_number(Report& report, std::size_t column, const std::string& least, const std::string& largest) const;
  void add_texts(Report& report) const;
  /// Whether a column says true or false.
  [[nodiscard]] bool is_flag(std::size_t column) const {
    return texts_[column].contains("true") || texts_[column].contains("false");
  }
  /// Adds the notes on what is remarkable; returns the columns whose worst scene a reader may want to see.
  [[nodiscard]] std::vector<std::size_t> remarked(Report& report) const;
  struct Tail {
    std::size_t column = 0;
    double times = 1;  ///< its largest value over its median; 1: no two values of any column differ
  };
  /// The column, but for the ranked one and times, whose largest value is the most times its median.
  [[nodiscard]] Tail longest_tail() const;
  [[nodiscard]] const char* end_of(std::size_t column) const;  ///< "least" of margins, "largest" of all else
  /// Whether one number of a column is worse than another: a margin where it is less.
  [[nodiscard]] bool is_worse(std::size_t column, double one, double other) const;
  void add_attitudes(Report& report, const std::function<std::string(long long)>& name) const;
  /// Keeps the scene if it is among the ten worst by the column that was asked for.
  void rank(const Extreme& scene, std::size_t column);
  /// The ten worst scenes: their numbers, the ranked quantity and the swept keys, the worst first; a command is to
  /// follow.
  [[nodiscard]] Grid worst_scenes() const;

  std::vector<Column> columns_;
  std::vector<std::size_t> asked_{};  ///< columns that were asked for, in the order in which they are told
  std::size_t first_;                 ///< column that is summarised: swept keys need not be told
  std::string rank_by_;  ///< name of the column by which attitudes are ranked first; empty: the force or impulse
  const SweepPoints* points_;
  std::size_t outcome_;  ///< column that each row has
  std::vector<Numbers> numbers_;
  std::vector<std::vector<Extreme>> worst_;  ///< of each listed attitude, of each column; index -1: none yet
  std::optional<std::size_t> ranked_{};      ///< column by which scenes are ranked, where no attitudes are listed
  std::vector<Extreme> worst_scenes_{};      ///< the worst first
  std::vector<Texts> texts_;
  std::vector<PackedCell> row_;
};

}  // namespace clatter::validation
