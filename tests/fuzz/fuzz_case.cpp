// Case files: any text is a case or is refused; the resolved text of a case reads back as the same case.
#include "harness.hpp"
#include "strandlab/case/case.hpp"
#include "strandlab/case/write.hpp"

using namespace strandlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cases::Case c;
  if (!fuzz::takes([&] { c = cases::case_from_text(std::string(fuzz::text_of(data, size)), "case.toml"); })) return 0;
  const auto text = cases::resolved_text(c);
  fuzz::require(cases::resolved_text(cases::case_from_text(text, "resolved.toml")) == text,
                "a resolved case reads back");
  return 0;
}
