// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef CLATTER_ASSIMP_LIBRARY
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <type_traits>

#include "numeric/base/errors.hpp"
#include "numeric/files/file_text.hpp"
#include "numeric/files/import.hpp"
#include "numeric/files/triangle_files.hpp"

namespace clatter::numeric {
#ifdef CLATTER_ASSIMP_LIBRARY
namespace {

using Matrix4 = Eigen::Matrix4d;

/// Assimp's library, loaded when a file asks for it.
template <class Function>
Function* function(const char* name) {
  static void* const library = dlopen(CLATTER_ASSIMP_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  void* const found = library ? dlsym(library, name) : nullptr;
  if (!found) throw MeshError("needs assimp's library, Debian package libassimp5: " + std::string(dlerror()));
  return reinterpret_cast<Function*>(found);
}

/// The part of a 3MF file that names its unit, read by the library of archives that assimp's needs, too.
std::string model_head(const std::string& path) {
  static void* const library = dlopen("libminizip.so.1", RTLD_NOW | RTLD_LOCAL);
  const auto function_of = [](const char* name) {
    void* const found = library ? dlsym(library, name) : nullptr;
    if (!found) throw MeshError("needs minizip's library, Debian package libminizip1: " + std::string(dlerror()));
    return found;
  };
  auto* const open = reinterpret_cast<void* (*)(const char*)>(function_of("unzOpen"));
  auto* const locate = reinterpret_cast<int (*)(void*, const char*, int)>(function_of("unzLocateFile"));
  auto* const begin = reinterpret_cast<int (*)(void*)>(function_of("unzOpenCurrentFile"));
  auto* const read = reinterpret_cast<int (*)(void*, void*, unsigned)>(function_of("unzReadCurrentFile"));
  constexpr int whatever_case = 2;
  constexpr unsigned most = 1 << 16;
  std::string text(most, '\0');
  void* const archive = open(path.c_str());
  const bool is_there = archive && locate(archive, "3D/3dmodel.model", whatever_case) == 0 && begin(archive) == 0;
  const int size = is_there ? read(archive, text.data(), most) : 0;
  text.resize(static_cast<std::size_t>(std::max(size, 0)));
  return text;
}

/// The value of an attribute of the first such tag; empty without one.
std::string attribute_of(const std::string& text, const std::string& tag, const std::string& name) {
  const std::size_t begin = text.find("<" + tag + " "), end = std::min(text.find('>', begin), text.size());
  if (begin == std::string::npos) return "";
  const std::string head = text.substr(begin, end - begin);
  const std::size_t at = head.find(" " + name + "=");
  if (at == std::string::npos) return "";
  const std::size_t first = at + name.size() + 3, last = head.find(head[first - 1], first);
  return last == std::string::npos ? "" : head.substr(first, last - first);
}

/// [m]; 0: none is named.  A 3MF file without one has millimetres, glTF has metres.
double unit_of(const std::string& path, const std::string& contents) {
  const std::size_t form = extension_index(surface_extensions, path);
  if (surface_extensions[form] == ".3mf") {
    constexpr std::array<std::pair<std::string_view, double>, 6> names{{{"micron", 1e-6},
                                                                        {"millimeter", 0.001},
                                                                        {"centimeter", 0.01},
                                                                        {"inch", 0.0254},
                                                                        {"foot", 0.3048},
                                                                        {"meter", 1}}};
    const std::string given = attribute_of(model_head(path), "model", "unit");
    for (const auto& [name, unit] : names) {
      if (name == given) return unit;
    }
    if (!given.empty()) throw MeshError("unknown unit " + given.substr(0, 40));
    return 0.001;
  }
  if (surface_extensions[form] != ".dae") return 1;
  const std::string given = attribute_of(contents, "unit", "meter");
  const double unit = given.empty() ? 1 : number_of(given);
  if (!(unit > 0 && std::isfinite(unit))) throw MeshError("unknown unit " + given.substr(0, 40));
  return unit;
}

Matrix4 matrix_of(const aiMatrix4x4& m) {
  Matrix4 made;
  made << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return made;
}

void add_mesh(const aiMesh& mesh, const Matrix4& place, Triangles& all) {
  const int first = static_cast<int>(all.corners.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    all.corners.emplace_back((place * Eigen::Vector4d(v.x, v.y, v.z, 1)).head<3>());
  }
  const bool mirrors = place.topLeftCorner<3, 3>().determinant() < 0;
  std::vector<int> polygon;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    polygon.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) throw MeshError("a face has a corner that is not there");
      polygon.push_back(first + static_cast<int>(face.mIndices[k]));
    }
    if (mirrors) std::reverse(polygon.begin(), polygon.end());
    add_polygon(all, polygon);
  }
}

/// @param place  of the node's parent
void add_node(const aiScene& scene, const aiNode& node, const Matrix4& place, Triangles& all, int depth) {
  constexpr int deepest = 1000;
  if (depth > deepest) throw MeshError("has more than 1000 nodes below each other");
  const Matrix4 own = place * matrix_of(node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene.mNumMeshes) throw MeshError("a node has a mesh that is not there");
    add_mesh(*scene.mMeshes[node.mMeshes[i]], own, all);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], own, all, depth + 1);
}

