#include "process.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

namespace strandlab::app {
namespace {

// OpenBLAS and OpenMP start as many threads as there are cores when they are loaded, and OpenBLAS takes 128 MB of
// address space for each, waiting for ever where a batch system gives less. CHOLMOD is called with one thread.
constexpr std::array kOneThread{"OPENBLAS_NUM_THREADS=1", "OMP_THREAD_LIMIT=1"};

// Whether `entry` of an environment, "NAME=value", sets the same name as `setting`.
bool same_name(const char* entry, const char* setting) {
  const auto length = static_cast<std::size_t>(std::strchr(setting, '=') - setting) + 1;
  return std::strncmp(entry, setting, length) == 0;
}

// The libraries read the environment before main(): the program starts once more where it does not say one thread.
// Runs before any library is initialised (.preinit_array), so that it may call the system and nothing else.
void pin_library_threads(int /*argc*/, char** argv, char** environment) {
  std::array<char*, 4096> changed{};
  std::size_t count = 0, right = 0;
  for (char** entry = environment; *entry != nullptr; ++entry) {
    bool ours = false;
    for (const char* setting : kOneThread) {
      ours = ours || same_name(*entry, setting);
      if (std::strcmp(*entry, setting) == 0) ++right;
    }
    if (ours) continue;
    if (count + kOneThread.size() + 1 >= changed.size()) return;
    changed[count++] = *entry;
  }
  if (right == kOneThread.size()) return;
  for (const char* setting : kOneThread) changed[count++] = const_cast<char*>(setting);
  ::execve("/proc/self/exe", argv, changed.data());  // where that fails the libraries start as they like
}

__attribute__((section(".preinit_array"), used)) void (*const before_libraries)(int, char**,
                                                                                char**) = pin_library_threads;

}  // namespace

void prepare_process() {
  while (true) {
    const int descriptor = ::open("/dev/null", O_RDONLY);
    if (descriptor > STDERR_FILENO) ::close(descriptor);
    if (descriptor < 0 || descriptor > STDERR_FILENO) break;
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace strandlab::app
