// Files of panels and checkpoints (HDF5) that were changed on purpose: the input is a list of edits of a good file,
// made through HDF5 itself, so that all checksums are right. Damaged bytes are refused by these checksums, as unit
// tests show.
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "harness.hpp"
#include "strandlab/io/checkpoint.hpp"

using namespace strandlab;

namespace {

// The input byte by byte; zeros behind its end.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  bool empty() const { return bytes_.empty(); }
  unsigned next() {
    if (bytes_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return byte;
  }
  template <class Number>
  Number number() {
    std::array<unsigned char, sizeof(Number)> raw{};
    for (auto& byte : raw) byte = static_cast<unsigned char>(next());
    Number value{};
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  // Small numbers as they are, and powers of two and their neighbours, where products overflow.
  hsize_t extent() {
    const unsigned power = next() % 128;
    return power < 64 ? power : (hsize_t{1} << (power - 64)) + next() % 3 - 1;
  }

 private:
  std::string_view bytes_;
};

// A folder that goes away with the process: HDF5 edits files with names only.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "strandlab_fuzz_XXXXXX").string();
    fuzz::require(::mkdtemp(name.data()) != nullptr, "there is a temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path file() const { return path_ / "checkpoint.h5"; }

 private:
  std::filesystem::path path_;
};

// Two strands of two points each, as a checkpoint: it also reads as a panel.
std::string good_file(const std::filesystem::path& file) {
  press::Checkpoint<2> checkpoint;
  checkpoint.panel.length_mm = 1;
  checkpoint.panel.initial_thickness_mm = checkpoint.panel.top_mm = 1.6;
  for (int row = 0; row < 2; ++row) {
    wood::StrandMaterial material;
    material.stiffness.setIdentity();
    material.yield_surface.setIdentity();
    auto strand = formed_strand<2>({{2, 1}, {0.5, 0.8}}, {}, material);
    strand.kind = "surface";
    strand.row = row;
    checkpoint.panel.strands.push_back(strand);
  }
  checkpoint.records.resize(2);
  io::write_checkpoint(checkpoint, "case", file);
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A file open for edits. Edits that HDF5 itself refuses change nothing.
class EditedFile {
 public:
  explicit EditedFile(const std::filesystem::path& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)) {
    fuzz::require(file_ >= 0, "the good file opens");
    const auto add = [](hid_t, const char* name, const H5O_info_t* info, void* paths) -> herr_t {
      if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(paths)->emplace_back(name);
      return 0;
    };
    H5Ovisit(file_, H5_INDEX_NAME, H5_ITER_INC, add, &datasets_);
    std::sort(datasets_.begin(), datasets_.end());
  }
  ~EditedFile() { H5Fclose(file_); }
  EditedFile(const EditedFile&) = delete;
  EditedFile& operator=(const EditedFile&) = delete;

  void edit(Bytes& in) {
    const unsigned what = in.next() % 6;
    const auto& path = datasets_[in.next() % datasets_.size()];
    if (what <= 1) {
      change_value(path, in);
    } else if (what <= 3) {
      replace(path, in);
    } else if (what == 4) {
      change_attribute(in);
    } else {
      remove(path, in.next() % 2 == 0);
    }
  }

 private:
  void change_value(const std::string& path, Bytes& in) {
    const hid_t dataset = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset), type = H5Dget_type(dataset);
    const auto count = H5Sget_simple_extent_npoints(space);
    if (count > 0 && count <= 1024) {
      std::vector<char> values(static_cast<std::size_t>(count) * H5Tget_size(type));
      H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      const auto at = in.next() % static_cast<std::size_t>(count);
      if (H5Tis_variable_str(type) > 0) {  // in memory these are pointers to texts
        std::vector<std::string> texts(static_cast<std::size_t>(count), "surface");
        for (unsigned n = in.next() % 32; n > 0; --n) texts[at] += static_cast<char>(in.next());
        std::vector<const char*> pointers;
        for (const auto& text : texts) pointers.push_back(text.c_str());
        H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data());
        H5Dvlen_reclaim(type, space, H5P_DEFAULT, values.data());
      } else {
        const auto raw = in.number<std::uint64_t>();
        std::memcpy(&values[at * H5Tget_size(type)], &raw, std::min(sizeof raw, H5Tget_size(type)));
        H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      }
    }
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(dataset);
  }

  static hid_t some_type(Bytes& in) {
    static const std::array numbers{H5T_IEEE_F64LE, H5T_STD_I64LE, H5T_IEEE_F32BE, H5T_STD_I8LE, H5T_STD_U64BE};
    const unsigned which = in.next() % (numbers.size() + 2);
    if (which < numbers.size()) return H5Tcopy(numbers[which]);
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, which == numbers.size() ? 1 + in.next() * 256 : H5T_VARIABLE);
    return text;
  }

  // Another type and extent, without values: HDF5 gives zeros for them, whatever the extent.
  void replace(const std::string& path, Bytes& in) {
    H5Ldelete(file_, path.c_str(), H5P_DEFAULT);
    const hid_t type = some_type(in);
    std::vector<hsize_t> shape(in.next() % 4);
    for (auto& extent : shape) extent = in.extent();
    const hid_t space =
        shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const std::vector<hsize_t> chunk(shape.size(), 1);
    if (!shape.empty()) H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    H5Dclose(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    H5Pclose(properties);
    H5Sclose(space);
    H5Tclose(type);
  }

  void change_attribute(Bytes& in) {
    static const std::array names{"format", "format_version", "strandlab_version", "case_hash", "dimensions"};
    const char* name = names[in.next() % names.size()];
    H5Adelete(file_, name);
    if (in.next() % 8 == 0) return;
    const hid_t type = some_type(in);
    std::array<hsize_t, 1> shape{1 + in.next() % 3};
    const hid_t space = H5Screate_simple(1, shape.data(), nullptr);
    const hid_t attribute = H5Acreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute >= 0 && H5Tis_variable_str(type) <= 0) {
      std::vector<char> values(H5Tget_size(type) * shape[0]);
      for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 24); ++i)
        values[i] = static_cast<char>(in.next());
      H5Awrite(attribute, type, values.data());
    }
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
  }

  // Nothing, or a group, in place of a dataset.
  void remove(const std::string& path, bool leave_group) {
    H5Ldelete(file_, path.c_str(), H5P_DEFAULT);
    if (leave_group) H5Gclose(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }

  hid_t file_;
  std::vector<std::string> datasets_;
};

// What the rest of the program may rely on.
void check(const Panel<2>& panel) {
  for (const auto& strand : panel.strands) {
    const auto size = strand.lattice.size();
    fuzz::require(size > 0, "a strand has points");
    for_each_field<2>([&](const auto& field) {
      const auto& values = strand.points.*field.values;
      fuzz::require(values.size() == size || (field.optional && values.empty()),
                    "every list of a strand is as long as its lattice");
    });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  static const std::string good = good_file(folder.file());
  const auto file = folder.file();
  std::ofstream(file, std::ios::binary) << good;
  Bytes in(fuzz::text_of(data, size));
  const bool edited = !in.empty();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  {
    EditedFile edits(file);
    for (int edit = 0; edit < 8 && !in.empty(); ++edit) edits.edit(in);
  }
  const bool panel_read = fuzz::takes([&] { check(io::read_panel<2>(file, "")); });
  const bool checkpoint_read = fuzz::takes([&] { check(io::read_checkpoint<2>(file, "").panel); });
  fuzz::require(edited || (panel_read && checkpoint_read), "the good file can be read");
  return 0;
}
