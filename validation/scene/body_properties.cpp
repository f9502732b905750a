// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/body_properties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <optional>
#include <tuple>

#include "analytic/space/flight/body.hpp"
#include "numeric/files/import.hpp"
#include "numeric/mesh/generators.hpp"
#include "validation/embedded/embedded.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/scene/assumed_inertia.hpp"
#include "validation/scene/hull.hpp"
#include "validation/scene/keys.hpp"

namespace clatter::validation {
namespace {

using numeric::MassProperties;
using numeric::Matrix3;
using numeric::Vector3;

constexpr double typed_rounding = 1e-9;  // of numbers that a user typed

/// The six numbers xx, yy, zz, xy, xz, yz, or three principal ones.
Matrix3 symmetric(const std::vector<double>& i) {
  Matrix3 matrix = Vector3(i[0], i[1], i[2]).asDiagonal();
  if (i.size() == 6) {
    matrix(0, 1) = matrix(1, 0) = i[3];
    matrix(0, 2) = matrix(2, 0) = i[4];
    matrix(1, 2) = matrix(2, 1) = i[5];
  }
  return matrix;
}

/// Eigenvalues, ascending; scaled, since their products may overflow where they do not.
Vector3 principal(const Matrix3& matrix) {
  const double size = matrix.cwiseAbs().maxCoeff();
  if (!(size > 0) || !std::isfinite(size)) return Vector3::Constant(size);
  const Matrix3 scaled = matrix / size;
  if (scaled.isDiagonal(0)) {  // the moments are its entries, for which no model in space has to be there
    Vector3 moments = scaled.diagonal();
    std::sort(moments.begin(), moments.end());
    return size * moments;
  }
  const auto [least, middle, largest] = analytic::space::PrincipalAxes(scaled).moments;
  return size * Vector3(static_cast<double>(least), static_cast<double>(middle), static_cast<double>(largest));
}

/// Six digits, without zeros at the end; "?" where the number is not representable.
std::string short_text(double value) {
  double rounded = 0;
  if (!std::isfinite(value) || !read_number(significant(value, 6), rounded)) return "?";
  return shortest(rounded);
}

/// What a body's inertia and centre must fit in.
struct Bounds {
  double reach = 0;         ///< largest distance of the hull from the centre of mass [m]
  bool is_outside = false;  ///< the centre lies outside the hull
  bool is_thin = false;     ///< the hull is a line: the moment about it may be 0
};

[[noreturn]] void refuse(const Scene& scene, const char* name, const std::string& allowed) {
  const Key& key = key_named(name);
  const std::string place = scene.path.empty() ? std::string(key.flag) : scene.path + ": " + name;
  throw BadInput("{} = {}: must be {}", place, compact_json(key.get(scene)), allowed);
}

/// @param k2 inertia over mass about the centre of mass, which does not overflow where m R² does
void check(const Scene& scene, double mass, const Matrix3& k2, const Bounds& bounds) {
  const BodyScene& body = scene.body;
  if (!body.centre.empty() && bounds.is_outside) refuse(scene, "body.centre", "within the hull of the body");
  if (body.centre.empty() && body.inertia.empty()) return;  // uniform bodies are
  const Vector3 moments = principal(k2);
  const auto of_mass = [&](double value) { return short_text(mass * value); };
  const std::string three =
      fmt::format("{}, {} and {} kg m2", of_mass(moments[0]), of_mass(moments[1]), of_mass(moments[2]));
  const bool is_given = !body.inertia.empty();
  const bool positive = moments[0] > 0 || (bounds.is_thin && moments[0] >= 0 && moments[1] > 0);
  if (is_given && !positive) refuse(scene, "body.inertia", "positive definite; its principal moments are " + three);
  if (is_given && !(moments[2] <= (moments[0] + moments[1]) * (1 + typed_rounding))) {
    refuse(scene, "body.inertia",
           "a body's, with no principal moment larger than the sum of the other two; they are " + three);
  }
  const double largest = bounds.reach * bounds.reach;
  if (moments[2] <= largest * (1 + typed_rounding)) return;
  refuse(scene, is_given ? "body.inertia" : "body.centre",
         fmt::format("a body's, with no principal moment larger than m R2 = {} kg m2, R = {} m from the centre of mass "
                     "to the furthest point of the hull; they are {}",
                     of_mass(largest), short_text(bounds.reach), three));
}

Bounds bounds_of(const Vector3& centre, const numeric::Surface& surface) {
  Bounds bounds{.is_outside = is_outside_hull(centre, surface.nodes)};
  for (const Vector3& node : surface.nodes) bounds.reach = std::max(bounds.reach, (node - centre).stableNorm());
  return bounds;
}

MassProperties surface_properties(const BodyScene& body, const numeric::Surface& surface) {
  MassProperties properties{.mass = body.mass};
  if (!body.density && !body.centre.empty() && !body.inertia.empty()) return properties;  // nothing of it is needed
  properties = mass_properties(surface, body.density.value_or(1));
  if (!body.density) {
    properties.inertia *= body.mass / properties.mass;
    properties.mass = body.mass;
  }
  return properties;
}

/// With a mass instead of a density the mesh's own is scaled.
numeric::Mesh gmsh_mesh(const BodyScene& body, double unit) {
  numeric::Mesh mesh = numeric::read_gmsh(body.file, body.density.value_or(1), unit);
  if (!body.density) {
    const double factor = body.mass / numeric::mass_properties(mesh).mass;
    for (numeric::Element& element : mesh.elements) element.density *= factor;
  }
  return mesh;
}

/// The mesh of a case that comes with the program, where it is not on the disk.
const EmbeddedFile* carried_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error)) return nullptr;
  const std::vector<EmbeddedFile>& all = embedded_files();
  const auto found = std::find_if(all.begin(), all.end(), [&](const EmbeddedFile& file) { return file.name == path; });
  return found == all.end() ? nullptr : &*found;
}

