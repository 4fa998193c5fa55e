#include "strandlab/files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <optional>
#include <regex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "strandlab/core/error.hpp"

namespace strandlab::files {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
  return std::generic_category().message(error);
}

// The user chose a place that cannot be written (InputError), or the disk fails under a run (RunError).
[[noreturn]] void fail(const fs::path& file, const std::string& what, int error) {
  const std::string message = fmt::format("cannot write {}: {}: {}", file.string(), what, reason(error));
  if (error == EACCES || error == EPERM || error == EROFS || error == ENOENT || error == ENOTDIR || error == EISDIR ||
      error == ENAMETOOLONG || error == ELOOP) {
    throw InputError(message);
  }
  throw RunError(message);
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }
  int close() {  // reports what a delayed write met; 0 when well
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void check_place(const fs::path& file) {
  std::error_code error;
  const fs::path folder = folder_of(file);
  if (!fs::exists(folder, error)) {
    if (error) fail(file, fmt::format("cannot use the folder {}", folder.string()), error.value());
    throw InputError(fmt::format("cannot write {}: the folder {} does not exist", file.string(), folder.string()));
  }
  if (fs::is_directory(file, error)) {
    throw InputError(fmt::format("cannot write {}: there is a folder of that name", file.string()));
  }
}

// Makes the rename itself last. Some file systems cannot sync folders; the rename is then as safe as they make it.
void sync_folder(const fs::path& folder) {
  const Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.valid()) ::fsync(fd.get());
}

// Opens a new file beside `file`. Another process of the same number, on another machine or before a kill, may have the
// name: then the next number is tried.
std::pair<fs::path, Descriptor> open_temporary(const fs::path& file) {
  while (true) {
    fs::path temporary = temporary_name(file);
    Descriptor fd(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (fd.valid()) return {std::move(temporary), std::move(fd)};
    if (errno != EEXIST) fail(file, "cannot create a file in that folder", errno);
  }
}

// Bytes on disk when it returns. `file` is the name the user knows.
void write_synced(Descriptor& fd, const fs::path& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(file, "writing failed", errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  if (::fsync(fd.get()) != 0) fail(file, "cannot sync to disk", errno);
  if (const int error = fd.close()) fail(file, "writing failed", error);
}

// The process that made a temporary file, by its name; nothing for another file.
std::optional<pid_t> process_of(const fs::path& file) {
  static const std::regex temporary(R"(.+\.(\d+)-\d+\.tmp)");
  std::smatch match;
  const auto name = file.filename().string();
  if (!std::regex_match(name, match, temporary)) return std::nullopt;
  const auto digits = match[1].str();
  pid_t process = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), process);  // 0: a number that no process has
  return process;
}

bool runs(pid_t process) {
  return process > 0 && (::kill(process, 0) == 0 || errno == EPERM);
}

}  // namespace

void write_atomically(const fs::path& file, std::string_view bytes, const std::function<void()>& before_rename) {
  check_place(file);
  auto [temporary, fd] = open_temporary(file);
  try {
    write_synced(fd, file, bytes);
    if (before_rename) before_rename();
    if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "cannot rename the temporary file", errno);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_folder(folder_of(file));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(
        fmt::format("cannot make the folder {}: {}; choose another with -o", folder.string(), error.message()));
  }
}

fs::path temporary_name(const fs::path& file) {
  static std::atomic<unsigned> number{0};
  fs::path temporary = file;
  temporary += fmt::format(".{}-{}.tmp", ::getpid(), ++number);
  return temporary;
}

bool is_temporary(const fs::path& file) {
  return process_of(file).has_value();
}

void remove_abandoned(const fs::path& folder, std::string_view name) {
  std::vector<fs::path> abandoned;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto process = process_of(entry.path());
    if (process && !runs(*process) && entry.path().filename().string().starts_with(name))
      abandoned.push_back(entry.path());
  }
  for (const auto& file : abandoned) fs::remove(file);
}

}  // namespace strandlab::files
