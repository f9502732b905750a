// SPDX-License-Identifier: GPL-3.0-or-later
// The module that writes HDF5.
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "validation/sweep/column_file.hpp"

namespace clatter::validation {
namespace {

/// Rows that a dataset stores and compresses together, at most `most_rows`: all chunks of a file are stored whole, and
/// so they are about equally full.
hsize_t chunk_of(long long rows) {
  constexpr long long most_rows = 65536;
  const long long chunks = std::max(1LL, (rows + most_rows - 1) / most_rows);
  return static_cast<hsize_t>(std::max(1LL, (rows + chunks - 1) / chunks));
}

/// An identifier of the library, given back at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("the HDF5 file cannot be written");
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: the library's functions take it as it is

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status) {
  if (status < 0) throw std::runtime_error("the HDF5 file cannot be written");
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  require(H5Tset_size(type, H5T_VARIABLE));
  require(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type = text_type();
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* const bytes = text.c_str();
  require(H5Awrite(attribute, type, &bytes));
}

/// Empty where there is none.
std::string attribute_of(hid_t object, const std::string& name) {
  if (!(H5Aexists(object, name.c_str()) > 0)) return "";
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose), type = text_type();
  char* bytes = nullptr;
  require(H5Aread(attribute, type, &bytes));
  const std::string text(bytes);
  require(H5free_memory(bytes));
  return text;
}

/// The last number of a dataset that has some.
double last_of(hid_t file, const char* name) {
  const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose), place(H5Dget_space(dataset), H5Sclose);
  const hsize_t one = 1, last = static_cast<hsize_t>(H5Sget_simple_extent_npoints(place) - 1);
  require(H5Sselect_hyperslab(place, H5S_SELECT_SET, &last, nullptr, &one, nullptr));
  const Handle memory(H5Screate_simple(1, &one, nullptr), H5Sclose);
  double number = 0;
  require(H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, place, H5P_DEFAULT, &number));
  return number;
}

/// One column: its dataset, and the rows that were not written yet.
class Dataset {
 public:
  Dataset(hid_t file, const Column& column, bool is_truth, hsize_t chunk)
      : file_(file), column_(column), is_truth_(is_truth), chunk_(chunk) {}

  void add(const PackedCell& cell) {
    if (is_truth_) {
      codes_.push_back(cell.is_truth ? static_cast<std::int32_t>(cell.number) : -1);
    } else if (column_.words) {
      const auto next = static_cast<std::int32_t>(words_.size());
      codes_.push_back(cell.is_text ? words_.try_emplace(std::string(cell.text), next).first->second : -1);
    } else {
      numbers_.push_back(cell.number);
    }
    if (std::max(codes_.size(), numbers_.size()) == chunk_) flush();
  }

