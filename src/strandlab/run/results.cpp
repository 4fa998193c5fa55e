#include "strandlab/run/results.hpp"

#include <fmt/format.h>

#include <system_error>

#include "strandlab/core/error.hpp"

namespace strandlab::run {

void refuse_results(const std::filesystem::path& file, bool force) {
  std::error_code error;
  if (force || !std::filesystem::exists(file, error)) return;
  throw InputError(
      fmt::format("{} holds results; --force overwrites them, -o names another folder", file.parent_path().string()));
}

}  // namespace strandlab::run
