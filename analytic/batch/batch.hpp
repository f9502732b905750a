// SPDX-License-Identifier: GPL-3.0-or-later
// Many planar drops at once: counts and first impacts for maps and arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "analytic/batch/lane_kernels.hpp"
#include "analytic/law/impact_law.hpp"
#include "analytic/plane/impact_rows.hpp"

namespace clatter::analytic {

/// Drops of one body, as arrays that somebody else keeps; each array has as many numbers as there are drops, or one for
/// all of them, which those that are left out have as Drop has it.  An impact's law is Newton's, or one of those that
/// agree with it here, and P_t = μ_i P_n.
struct BatchDrops {
  static constexpr double zero[1]{0}, one[1]{1};

  PlanarBody body;
  std::span<const double> inclination;               ///< [rad]
  std::span<const double> normal, tangential{zero};  ///< velocity before the first impact [m/s]
  std::span<const double> angular{zero};             ///< likewise [rad/s]
  std::span<const double> gravity{zero};             ///< [m/s²]
  std::span<const double> restitution{one};          ///< e
  std::span<const double> impulse_ratio{zero};       ///< μ_i

  [[nodiscard]] std::size_t count() const;
  /// Drop i for the scalar code.
  [[nodiscard]] Drop drop(std::size_t i) const;
  /// @throws std::invalid_argument if two arrays have different lengths, neither of them 1, std::domain_error as
  ///         Drop::validate() for a body that is none.
  void validate() const;
};

/// How a drop of a batch ended.
enum class BatchEnd : std::uint8_t {
  finished,      ///< nothing reaches the ground any more
  at_limit,      ///< as many impacts as asked for
  infinite,      ///< infinitely many impacts in a finite time, of which `impacts` were listed
  stays,         ///< an end stays on the ground: e = 0
  refused,       ///< no such drop, or its first contact does not approach the ground
  outside,       ///< an impact jams
  not_computed,  ///< a number could not be had
};
/// How a drop of a batch ends whose sequence, of the plane or of space, ends so.
[[nodiscard]] BatchEnd batch_end(Outcome outcome, bool has_tail);

/// What came out of a drop.  Numbers that it has not are NaN.
struct BatchOutcome {
  int impacts = 0;
  BatchEnd end = BatchEnd::finished;
  bool is_open = false;                                       ///< rounding, or a fold, leaves another sequence possible
  bool is_scalar = false;                                     ///< by the scalar code
  double total = 0;                                           ///< sum of the normal impulses [N·s]
  double largest = 0;                                         ///< normal impulse [N·s]
  int hardest = 0;                                            ///< impact with the largest normal impulse, from 1
  VertexSet last_vertices = 0;                                ///< which struck last
  double last_start = 0;                                      ///< of the last impact [s]
  double energy_loss = 0;                                     ///< over the impacts [J]
  std::array<double, 3> impulse{}, contact_angle{}, start{};  ///< of the first three impacts [N·s, rad, s]
};

using batch::BatchRequest;

/// The scalar code's sequence of up to `limit` impacts as such an outcome.
[[nodiscard]] BatchOutcome scalar_outcome(const Drop& drop, int limit);

/// The outcomes of drops first … first + outcomes.size() − 1, each as impact_sequence() has it, up to `request.limit`
/// impacts; of those with infinitely many `impacts` is how many were followed.  What is no drop is `refused`; the
/// others go on.
///
/// Vectors of drops take a fixed number of Halley steps from a guess to each root.  A drop's root counts if a last
/// step of Newton proves it to half an ulp beside the rounding of h, within a piece of h in which it is the first, and
/// if h of every other vertex is clear of zero before: by 2⁻⁴² of its terms and what an ulp of the start and rounding
/// have grown to, which is carried to first order through flights and impacts.  All other drops (nearer to a fold,
/// flat, upright, e < 1e-4, errors of an angle beyond 1e-4) are the scalar code's, and where a limit of 5 or more cuts
/// off what may be the beginning of infinitely many impacts. Accuracy: within the scalar code's error bars; sums of
/// four impacts or more of one drop in 10⁴ by up to ten times those, where gravity and turns lose three digits.
/// @param kernel  of batch::kernels(); none: the widest
/// @throws as BatchDrops::validate(); std::invalid_argument if request.limit < 1 or there are fewer drops.
void run_batch(const BatchDrops& drops, const BatchRequest& request, std::size_t first,
               std::span<BatchOutcome> outcomes, batch::Kernel kernel = nullptr);

/// The same without the scalar code: a drop that is that one's has `is_scalar` and no numbers.
void run_lanes(const BatchDrops& drops, const BatchRequest& request, std::size_t first,
               std::span<BatchOutcome> outcomes, batch::Kernel kernel = nullptr);

}  // namespace clatter::analytic
