// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/files/import.hpp"

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "numeric/body/mass_properties.hpp"
#include "tests/numeric/support.hpp"

/// Gmsh's library loses memory when it refuses a file; AddressSanitizer asks this function.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgmsh\n"; }

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

constexpr double rounding = 100 * eps;

class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& contents)
      : path_(std::filesystem::temp_directory_path() / ("clatter_" + std::to_string(getpid()) + "_" + name)) {
    std::ofstream(path_, std::ios::binary) << contents;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// The box 1 × 2 × 3 with a corner at the origin.
std::vector<Triangle> box_triangles() { return box_of_triangles(Vector3::Zero(), {1, 2, 3}); }

/// Two lines of head, then seven for each triangle.
std::string text_stl(const std::vector<Triangle>& triangles) {
  std::ostringstream text;
  text << "solid a box of 1 x 2 x 3\n\n";
  for (const Triangle& triangle : triangles) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (const Vector3& v : triangle) text << "      vertex " << v.x() << ' ' << v.y() << " +" << v.z() << "e0\n";
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid a box of 1 x 2 x 3\n";
  return text.str();
}

std::string little_endian(std::uint32_t word) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> 8 * i & 0xff);
  return bytes;
}

std::string binary_stl(const std::vector<Triangle>& triangles, std::string header = "made by a test") {
  header.resize(80);
  std::string file = header + little_endian(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    file += std::string(12, '\0');
    for (const Vector3& v : triangle)
      for (const double x : v) file += little_endian(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
    file += "\1\2";
  }
  return file;
}

void check_box(const std::string& contents) {
  const TemporaryFile file("box.stl", contents);
  const Surface surface = read_stl(file.path());
  BOOST_TEST(surface.nodes.size() == 8u);
  BOOST_TEST(surface.elements.size() == 12u);
  for (int i = 0; i < 12; ++i) BOOST_TEST(surface.elements[i].element == i);
  BOOST_TEST(std::fabs(enclosed(surface) - 6) <= rounding * 6);
  const Surface millimetres = read_stl(file.path(), 0.001);
  BOOST_TEST(std::fabs(enclosed(millimetres) - 6e-9) <= rounding * 6e-9);
}

void check_refused(const std::string& contents, const std::string& where, const std::string& what) {
  const TemporaryFile file("bad.stl", contents);
  CHECK_REFUSED_SAYING(read_stl(file.path()), MeshError, file.path() + where);
  CHECK_REFUSED_SAYING(read_stl(file.path()), MeshError, what);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  BOOST_REQUIRE(at != text.npos);
  return text.replace(at, what.size(), by);
}

/// A block with a wedge and a tetrahedron on it: volumes 1, 1/2 and 1/6.
std::string mixed_msh(const std::string& name = "heavy density=7") {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n2\n3 1 \"plain\"\n3 2 \"" +
         name +
         "\"\n$EndPhysicalNames\n"
         "$Nodes\n12\n"
         "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n"
         "10 0 0 2\n11 1 0 2\n12 0 0 3\n20 9 9 9\n$EndNodes\n"
         "$Elements\n4\n"
         "3 5 2 1 1 1 2 3 4 5 6 7 8\n"
         "7 6 2 1 1 5 8 10 6 7 11\n"
         "5 4 2 2 2 10 11 8 12\n"
         "1 2 2 9 9 1 2 3\n"
         "$EndElements\n";
}

void check_gmsh_refused(const std::string& name, const std::string& contents, const std::string& what) {
  const TemporaryFile file(name, contents);
  CHECK_REFUSED_SAYING(read_gmsh(file.path(), 1), MeshError, file.path());
  CHECK_REFUSED_SAYING(read_gmsh(file.path(), 1), MeshError, what);
}

/// What a call writes to standard output and standard error.
template <typename Call>
std::string printed_by(Call call) {
  const TemporaryFile file("printed.txt", "");
  std::fflush(nullptr);
  const int out = dup(1), err = dup(2);
  BOOST_REQUIRE(std::freopen(file.path().c_str(), "w", stdout) != nullptr);
  dup2(1, 2);
  call();
  std::fflush(nullptr);
  dup2(out, 1);
  dup2(err, 2);
  close(out);
  close(err);
  std::ostringstream text;
  text << std::ifstream(file.path()).rdbuf();
  return text.str();
}

boost::test_tools::assertion_result with_gmsh(boost::unit_test::test_unit_id) { return has_gmsh(); }

}  // namespace

