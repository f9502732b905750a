// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clatter::validation {
namespace {

using Signs = std::array<int, 3>;

constexpr double attitude_rounding = 0.01;  // numbers typed with two digits are meant to have the length 1

int parts_of(const Signs& signs) {
  return static_cast<int>(std::count_if(signs.begin(), signs.end(), [](int sign) { return sign != 0; }));
}

/// In the order of their numbers.
std::vector<Signs> all_signs() {
  std::vector<Signs> all;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) all.push_back({x, y, z});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Signs& a, const Signs& b) { return parts_of(a) < parts_of(b); });
  // Faces by their axis, as people count them.
  std::stable_sort(all.begin(), all.begin() + 6, [](const Signs& a, const Signs& b) {
    const auto axis = [](const Signs& s) { return s[0] != 0 ? 0 : s[1] != 0 ? 1 : 2; };
    return axis(a) < axis(b);
  });
  return all;
}

}  // namespace

Signs orientation_signs(int orientation) {
  static const std::vector<Signs> all = all_signs();
  return all.at(static_cast<std::size_t>(orientation - 1));
}

std::string orientation_name(int orientation) {
  std::string name;
  const Signs signs = orientation_signs(orientation);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (signs[axis] != 0) name += {signs[axis] < 0 ? '-' : '+', "xyz"[axis]};
  }
  return name;
}

std::vector<double> orientation_attitude(int orientation, const numeric::Vector3& size) {
  const Signs signs = orientation_signs(orientation);
  const numeric::Vector3 down =
      numeric::Vector3(signs[0] * size.x(), signs[1] * size.y(), signs[2] * size.z()).normalized();
  // The turn that takes `down` to −z: half of it about down × −z = (−d_y, d_x, 0).
  const double across = std::hypot(down.x(), down.y());
  if (across == 0) return down.z() < 0 ? std::vector<double>{1, 0, 0, 0} : std::vector<double>{0, 1, 0, 0};
  const double half = std::atan2(across, -down.z()) / 2;
  const double part = std::sin(half) / across;
  return {std::cos(half), -down.y() * part, down.x() * part, 0};
}

bool is_attitude(std::span<const double> parameters) {
  const double square = std::inner_product(parameters.begin(), parameters.end(), parameters.begin(), 0.0);
  return parameters.size() == 4 && std::fabs(std::sqrt(square) - 1) <= attitude_rounding;
}

}  // namespace clatter::validation