  void close() {
    flush();
    if (!column_.words) return;
    std::vector<const char*> texts(words_.size());
    for (const auto& [text, code] : words_) texts[static_cast<std::size_t>(code)] = text.c_str();
    const hsize_t count = texts.size();
    const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose), type = text_type();
    const Handle options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(options, false));
    const Handle words(
        H5Dcreate2(file_, ("words/" + column_.name).c_str(), type, space, H5P_DEFAULT, options, H5P_DEFAULT), H5Dclose);
    if (count > 0) require(H5Dwrite(words, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()));
  }

 private:
  [[nodiscard]] bool is_coded() const { return is_truth_ || column_.words; }

  /// Whole numbers, texts, errors of two digits and values of a grid compress well; what measures something has random
  /// last bits.
  [[nodiscard]] bool is_compressible() const {
    const auto is_whole = [](double number) { return !std::isfinite(number) || number == std::floor(number); };
    const bool is_grid =
        column_.name.find('.') != std::string::npos && std::is_sorted(numbers_.begin(), numbers_.end());
    return is_coded() || is_grid || column_.name.ends_with("_error") ||
           std::all_of(numbers_.begin(), numbers_.end(), is_whole);
  }

  void create() {
    const hsize_t none = 0, most = H5S_UNLIMITED;
    const Handle space(H5Screate_simple(1, &none, &most), H5Sclose), options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_chunk(options, 1, &chunk_));
    require(H5Pset_obj_track_times(options, false));  // the same rows are the same bytes
    if (is_compressible()) {
      require(H5Pset_shuffle(options));
      require(H5Pset_deflate(options, 1));
    }
    const hid_t type = is_truth_ ? H5T_STD_I8LE : column_.words ? H5T_STD_I32LE : H5T_IEEE_F64LE;
    dataset_.emplace(H5Dcreate2(file_, column_.name.c_str(), type, space, H5P_DEFAULT, options, H5P_DEFAULT), H5Dclose);
    write_attribute(*dataset_, "unit", column_.unit);
    write_attribute(*dataset_, "meaning", column_.meaning);
  }

  void flush() {
    if (!dataset_) create();
    const hsize_t count = std::max(codes_.size(), numbers_.size()), first = std::exchange(rows_, rows_ + count);
    if (count == 0) return;
    require(H5Dset_extent(*dataset_, &rows_));
    const Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose), place(H5Dget_space(*dataset_), H5Sclose);
    require(H5Sselect_hyperslab(place, H5S_SELECT_SET, &first, nullptr, &count, nullptr));
    const void* const rows = is_coded() ? static_cast<const void*>(codes_.data()) : numbers_.data();
    require(H5Dwrite(*dataset_, is_coded() ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE, memory, place, H5P_DEFAULT, rows));
    codes_.clear();
    numbers_.clear();
  }

  hid_t file_;
  Column column_;
  bool is_truth_;
  hsize_t chunk_;
  std::optional<Handle> dataset_;
  hsize_t rows_ = 0;
  std::vector<double> numbers_;
  std::vector<std::int32_t> codes_;
  std::unordered_map<std::string, std::int32_t> words_;
};

class Hdf5File final : public ColumnFile {
 public:
  Hdf5File(const std::string& path, const ColumnFileHead& head)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose) {
    for (const auto& [name, text] : head.attributes) write_attribute(file_, name, text);
    write_attribute(file_, "fell_short", head.told.fell_short);
    write_attribute(file_, "set_aside", head.told.set_aside);
    const Handle options(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(options, false));
    const Handle words(H5Gcreate2(file_, "words", H5P_DEFAULT, options, H5P_DEFAULT), H5Gclose);
    datasets_.reserve(head.columns.size());
    for (const Column& column : head.columns) {
      const bool is_truth = std::ranges::find(head.truths, column.name) != head.truths.end();
      datasets_.emplace_back(file_, column, is_truth, chunk_of(head.rows));
    }
  }

  void add(const std::vector<PackedCell>& row) override {
    for (std::size_t i = 0; i < datasets_.size(); ++i) datasets_[i].add(row[i]);
  }
  void close() override {
    for (Dataset& dataset : datasets_) dataset.close();
    require(H5Fflush(file_, H5F_SCOPE_GLOBAL));
  }

 private:
  Handle file_;
  std::vector<Dataset> datasets_;
};

}  // namespace
}  // namespace clatter::validation

extern "C" clatter::validation::ColumnFile* clatter_open_hdf5(const std::string& path,
                                                              const clatter::validation::ColumnFileHead& head) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // failures are told once, by who catches them
  return new clatter::validation::Hdf5File(path, head);
}

extern "C" bool clatter_read_hdf5_head(const std::string& path, clatter::validation::ColumnFileHead& head) {
  using namespace clatter::validation;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  try {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    for (auto& [name, text] : head.attributes) text = attribute_of(file, name);
    head.told = {attribute_of(file, "fell_short"), attribute_of(file, "set_aside")};
    head.rows = static_cast<long long>(last_of(file, "index"));
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}
