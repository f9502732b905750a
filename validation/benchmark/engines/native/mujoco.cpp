// SPDX-License-Identifier: GPL-3.0-or-later
// MuJoCo 2: soft contacts without a coefficient of restitution.
// default: its own contact.  tuned: a spring and a damper (negative solref) that return the coefficient of restitution.
#include <mujoco/mujoco.h>

#include <cstring>
#include <memory>

#include "problem.hpp"

namespace {

constexpr double contact_steps = 10;  // that long a tuned contact lasts

/// Angle w t by which a damped oscillator's force is zero again; `damping` is the part of the critical one, below 1.
double contact_angle(double damping) {
  const double rest = std::sqrt(1 - damping * damping);
  return (M_PI - std::atan2(2 * damping * rest, 1 - 2 * damping * damping)) / rest;
}

/// Damping at which a spring and damper that do not pull return `restitution`: e = exp(-d w t), Schwager and Poeschel
/// (2007), "Coefficient of restitution and linear-dashpot model revisited".
double damping_for(double restitution) {
  double low = 0, high = 1 - 1e-9;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (std::exp(-middle * contact_angle(middle)) > restitution ? low : high) = middle;
  }
  return restitution < 1 ? low : 0;
}

std::string contact_settings(const league::Problem& problem) {
  if (!problem.tuned()) return "";
  // Modeling, "Solver parameters": solref = (-stiffness, -damping) per unit of mass; the impedance near 1 makes it so.
  const double damping = damping_for(problem.restitution);
  const double frequency = contact_angle(damping) / (contact_steps * problem.step);
  std::ostringstream text;
  text.precision(17);
  text << " solref=\"" << -frequency * frequency << ' ' << -2 * damping * frequency
       << "\" solimp=\"0.9999 0.9999 0.001\"";
  return text.str();
}

std::string model_of(const league::Problem& problem) {
  const auto &p = problem.position, &inertia = problem.inertia;
  const auto& q = problem.attitude;
  const bool friction = problem.friction > 0;
  std::ostringstream text;
  text.precision(17);
  std::ostringstream surface;
  surface.precision(17);
  surface << " condim=\"" << (friction ? 3 : 1) << "\" friction=\"" << (friction ? problem.friction : 1e-5) << " 0 0\"";
  text << "<mujoco><option timestep=\"" << problem.step << "\" gravity=\"0 0 " << -problem.gravity << '"'
       << (problem.tuned() ? " integrator=\"RK4\" tolerance=\"1e-12\" iterations=\"200\" cone=\"elliptic\"" : "")
       << "/><worldbody><geom type=\"plane\" size=\"100 100 1\" priority=\"1\"" << surface.str()
       << contact_settings(problem) << "/><body pos=\"" << p[0] << ' ' << p[1] << ' ' << p[2] << "\" quat=\"" << q[0]
       << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << "\"><freejoint/><inertial pos=\"0 0 0\" mass=\"" << problem.mass
       << "\" diaginertia=\"" << inertia[0] << ' ' << inertia[1] << ' ' << inertia[2] << "\"/><geom" << surface.str();
  if (problem.rod()) {
    text << " type=\"capsule\" fromto=\"" << -problem.length / 2 << " 0 0 " << problem.length / 2 << " 0 0\" size=\""
         << problem.radius << "\"/>";
  } else {
    text << " type=\"box\" size=\"" << problem.length / 2 << ' ' << problem.width / 2 << ' ' << problem.height / 2
         << "\"/>";
  }
  text << "</body></worldbody></mujoco>";
  return text.str();
}

mjModel* compile(const std::string& text) {
  auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "model.xml", static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  char error[500] = "";
  mjModel* model = mj_loadXML("model.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(error);
  return model;
}

void simulate(const league::Problem& problem, league::Trajectory& trajectory) {
  mjModel* model = compile(model_of(problem));
  mjData* data = mj_makeData(model);
  std::copy(problem.velocity.begin(), problem.velocity.end(), data->qvel);
  // A free joint turns with angular velocities in the body's axes.
  mjtNum to_body[4];
  mju_negQuat(to_body, problem.attitude.data());
  mju_rotVecQuat(data->qvel + 3, problem.angular_velocity.data(), to_body);
  trajectory.record([&] { mj_step(model, data); },
                    [&] {
                      const mjtNum *q = data->qpos, *v = data->qvel;
                      mjtNum spin[3];
                      mju_rotVecQuat(spin, v + 3, q + 3);
                      trajectory.add_spatial({q[0], q[1], q[2]}, {q[3], q[4], q[5], q[6]}, {v[0], v[1], v[2]},
                                             {spin[0], spin[1], spin[2]});
                    });
  mj_deleteData(data);
  mj_deleteModel(model);
}

}  // namespace

int main() { return league::run_all({"MuJoCo 2", mj_versionString(), "newton routh"}, simulate); }
