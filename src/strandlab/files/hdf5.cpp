#include "strandlab/files/hdf5.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "strandlab/core/error.hpp"

namespace strandlab::files::hdf5 {
namespace {

constexpr std::size_t kMemoryStep = std::size_t{4} << 20;  // growth of a file in memory, bytes
constexpr std::size_t kEndOfFile = 28;  // of the end-of-file address in superblock version 3, little endian
constexpr std::string_view kSignature{"\211HDF\r\n\032\n", 8};

// The innermost entry of the error stack is where HDF5 says what it really met ("truncated file: eof = ...").
std::string innermost_error() {
  std::string text;
  const auto visit = [](unsigned n, const H5E_error2_t* entry, void* out) -> herr_t {
    if (n == 0 && entry->desc != nullptr) *static_cast<std::string*>(out) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, visit, &text);
  return text.empty() ? "unknown HDF5 error" : text;
}

// Result of an HDF5 call in memory, where only a lack of memory or a mistake of ours can go wrong.
template <class Result>
Result checked(Result result) {
  if (result < 0) throw RunError(fmt::format("cannot hold an HDF5 file in memory: {}", innermost_error()));
  return result;
}

// The newest format gives every piece of metadata a checksum.
Id memory_access() {
  Id access(checked(H5Pcreate(H5P_FILE_ACCESS)), H5Pclose);
  checked(H5Pset_fapl_core(access, kMemoryStep, false));
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
  return access;
}

// The memory of a file lives in a string, where it stays when HDF5 has closed the file. (H5Fget_file_image() of an open
// file leaves a superblock whose checksum is wrong.)
void* image_resize(void*, std::size_t size, H5FD_file_image_op_t, void* image) {
  auto& bytes = *static_cast<std::string*>(image);
  bytes.resize(size);
  return bytes.data();
}
void* image_allocate(std::size_t size, H5FD_file_image_op_t op, void* image) {
  return image_resize(nullptr, size, op, image);
}
herr_t image_keep(void*, H5FD_file_image_op_t, void*) {
  return 0;
}
void* image_share(void* image) {
  return image;
}
herr_t image_unshare(void*) {
  return 0;
}

Id writing_access(std::string* image) {
  const auto copy = [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
  };
  H5FD_file_image_callbacks_t callbacks{image_allocate, copy,          image_resize, image_keep,
                                        image_share,    image_unshare, image};
  Id access = memory_access();
  checked(H5Pset_file_image_callbacks(access, &callbacks));
  return access;
}

// HDF5 takes open files of one name for one file, and refuses an image under the name of a file on disk.
std::string memory_name() {
  static std::atomic<unsigned> count{0};
  return fmt::format("strandlab/in/memory/{}", count++);
}

Id text_type(std::size_t length) {
  Id type(checked(H5Tcopy(H5T_C_S1)), H5Tclose);
  checked(H5Tset_size(type, std::max<std::size_t>(length, 1)));
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  return type;
}

void write_text_attribute(hid_t object, const char* name, const std::string& value) {
  const Id type = text_type(value.size());
  const Id space(checked(H5Screate(H5S_SCALAR)), H5Sclose);
  const Id attribute(checked(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT)), H5Aclose);
  const std::string padded = value.empty() ? std::string(1, '\0') : value;
  checked(H5Awrite(attribute, type, padded.data()));
}

// No time stamps: the same state gives the same bytes.
Id without_times(hid_t list_class) {
  Id properties(checked(H5Pcreate(list_class)), H5Pclose);
  checked(H5Pset_obj_track_times(properties, false));
  return properties;
}

// One checksummed chunk where it fits (its address then lies in checksummed metadata), else slices of the first extent.
Id chunked(const Shape& shape) {
  constexpr hsize_t kLargestChunk = hsize_t{1} << 28;  // numbers; HDF5 allows 4 GiB
  Shape chunk = shape;
  hsize_t row = 1;
  for (std::size_t d = 1; d < chunk.size(); ++d) row *= chunk[d];
  for (auto& extent : chunk) extent = std::max<hsize_t>(extent, 1);
  chunk[0] = std::min(chunk[0], std::max<hsize_t>(kLargestChunk / std::max<hsize_t>(row, 1), 1));
  Id properties = without_times(H5P_DATASET_CREATE);
  checked(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()));
  checked(H5Pset_fletcher32(properties));
  return properties;
}

// The groups on the way to `path`.
void make_groups(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end);
    if (checked(H5Lexists(file, group.c_str(), H5P_DEFAULT)) > 0) continue;
    const Id made(checked(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, without_times(H5P_GROUP_CREATE), H5P_DEFAULT)),
                  H5Gclose);
  }
}

