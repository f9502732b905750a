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

#if defined(__x86_64__)
#define CLATTER_LANES 2
namespace sse2 {
namespace {
#include "analytic/batch/lane_kernel.hpp"
}
}  // namespace sse2
#undef CLATTER_LANES

#pragma GCC push_options
#pragma GCC target("avx2")
#define CLATTER_LANES 4
namespace avx2 {
namespace {
#include "analytic/batch/lane_kernel.hpp"
}
}  // namespace avx2
#undef CLATTER_LANES
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl")
#define CLATTER_LANES 8
namespace avx512 {
namespace {
#include "analytic/batch/lane_kernel.hpp"
}
}  // namespace avx512
#undef CLATTER_LANES
#pragma GCC pop_options
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
