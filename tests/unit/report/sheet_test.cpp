// What the page says without scripts: numbers as they are read, texts that stay text, words with their meanings.
#include "strandlab/report/sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "strandlab/report/glossary.hpp"

namespace strandlab::report {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(Shown, HasTheDigitsThatAreKnown) {
  EXPECT_EQ(shown(3.6774), "3.68");
  EXPECT_EQ(shown(3.6774, 2), "3.7");
  EXPECT_EQ(shown(0.0105), "0.0105");
  EXPECT_EQ(shown(2.0), "2");
  EXPECT_EQ(shown(0), "0");
  EXPECT_EQ(shown(8927.4), "8927");
  EXPECT_EQ(shown(13764), "13\u202f764");
  EXPECT_EQ(shown(-1234567), "-1\u202f234\u202f567");
  EXPECT_EQ(shown(std::nan("")), "–");
}

TEST(Sheet, TextsStayText) {
  const std::string name = "</h1><script>\"&";
  const auto html = to_html({name,
                             {{name, name}},
                             {name},
                             {{name, name, name, name}},
                             {{Level::kNote, name, About::kBoard, name, name}},
                             {{"t", name, {name}, {{name}}}}});
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_GT(count(html, "&lt;/h1&gt;&lt;script&gt;&quot;&amp;"), 9U);
}

// The chip counts warnings and leads to the first; groups have warnings first, then the order given.
TEST(Sheet, FindingsStandInTwoGroups) {
  Sheet sheet;
  sheet.findings = {{Level::kNote, "first", About::kBoard},
                    {Level::kWarning, "second", About::kBoard},
                    {Level::kGood, "third", About::kBoard},
                    {Level::kWarning, "fourth", About::kCalculation}};
  const auto html = to_html(sheet);
  EXPECT_NE(html.find("<a class=\"chip warning\" href=\"#warnings\">2 warnings</a>"), std::string::npos) << html;
  EXPECT_EQ(count(html, "id=\"warnings\""), 1U);
  const auto at = [&](const char* part) { return html.find(part); };
  EXPECT_LT(at("The board"), at("second"));
  EXPECT_LT(at("second"), at("first"));
  EXPECT_LT(at("first"), at("third"));
  EXPECT_LT(at("third"), at("The calculation"));
  EXPECT_LT(at("The calculation"), at("fourth"));
}

TEST(Glossary, TellsAWordOnceAndWholeWordsOnly) {
  std::set<std::string> told;
  const auto html = with_meanings("platens and a platen; the sections, dissection, PFD", told);
  EXPECT_EQ(count(html, "<abbr"), 2U) << html;
  EXPECT_NE(html.find(">platen</abbr>s and a platen"), std::string::npos) << html;
  EXPECT_EQ(told, (std::set<std::string>{"platen", "section"}));
  EXPECT_EQ(with_meanings("platen", told), "platen");
}

}  // namespace
}  // namespace strandlab::report
