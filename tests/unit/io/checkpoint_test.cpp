#include "strandlab/io/checkpoint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/wait.h>

#include <bit>
#include <chrono>
#include <cstdint>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/core/members.hpp"
#include "support/temporary_folder.hpp"
#include "support/unwritable.hpp"

// For the leak checker of the debug build: HDF5 1.10 forgets some of its memory when it refuses a damaged file.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}  // NOLINT(bugprone-reserved-identifier)

namespace strandlab::io {
namespace {

using press::Checkpoint;
using test::contents;
using test::message_of;
using test::put;
using test::TemporaryFolder;

constexpr const char* kHash = "8f3a";

// Doubles of any bit pattern: a file that converts, rounds or normalises them would change some.
class AnyDouble {
 public:
  double operator()() { return std::bit_cast<double>(random_()); }

 private:
  std::mt19937_64 random_{20};
};

press::Record any_record(AnyDouble& any) {
  return {any(), any(), any(), any(), any(), any(), any(), any(), any(), any(), any(), any()};
}

template <int Dim>
Strand<Dim> any_strand(AnyDouble& any, int row, std::array<int, Dim> points) {
  const auto fill = [&any](auto& matrix) {
    for (auto& value : matrix.reshaped()) value = any();
  };
  Strand<Dim> strand;
  strand.kind = row == 0 ? "surface" : "core of the mat";
  strand.row = row;
  strand.angle_deg = any();
  strand.stiffness_factor = any();
  strand.lattice.counts = points;
  fill(strand.lattice.spacing);
  strand.material.density = any();
  fill(strand.material.stiffness);
  fill(strand.material.yield_surface);
  strand.material.hardening = {{any(), any(), any()}, {any(), any(), any(), any(), any()}};
  for_each_field<Dim>([&](const auto& field) {
    auto& values = strand.points.*field.values;
    set_zero(values, strand.lattice.size());
    for (auto& value : values) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
        value = any();
      } else {
        fill(value);
      }
    }
  });
  return strand;
}

template <int Dim>
Checkpoint<Dim> any_checkpoint() {
  AnyDouble any;
  Checkpoint<Dim> c;
  c.panel.length_mm = any();
  c.panel.depth_mm = any();
  c.panel.initial_thickness_mm = any();
  c.panel.bottom_mm = any();
  c.panel.top_mm = any();
  c.panel.time_s = any();
  if constexpr (Dim == 2) {
    c.panel.strands = {any_strand<2>(any, 0, {40, 6}), any_strand<2>(any, 1, {7, 3})};
  } else {
    c.panel.periodic = true;
    c.panel.strands = {any_strand<3>(any, 0, {9, 4, 3}), any_strand<3>(any, 2, {5, 2, 3})};
  }
  c.engine = {123456789012LL, any(),          any(),
              {any(), any()}, {any(), any()}, {any(), any(), any(), any(), any(), any(), any(), any()},
              98765432109LL};
  for (int i = 0; i < 5; ++i) c.records.push_back(any_record(any));
  c.pending = any_record(any);
  c.snapshots_done = 3;
  for (double* value : {&c.balance_time_s, &c.balance_top, &c.balance_bottom, &c.worst_imbalance, &c.worst_kinetic}) {
    *value = any();
  }
  return c;
}

// All of a state's bits in a fixed order, to compare NaN with NaN and -0 with 0 as the bits they are.
class Bits {
 public:
  void add(double value) { bits_.push_back(std::bit_cast<std::uint64_t>(value)); }
  void add(long long value) { bits_.push_back(static_cast<std::uint64_t>(value)); }
  void add(int value) { add(static_cast<long long>(value)); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& matrix) {
    for (const double value : matrix.reshaped()) add(value);
  }
  void add(const press::Record& r) {
    for (const double value :
         {r.compaction, r.time_ms, r.stress_MPa, r.force_top_N, r.force_bottom_N, r.kinetic_mJ, r.elastic_mJ,
          r.plastic_mJ, r.friction_mJ, r.contact_mJ, r.filter_mJ, r.platen_work_mJ}) {
      add(value);
    }
  }
  void add(const mpm::EngineState& s) {
    for_each_member(s, [this](auto number) { add(number); });
  }
  template <int Dim>
  void add(const Strand<Dim>& s) {
    for (const char c : s.kind) add(static_cast<long long>(c));
    add(static_cast<long long>(s.row));
    for (const int extent : s.lattice.counts) add(static_cast<long long>(extent));
    add(s.angle_deg);
    add(s.lattice.spacing);
    add(s.material.density);
    add(s.material.stiffness);
    add(s.material.yield_surface);
    const auto& [hill, k] = s.material.hardening;
    for (const double value : {hill.Y_R, hill.K, hill.n}) add(value);
    for (const double value : {k.limit, k.x0, k.h1, k.h2, k.exponent}) add(value);
    for_each_field<Dim>([&](const auto& field) {
      for (const auto& value : s.points.*field.values) add(value);
    });
  }
  template <int Dim>
  void add(const Panel<Dim>& p) {
    for (const double value : {p.length_mm, p.depth_mm, p.initial_thickness_mm, p.bottom_mm, p.top_mm, p.time_s}) {
      add(value);
    }
    add(p.periodic ? 1.0 : 0.0);
    for (const auto& strand : p.strands) add(strand);
  }
  bool operator==(const Bits&) const = default;

