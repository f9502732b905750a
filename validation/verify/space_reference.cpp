#include "validation/verify/space_reference.hpp"

#include <limits>
#include <map>

#include "analytic/space/shapes.hpp"
#include "validation/output/number.hpp"
#include "validation/verify/reference.hpp"

namespace clatter::validation {
namespace {

using analytic::FrictionKind;
using analytic::RestitutionLaw;
using analytic::space::Matrix3;
using analytic::space::Quaternion;
using analytic::space::Vector3;

/// The cells of a row by the names of their columns.
class Cells {
 public:
  explicit Cells(const ReferenceWords& row) : row_(row) {}
  [[nodiscard]] const std::string& text(const std::string& name) const { return row_.at(name); }
  [[nodiscard]] double number(const std::string& name) const {
    double value = std::numeric_limits<double>::quiet_NaN();
    static_cast<void>(read_number(row_.at(name), value));
    return value;
  }
  [[nodiscard]] Vector3 vector(const std::string& name) const {
    return {number(name + "x"), number(name + "y"), number(name + "z")};
  }
  [[nodiscard]] Quaternion attitude() const { return {number("q0"), number("q1"), number("q2"), number("q3")}; }

 private:
  const ReferenceWords& row_;
};

Matrix3 inertia_of(const Cells& row) {
  const double xy = row.number("Ixy"), xz = row.number("Ixz"), yz = row.number("Iyz");
  Matrix3 inertia;
  inertia << row.number("Ixx"), xy, xz, xy, row.number("Iyy"), yz, xz, yz, row.number("Izz");
  return inertia;
}

RestitutionLaw law_named(const std::string& name) {
  return std::map<std::string, RestitutionLaw>{
      {"newton", RestitutionLaw::newton}, {"poisson", RestitutionLaw::poisson}, {"stronge", RestitutionLaw::stronge}}
      .at(name);
}

SpaceReference scene_of(const Cells& row) {
  SpaceReference scene{.name = row.text("scene"), .drop = {}, .tolerance = row.number("tolerance"), .impacts = {}};
  analytic::space::Drop& drop = scene.drop;
  drop.body = analytic::space::box(row.number("mass"), {.size = row.vector("L"), .centre = row.vector("c")});
  drop.body.inertia = inertia_of(row);
  drop.attitude = row.attitude();
  drop.velocity = row.vector("V");
  drop.angular_velocity = row.vector("O");
  drop.gravity = row.number("gravity");
  const double friction = row.number("friction");
  drop.law.law = {.restitution = row.number("restitution"),
                  .law = law_named(row.text("law")),
                  .friction = friction > 0 ? FrictionKind::coulomb : FrictionKind::none,
                  .friction_value = friction};
  return scene;
}

std::vector<SpaceReference> read() {
  std::vector<SpaceReference> scenes;
  for (const ReferenceWords& row : reference_words("space_scenes.csv")) scenes.push_back(scene_of(Cells(row)));
  for (const ReferenceWords& words : reference_words("space_sequences.csv")) {
    const Cells row(words);
    for (SpaceReference& scene : scenes) {
      if (scene.name != row.text("scene")) continue;
      scene.impacts.push_back({.time = row.number("time"),
                               .corner = static_cast<int>(row.number("corner")),
                               .attitude = row.attitude(),
                               .impulse = row.vector("P"),
                               .velocity = row.vector("V"),
                               .angular_velocity = row.vector("O")});
    }
  }
  return scenes;
}

}  // namespace

const std::vector<SpaceReference>& space_references() {
  static const std::vector<SpaceReference> scenes = read();
  return scenes;
}

}  // namespace clatter::validation
