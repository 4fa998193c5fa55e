#include "strandlab/study/claim.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"

namespace strandlab::study {
namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

int open_lock(const std::filesystem::path& folder) {
  files::make_folder(folder);
  const auto file = folder / "lock";
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor >= 0) return descriptor;
  const int error = errno;
  const auto message = fmt::format("cannot write {}: {}", file.string(), reason(error));
  if (error == ENOSPC || error == EDQUOT || error == EIO) throw RunError(message);
  throw InputError(message);
}

// Whether the lock is held now.
bool lock(int descriptor, int how, const std::filesystem::path& folder) {
  while (::flock(descriptor, how) != 0) {
    const int error = errno;
    if (error == EINTR) continue;
    ::close(descriptor);
    if (error == EWOULDBLOCK) return false;
    throw RunError(fmt::format("{}: cannot be locked: {}", (folder / "lock").string(), reason(error)));
  }
  return true;
}

}  // namespace

std::optional<Claim> Claim::attempt(const std::filesystem::path& folder) {
  const int descriptor = open_lock(folder);
  if (!lock(descriptor, LOCK_EX | LOCK_NB, folder)) return std::nullopt;
  return Claim(descriptor);
}

Claim Claim::wait(const std::filesystem::path& folder) {
  const int descriptor = open_lock(folder);
  lock(descriptor, LOCK_EX, folder);
  return Claim(descriptor);
}

Claim::~Claim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Claim::Claim(Claim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace strandlab::study