BOOST_AUTO_TEST_CASE(text_of_any_form_and_binary_files_give_the_same_box) {
  const std::vector<Triangle> all = box_triangles();
  const std::string text = text_stl(all);
  std::string capitals, carriage_returns;
  for (const char c : text) {
    capitals += static_cast<char>(std::toupper(c));
    carriage_returns += c == '\n' ? "\r\n" : std::string(1, c);
  }
  const std::string patches = text_stl({all.begin(), all.begin() + 5}) + text_stl({all.begin() + 5, all.end()});
  for (const std::string& file : {text, binary_stl(all), binary_stl(all, "solid but binary"), capitals,
                                  carriage_returns, patches, replaced(text, "vertex 0 0", "vertex -0 -0.0")}) {
    check_box(file);
  }
}

BOOST_AUTO_TEST_CASE(a_truncated_file_is_refused) {
  const std::string text = text_stl(box_triangles()), binary = binary_stl(box_triangles());
  check_refused(text.substr(0, text.size() / 2), ":", "expected");
  check_refused(text.substr(0, text.find("endsolid")), ":87: ", "the end of the file");
  check_refused(binary.substr(0, binary.size() - 1), ": truncated", "12 triangles take 684 bytes");
  check_refused(binary.substr(0, 83), ": truncated", "header");
  check_refused(binary_stl(box_triangles(), "solid").substr(0, 600), ": truncated", "12 triangles");
  check_refused("", ": ", "empty");
  std::string lies = binary_stl(box_triangles());
  lies.replace(80, 4, little_endian(1'000'000'000));
  check_refused(lies, ": truncated", "1000000000 triangles take 50000000084 bytes");
}

BOOST_AUTO_TEST_CASE(trailing_data_is_refused_where_nothing_may_be_repaired_or_a_triangle_is_there) {
  const std::string binary = binary_stl(box_triangles()), text = text_stl(box_triangles());
  check_refused(binary + "x", ": trailing data", "1 bytes");
  check_refused(binary + std::string(50, 'x'), ": trailing data", "684 bytes, the file has 734");
  check_refused(text + "more\n", ":88: ", "found more");
  for (const std::string& file : {binary + "x", text + std::string(1, '\0'), "\xEF\xBB\xBF" + text}) {
    const TemporaryFile stored("box.stl", file);
    BOOST_TEST(std::fabs(enclosed(read_surface(stored.path()).surface) - 6) <= rounding * 6);
  }
}

BOOST_AUTO_TEST_CASE(wrong_words_and_numbers_are_refused_by_line) {
  const std::string text = text_stl(box_triangles());
  check_refused(replaced(text, "outer loop", "inner loop"), ":4: ", "expected outer, found inner");
  check_refused(replaced(text, "vertex 0 2", "vertex zero 2"), ":6: ", "expected a number, found zero");
  check_refused(replaced(text, "vertex 0 2", "vertex 1e999 2"), ":6: ", "range");
  check_refused(replaced(text, "vertex 0 2", "vertex nan 2"), ":6: ", "not finite");
  check_refused(replaced(text, "facet normal 0 0 0", "facet normal 0 0"), ":4: ", "expected a number");
}

BOOST_AUTO_TEST_CASE(bad_triangles_are_refused_by_number) {
  auto triangles = box_triangles();
  triangles[7][1] = triangles[7][0];
  check_refused(text_stl(triangles), ": triangle 7", "same point");
  check_refused(binary_stl(triangles), ": triangle 7", "same point");
  triangles[7][1] = (triangles[7][0] + triangles[7][2]) / 2;
  check_refused(binary_stl(triangles), ": triangle 7", "no area");
  triangles[7][1].y() = std::numeric_limits<double>::infinity();
  check_refused(binary_stl(triangles), ": triangle 7", "not finite");
}

BOOST_AUTO_TEST_CASE(open_inward_and_inconsistent_surfaces_are_refused) {
  auto triangles = box_triangles();
  triangles.pop_back();
  check_refused(binary_stl(triangles), ": triangle", "open");
  triangles = box_triangles();
  for (Triangle& triangle : triangles) std::swap(triangle[0], triangle[1]);
  check_refused(binary_stl(triangles), ": triangle", "inward");
  triangles = box_triangles();
  std::swap(triangles[3][0], triangles[3][1]);
  check_refused(binary_stl(triangles), ": triangle", "same direction");
  check_refused(binary_stl({}), ": ", "no element");
}

BOOST_AUTO_TEST_CASE(files_that_cannot_be_read_and_senseless_units_are_refused) {
  CHECK_REFUSED_SAYING(read_stl("no/such.stl"), MeshError, "no/such.stl: cannot be opened");
  CHECK_REFUSED_SAYING(read_stl(std::filesystem::temp_directory_path().string()), MeshError, "is a folder");
  CHECK_REFUSED_SAYING(read_stl("/dev/null"), MeshError, "no file on a disk");
  for (const double unit : {0., -1., not_a_number, infinite})
    CHECK_REFUSED_SAYING(read_stl("box.stl", unit), std::domain_error, "unit = ");
}

BOOST_AUTO_TEST_CASE(a_build_without_gmsh_says_so) {
  if (has_gmsh()) return;
  CHECK_REFUSED_SAYING(read_gmsh("box.msh", 1), MeshError, "no Gmsh");
}

BOOST_AUTO_TEST_CASE(gmsh_files_of_mixed_elements_keep_their_order_and_densities,
                     *boost::unit_test::precondition(with_gmsh)) {
  const TemporaryFile file("mixed.msh", mixed_msh());
  const Mesh mesh = read_gmsh(file.path(), 2, 0.1);
  BOOST_REQUIRE(mesh.elements.size() == 3u);
  BOOST_TEST(mesh.nodes.size() == 11u);
  const std::pair<ElementShape, double> expected[] = {
      {ElementShape::hexahedron, 2}, {ElementShape::tetrahedron, 7}, {ElementShape::prism, 2}};
  for (int i = 0; i < 3; ++i)
    BOOST_CHECK((mesh.elements[i].shape == expected[i].first && mesh.elements[i].density == expected[i].second));
  const double mass = 1e-3 * (2 * 1. + 2 * 0.5 + 7 / 6.);
  BOOST_TEST(std::fabs(mass_properties(mesh).mass - mass) <= rounding * mass);
}

BOOST_AUTO_TEST_CASE(a_geometry_is_meshed, *boost::unit_test::precondition(with_gmsh)) {
  const TemporaryFile file("box.geo",
                           "Point(1) = {0, 0, 0, 0.5};\n"
                           "l[] = Extrude {1, 0, 0} { Point{1}; };\ns[] = Extrude {0, 2, 0} { Line{l[1]}; };\n"
                           "v[] = Extrude {0, 0, 3} { Surface{s[1]}; };\n"
                           "Physical Volume(\"box, density=1.5\") = {v[1]};\n");
  const Mesh mesh = read_gmsh(file.path(), 1);
  BOOST_TEST(mesh.elements.size() > 10u);
  const MassProperties body = mass_properties(mesh);
  BOOST_TEST(std::fabs(body.mass - 9) <= rounding * 9);
  BOOST_TEST((body.centre - Vector3(0.5, 1, 1.5)).norm() <= rounding);
  BOOST_TEST(std::fabs(enclosed(boundary_surface(mesh)) - 6) <= rounding * 6);
}

BOOST_AUTO_TEST_CASE(gmsh_prints_nothing, *boost::unit_test::precondition(with_gmsh)) {
  const TemporaryFile good("good.msh", mixed_msh()), bad("bad.msh", "$MeshFormat\n99 0 8\n");
  BOOST_TEST(printed_by([&] { static_cast<void>(read_gmsh(good.path(), 1)); }).empty());
  BOOST_TEST(printed_by([&] { BOOST_CHECK_THROW(static_cast<void>(read_gmsh(bad.path(), 1)), MeshError); }).empty());
}

BOOST_AUTO_TEST_CASE(gmsh_files_with_other_elements_are_refused_by_tag, *boost::unit_test::precondition(with_gmsh)) {
  for (const char* other : {"5 7 2 2 2 5 6 7 8 12", "5 11 2 2 2 1 2 3 4 5 6 7 8 10 11"}) {  // a pyramid, a second order
    check_gmsh_refused("other.msh", replaced(mixed_msh(), "5 4 2 2 2 10 11 8 12", other), "tag 5");
  }
}

BOOST_AUTO_TEST_CASE(gmsh_files_without_a_body_are_refused, *boost::unit_test::precondition(with_gmsh)) {
  const std::string flat =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
      "$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n";
  check_gmsh_refused("flat.msh", flat, "no solid element");
  check_gmsh_refused("empty.msh", "", "");
  check_gmsh_refused("garbage.msh", "this is not a mesh\n", "");
  check_gmsh_refused("unknown.msh", replaced(mixed_msh(), "10 11 8 12", "10 11 8 99"), "");
  check_gmsh_refused("cut.msh", mixed_msh().substr(0, 200), "");
  check_gmsh_refused("broken.geo", "Point(1) = {0, 0;\n", "Gmsh says");
  check_gmsh_refused("mesh.txt", mixed_msh(), "neither");
  CHECK_REFUSED_SAYING(read_gmsh("no/such.msh", 1), MeshError, "cannot be opened");
}

BOOST_AUTO_TEST_CASE(senseless_densities_are_refused, *boost::unit_test::precondition(with_gmsh)) {
  for (const char* density : {"0", "-1", "x", "", "1 kg", "nan", "inf"})
    check_gmsh_refused("density.msh", mixed_msh(std::string("density=") + density), "physical volume");
  for (const double value : {0., -1., not_a_number}) {
    CHECK_REFUSED_SAYING(read_gmsh("box.msh", value), std::domain_error, "density = ");
    CHECK_REFUSED_SAYING(read_gmsh("box.msh", 1, value), std::domain_error, "unit = ");
  }
}