SolidBody read_solid(const BodyScene& body) {
  if (body.is_surface()) {
    const numeric::SurfaceFileOptions options{
        .unit = body.has_unit ? body.unit : 0, .weld = body.weld, .strict = body.strict};
    const EmbeddedFile* const carried = carried_file(body.file);
    numeric::SurfaceFile file =
        carried ? numeric::parse_surface(body.file, carried->text, options) : numeric::read_surface(body.file, options);
    const MassProperties properties = surface_properties(body, file.surface);
    return {properties, std::move(file.surface), {}, file.repairs, file.unit};
  }
  // OpenCASCADE hands over millimetres, whatever the file's unit.
  const double unit = numeric::is_cad_file(body.file) && !body.has_unit ? 0.001 : body.unit;
  const numeric::Mesh mesh = gmsh_mesh(body, unit);
  return {numeric::mass_properties(mesh), numeric::boundary_surface(mesh), {}, {}, unit};
}

/// Properties of a sphere, an ellipsoid or a capsule.
numeric::SmoothShape round_shape(const BodyScene& body) {
  return {.semiaxes = body.has_size() ? Vector3(body.size / 2) : Vector3(Vector3::Constant(body.radius)),
          .straight = body.has_length() ? body.length - 2 * body.radius : 0};
}

numeric::Mesh own_mesh(const BodyScene& body) {
  if (body.shape == BodyScene::Shape::box)
    return numeric::box_mesh({.size = body.size, .mass = body.mass, .nx = body.nx, .ny = body.ny, .nz = body.nz});
  if (body.is_round()) {
    const numeric::SmoothShape shape = round_shape(body);
    return numeric::round_mesh({.semiaxes = shape.semiaxes,
                                .straight = shape.straight,
                                .mass = body.mass,
                                .sectors = body.meshed_sectors(),
                                .rings = body.meshed_rings()});
  }
  return numeric::rod_mesh({.length = body.length,
                            .radius = body.meshed_radius(),
                            .mass = body.mass,
                            .sectors = body.meshed_sectors(),
                            .rings = body.meshed_rings(),
                            .layers = body.layers});
}

/// Sums that cancel leave no number to be shown.
template <class Numbers>
Numbers without_rounding(const Numbers& numbers, double size) {
  return (numbers.array().abs() <= 1e-14 * size).select(0, numbers);
}

