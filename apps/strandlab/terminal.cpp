#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"

namespace strandlab::app {

void refuse_lost_output() {
  errno = 0;
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (!lost) return;
  const auto why = errno != 0 ? std::generic_category().message(errno) : "an earlier part was lost";
  throw RunError(fmt::format("cannot write all of the result to standard output: {}", why));
}

void tell(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

void warn(const std::string& line) {
  tell(STDERR_FILENO, fmt::format("warning: {}\n", printable(line)));
}

Terminal::Terminal() : terminal_(::isatty(STDOUT_FILENO) == 1), last_plain_line_(std::chrono::steady_clock::now()) {}

Terminal::~Terminal() {
  clear_progress();
}

void Terminal::clear_progress() {
  if (line_open_) tell(STDOUT_FILENO, "\r\x1b[K");
  line_open_ = false;
}

void Terminal::say(const std::string& line) {
  clear_progress();
  tell(STDOUT_FILENO, printable(line) + "\n");
}

void Terminal::warn(const std::string& line) {
  clear_progress();
  app::warn(line);
}

void Terminal::progress(const run::Progress& progress) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (terminal_) {
    tell(STDOUT_FILENO, "\r\x1b[K" + run::line_of(progress));
    line_open_ = true;
  } else if (now - last_plain_line_ >= 10s) {
    last_plain_line_ = now;
    tell(STDOUT_FILENO, run::line_of(progress) + "\n");
  }
}

}  // namespace strandlab::app