 private:
  std::vector<std::uint64_t> bits_;
};

template <int Dim>
Bits bits(const Panel<Dim>& panel) {
  Bits out;
  out.add(panel);
  return out;
}

template <int Dim>
Bits bits(const Checkpoint<Dim>& c) {
  Bits out;
  out.add(c.panel);
  out.add(c.engine);
  for (const auto& record : c.records) out.add(record);
  out.add(c.pending);
  out.add(static_cast<long long>(c.snapshots_done));
  for (const double value : {c.balance_time_s, c.balance_top, c.balance_bottom, c.worst_imbalance, c.worst_kinetic}) {
    out.add(value);
  }
  return out;
}

void expect_contains(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << "\"" << message << "\" does not say \"" << part << "\"";
}

class CheckpointFile : public testing::Test {
 protected:
  CheckpointFile() { write_checkpoint(state_, kHash, file_); }
  std::string refusal() const {
    return message_of<InputError>([this] { read_checkpoint<2>(file_, kHash); });
  }
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "state.h5";
  Checkpoint<2> state_ = any_checkpoint<2>();
};

TEST_F(CheckpointFile, ComesBackBitForBit) {
  EXPECT_EQ(bits(read_checkpoint<2>(file_, kHash)), bits(state_));
  EXPECT_EQ(folder_.files(), 1U);
}

TEST_F(CheckpointFile, ComesBackBitForBitIn3D) {
  const auto state = any_checkpoint<3>();
  write_checkpoint(state, kHash, file_);
  EXPECT_EQ(bits(read_checkpoint<3>(file_, kHash)), bits(state));
}

TEST_F(CheckpointFile, EmptyStateComesBack) {
  const Checkpoint<2> nothing;
  write_checkpoint(nothing, "", file_);
  EXPECT_EQ(bits(read_checkpoint<2>(file_, "")), bits(nothing));
}

TEST_F(CheckpointFile, TheSameStateGivesTheSameBytes) {
  const std::string first = contents(file_);
  write_checkpoint(state_, kHash, file_);
  EXPECT_EQ(contents(file_), first);
}

TEST_F(CheckpointFile, ReadsAsAPanel) {
  EXPECT_EQ(bits(read_panel<2>(file_, kHash)), bits(state_.panel));
  write_panel(state_.panel, kHash, file_);
  EXPECT_EQ(bits(read_panel<2>(file_, kHash)), bits(state_.panel));
  expect_contains(refusal(), "its format is \"strandlab panel\", expected \"strandlab checkpoint\"");
}

// Other tools find the unit of every dataset beside it.
TEST_F(CheckpointFile, EveryDatasetSaysItsUnit) {
  const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  struct Count {
    int datasets = 0, labelled = 0;
  } count;
  const auto visit = [](hid_t object, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    if (info->type != H5O_TYPE_DATASET) return 0;
    auto& c = *static_cast<Count*>(data);
    ++c.datasets;
    if (H5Aexists_by_name(object, name, "unit", H5P_DEFAULT) > 0 &&
        H5Aexists_by_name(object, name, "description", H5P_DEFAULT) > 0) {
      ++c.labelled;
    }
    return 0;
  };
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &count);
  H5Fclose(file);
  EXPECT_EQ(count.datasets,
            6 + 3 + 14 + 12 + 20 + 14 + 14 + 6);  // frame, strands, points, engine, records, pending, press
  EXPECT_EQ(count.labelled, count.datasets);
}

TEST_F(CheckpointFile, MissingFileIsRefused) {
  std::filesystem::remove(file_);
  expect_contains(refusal(), "cannot read " + file_.string() + ": No such file or directory");
}

TEST_F(CheckpointFile, TextFileIsRefused) {
  put(file_, "{\"length_mm\": 100}");
  EXPECT_EQ(refusal(), "cannot use " + file_.string() + ": this is not an HDF5 file");
  put(file_, "");
  EXPECT_EQ(refusal(), "cannot use " + file_.string() + ": the file is empty");
}