BodyProperties of_solid(const SolidBody& solid) {
  Vector3 low = solid.surface.nodes[0], high = low;
  for (const Vector3& node : solid.surface.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  const MassProperties& p = solid.properties;
  const Matrix3 k2 = p.inertia / p.mass;
  return {p.mass, high - low, without_rounding(p.centre, (high - low).maxCoeff()),
          without_rounding(k2, k2.cwiseAbs().maxCoeff())};
}

/// The bounds of a centre in an ellipsoid, or in the capsule of its spheres.
Bounds round_bounds(const analytic::space::Body& body, const Vector3& centre) {
  Bounds bounds;
  for (const auto& [middle, semiaxes] : body.ellipsoids)
    bounds.reach = std::fmax(bounds.reach, (middle - centre).norm() + semiaxes.maxCoeff());
  const auto& [end, semiaxes] = body.ellipsoids.back();
  Vector3 off = centre;
  off.x() -= std::clamp(centre.x(), -end.x(), end.x());
  bounds.is_outside = !(off.cwiseQuotient(semiaxes).norm() <= 1 + typed_rounding);
  return bounds;
}

/// The properties of a rod of this radius or of another shape by its sizes.
BodyProperties shape_properties(const Scene& scene, double radius) {
  const BodyScene& body = scene.body;
  const bool is_rod = body.shape == BodyScene::Shape::rod;
  BodyProperties properties{.mass = body.mass};
  properties.extents = body.extents(radius);
  const Vector3 s = properties.extents.cwiseProduct(properties.extents) / (is_rod ? 16 : 12);
  const double along = is_rod ? body.length * body.length / 12 : s.x();
  properties.gyration_square = Vector3(s.y() + s.z(), s.z() + along, along + s.y()).asDiagonal();
  if (body.is_round()) properties.gyration_square = round_body(body).inertia / body.mass;
  if (!body.centre.empty()) properties.centre = vector_of(body.centre);
  if (!body.inertia.empty()) properties.gyration_square = symmetric(body.inertia) / body.mass;
  const Vector3 half = properties.extents / 2, off = properties.centre.cwiseAbs();
  Bounds bounds{.is_thin = is_rod && radius == 0};
  if (body.is_round()) {
    bounds = round_bounds(round_body(body), properties.centre);
  } else if (is_rod) {
    const double across = std::hypot(off.y(), off.z());
    bounds.reach = std::hypot(half.x() + off.x(), radius + across);
    bounds.is_outside = std::max(off.x() - half.x(), across - radius) > typed_rounding * bounds.reach;
  } else {
    bounds.reach = (half + off).stableNorm();
    bounds.is_outside = (off - half).maxCoeff() > typed_rounding * bounds.reach;
  }
  check(scene, properties.mass, properties.gyration_square, bounds);
  return properties;
}

/// The body of a file, with centre and inertia that the scene gives.
SolidBody settled_solid(const Scene& scene) {
  const BodyScene& body = scene.body;
  SolidBody solid = read_solid(body);
  MassProperties& properties = solid.properties;
  if (!body.centre.empty()) properties.centre = solid.unit * vector_of(body.centre);
  if (!body.inertia.empty()) properties.inertia = symmetric(body.inertia);
  check(scene, properties.mass, properties.inertia / properties.mass, bounds_of(properties.centre, solid.surface));
  return solid;
}

}  // namespace

/// Keeps the mesh that it has read, and reads again only where something has changed that its body depends on.
class MeshFile {
 public:
  [[nodiscard]] std::shared_ptr<const SolidBody> read(const Scene& scene) {
    const std::scoped_lock lock(mutex_);
    const BodyScene& body = scene.body;
    const Key key{
        body.file,   body.has_unit ? body.unit : 0, body.weld, body.strict, body.density, body.mass, body.centre,
        body.inertia};
    if (key_ != key) solid_ = std::make_shared<const SolidBody>(settled_solid(scene));
    key_ = key;
    return solid_;
  }

 private:
  using Key = std::tuple<std::string, double, double, bool, std::optional<double>, double, std::vector<double>,
                         std::vector<double>>;
  std::mutex mutex_;
  std::optional<Key> key_;
  std::shared_ptr<const SolidBody> solid_;
};

namespace {

std::shared_ptr<const SolidBody> solid_of_file(const Scene& scene) {
  return scene.body.mesh_file ? scene.body.mesh_file->read(scene)
                              : std::make_shared<const SolidBody>(settled_solid(scene));
}

/// Bounds of what is left open of a body by its file.
struct FileErrors {
  double volume = 0, inertia = 0;  ///< [m³]; of each moment [kg·m²]
};

FileErrors file_errors(const Scene& scene, const SolidBody& solid) {
  const numeric::Repairs& repairs = *solid.repairs;
  FileErrors errors{.volume = repairs.volume_error};
  if (!scene.body.inertia.empty()) return errors;
  const MassProperties& p = solid.properties;
  const double density = p.mass / repairs.volume;
  errors.inertia = density * repairs.moment_error;
  if (!scene.body.density) errors.inertia += p.inertia.diagonal().maxCoeff() * repairs.volume_error / repairs.volume;
  return errors;
}

}  // namespace

analytic::space::Body round_body(const BodyScene& body) {
  if (body.shape == BodyScene::Shape::capsule)
    return analytic::space::capsule(body.mass, {.length = body.length, .radius = body.radius});
  return analytic::space::ellipsoid(body.mass, body.extents(body.radius) / 2);
}

std::shared_ptr<MeshFile> unread_mesh() { return std::make_shared<MeshFile>(); }

Vector3 BodyProperties::principal_inertia() const { return mass * principal(gyration_square); }

SolidBody solid_body(const Scene& scene) {
  const BodyScene& body = scene.body;
  if (!body.is_polyhedron()) {
    const BodyProperties given = shape_properties(scene, body.meshed_radius());
    return {{.mass = given.mass, .centre = given.centre, .inertia = given.mass * given.gyration_square},
            numeric::boundary_surface(own_mesh(body)),
            body.is_smooth() ? std::optional(round_shape(body)) : std::nullopt,
            {}};
  }
  return *solid_of_file(scene);
}

