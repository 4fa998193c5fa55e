// Case files: any text is a case or is refused; the resolved text of a case reads back as the same case.
#include "harness.hpp"
#include "strandlab/io/case.hpp"
#include "strandlab/io/case_write.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  io::Case c;
  if (!fuzz::takes([&] { c = io::case_from_text(std::string(fuzz::text_of(data, size)), "case.toml"); })) return 0;
  const auto text = io::resolved_text(c);
  fuzz::require(io::resolved_text(io::case_from_text(text, "resolved.toml")) == text, "a resolved case reads back");
  return 0;
}
