// SPDX-License-Identifier: GPL-3.0-or-later
// The batch's kernels for the instruction sets of this processor, and what both hand to one another: blocks of eight
// drops.
#pragma once

#include <array>
#include <vector>

#include "analytic/plane/body.hpp"

namespace clatter::analytic::batch {

inline constexpr int block_size = 8;

/// A number for each drop of a block.
using Block = std::array<double, block_size>;

/// A planar body as the kernels see it; the same for all drops.
struct LaneBody {
  double mass = 1;                      ///< [kg]
  double inverse_gyration_square = 12;  ///< 1/k² [1/m²]
  int vertex_count = 2;
  std::array<double, max_vertices> x{}, z{};  ///< [m]
  std::array<double, max_vertices> reach{};   ///< √(x² + z²) [m]
  std::array<double, max_vertices> polar{};   ///< of the vertex in the body's frame [rad]
  double most_reach = 0;                      ///< the largest [m]
};

/// What is asked of each drop.
struct BatchRequest {
  int limit = 6;  ///< most impacts that are followed
  /// Where infinitely many impacts are proven, close to flat, the drop ends there, without numbers.
  bool only_counts = false;
};

/// Eight drops.  Ones that fill a block up may repeat others.
struct alignas(64) LaneDrops {
  Block inclination;                  ///< [rad]
  Block normal, tangential, angular;  ///< before the first impact [m/s, rad/s]
  Block gravity;                      ///< [m/s²]
  Block restitution, impulse_ratio;   ///< e, μ_i
};

/// What came out of eight drops; numbers of a drop that is not certain mean nothing.
struct alignas(64) LaneResults {
  std::array<bool, block_size> is_certain;             ///< every root and every decision is certified
  std::array<bool, block_size> is_at_limit;            ///< more impacts may follow
  std::array<bool, block_size> is_infinite;            ///< infinitely many follow; numbers mean nothing
  Block impacts;                                       ///< how many
  Block total, largest, hardest;                       ///< sum of P_n, largest P_n [N·s], its impact from 1
  Block last_vertex, last_start, loss;                 ///< index; [s]; energy lost [J]
  std::array<Block, 3> impulse, contact_angle, start;  ///< of the first three impacts [N·s, rad, s]
};

using Kernel = void (*)(const LaneBody& body, const LaneDrops& drops, const BatchRequest& request,
                        LaneResults& results);

/// An instruction set and its kernel.
struct KernelChoice {
  const char* name;  ///< "sse2", "avx2", "avx512"; "portable" beside x86
  Kernel run;
};

/// Those that run here, the widest first.  All do the same operations in the same order, none of them contracted, so
/// that their results agree bit for bit.
[[nodiscard]] const std::vector<KernelChoice>& kernels();

}  // namespace clatter::analytic::batch
