// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/column_file.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "validation/output/bad_input.hpp"

namespace clatter::validation {
namespace {

using Open = ColumnFile* (*)(const std::string&, const ColumnFileHead&);
using Read = bool (*)(const std::string&, ColumnFileHead&);

void* find_module() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const std::filesystem::path& place : {folder, folder.parent_path() / "lib/clatter/modules"}) {
    void* const module = dlopen((place / "clatter-hdf5.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module != nullptr) return module;
  }
  return nullptr;
}

/// A function of the module, which is looked for once; none: there is no such module.
template <class Function>
Function in_module(const char* name) {
  static void* const module = find_module();
  return module == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(module, name));
}

}  // namespace

void require_hdf5() {
  if (in_module<Open>("clatter_open_hdf5") != nullptr) return;
  throw BadInput("--output: this program was built without HDF5; install libhdf5-dev and build it again");
}

std::unique_ptr<ColumnFile> open_hdf5(const std::string& path, const ColumnFileHead& head) {
  require_hdf5();
  return std::unique_ptr<ColumnFile>(in_module<Open>("clatter_open_hdf5")(path, head));
}

std::optional<ColumnFileHead> read_hdf5_head(const std::string& path, ColumnFileHead head) {
  require_hdf5();
  return in_module<Read>("clatter_read_hdf5_head")(path, head) ? std::optional(std::move(head)) : std::nullopt;
}

}  // namespace clatter::validation
