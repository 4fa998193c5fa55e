#include "strandlab/run/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"

namespace strandlab::run {

void Log::open(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string());
    log_ = std::make_shared<spdlog::logger>("strandlab", sink);
  } catch (const spdlog::spdlog_ex& e) {
    throw InputError(fmt::format("{}: cannot write the log: {}", file.string(), e.what()));
  }
  log_->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  log_->flush_on(spdlog::level::info);
}

void Log::say(const std::string& line) {
  observer_.say(line);
  if (log_) log_->info(printable(line));
}

void Log::warn(const std::string& line) {
  observer_.warn(line);
  if (log_) log_->warn(printable(line));
}

void Log::progress(const Progress& progress) {
  using namespace std::chrono_literals;
  observer_.progress(progress);
  const auto now = std::chrono::steady_clock::now();
  if (!log_ || now - last_progress_ < 10s) return;
  last_progress_ = now;
  log_->info(line_of(progress));
}

void Log::keep_error(const std::string& line) {
  if (log_) log_->error(printable(line));
}

}  // namespace strandlab::run
