#include "strandlab/files/text_file.hpp"

#include <fstream>
#include <sstream>

namespace strandlab::files {

std::optional<std::string> read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace strandlab::files
