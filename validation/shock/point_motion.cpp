// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/point_motion.hpp"

#include <cassert>

namespace clatter::validation {

Vector3 specific_force(const numeric::PieceSample& at, const Vector3& r, double mass) {
  const Vector3& omega = at.state.angular_velocity;
  return at.state.attitude.conjugate() * at.force / mass + at.angular_acceleration.cross(r) +
         omega.cross(omega.cross(r));
}

Vector3 value_at(const VectorPolynomial& vector, double x) {
  return {vector[0].at(x), vector[1].at(x), vector[2].at(x)};
}

void MotionRecorder::record_piece(const numeric::HistoryPiece& piece) {
  assert(piece.samples.size() == sample_count);
  pieces_.push_back({piece, {piece.samples.begin(), piece.samples.end()}});
  pieces_.back().piece.samples = {};
}

}  // namespace clatter::validation
