// SPDX-License-Identifier: GPL-3.0-or-later
// What a sweep computes: scenes that differ in the values of a few keys.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/argument.hpp"
#include "validation/scene/keys.hpp"
#include "validation/scene/scene.hpp"
#include "validation/sweep/points.hpp"
#include "validation/sweep/rows.hpp"

namespace clatter::validation {

/// What is asked of a sweep.
struct SweepRequest {
  std::string file;
  std::optional<std::string> text;  ///< of the scene that `file` then only names in messages
  std::vector<std::string> sets, probes;
  std::optional<int> random, seed;
  std::optional<double> scatter;  ///< [°]
  std::optional<Model> model;     ///< else the continuous one where there is a ground
  bool takes_other_model = true;  ///< whether `model` could be another one, which messages then name
  std::optional<RowKind> rows;
  std::string scenes{};         ///< FROM:TO or FROM:TO:STEP, which are computed; empty: all
  std::string columns;          ///< empty: no more than rows have anyway
  bool no_errors = false;       ///< as --set run.errors=false
  bool require_digits = false;  ///< as --set run.require_digits=true
  /// Percentiles and extremes in place of rows: of attitudes the hardest impact's number, impulse and corners without
  /// being asked, and by the continuous model no more than three digits and no growth of errors unless they are.
  bool summary = false;
  std::vector<FragilePart> parts;  ///< at the probe that each names or at each; none: those of the file's probes
  std::string rank_by;             ///< column by which attitudes are ranked, with `summary`; empty: by what is hard
};

/// The options that fill it, but for values, points and flags.
[[nodiscard]] Arguments sweep_arguments(SweepRequest& request);

/// The scenes of a sweep whose run warns of something, from any thread: how many they are, and the first.
class FirstWarning {
 public:
  void note(long long index, const std::string& words) {
    const std::lock_guard lock(mutex_);
    ++count_;
    if (first_ && first_->first <= index) return;
    first_ = {index, words};
  }
  /// Index and words; none: no scene warned.
  [[nodiscard]] const std::optional<std::pair<long long, std::string>>& found() const { return first_; }
  [[nodiscard]] long long count() const { return count_; }

 private:
  std::mutex mutex_;
  std::optional<std::pair<long long, std::string>> first_;
  long long count_ = 0;
};

struct SweepPlan {
  Scene scene;  ///< the swept keys have their first values
  RowLayout layout;
  SweepPoints points;
  PickedScenes range;          ///< of the points: the scenes that are computed
  bool packed = false;         ///< rows are not CSV but packed cells
  bool has_own_limit = false;  ///< run.impacts is given
  /// What puts the value of each axis into a scene.
  std::vector<std::function<void(Scene&, std::span<const double>)>> put;
  /// Places, among the numbers of a point, of those that make the body another one.
  std::vector<std::size_t> body_values;
  /// How it was asked for: the values set, and how many scenes there are.
  std::vector<std::string> words;
  std::vector<RunFile> attitude_files;                                       ///< lists that it was read from
  std::shared_ptr<FirstWarning> warning = std::make_shared<FirstWarning>();  ///< of its runs
  /// Keys of which a head says nothing: the swept ones and what follows from them.
  std::vector<std::string> unsettled;

  /// The scene's file or name and what is set to one value, as words of a command.
  std::string fixed_words;

  /// The command that shows the impacts of one scene, or its row where the column is a probe's.
  [[nodiscard]] std::string command_of(long long index, const std::string& column) const;
  /// The name of a listed attitude, of its place from 0: of a box's 26 its number and the part that points down.
  [[nodiscard]] std::string attitude_name(long long place) const;
  bool numbered_attitudes = false;  ///< the listed ones are a box's 26
  /// Puts the numbers of a point into a scene.
  void put_point(const std::vector<double>& values, Scene& into) const;
  std::vector<std::string> in_vain{};  ///< what is set to one value that the model does not read
  /// What to say of rows that are whole: what is set in vain, how many of its runs warn, and the first, and how many
  /// end at a limit that nobody gave.
  /// @param cut  scenes that end at run.impacts, where more may follow
  /// @param warned  scenes that warn, where earlier runs computed some; none: those of this run
  [[nodiscard]] std::vector<std::string> remarks(long long cut, std::optional<long long> warned = {}) const;
  /// The report without rows.  Equal for equal sweeps; a mesh and lists of attitudes are in it by digests of their
  /// files.  What it says of the scene leaves out the swept keys.
  [[nodiscard]] Report report() const;
};

/// A scene with a ground is for the continuous model unless the other one is named.  As in scene files, one coefficient
/// of the ground's friction is both: a sliding one that is set replaces the file's static one too, unless both are set.
/// @throws BadInput with one line; both ends of every axis are checked like keys of the scene file.
[[nodiscard]] SweepPlan read_sweep_plan(const SweepRequest& request);

}  // namespace clatter::validation
