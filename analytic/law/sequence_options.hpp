// SPDX-License-Identifier: GPL-3.0-or-later
// What an impact sequence is asked for, and how it ends: the same in the plane and in space.
#pragma once

#include <cmath>
#include <limits>

#include "analytic/base/errors.hpp"

namespace clatter::analytic {

struct SequenceOptions {
  int impacts = 6;  ///< most impacts to report, >= 1, with until_rest too: some hundreds may come before the rest
  /// Relative error to which the end of an accumulation of impacts must be known before the sequence
  /// is cut there: 10^−digits of the remaining time.  In [1, 15].
  int digits = 6;
  /// Also follow how errors of the drop and of rounding grow: `error` and `amplification` of each row, and the errors
  /// of tail and total.  A loop over many drops that needs no bounds does without, in space in half of the time.  With
  /// until_rest, in space, they are followed in any case: where rows can no longer be predicted decides where it ends.
  bool amplification = true;
  /// The end is asked for and not each row: bouncing in closed form is summed up at once.  In space: goes on after
  /// corners have stayed on the ground while the body turns, and ends where the body has to settle on one face and no
  /// impact can be predicted any more.
  bool until_rest = false;
  /// With until_rest: ends as soon as the face is known on which the body must come to rest; in the plane, where the
  /// rest itself is found at once, no sooner than that.
  bool until_face = false;
  /// No impact after this time since the first is followed [s].
  double until = std::numeric_limits<double>::infinity();

  /// @throws std::domain_error naming the field, its value and what is allowed.
  void validate() const {
    detail::require(impacts >= 1, "impacts", impacts, "at least 1");
    detail::require(!std::isnan(until), "until", until, "a number");
    detail::require(digits >= 1 && digits <= 15, "digits", digits, "between 1 and 15");
  }
};

enum class Outcome {
  no_further_impact,  ///< nothing reaches the ground any more
  impact_limit,       ///< as many impacts as asked for
  time_limit,         ///< the next impact comes after SequenceOptions::until
  at_rest,            ///< infinitely many impacts end in a finite time, with no normal or angular motion left that
                      ///< doubles could tell from none, or with a face that the body must settle on
  sustained_contact,  ///< a vertex stays on the ground (after infinitely many impacts, or with e = 0)
                      ///< while the body still turns: beyond the model
  not_computed,       ///< a number of the next flight or impact could not be had; the rows so far hold
  outside_model,      ///< the next impact jams; the rows so far hold
};

}  // namespace clatter::analytic
