// What the user sees while a command works, and the log that keeps it.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace spdlog {
class logger;
}

namespace strandlab::app {

// Part of a result, on standard output. What cannot be written is met by refuse_lost_output().
template <class... T>
void print(fmt::format_string<T...> format, T&&... values) {
  const auto text = fmt::format(format, std::forward<T>(values)...);
  std::fwrite(text.data(), 1, text.size(), stdout);
}

// Throws RunError when something that print() or std::cout wrote did not reach standard output: a table that ends
// early looks like a shorter one. To be called at the end of a command.
void refuse_lost_output();

// Tells the user something on the way (stdout or stderr, by descriptor). Never fails: a terminal may be closed and a
// disk full while a run goes on.
void tell(int descriptor, std::string_view text);

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
