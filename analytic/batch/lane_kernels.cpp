// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/batch/lane_kernels.hpp"

#include "analytic/base/angle.hpp"

// g++'s vector types, compiled three times by pragma.  Highway would do the same by a package more; with
// std::experimental::simd the instruction set is that of a whole file, whose inline functions of other headers the
// linker may then choose for processors that lack it.
namespace clatter::analytic::batch {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"
#pragma GCC diagnostic ignored "-Wold-style-cast"

// What follows is compiled for an instruction set.
#define CLATTER_PRAGMA(text) _Pragma(#text)
#if defined(__clang__)
#define CLATTER_BEGIN_TARGET(set) \
  CLATTER_PRAGMA(clang attribute push(__attribute__((target(set))), apply_to = function))
#define CLATTER_END_TARGET CLATTER_PRAGMA(clang attribute pop)
#else
#define CLATTER_BEGIN_TARGET(set) CLATTER_PRAGMA(GCC push_options) CLATTER_PRAGMA(GCC target(set))
#define CLATTER_END_TARGET CLATTER_PRAGMA(GCC pop_options)
#endif

#if defined(__x86_64__)
#define CLATTER_LANES 2
namespace sse2 {
namespace {
#include "analytic/batch/lane_kernel.hpp"
}
}  // namespace sse2
#undef CLATTER_LANES

CLATTER_BEGIN_TARGET("avx2")
#define CLATTER_LANES 4
namespace avx2 {
namespace {
#include "analytic/batch/lane_kernel.hpp"
}
}  // namespace avx2
#undef CLATTER_LANES
CLATTER_END_TARGET

CLATTER_BEGIN_TARGET("avx512f,avx512dq,avx512vl")
#define CLATTER_LANES 8
namespace avx512 {
namespace {
#include "analytic/batch/lane_kernel.hpp"
}
}  // namespace avx512
#undef CLATTER_LANES
CLATTER_END_TARGET
#else
#define CLATTER_LANES 2
namespace portable {
namespace {
#include "analytic/batch/lane_kernel.hpp"
}
}  // namespace portable
#undef CLATTER_LANES
#endif

#pragma GCC diagnostic pop

const std::vector<KernelChoice>& kernels() {
  static const std::vector<KernelChoice> all = [] {
    std::vector<KernelChoice> found;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
      found.push_back({"avx512", avx512::run_block});
    if (__builtin_cpu_supports("avx2")) found.push_back({"avx2", avx2::run_block});
    found.push_back({"sse2", sse2::run_block});
#else
    found.push_back({"portable", portable::run_block});
#endif
    return found;
  }();
  return all;
}

}  // namespace clatter::analytic::batch
