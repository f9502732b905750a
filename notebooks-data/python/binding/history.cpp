// SPDX-License-Identifier: GPL-3.0-or-later
#include "history.hpp"

#include <pybind11/numpy.h>

namespace clatter::python {
namespace {

namespace py = pybind11;
using numeric::HistorySample;
using numeric::Vector3;

using Samples = std::vector<HistorySample>;

template <class Number, class Get>
py::array_t<Number> column(const Samples& samples, const Get& get) {
  py::array_t<Number> array(static_cast<py::ssize_t>(samples.size()));
  auto values = array.template mutable_unchecked<1>();
  for (std::size_t i = 0; i < samples.size(); ++i) values(static_cast<py::ssize_t>(i)) = get(samples[i]);
  return array;
}

/// `get` gives a vector with operator[].
template <int Size, class Get>
py::array_t<double> columns(const Samples& samples, const Get& get) {
  py::array_t<double> array({static_cast<py::ssize_t>(samples.size()), static_cast<py::ssize_t>(Size)});
  auto values = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto vector = get(samples[i]);
    for (int k = 0; k < Size; ++k) values(static_cast<py::ssize_t>(i), k) = vector[k];
  }
  return array;
}

Eigen::Vector4d euler_parameters(const HistorySample& sample) {
  const Eigen::Quaterniond& beta = sample.state.attitude;
  return {beta.w(), beta.x(), beta.y(), beta.z()};
}

Vector3 world_angular_velocity(const HistorySample& sample) {
  return sample.state.attitude * sample.state.angular_velocity;
}

}  // namespace

py::dict History::arrays() const {
  const Samples& s = samples_;
  py::dict arrays;
  arrays["time"] = column<double>(s, [](const HistorySample& at) { return at.time; });
  arrays["centre"] = columns<3>(s, [](const HistorySample& at) { return at.state.centre; });
  arrays["attitude"] = columns<4>(s, euler_parameters);
  arrays["velocity"] = columns<3>(s, [](const HistorySample& at) { return at.state.velocity; });
  arrays["angular_velocity"] = columns<3>(s, world_angular_velocity);
  arrays["force"] = columns<3>(s, [](const HistorySample& at) { return at.force; });
  arrays["point_velocity"] = columns<3>(s, [](const HistorySample& at) { return at.point_velocity; });
  arrays["energy_translation"] = column<double>(s, [](const HistorySample& at) { return at.energy_translation; });
  arrays["energy_rotation"] = column<double>(s, [](const HistorySample& at) { return at.energy_rotation; });
  arrays["energy_potential"] = column<double>(s, [](const HistorySample& at) { return at.energy_potential; });
  arrays["energy_ground"] = column<double>(s, [](const HistorySample& at) { return at.energy_ground; });
  arrays["energy_total"] = column<double>(s, [](const HistorySample& at) { return at.energy_total(); });
  arrays["in_contact"] = column<bool>(s, [](const HistorySample& at) { return at.in_contact; });
  return arrays;
}

}  // namespace clatter::python
