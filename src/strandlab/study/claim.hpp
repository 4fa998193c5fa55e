// Who works in a folder of a study: one process at a time.
#pragma once

#include <filesystem>
#include <optional>

namespace strandlab::study {

// Holds the folder's file `lock` (flock) until it goes, also with a process that is killed: nothing has to be cleaned
// up. A child that is forked meanwhile holds it too, and on after its parent. The file is opened for writing, which
// locks over NFS need, and stays.
class Claim {
 public:
  // None where another process holds it. Both throw InputError where the folder cannot be made or the file not be
  // opened, RunError where locks do not work.
  static std::optional<Claim> attempt(const std::filesystem::path& folder);
  // Waits until it is free.
  static Claim wait(const std::filesystem::path& folder);

  ~Claim();
  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&&) = delete;
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  explicit Claim(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace strandlab::study
