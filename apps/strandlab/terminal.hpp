// What the user sees while a command works.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "strandlab/run/observer.hpp"

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

// A warning on standard error, as a run's.
void warn(const std::string& line);

// A run as the terminal shows it.
class Terminal final : public run::Observer {
 public:
  Terminal();
  ~Terminal() override;

  void say(const std::string& line) override;
  void warn(const std::string& line) override;
  // On a terminal one line that is written over; else a plain line every ten seconds.
  void progress(const run::Progress& progress) override;

 private:
  void clear_progress();

  bool terminal_ = false;
  bool line_open_ = false;
  std::chrono::steady_clock::time_point last_plain_line_;
};

}  // namespace strandlab::app
