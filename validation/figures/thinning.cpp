// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/figures/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter::validation::inline figures {
namespace {

constexpr double strips = 1000;
using Place = std::vector<CurvePoint>::const_iterator;

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Span span_of(const std::vector<CurvePoint>& points) {
  Span span;
  for (const CurvePoint& point : points) {
    if (point.is_gap()) continue;
    span.low = std::min(span.low, point.x);
    span.high = std::max(span.high, point.x);
  }
  return span;
}

double strip_of(const CurvePoint& point, const Span& span) {
  return std::floor(strips * (point.x - span.low) / (span.high - span.low));
}

/// First, last, highest and lowest of a run.
void keep(Place begin, Place end, std::vector<CurvePoint>& kept) {
  const auto [lowest, highest] =
      std::minmax_element(begin, end, [](const CurvePoint& a, const CurvePoint& b) { return a.y < b.y; });
  for (Place at = begin; at != end; ++at) {
    if (at == begin || at == lowest || at == highest || at + 1 == end) kept.push_back(*at);
  }
}

}  // namespace

bool CurvePoint::is_gap() const { return !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(low); }

std::vector<CurvePoint> thinned(const std::vector<CurvePoint>& points) {
  if (points.size() <= whole_curve) return points;
  const Span span = span_of(points);
  std::vector<CurvePoint> kept;
  for (Place begin = points.begin(); begin != points.end();) {
    if (begin->is_gap()) {
      kept.push_back(*begin++);
      continue;
    }
    const Place end = std::find_if(begin + 1, points.end(), [&](const CurvePoint& point) {
      return point.is_gap() || strip_of(point, span) != strip_of(*begin, span);
    });
    keep(begin, end, kept);
    begin = end;
  }
  return kept;
}

}  // namespace clatter::validation::inline figures
