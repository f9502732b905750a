// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that several checks and figures share, each made once.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "numeric/simulate.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// One value of a swept case.
struct SweptSimulation {
  double value;
  numeric::Simulation run;
  double force_impulse;  ///< ∫F_z dt over all contacts, by the trapezoidal rule over the accepted steps [N·s]
};

/// A run with its time history.
struct RecordedRun {
  numeric::Simulation run;
  std::vector<numeric::HistorySample> samples;

  [[nodiscard]] double force_impulse() const;  ///< as in SweptSimulation
};

/// How a case is run.
struct RunOptions {
  int digits = 0;   ///< 0: as the case says
  int impacts = 0;  ///< 0: as the case says
  bool planar = false;
  numeric::Method method = numeric::Method::automatic;
  double step = 0;  ///< of a method of fixed step [s]; 0: as the case says
  numeric::AreaMeasure area = numeric::AreaMeasure::surface;

  [[nodiscard]] std::string key() const;
};

/// Results by the name of the case (validation/cases/NAME.toml).  Thread-safe: who comes second waits for the first.
class CaseRuns {
 public:
  /// Asked now and then by long checks; false ends them with Interrupted.
  std::function<bool()> goes_on = [] { return true; };
  struct Interrupted {};
  /// Put into each case.
  std::vector<SceneOverride> changes{};

  /// The case's scene with the options and the changes put in.
  [[nodiscard]] Scene scene(const std::string& name, const RunOptions& options = {}) const;

  const numeric::Simulation& run(const std::string& name, const RunOptions& options = {});
  const RecordedRun& history(const std::string& name, const RunOptions& options = {});
  const std::vector<SweptSimulation>& sweep(const std::string& name, const RunOptions& options = {});
  const Comparison& comparison(const std::string& name, int impacts);
  /// Values of the case's sweep with the comparison of each.
  const std::vector<SweptComparison>& swept_comparison(const std::string& name);

 private:
  template <class Result>
  struct Made {
    struct Entry {
      std::once_flag made;
      Result result;
    };
    std::map<std::string, std::shared_ptr<Entry>> entries;
  };
  template <class Result>
  const Result& once(Made<Result>& made, const std::string& key, const std::function<Result()>& make);

  std::mutex mutex_;
  Made<numeric::Simulation> runs_;
  Made<RecordedRun> histories_;
  Made<std::vector<SweptSimulation>> sweeps_;
  Made<Comparison> comparisons_;
  Made<std::vector<SweptComparison>> swept_comparisons_;
};

/// The case's scene with the options put in.
/// @param changes  in place of what the case says
[[nodiscard]] Scene scene_of_case(const std::string& name, const RunOptions& options,
                                  const std::vector<SceneOverride>& changes = {});

}  // namespace clatter::validation
