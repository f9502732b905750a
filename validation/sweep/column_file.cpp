// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/column_file.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "validation/output/bad_input.hpp"

namespace clatter::validation {
namespace {

using Open = ColumnFile* (*)(const std::string&, const ColumnFileHead&);

Open find_module() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const std::filesystem::path& place : {folder, folder.parent_path() / "lib/clatter/modules"}) {
    void* const module = dlopen((place / "clatter-hdf5.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module != nullptr) return reinterpret_cast<Open>(dlsym(module, "clatter_open_hdf5"));
  }
  return nullptr;
}

/// The function of the module, which is looked for once; none: there is no such module.
Open open_in_module() {
  static const Open open = find_module();
  return open;
}

}  // namespace

void require_hdf5() {
  if (open_in_module() != nullptr) return;
  throw BadInput("--output: this program was built without HDF5; install libhdf5-dev and build it again");
}

std::unique_ptr<ColumnFile> open_hdf5(const std::string& path, const ColumnFileHead& head) {
  require_hdf5();
  return std::unique_ptr<ColumnFile>(open_in_module()(path, head));
}

}  // namespace clatter::validation
