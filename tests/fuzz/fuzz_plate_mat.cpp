// Mat files of plates: any bytes are a mat or are refused; the file of a mat reads back as the same mat.
#include "harness.hpp"
#include "strandlab/mat/plate.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<mat::RoleAngle> roles{{"surface", 0}, {"core", 90}};
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  mat::PlateMat mat;
  if (!fuzz::takes([&] { mat = mat::read_plate(file.path(), roles); })) return 0;
  const auto text = mat::to_text(mat);
  const fuzz::MemoryFile written(text);
  fuzz::require(mat::to_text(mat::read_plate(written.path(), roles)) == text, "the file of a mat reads back");
  return 0;
}
