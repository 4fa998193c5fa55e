// Mat files: any bytes are a mat or are refused; the file of a mat reads back as the same mat.
#include "harness.hpp"
#include "strandlab/mat/mat.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(fuzz::text_of(data, size));
  fuzz::takes([&] { mat::read(file.path(), {"surface", "core"}); });
  mat::Mat mat;
  if (!fuzz::takes([&] { mat = mat::read(file.path(), {}); })) return 0;
  const auto text = mat::to_text(mat);
  const fuzz::MemoryFile written(text);
  fuzz::require(mat::to_text(mat::read(written.path(), {})) == text, "the file of a mat reads back");
  return 0;
}
