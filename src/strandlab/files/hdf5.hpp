// The small part of HDF5 that strandlab's files need: a file is built in memory and read from memory, so that disk
// errors are met by our own reads and writes, and a file on disk is always a whole one. Included by .cpp files of this
// room only.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strandlab::files::hdf5 {

using Shape = std::vector<hsize_t>;

// An HDF5 object that is closed with its owner.
class Id {
 public:
  using Close = herr_t (*)(hid_t);
  Id(hid_t id, Close close) : id_(id), close_(close) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Id& operator=(Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): stands for the id in every HDF5 call
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

// Keeps HDF5 from printing its error stack; what matters of it goes into our messages.
class SilentErrors {
 public:
  SilentErrors();
  ~SilentErrors();
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// What a dataset is, for whoever opens the file with another tool.
struct Label {
  const char* unit;  // "mm", "MPa"; "1" for pure numbers
  const char* description;
};

// Builds a file in memory. Paths are absolute; the groups on the way are made. Every dataset carries a checksum. Throws
// RunError where HDF5 refuses (no memory).
class Writer {
 public:
  Writer();
  void attribute(const char* name, const std::string& value);  // of the root
  void attribute(const char* name, std::int64_t value);
  void write(const std::string& path, const Shape& shape, std::span<const double> values, const Label& label);
  void write(const std::string& path, const Shape& shape, std::span<const std::int64_t> values, const Label& label);
  void write(const std::string& path, const std::vector<std::string>& values, const Label& label);
  std::string finish();  // closes the file and returns its bytes; nothing can be written after

 private:
  void write_raw(const std::string& path, const Shape& shape, hid_t type, const void* values, const Label& label);
  SilentErrors silent_;
  std::unique_ptr<std::string> image_;  // the file's memory, which HDF5 holds on to by address
  Id file_;
};

// Reads a file. Every function throws InputError naming the file, the object and what is wrong with it.
class Reader {
 public:
  explicit Reader(std::filesystem::path file);
  bool has_attribute(const char* name) const;
  bool has(const std::string& path) const;  // whose group exists
  std::string text_attribute(const char* name) const;
  std::int64_t integer_attribute(const char* name) const;
  std::vector<double> doubles(const std::string& path, const Shape& shape) const;
  std::vector<std::int64_t> integers(const std::string& path, const Shape& shape) const;
  std::vector<std::string> texts(const std::string& path, hsize_t count) const;
  hsize_t length(const std::string& path) const;  // first extent of a dataset
  [[noreturn]] void fail(const std::string& what) const;

 private:
  Id open_dataset(const std::string& path) const;
  Shape shape_of(hid_t dataset, const std::string& path) const;  // no more values than are stored
  Id open_dataset(const std::string& path, const Shape& shape, H5T_class_t type_class) const;
  void read_raw(hid_t dataset, const std::string& path, hid_t type, std::size_t count, void* values) const;
  SilentErrors silent_;
  std::filesystem::path path_;
  std::string image_;
  hsize_t bytes_;  // of the file
  Id file_;
};

}  // namespace strandlab::files::hdf5