Triangles triangles_of(const std::string& path, double unit) {
  auto* const import = function<decltype(aiImportFileExWithProperties)>("aiImportFileExWithProperties");
  auto* const settings = function<decltype(aiCreatePropertyStore)>("aiCreatePropertyStore")();
  function<decltype(aiSetImportPropertyInteger)>("aiSetImportPropertyInteger")(
      settings, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);  // the body's axes are the file's
  auto* const complaint = function<decltype(aiGetErrorString)>("aiGetErrorString");
  const aiScene* const scene = import(path.c_str(), 0, nullptr, settings);
  if (!scene) throw MeshError("assimp says: " + std::string(complaint()));
  Triangles all{.corners = {}, .triangles = {}, .rounding = 0x1p-24};
  // Coordinates of COLLADA come in metres, others in the unit of the file.
  const bool is_scaled = surface_extensions[extension_index(surface_extensions, path)] == ".dae";
  Matrix4 place = Matrix4::Identity();
  if (is_scaled) place.topLeftCorner<3, 3>() /= unit;
  if (scene->mRootNode) add_node(*scene, *scene->mRootNode, place, all, 0);
  return all;  // the process ends, and with it what the library holds
}

template <class Value>
void put(std::FILE* pipe, const Value* values, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<Value> || std::is_same_v<Value, Vector3>);
  std::fwrite(values, sizeof(Value), count, pipe);
}

template <class Value>
bool get(std::FILE* pipe, Value* values, std::size_t count) {
  return std::fread(static_cast<void*>(values), sizeof(Value), count, pipe) == count;
}

/// What the process that reads hands over: a letter, then counts and numbers, or a complaint.
void hand_over(const std::string& path, const std::string& contents, std::FILE* pipe) {
  try {
    const double unit = unit_of(path, contents);
    const Triangles all = triangles_of(path, unit);
    const std::uint64_t counts[]{all.corners.size(), all.triangles.size()};
    std::fputc('t', pipe);
    put(pipe, &unit, 1);
    put(pipe, counts, 2);
    put(pipe, all.corners.data(), all.corners.size());
    put(pipe, all.triangles.data(), all.triangles.size());
  } catch (const std::exception& error) {
    std::fputc('e', pipe);
    std::fputs(error.what(), pipe);
  }
  std::fflush(pipe);
}

TriangleFile taken_over(std::FILE* pipe) {
  const std::string broken = "assimp's library broke down on it";
  const int letter = std::fgetc(pipe);
  if (letter == 'e') {
    std::string words;
    for (int c = std::fgetc(pipe); c != EOF && words.size() < 400; c = std::fgetc(pipe))
      words += c == '\n' || c == '\r' ? ' ' : static_cast<char>(c);
    throw MeshError(words);
  }
  std::uint64_t counts[2]{};
  constexpr std::uint64_t most = 500'000'000;
  double unit = 0;
  if (letter != 't' || !get(pipe, &unit, 1) || !get(pipe, counts, 2) || counts[0] > most || counts[1] > most)
    throw MeshError(broken);
  Triangles all{.corners = std::vector<Vector3>(counts[0]), .triangles = {}, .rounding = 0x1p-24};
  all.triangles.resize(counts[1]);
  if (!get(pipe, all.corners.data(), counts[0]) || !get(pipe, all.triangles.data(), counts[1])) throw MeshError(broken);
  return {.triangles = std::move(all), .unit = unit};
}

/// Damaged files have made the library write beside its memory, take all there is, or never end: it reads in a process
/// of its own, with limits.
TriangleFile read_apart(const std::string& path, const std::string& contents) {
  int ends[2];
  if (pipe(ends) != 0) throw MeshError(std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    throw MeshError(std::string("no process could be made to read it: ") + std::strerror(errno));
  }
  if (child == 0) {
    close(ends[0]);
    constexpr rlim_t most_memory = rlim_t{4} << 30, most_seconds = 120;
    const rlimit memory{most_memory, most_memory}, seconds{most_seconds, most_seconds}, none{0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_CORE, &none);
    if (std::FILE* const silence = std::freopen("/dev/null", "w", stderr)) static_cast<void>(silence);
    if (std::FILE* const out = fdopen(ends[1], "wb")) hand_over(path, contents, out);
    _exit(0);
  }
  close(ends[1]);
  std::FILE* const in = fdopen(ends[0], "rb");
  const auto end = [&] {
    std::fclose(in);
    int status = 0;
    waitpid(child, &status, 0);
  };
  try {
    TriangleFile file = taken_over(in);
    end();
    return file;
  } catch (...) {
    end();
    throw;
  }
}

}  // namespace

bool has_assimp() noexcept { return true; }

TriangleFile read_by_assimp(const std::string& path) {
  const std::string contents = file_contents(path);  // refuses what is no file in this project's words
  try {
    return read_apart(path, contents);
  } catch (const MeshError& error) {
    throw MeshError(path + ": " + error.what());
  }
}

#else  // the library was not found, or not wanted

bool has_assimp() noexcept { return false; }

TriangleFile read_by_assimp(const std::string& path) {
  throw MeshError(path + ": this build reads no glTF, 3MF and COLLADA (Debian package libassimp-dev)");
}

#endif
}  // namespace clatter::numeric
