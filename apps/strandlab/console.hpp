// What the user sees while a command works, and the log that keeps it.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace strandlab::app {

class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  // From now on every line also goes to this file, with date and time. Throws InputError when it cannot be opened.
  void log_to(const std::filesystem::path& file);

  void say(const std::string& line);
  void warn(const std::string& line);
  void log_error(const std::string& line);  // main() tells the user
  // On a terminal one line that is written over; else, and in the log, a plain line every ten seconds.
  void progress(const std::string& line);

 private:
  void clear_progress();

  bool terminal_ = false;
  bool line_open_ = false;
  std::chrono::steady_clock::time_point last_plain_line_;
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace strandlab::app
