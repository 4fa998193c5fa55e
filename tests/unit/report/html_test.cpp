// A page takes its data as text, whatever they say.
#include "strandlab/report/html.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "strandlab/core/error.hpp"
#include "support/temporary_folder.hpp"

namespace strandlab::report {
namespace {

constexpr const char* kPage =
    "<title>/*strandlab-title*/</title><main><!--strandlab-sheet--></main><script "
    "type=\"application/json\">/*strandlab-data*/</script><p>after</p>";
const Sheet kSheet{"board", {}, {}, {}, {}, {}};

TEST(FilledPage, HostileNamesStayText) {
  const std::string name = "</script><script>alert('\"\\')</script><!-- \xF0\x9F\xAA\xB5 \n & \xE2\x80\xA8";
  const auto filled = filled_page(kPage, kSheet, {{name, name}});
  const auto begin = filled.find("json\">") + 6, end = filled.find("</script><p>after</p>");
  ASSERT_NE(end, std::string::npos);
  const auto data = filled.substr(begin, end - begin);
  EXPECT_EQ(data.find('<'), std::string::npos) << data;
  EXPECT_EQ(nlohmann::json::parse(data).at(name), name);
}

TEST(FilledPage, BytesThatAreNotTextAreReplaced) {
  const auto filled = filled_page(kPage, kSheet, {{"name", "a\xFF"}});
  EXPECT_NE(filled.find("a\xEF\xBF\xBD"), std::string::npos) << "by U+FFFD";
}

TEST(FilledPage, WithoutAPlaceForDataIsRefused) {
  EXPECT_THROW(filled_page("<html></html>", kSheet, {}), InputError);
}

TEST(FilledPage, HasTitleAndSheet) {
  const auto filled = filled_page(kPage, kSheet, {});
  EXPECT_NE(filled.find("<title>board</title>"), std::string::npos);
  EXPECT_NE(filled.find("<h1>board</h1>"), std::string::npos);
}

class Share : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("STRANDLAB_SHARE", folder_.path().c_str(), 1); }
  void TearDown() override { ::unsetenv("STRANDLAB_SHARE"); }
  test::TemporaryFolder folder_;
};

TEST_F(Share, GivesThePage) {
  test::put(folder_ / "report.html", kPage);
  EXPECT_EQ(empty_page(), kPage);
}

TEST_F(Share, WithoutAPageSaysHowToGetIt) {
  const auto message = test::message_of<InputError>([] { empty_page(); });
  for (const char* part : {"report.html", "STRANDLAB_SHARE", "Node.js"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace strandlab::report
