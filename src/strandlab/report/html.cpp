#include "strandlab/report/html.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "strandlab/core/error.hpp"
#include "strandlab/core/markup.hpp"
#include "strandlab/core/version.hpp"
#include "strandlab/files/text_file.hpp"

// The bundled page becomes part of this object file (CMakeLists.txt names the file where there is one).
#ifdef STRANDLAB_REPORT_PAGE
asm(".pushsection .rodata\n"
    ".global strandlab_report_page\n"
    ".global strandlab_report_page_end\n"
    "strandlab_report_page:\n"
    ".incbin \"" STRANDLAB_REPORT_PAGE
    "\"\n"
    "strandlab_report_page_end:\n"
    ".byte 0\n"
    ".popsection\n");
extern "C" const char strandlab_report_page[], strandlab_report_page_end[];  // NOLINT(modernize-avoid-c-arrays)
#endif

namespace strandlab::report {
namespace {

namespace fs = std::filesystem;

std::string built_in_page() {
#ifdef STRANDLAB_REPORT_PAGE
  return {strandlab_report_page, strandlab_report_page_end};
#else
  return {};
#endif
}

// share/strandlab beside the bin folder that holds the program.
fs::path installed_share() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "share" / "strandlab";
}

}  // namespace

std::string empty_page() {
  const char* share = std::getenv("STRANDLAB_SHARE");
  const bool given = share != nullptr && *share != '\0';
  if (!given) {
    if (auto page = built_in_page(); !page.empty()) return page;
  }
  const auto file = (given ? fs::path(share) : installed_share()) / "report.html";
  if (auto page = files::read_text(file)) return *page;
  throw InputError(
      fmt::format("{}: no report page{}. Get report.html of release {} and put it there, or name its folder in "
                  "STRANDLAB_SHARE; building with Node.js 18 or newer puts it into the program",
                  file.string(), given ? "" : ", and this program was built without Node.js", version()));
}

std::string filled_page(const std::string& page, const Sheet& sheet, const nlohmann::json& data) {
  const auto text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string json;
  json.reserve(text.size() + 1024);
  for (const char c : text) {
    if (c == '<')
      json += "\\u003c";
    else
      json += c;
  }
  std::string filled;
  std::size_t behind = 0;
  for (const auto& [place, content] : {std::pair{"/*strandlab-title*/", escaped_markup(sheet.title)},
                                       {"<!--strandlab-sheet-->", to_html(sheet)},
                                       {"/*strandlab-data*/", json}}) {
    const auto at = page.find(place, behind);
    if (at == std::string::npos) throw InputError("the report page has no place for the data of a run");
    filled.append(page, behind, at - behind).append(content);
    behind = at + std::char_traits<char>::length(place);
  }
  return filled.append(page, behind);
}

}  // namespace strandlab::report