TEST_F(CheckpointFile, ForeignHdf5IsRefused) {
  H5Fclose(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  expect_contains(refusal(), "was not written by strandlab");
}

TEST_F(CheckpointFile, OtherCaseDimensionOrVersionIsRefused) {
  expect_contains(message_of<InputError>([&] { read_checkpoint<2>(file_, "77"); }),
                  "it belongs to another case (hash 8f3a, this case has 77)");
  expect_contains(message_of<InputError>([&] { read_checkpoint<3>(file_, kHash); }),
                  "it holds a 2-dimensional state, expected 3 dimensions");
  const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
  const std::int64_t later = 99;
  H5Awrite(attribute, H5T_NATIVE_INT64, &later);
  H5Aclose(attribute);
  H5Fclose(file);
  expect_contains(refusal(), "its format version is 99");
}

// A state whose lattice does not account for its points (written by a tool, not by us) is named, not read past its end.
TEST_F(CheckpointFile, LatticeThatDoesNotFitIsRefused) {
  const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(file, "/panel/strands/points", H5P_DEFAULT);
  const std::int64_t lattice[] = {40, 6, 7, 4};
  H5Dwrite(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, lattice);
  H5Dclose(dataset);
  H5Fclose(file);
  expect_contains(refusal(), "strand 1 of 7 x 4 points goes beyond the 261 points stored");
}

// Replaces a dataset by one that claims these extents and stores nothing.
void claim(const std::filesystem::path& path, const char* dataset, const std::vector<hsize_t>& extents, hid_t type) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, dataset, H5P_DEFAULT);
  const auto rank = static_cast<int>(extents.size());
  const hid_t space = H5Screate_simple(rank, extents.data(), nullptr);
  const hid_t chunked = H5Pcreate(H5P_DATASET_CREATE);
  const std::vector<hsize_t> chunk(extents.size(), 1);
  H5Pset_chunk(chunked, rank, chunk.data());
  H5Dclose(H5Dcreate2(file, dataset, type, space, H5P_DEFAULT, chunked, H5P_DEFAULT));
  H5Pclose(chunked);
  H5Sclose(space);
  H5Fclose(file);
}

// Extents whose product wraps around or is beyond any memory are refused by what is stored, before they are allocated.
TEST_F(CheckpointFile, ExtentsBeyondWhatIsStoredAreRefused) {
  constexpr hsize_t kOne = 1;
  const std::filesystem::path whole = folder_ / "whole.h5";
  std::filesystem::copy_file(file_, whole);
  struct Claim {
    const char* dataset;
    std::vector<hsize_t> extents;
    hid_t type;
  };
  for (const auto& [dataset, extents, type] :
       {Claim{"/panel/strands/row", {kOne << 40}, H5T_STD_I64LE},
        Claim{"/panel/strands/points", {kOne << 24, kOne << 40}, H5T_STD_I64LE},
        Claim{"/panel/points/plastic_strain", {kOne << 32, kOne << 32}, H5T_IEEE_F64LE},
        Claim{"/panel/points/plastic_strain", {kOne << 40, 0}, H5T_IEEE_F64LE},
        Claim{"/records/compaction", {kOne << 34}, H5T_IEEE_F64LE}}) {
    std::filesystem::copy_file(whole, file_, std::filesystem::copy_options::overwrite_existing);
    claim(file_, dataset, extents, type);
    expect_contains(refusal(), fmt::format("dataset {} claims {} values, but only 0 bytes are stored", dataset,
                                           fmt::join(extents, " x ")));
  }
}

TEST_F(CheckpointFile, MissingDatasetIsNamed) {
  const hid_t file = H5Fopen(file_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "/engine/time_s", H5P_DEFAULT);
  H5Fclose(file);
  expect_contains(refusal(), "dataset /engine/time_s is missing");
}

TEST_F(CheckpointFile, TruncatedFileIsRefusedAtEveryLength) {
  const std::string whole = contents(file_);
  for (std::size_t length = 1; length < whole.size(); length += 1 + length / 20) {
    put(file_, whole.substr(0, length));
    expect_contains(refusal(), file_.string());
  }
  put(file_, whole.substr(0, whole.size() - 1));
  expect_contains(refusal(), "truncated");
}

// Every byte that means anything has a checksum: a flipped bit is either found or in padding.
TEST_F(CheckpointFile, FlippedBitsAreNeverTakenForData) {
  const std::string whole = contents(file_);
  const Bits expected = bits(state_);
  std::mt19937 random(3);
  int refused = 0;
  const int trials = 400;
  for (int i = 0; i < trials; ++i) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] ^= static_cast<char>(1U << random() % 8);
    put(file_, damaged);
    try {
      EXPECT_EQ(bits(read_checkpoint<2>(file_, kHash)), expected);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, trials / 2);
}

