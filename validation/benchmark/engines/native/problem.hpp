// SPDX-License-Identifier: GPL-3.0-or-later
// What every native adapter shares: a run as flat numbers, the trajectory it returns, and the loop around both.
//
// An adapter reads runs from standard input, one a line, as `key=value` pairs in SI units:
//   problem=ID shape=rod|box length= width= height= radius= mass= inertia=Ixx,Iyy,Izz restitution= friction= gravity=
//   position=x,y,z attitude=q0,q1,q2,q3 velocity=x,y,z angular_velocity=x,y,z (world) space=0|1
//   start=t of the first row, duration=, step=, settings=default|tuned, output=FILE
// x points to the right, y into the page, z up; the floor is z = 0.  The body's long axis is its x axis.
// For each run it writes the trajectory to FILE and one line to standard output:
//   done FILE SECONDS      wall time of the steps alone
//   cannot FILE REASON     the engine has no means to express the problem
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace league {

using Vector3 = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  // scalar first, body to world

/// The engine has no means to express a problem; the text says which is missing.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Problem {
  std::string id, shape, settings, output;
  double length = 0, width = 0, height = 0;  // extents of the body along its x, y and z axis [m]
  double radius = 0;                         // of the spheres that stand for a thin rod's ends [m]
  double mass = 0;
  Vector3 inertia{};  // principal, about the centre of mass [kg m^2]
  double restitution = 0, friction = 0, gravity = 0;
  Vector3 position{};  // of the centre of mass, with the spheres' radius already added to z
  Quaternion attitude{};
  Vector3 velocity{}, angular_velocity{};
  bool space = false;
  double start = 0, duration = 0, step = 0;

  bool tuned() const { return settings == "tuned"; }
  bool rod() const { return shape == "rod"; }
  int steps() const { return static_cast<int>(std::ceil(duration / step - 1e-9)); }
  /// Counter-clockwise angle of the body's x axis on the page [rad]; y points into the page.
  double phi() const { return -2 * std::atan2(attitude[2], attitude[0]); }
  double omega() const { return -angular_velocity[1]; }
  double planar_inertia() const { return inertia[1]; }
  void require_plane(const char* reason = "an engine of the plane") const {
    if (space) throw Unsupported(reason);
  }
};

/// Where the body can touch the floor, in its own axes: the rod's ends or the box's corners, those of its middle plane
/// if the problem is one of the plane.
inline std::vector<Vector3> contact_points(const Problem& problem) {
  const double x = problem.length / 2, y = problem.width / 2, z = problem.height / 2;
  if (problem.rod()) return {{-x, 0, 0}, {x, 0, 0}};
  if (!problem.space) return {{-x, 0, -z}, {x, 0, -z}, {-x, 0, z}, {x, 0, z}};
  return {{-x, -y, -z}, {x, -y, -z}, {-x, y, -z}, {x, y, -z}, {-x, -y, z}, {x, -y, z}, {-x, y, z}, {x, y, z}};
}

struct Engine {
  std::string name, version;
  std::string law = "newton moreau";
};

/// Rows of one run.
class Trajectory {
 public:
  explicit Trajectory(const Problem& problem) : problem_(problem) {}

  void add_planar(double x, double z, double phi, double vx, double vz, double omega) {
    const double turn = 2 * M_PI;
    if (!rows_.empty()) phi += turn * std::round((rows_.back()[3] - phi) / turn);
    rows_.push_back({time(), x, z - problem_.radius, phi, vx, vz, omega});
  }

  /// Angular velocity in the world frame.  For a problem of the plane the row keeps what lies in the plane.
  void add_spatial(const Vector3& position, const Quaternion& q, const Vector3& velocity, const Vector3& spin) {
    if (!problem_.space) {
      const double across = 2 * (q[1] * q[3] - q[0] * q[2]), along = 1 - 2 * (q[2] * q[2] + q[3] * q[3]);
      add_planar(position[0], position[2], std::atan2(across, along), velocity[0], velocity[2], -spin[1]);
      return;
    }
    rows_.push_back({time(), position[0], position[1], position[2] - problem_.radius, q[0], q[1], q[2], q[3],
                     velocity[0], velocity[1], velocity[2], spin[0], spin[1], spin[2]});
  }

