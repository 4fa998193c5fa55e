// What the fuzzing harnesses share. A harness takes any bytes for one kind of input: the reader under test may take
// them or refuse them with an InputError, and everything else ends the process, which counts as a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "strandlab/core/error.hpp"

// Each harness defines it; called by libFuzzer, or by replay.cpp with the files of the corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace strandlab::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Bytes under a name that readers of files can open; nothing reaches the disk.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const;

 private:
  int descriptor_;
};

// Ends the process and says why: a promise of the reader does not hold.
void require(bool holds, const char* promise);

// Does `read` take its input? False where it refuses it by an InputError with a message.
template <class Read>
bool takes(const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& refusal) {
    require(*refusal.what() != '\0', "a refusal says why");
    return false;
  }
}

}  // namespace strandlab::fuzz
