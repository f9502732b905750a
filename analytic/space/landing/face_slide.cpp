// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/face_slide.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "analytic/base/limits.hpp"
#include "analytic/space/impulse/slip_motion.hpp"
#include "analytic/space/landing/face_pressure.hpp"

namespace clatter::analytic::space {

namespace {

/// y = (√m U, √I_zz w, ψ, x/ℓ), ℓ the way that friction alone would leave a slide as fast as this.
class FaceSlide final : SlipMotion {
 public:
  FaceSlide(const SpinningFace& face, const ContactArea& area, double impulse)
      : SlipMotion(6), face_(face), pressure_(area, {face.friction, Vector2::Zero(), shift_of(face)}),
        weight_(face.mass * face.gravity), impulse_(impulse),
        root_(std::sqrt(face.mass), std::sqrt(face.mass), std::sqrt(face.moment)) {
    y_.head<3>() << root_[0] * face.slip, root_[2] * face.spin;
    unit_ = y_.head<3>().squaredNorm() / (2 * face.friction * weight_);
    only_friction_ = scales_along_ = true;
  }

  std::optional<SlidFace> follow() {
    const End end = slide();
    if (end == End::no_pressure) return {};
    SlidFace result{.time = spent_ / weight_, .has_stopped = end == End::stopped, .turn = y_[3]};
    result.way = unit_ * y_.tail<2>();
    if (result.has_stopped) return result;
    result.slip = Eigen::Rotation2Dd(y_[3]) * Vector2(y_.head<2>() / root_[0]);
    result.spin = y_[2] / root_[2];
    return result;
  }

 private:
  static Eigen::Matrix<double, 2, 3> shift_of(const SpinningFace& face) {
    Eigen::Matrix<double, 2, 3> shift = Eigen::Matrix<double, 2, 3>::Zero();
    shift.leftCols<2>() = -face.depth * Matrix2::Identity();
    return shift;
  }

  Values rate(const Values& y) override {
    const Vector2 slip = y.head<2>() / root_[0];
    const double spin = y[2] / root_[2];
    const auto push = pressure_.against(slip, spin, at_once_);
    Values change(6);
    change.head<3>() = push.friction.array() / root_.array();
    change.head<2>() -= root_[0] * spin / weight_ * quarter_turn(slip);
    change[3] = spin / weight_;
    change.tail<2>() = Eigen::Rotation2Dd(y[3]) * slip / (weight_ * unit_);
    if (push.beyond != Vector2::Zero()) change.setConstant(detail::missing);  // it tips
    return change;
  }
  double impulse_left(const Values&) override { return impulse_ - spent_; }
  bool end_stage() override { return true; }
  void keep() override { pressure_.keep(); }
  void go_back() override { pressure_.go_back(); }

  const SpinningFace& face_;
  FacePressure pressure_;
  double weight_, impulse_, unit_ = 1;
  Vector3 root_;  ///< √m, √m, √I_zz
};

}  // namespace

std::optional<SlidFace> slide_and_spin(const SpinningFace& face, const ContactArea& area, double until) {
  if (!(until > 0)) return SlidFace{.slip = face.slip, .spin = face.spin};
  return FaceSlide(face, area, face.mass * face.gravity * until).follow();
}

}  // namespace clatter::analytic::space
