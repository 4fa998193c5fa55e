// Checkpoints of a press run and snapshots of panels in HDF5 files that other tools can read: every dataset has a
// "unit" and a "description", the root says the format, its version and the case. Doubles come back bit for bit.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "strandlab/press/press.hpp"

namespace strandlab::io {

// Writes one file (temporary file, sync, rename). `case_hash` says which case the state belongs to and is compared on
// reading. Throws InputError for a folder that is missing or may not be written, RunError for a full or failing disk;
// an existing file then stays as it was. Dim is 2 or 3.
template <int Dim>
void write_checkpoint(const press::Checkpoint<Dim>& checkpoint, const std::string& case_hash,
                      const std::filesystem::path& file);
template <int Dim>
void write_panel(const Panel<Dim>& panel, const std::string& case_hash, const std::filesystem::path& file);

// Reads one file. Throws InputError naming the file and why it cannot be used: missing, not HDF5, truncated, damaged
// (every dataset has a checksum), not written by strandlab, another format version, number of dimensions or case. An
// empty `case_hash` accepts any case. A checkpoint file also reads as a panel.
template <int Dim>
press::Checkpoint<Dim> read_checkpoint(const std::filesystem::path& file, const std::string& case_hash);
template <int Dim>
Panel<Dim> read_panel(const std::filesystem::path& file, const std::string& case_hash);

// The two newest checkpoints of a run: "checkpoint.h5" and, one older, "checkpoint.previous.h5" in `folder`. A run
// killed at any moment leaves at least one that is complete.
class CheckpointStore {
 public:
  CheckpointStore(std::filesystem::path folder, std::string case_hash);

  std::filesystem::path newest() const;
  std::filesystem::path previous() const;
  bool exists() const;  // either file

  // The newest becomes the previous one. Throws as write_checkpoint(); both files then stay as they were.
  template <int Dim>
  void save(const press::Checkpoint<Dim>& checkpoint) const;

  // The newest checkpoint that can be read; where that is not the newest file, `warnings` (may be null) gets a sentence
  // saying why. Nothing when there is no checkpoint. Throws InputError when there are files and none can be used.
  template <int Dim>
  std::optional<press::Checkpoint<Dim>> load(std::vector<std::string>* warnings) const;

 private:
  void keep_newest() const;
  std::filesystem::path folder_;
  std::string case_hash_;
};

}  // namespace strandlab::io
