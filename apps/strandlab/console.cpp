#include "console.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"

namespace strandlab::app {

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
  if (line_open_) fmt::print("\r\x1b[K");
  std::fflush(stdout);
  line_open_ = false;
}

void Console::say(const std::string& line) {
  clear_progress();
  fmt::print("{}\n", printable(line));
  std::fflush(stdout);
  if (log_) log_->info(printable(line));
}

void Console::warn(const std::string& line) {
  clear_progress();
  fmt::print(stderr, "warning: {}\n", printable(line));
  if (log_) log_->warn(printable(line));
}

void Console::log_error(const std::string& line) {
  clear_progress();
  if (log_) log_->error(printable(line));
}

void Console::progress(const std::string& line) {
  using namespace std::chrono_literals;
  if (terminal_) {
    fmt::print("\r\x1b[K{}", line);
    std::fflush(stdout);
    line_open_ = true;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - last_plain_line_ < 10s) return;
  last_plain_line_ = now;
  if (!terminal_) fmt::print("{}\n", line);
  std::fflush(stdout);
  if (log_) log_->info(line);
}

}  // namespace strandlab::app