BodyProperties body_properties(const Scene& scene, Model model) {
  if (scene.body.is_polyhedron()) return of_solid(*solid_of_file(scene));
  return shape_properties(scene, model == Model::discrete ? scene.body.radius : scene.body.meshed_radius());
}

namespace {

Value mesh_value(const SolidBody& solid, const Scene& scene) {
  const numeric::Repairs& r = *solid.repairs;
  const FileErrors errors = file_errors(scene, solid);
  return Value::Fields{{"unit", solid.unit},
                       {"triangles", static_cast<long long>(solid.surface.elements.size())},
                       {"corners_joined", r.joined},
                       {"flat_left_out", r.flat},
                       {"doubled_left_out", r.doubled},
                       {"turned_outward", r.turned},
                       {"touching_edges", r.touching},
                       {"parts", r.parts},
                       {"cavities", r.cavities},
                       {"nested_left_out", r.nested},
                       {"overlapping", r.overlapping},
                       {"volume", r.volume},
                       {"volume_error", errors.volume},
                       {"inertia_error", errors.inertia}};
}

}  // namespace

std::string mesh_words(const Scene& scene) {
  if (!scene.body.is_polyhedron() || !scene.body.is_surface()) return "";
  const std::shared_ptr<const SolidBody> solid = solid_of_file(scene);
  const numeric::Repairs& r = *solid->repairs;
  const FileErrors errors = file_errors(scene, *solid);
  std::string pieces;
  if (r.parts > 1) pieces += fmt::format(", {} parts", r.parts);
  if (r.cavities > 0) pieces += fmt::format(", {} {}", r.cavities, r.cavities == 1 ? "cavity" : "cavities");
  const std::string inertia = errors.inertia > 0 ? fmt::format(", inertia ± {} kg·m²", rounded_up(errors.inertia)) : "";
  return fmt::format("mesh: {} triangles{}, {}; volume {} m³ ± {}{}", solid->surface.elements.size(), pieces, r.words(),
                     short_text(r.volume), rounded_up(errors.volume), inertia);
}

Value body_value(const Scene& scene, Model model) {
  const BodyProperties body = body_properties(scene, model);
  const Matrix3 i = body.mass * body.gyration_square;
  Value value = Value::Fields{{"mass", body.mass},
                              {"extents", body.extents},
                              {"centre", body.centre},
                              {"principal_inertia", body.principal_inertia()},
                              {"inertia", std::vector<double>{i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)}}};
  if (scene.body.is_polyhedron() && scene.body.is_surface()) value["mesh"] = mesh_value(*solid_of_file(scene), scene);
  return value;
}

std::string body_words(const Scene& scene, Model model) {
  const BodyProperties body = body_properties(scene, model);
  const auto three = [&](const Vector3& v, const char* between) {
    return fmt::format("{1}{0}{2}{0}{3}", between, short_text(v.x()), short_text(v.y()), short_text(v.z()));
  };
  const std::string uniform = uniform_inertia_words(scene);
  return fmt::format("body: mass {} kg, extents {} m, centre of mass ({}) m, principal inertia {} kg·m²{}",
                     short_text(body.mass), three(body.extents, " × "), three(body.centre, ", "),
                     three(body.principal_inertia(), ", "), uniform.empty() ? "" : ": " + uniform);
}

std::string unit_doubts(const Scene& scene, const BodyProperties& body) {
  constexpr double least = 1e-5, largest = 20, heaviest = 1000, densest = 2.5e5;  // [m], [kg], [kg/m³]
  const double volume = body.extents.prod();  // of the box about the body, which it does not exceed
  const bool is_large = body.extents.maxCoeff() > largest, is_dense = volume > 0 && body.mass > densest * volume;
  if (scene.body.is_polyhedron() && (is_large || body.extents.maxCoeff() < least)) {
    return fmt::format("!: warning: a mesh of {} m across: {}", significant(body.extents.maxCoeff(), 3),
                       is_large ? "millimetres? say unit = \"mm\" (--unit mm)"
                                : "say the unit of its coordinates (--unit mm|cm|m|in)");
  }
  if (!is_large && !is_dense && !(body.mass > heaviest)) return "";
  const std::string words = is_large ? fmt::format("{} m across", significant(body.extents.maxCoeff(), 3))
                            : is_dense
                                ? fmt::format("{} kg in {} m³", significant(body.mass, 3), significant(volume, 3))
                                : fmt::format("{} kg", significant(body.mass, 3));
  return fmt::format("!: warning: a body of {}: lengths are in m and masses in kg; were mm or g meant?", words);
}

}  // namespace clatter::validation
