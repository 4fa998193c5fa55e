// log.txt of a run folder: what the observer is told, with date and time.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "strandlab/run/observer.hpp"

namespace spdlog {
class logger;
}

namespace strandlab::run {

// Hands everything on to another observer.
class Log final : public Observer {
 public:
  explicit Log(Observer& observer) : observer_(observer) {}

  // From now on every line also goes to this file. Throws InputError when it cannot be opened.
  void open(const std::filesystem::path& file);

  void say(const std::string& line) override;
  void warn(const std::string& line) override;
  void progress(const Progress& progress) override;  // in the file a line every ten seconds
  bool cancelled() override { return observer_.cancelled(); }
  void keep_error(const std::string& line);  // in the file only: the exception tells the user

 private:
  Observer& observer_;
  std::chrono::steady_clock::time_point last_progress_ = std::chrono::steady_clock::now();
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace strandlab::run