  void write(const Engine& engine) const {
    std::ofstream file(problem_.output);
    file << "# engine: " << engine.name << "\n# version: " << engine.version << "\n# problem: " << problem_.id
         << "\n# step: " << exact(problem_.step) << "\n# settings: " << problem_.settings
         << "\n# law: " << (law.empty() ? engine.law : law) << '\n'
         << (problem_.space ? "t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz\n" : "t,x,z,phi,vx,vz,omega\n");
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i) file << (i ? "," : "") << exact(row[i]);
      file << '\n';
    }
    if (!file.flush()) throw std::runtime_error("cannot write " + problem_.output);
  }

  /// Rows at the start and after each step; `seconds` takes the wall time of the steps.
  template <class Step, class Sample>
  void record(Step step, Sample sample) {
    sample();
    for (int i = 0; i < problem_.steps(); ++i) {
      const auto before = std::chrono::steady_clock::now();
      step();
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
      sample();
    }
  }

  double seconds = 0;
  std::string law;  // where the settings choose another than the engine's
  /// Time of the next row; an engine that chooses its own steps sets it before it adds a row.
  double own_time = NAN;

 private:
  double time() const {
    return problem_.start + (std::isnan(own_time) ? static_cast<double>(rows_.size()) * problem_.step : own_time);
  }
  static std::string exact(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
  }

  const Problem& problem_;
  std::vector<std::vector<double>> rows_;
};

template <std::size_t n>
std::array<double, n> numbers(const std::string& text) {
  std::array<double, n> values{};
  std::istringstream in(text);
  for (std::size_t i = 0; i < n; ++i) {
    if (i && in.get() != ',') throw std::invalid_argument("'" + text + "' does not hold enough numbers");
    if (!(in >> values[i])) throw std::invalid_argument("'" + text + "' is not a number");
  }
  return values;
}

inline Problem read_problem(const std::string& line) {
  std::map<std::string, std::string> pairs;
  std::istringstream words(line);
  for (std::string word; words >> word;) pairs[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
  const auto number = [&](const char* key) { return numbers<1>(pairs.at(key))[0]; };
  Problem problem;
  problem.id = pairs.at("problem");
  problem.shape = pairs.at("shape");
  problem.settings = pairs.at("settings");
  problem.output = pairs.at("output");
  problem.length = number("length");
  problem.width = number("width");
  problem.height = number("height");
  problem.radius = number("radius");
  problem.mass = number("mass");
  problem.inertia = numbers<3>(pairs.at("inertia"));
  problem.restitution = number("restitution");
  problem.friction = number("friction");
  problem.gravity = number("gravity");
  problem.position = numbers<3>(pairs.at("position"));
  problem.attitude = numbers<4>(pairs.at("attitude"));
  problem.velocity = numbers<3>(pairs.at("velocity"));
  problem.angular_velocity = numbers<3>(pairs.at("angular_velocity"));
  problem.space = number("space") != 0;
  problem.start = number("start");
  problem.duration = number("duration");
  problem.step = number("step");
  return problem;
}

/// Reads the runs, hands each to `simulate(problem, trajectory)` and reports.  Exit status 2: a line that cannot be
/// read.
template <class Simulate>
int run_all(const Engine& engine, Simulate simulate) {
  for (std::string line; std::getline(std::cin, line);) {
    try {
      const Problem problem = read_problem(line);
      try {
        Trajectory trajectory(problem);
        simulate(problem, trajectory);
        trajectory.write(engine);
        std::cout << "done " << problem.output << ' ' << trajectory.seconds << std::endl;
      } catch (const Unsupported& reason) {
        std::cout << "cannot " << problem.output << ' ' << reason.what() << std::endl;
      }
    } catch (const std::exception& error) {
      std::cerr << engine.name << ": " << error.what() << ": " << line << '\n';
      return 2;
    }
  }
  return 0;
}

}  // namespace league
