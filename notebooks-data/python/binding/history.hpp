// SPDX-License-Identifier: GPL-3.0-or-later
// A time history in memory, for NumPy.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "numeric/drop/history.hpp"

namespace clatter::python {

class History : public numeric::HistoryRecorder {
 public:
  void record(const numeric::HistorySample& sample) override { samples_.push_back(sample); }
  /// One array a quantity, (n) or (n, 3) or (n, 4); SI, world frame.
  [[nodiscard]] pybind11::dict arrays() const;

 private:
  std::vector<numeric::HistorySample> samples_;
};

}  // namespace clatter::python