hsize_t product(const Shape& shape) {
  hsize_t n = 1;
  for (const auto extent : shape) n *= extent;
  return n;
}

std::string read_whole(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  const auto refuse = [&](int error) {
    throw InputError(fmt::format("cannot read {}: {}", path.string(), std::generic_category().message(error)));
  };
  if (!file) refuse(errno);
  std::string bytes;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file.get())) bytes.append(buffer.data(), n);
  if (std::ferror(file.get()) != 0) refuse(errno);
  return bytes;
}

}  // namespace

SilentErrors::SilentErrors() {
  // A damaged file can leave the library with objects that it fails to close at exit, and says so on the terminal. Our
  // files live in memory: there is nothing to close.
  H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

SilentErrors::~SilentErrors() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

Writer::Writer()
    : image_(std::make_unique<std::string>()),
      file_(checked(H5Fcreate(memory_name().c_str(), H5F_ACC_TRUNC, without_times(H5P_FILE_CREATE),
                              writing_access(image_.get()))),
            H5Fclose) {}

void Writer::attribute(const char* name, const std::string& value) {
  write_text_attribute(file_, name, value);
}

void Writer::attribute(const char* name, std::int64_t value) {
  const Id space(checked(H5Screate(H5S_SCALAR)), H5Sclose);
  const Id attribute(checked(H5Acreate2(file_, name, H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT)), H5Aclose);
  checked(H5Awrite(attribute, H5T_NATIVE_INT64, &value));
}

void Writer::write_raw(const std::string& path, const Shape& shape, hid_t type, const void* values,
                       const Label& label) {
  make_groups(file_, path);
  const Id space(checked(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr)), H5Sclose);
  const Id properties = chunked(shape);
  const Id dataset(checked(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT)),
                   H5Dclose);
  if (product(shape) > 0) checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  write_text_attribute(dataset, "unit", label.unit);
  write_text_attribute(dataset, "description", label.description);
}

void Writer::write(const std::string& path, const Shape& shape, std::span<const double> values, const Label& label) {
  if (product(shape) != values.size()) throw RunError(path + ": the state's arrays do not fit its lattice");
  write_raw(path, shape, H5T_IEEE_F64LE, values.data(), label);
}

void Writer::write(const std::string& path, const Shape& shape, std::span<const std::int64_t> values,
                   const Label& label) {
  if (product(shape) != values.size()) throw RunError(path + ": the state's arrays do not fit its lattice");
  write_raw(path, shape, H5T_STD_I64LE, values.data(), label);
}

void Writer::write(const std::string& path, const std::vector<std::string>& values, const Label& label) {
  std::size_t length = 1;
  for (const auto& value : values) length = std::max(length, value.size());
  std::string padded(length * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) std::copy(values[i].begin(), values[i].end(), &padded[i * length]);
  write_raw(path, {values.size()}, text_type(length), padded.data(), label);
}

std::string Writer::finish() {
  file_ = Id(-1, H5Fclose);
  std::uint64_t size = 0;  // the memory grows in steps; the superblock says where the file ends
  std::memcpy(&size, image_->data() + kEndOfFile, sizeof size);
  image_->resize(size);
  return std::move(*image_);
}

Reader::Reader(std::filesystem::path file)
    : path_(std::move(file)), image_(read_whole(path_)), bytes_(image_.size()), file_(-1, H5Fclose) {
  if (image_.empty()) fail("the file is empty");
  if (!std::string_view(image_).starts_with(kSignature)) fail("this is not an HDF5 file");
  const Id access = memory_access();
  checked(H5Pset_file_image(access, image_.data(), image_.size()));
  file_ = Id(H5Fopen(memory_name().c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!file_.valid()) fail(fmt::format("the file is truncated or damaged ({})", innermost_error()));
  image_ = {};  // HDF5 keeps its own copy
}

void Reader::fail(const std::string& what) const {
  throw InputError(fmt::format("cannot use {}: {}", path_.string(), what));
}

bool Reader::has_attribute(const char* name) const {
  return H5Aexists(file_, name) > 0;
}

bool Reader::has(const std::string& path) const {
  return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
}

std::string Reader::text_attribute(const char* name) const {
  if (!has_attribute(name)) fail(fmt::format("attribute \"{}\" is missing", name));
  const Id attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose);
  const Id stored(H5Aget_type(attribute), H5Tclose);
  const Id space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) > 0 ||
      H5Sget_simple_extent_npoints(space) != 1) {
    fail(fmt::format("attribute \"{}\" is not a text of fixed length", name));
  }
  if (H5Tget_size(stored) > bytes_) fail(fmt::format("attribute \"{}\" is longer than the file", name));
  std::string value(H5Tget_size(stored), '\0');
  if (H5Aread(attribute, stored, value.data()) < 0) {
    fail(fmt::format("attribute \"{}\" is damaged ({})", name, innermost_error()));
  }
  value.resize(std::min(value.find('\0'), value.size()));  // the padding
  return value;
}

