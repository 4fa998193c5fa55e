#include "console.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
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

Console::Console() : terminal_(::isatty(STDOUT_FILENO) == 1), last_plain_line_(std::chrono::steady_clock::now()) {}

Console::~Console() {
  clear_progress();
}

void Console::log_to(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string());
    log_ = std::make_shared<spdlog::logger>("strandlab", sink);
  } catch (const spdlog::spdlog_ex& e) {
    throw InputError(fmt::format("{}: cannot write the log: {}", file.string(), e.what()));
  }
  log_->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  log_->flush_on(spdlog::level::info);
}

void Console::clear_progress() {
  if (line_open_) tell(STDOUT_FILENO, "\r\x1b[K");
  line_open_ = false;
}

void Console::say(const std::string& line) {
  clear_progress();
  tell(STDOUT_FILENO, printable(line) + "\n");
  if (log_) log_->info(printable(line));
}

void Console::warn(const std::string& line) {
  clear_progress();
  tell(STDERR_FILENO, fmt::format("warning: {}\n", printable(line)));
  if (log_) log_->warn(printable(line));
}

void Console::log_error(const std::string& line) {
  clear_progress();
  if (log_) log_->error(printable(line));
}

void Console::progress(const std::string& line) {
  using namespace std::chrono_literals;
  if (terminal_) {
    tell(STDOUT_FILENO, "\r\x1b[K" + line);
    line_open_ = true;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - last_plain_line_ < 10s) return;
  last_plain_line_ = now;
  if (!terminal_) tell(STDOUT_FILENO, line + "\n");
  if (log_) log_->info(line);
}

}  // namespace strandlab::app