TEST_F(CheckpointFile, PlacesThatCannotBeWrittenLeaveTheOldFile) {
  const std::string whole = contents(file_);
  auto later = state_;
  later.snapshots_done = 4;
  EXPECT_THROW(write_checkpoint(later, kHash, folder_ / "none" / "state.h5"), InputError);
  {
    const test::ReadOnly locked(folder_.path());
    EXPECT_THROW(write_checkpoint(later, kHash, file_), InputError);
  }
  {
    const test::FullDisk full(4096);
    EXPECT_THROW(write_checkpoint(later, kHash, file_), RunError);
  }
  EXPECT_EQ(contents(file_), whole);
  EXPECT_EQ(folder_.files(), 1U);
}

class Store : public testing::Test {
 protected:
  Checkpoint<2> at(int n) const {
    auto state = any_checkpoint<2>();
    state.snapshots_done = n;
    return state;
  }
  TemporaryFolder folder_;
  CheckpointStore store_{folder_.path(), kHash};
  std::vector<std::string> warnings_;
};

TEST_F(Store, IsEmptyBeforeTheFirstCheckpoint) {
  EXPECT_FALSE(store_.exists());
  EXPECT_FALSE(store_.load<2>(&warnings_).has_value());
  put(folder_ / "checkpoint.h5.tmp", "killed while writing the very first one");
  EXPECT_FALSE(store_.load<2>(&warnings_).has_value());
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(Store, KeepsTheLastTwo) {
  for (int n = 1; n <= 4; ++n) store_.save(at(n));
  EXPECT_EQ(read_checkpoint<2>(store_.newest(), kHash).snapshots_done, 4);
  EXPECT_EQ(read_checkpoint<2>(store_.previous(), kHash).snapshots_done, 3);
  EXPECT_EQ(folder_.files(), 2U);
  EXPECT_EQ(bits(*store_.load<2>(&warnings_)), bits(at(4)));
  EXPECT_TRUE(warnings_.empty());
}

// Killed after the newest file took its second name and before the next one took its first: both names are one file.
TEST_F(Store, LeavesNoThirdNameWhenBothAreOneFile) {
  store_.save(at(1));
  std::filesystem::create_hard_link(store_.newest(), store_.previous());
  store_.save(at(2));
  EXPECT_EQ(read_checkpoint<2>(store_.newest(), kHash).snapshots_done, 2);
  EXPECT_EQ(read_checkpoint<2>(store_.previous(), kHash).snapshots_done, 1);
  EXPECT_EQ(folder_.files(), 2U);
}

TEST_F(Store, FallsBackToThePreviousOneWithAWarning) {
  store_.save(at(1));
  store_.save(at(2));
  put(store_.newest(), contents(store_.newest()).substr(0, 3000));
  EXPECT_EQ(bits(*store_.load<2>(&warnings_)), bits(at(1)));
  ASSERT_EQ(warnings_.size(), 1U);
  expect_contains(warnings_[0], store_.newest().string());
  expect_contains(warnings_[0], "going on from " + store_.previous().string());
}

TEST_F(Store, RefusesWhenNoneCanBeUsed) {
  store_.save(at(1));
  store_.save(at(2));
  put(store_.newest(), "no");
  put(store_.previous(), "no");
  const std::string message = message_of<InputError>([&] { store_.load<2>(&warnings_); });
  expect_contains(message, store_.newest().string());
  expect_contains(message, store_.previous().string());
}

TEST_F(Store, FullDiskLeavesBoth) {
  store_.save(at(1));
  store_.save(at(2));
  {
    const test::FullDisk full(4096);
    EXPECT_THROW(store_.save(at(3)), RunError);
  }
  EXPECT_EQ(read_checkpoint<2>(store_.newest(), kHash).snapshots_done, 2);
  EXPECT_EQ(read_checkpoint<2>(store_.previous(), kHash).snapshots_done, 1);
}

// A process that does nothing but save checkpoints is killed at moments spread over many saves; what it leaves is
// always a whole checkpoint of the last saves it had begun.
TEST_F(Store, SurvivesBeingKilledAtAnyMoment) {
  for (int round = 0; round < 25; ++round) {
    store_.save(at(0));
    const pid_t child = fork();
    if (child == 0) {
      for (int n = 1;; ++n) store_.save(at(n));
    }
    ASSERT_GT(child, 0);
    std::this_thread::sleep_for(std::chrono::microseconds(5000 + 1700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto left = store_.load<2>(&warnings_);
    ASSERT_TRUE(left.has_value());
    EXPECT_EQ(bits(*left), bits(at(left->snapshots_done)));
  }
  EXPECT_TRUE(warnings_.empty());
}

}  // namespace
}  // namespace strandlab::io