std::int64_t Reader::integer_attribute(const char* name) const {
  if (!has_attribute(name)) fail(fmt::format("attribute \"{}\" is missing", name));
  const Id attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose);
  const Id stored(H5Aget_type(attribute), H5Tclose);
  const Id space(H5Aget_space(attribute), H5Sclose);
  if (H5Tget_class(stored) != H5T_INTEGER || H5Sget_simple_extent_npoints(space) != 1) {
    fail(fmt::format("attribute \"{}\" is not an integer", name));
  }
  std::int64_t value = 0;
  if (H5Aread(attribute, H5T_NATIVE_INT64, &value) < 0) {
    fail(fmt::format("attribute \"{}\" is damaged ({})", name, innermost_error()));
  }
  return value;
}

Id Reader::open_dataset(const std::string& path) const {
  Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) fail(fmt::format("dataset {} is missing or damaged ({})", path, innermost_error()));
  return dataset;
}

// Extents are a claim: they are held against the bytes that the dataset has (our files are not compressed) and that the
// file has, extent by extent, before anyone multiplies or allocates them.
Shape Reader::shape_of(hid_t dataset, const std::string& path) const {
  const Id space(H5Dget_space(dataset), H5Sclose);
  const Id stored(H5Dget_type(dataset), H5Tclose);
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space) : -1;
  if (rank < 0 || !stored.valid()) fail(fmt::format("dataset {} has no extent ({})", path, innermost_error()));
  Shape shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  if (!shape.empty() && shape[0] == 0) return shape;  // an empty list
  const hsize_t there = std::min<hsize_t>(H5Dget_storage_size(dataset), bytes_);
  hsize_t room = there / std::max<hsize_t>(H5Tget_size(stored), 1);
  for (const auto extent : shape) {
    if (extent == 0 || extent > room) {
      fail(fmt::format("dataset {} claims {} values, but only {} bytes are stored", path, fmt::join(shape, " x "),
                       there));
    }
    room /= extent;
  }
  return shape;
}

hsize_t Reader::length(const std::string& path) const {
  const Shape shape = shape_of(open_dataset(path), path);
  if (shape.empty()) fail(fmt::format("dataset {} is a single value, expected a list", path));
  return shape[0];
}

// The dataset, which has this shape and type: an array for its values may be allocated.
Id Reader::open_dataset(const std::string& path, const Shape& shape, H5T_class_t type_class) const {
  Id dataset = open_dataset(path);
  const Id stored(H5Dget_type(dataset), H5Tclose);
  if (H5Tget_class(stored) != type_class) fail(fmt::format("dataset {} has values of another type", path));
  const Shape found = shape_of(dataset, path);
  if (found != shape) {
    fail(fmt::format("dataset {} has {} values, expected {}", path, fmt::join(found, " x "), fmt::join(shape, " x ")));
  }
  return dataset;
}

void Reader::read_raw(hid_t dataset, const std::string& path, hid_t type, std::size_t count, void* values) const {
  if (count == 0) return;
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
    fail(fmt::format("dataset {} is damaged ({})", path, innermost_error()));
  }
}

std::vector<double> Reader::doubles(const std::string& path, const Shape& shape) const {
  const Id dataset = open_dataset(path, shape, H5T_FLOAT);
  std::vector<double> values(product(shape));
  read_raw(dataset, path, H5T_NATIVE_DOUBLE, values.size(), values.data());
  return values;
}

std::vector<std::int64_t> Reader::integers(const std::string& path, const Shape& shape) const {
  const Id dataset = open_dataset(path, shape, H5T_INTEGER);
  std::vector<std::int64_t> values(product(shape));
  read_raw(dataset, path, H5T_NATIVE_INT64, values.size(), values.data());
  return values;
}

std::vector<std::string> Reader::texts(const std::string& path, hsize_t count) const {
  const Id dataset = open_dataset(path, {count}, H5T_STRING);
  const Id stored(H5Dget_type(dataset), H5Tclose);
  if (H5Tis_variable_str(stored) > 0) {
    fail(fmt::format("dataset {} has values of another type", path));
  }
  const std::size_t length = H5Tget_size(stored);
  std::string padded(length * count, '\0');
  read_raw(dataset, path, stored, count, padded.data());
  std::vector<std::string> values;
  for (hsize_t i = 0; i < count; ++i) {
    const std::string_view cell(padded.data() + i * length, length);
    values.emplace_back(cell.substr(0, cell.find('\0')));
  }
  return values;
}

}  // namespace strandlab::files::hdf5
