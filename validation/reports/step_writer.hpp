// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of a derivation: titled groups of equations with their numbers put in.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "analytic/plane/sequence.hpp"

namespace clatter::validation::inline reports {

/// One line of a derivation: `name = formula = numbers = value unit`.
struct Equation {
  std::string name{};
  std::string formula{};  ///< or words; "FORMULA, words"
  std::string numbers{};  ///< the formula with numbers put in; may be empty
  double value = 0;
  std::string unit{};
  double error = 0;  ///< bound on the value's error; infinite: not known
  double size = 0;   ///< of such values, against which one counts as zero
};

/// A titled group of equations with a sentence before and after.
struct Step {
  std::string title;
  std::string text;
  std::vector<Equation> equations;
};

/// Why the sequence has no impact n.
struct SequenceEnd {
  std::size_t impacts = 0;
  analytic::Outcome outcome = analytic::Outcome::no_further_impact;
  const std::string& message;
  const analytic::NearMiss& near_miss;
};
[[nodiscard]] Step missing_impact(int n, const SequenceEnd& end);

/// Writes steps whose numbers are known to one relative error: none of them is known better than the impact's record.
class StepWriter {
 public:
  /// @param relative  infinite: nothing is known
  StepWriter(int digits, double relative) : digits_(digits), relative_(relative) {}

  void open(std::string title, std::string text) { steps_.push_back({std::move(title), std::move(text), {}}); }
  /// An error of 0 becomes the relative one, of the value's size.
  void add(Equation equation);
  /// Components NAME_x, NAME_y, NAME_z with `prime` behind; `formula` says where the vector comes from.
  void add_vector(const std::string& name, const std::string& prime, const std::string& formula,
                  const Eigen::Vector3d& vector, const std::string& unit);
  /// The number for a formula, in brackets where negative.
  [[nodiscard]] std::string number(double value) const { return number(value, 0); }
  /// The same of a number that counts as zero next to `size`.
  [[nodiscard]] std::string number(double value, double size) const;
  /// a·b of two vectors with their numbers.
  [[nodiscard]] std::string product(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

  [[nodiscard]] std::vector<Step> take() { return std::move(steps_); }

 private:
  int digits_;
  double relative_;
  std::vector<Step> steps_;
};

}  // namespace clatter::validation::inline reports
