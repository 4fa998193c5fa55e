#include "strandlab/report/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <regex>
#include <set>

#include "strandlab/core/markup.hpp"
#include "strandlab/report/glossary.hpp"

namespace strandlab::report {
namespace {

constexpr const char* kNarrowSpace = "\u202f";

using Told = std::set<std::string>;

// As HTML, a per cent sign on the line of its number.
std::string set_in_type(const std::string& text) {
  auto html = escaped_markup(text);
  for (auto at = html.find(" %"); at != std::string::npos; at = html.find(" %", at)) html.replace(at, 1, "\u00a0");
  return html;
}

std::string in_words(const std::string& text, Told& told) {
  return with_meanings(set_in_type(text), told);
}

std::string html_of_chip(const Sheet& sheet) {
  const auto warnings = std::count_if(sheet.findings.begin(), sheet.findings.end(),
                                      [](const Finding& f) { return f.level == Level::kWarning; });
  if (warnings == 0) return sheet.findings.empty() ? "" : "<a class=\"chip good\" href=\"#findings\">no warnings</a>";
  return fmt::format("<a class=\"chip warning\" href=\"#warnings\">{} {}</a>", warnings,
                     warnings == 1 ? "warning" : "warnings");
}

std::string html_of_header(const Sheet& sheet, Told& told) {
  auto html = fmt::format(
      "<header class=\"page-head\"><div><p class=\"brand\">Strandlab {}</p><h1>{}</h1></div></header>\n"
      "<div class=\"about\"><dl class=\"board\">",
      html_of_chip(sheet), escaped_markup(sheet.title));
  for (const auto& fact : sheet.board)
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped_markup(fact.name), in_words(fact.text, told));
  html += "</dl>";
  for (const auto& line : sheet.limits) html += fmt::format("<p class=\"limit\">{}</p>\n", in_words(line, told));
  return html + "</div>\n";
}

std::string html_of_headlines(const Sheet& sheet, Told& told) {
  if (sheet.headlines.empty()) return {};
  std::string html = "<dl class=\"tiles\">";
  for (const auto& h : sheet.headlines) {
    html +=
        fmt::format("<div class=\"tile\"><dt>{}</dt><dd><b>{}</b> <span>{}</span><p>{}</p></dd></div>",
                    escaped_markup(h.name), escaped_markup(h.value), in_words(h.unit, told), in_words(h.context, told));
  }
  return html + "</dl>\n";
}

// The documentation's section behind a finding; the page has it under this anchor (web/build.mjs).
std::string html_of_docs(const std::string& docs) {
  const auto text = escaped_markup(docs);
  static const std::regex kSection(R"re(docs/([a-z0-9-]+)\.md, "([^"<>&]+)")re");
  std::smatch part;
  if (!std::regex_match(docs, part, kSection)) return fmt::format(" <cite>{}</cite>", text);
  std::string anchor = "docs-";
  for (const char c : part[1].str() + "-" + part[2].str()) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0)
      anchor += static_cast<char>(std::tolower(letter));
    else if (anchor.back() != '-')
      anchor += '-';
  }
  return fmt::format(" <cite><a href=\"#{}\">{}</a></cite>", anchor, text);
}

std::string html_of_item(const Finding& f, bool first_warning, Told& told) {
  struct Look {
    const char *name, *mark, *read;
  };
  static constexpr std::array<Look, 3> kLooks{
      {{"good", "✓", "Good: "}, {"note", "•", ""}, {"warning", "!", "Warning: "}}};
  const auto& look = kLooks[static_cast<std::size_t>(f.level)];
  std::string more;
  if (!f.chart.empty())
    more += fmt::format(" <a href=\"#chart-{0}\" aria-label=\"Chart: {0}\">chart</a>", escaped_markup(f.chart));
  if (!f.docs.empty()) more += html_of_docs(f.docs);
  return fmt::format(
      "<li class=\"{}\"{}><span class=\"mark\" aria-hidden=\"true\">{}</span><span><span class=\"sr\">{}</span>{}{}"
      "</span></li>\n",
      look.name, first_warning ? " id=\"warnings\"" : "", look.mark, look.read, in_words(f.text, told), more);
}

std::string html_of_findings(const Sheet& sheet, Told& told) {
  if (sheet.findings.empty()) return {};
  std::string html = "<section id=\"findings\"><h2>What the numbers say</h2>\n";
  bool warned = false;
  for (const auto& [about, title] : {std::pair{About::kBoard, "The board"}, {About::kCalculation, "The calculation"}}) {
    std::string list;
    for (const bool warnings : {true, false}) {
      for (const auto& f : sheet.findings) {
        if (f.about != about || (f.level == Level::kWarning) != warnings) continue;
        list += html_of_item(f, warnings && !warned, told);
        warned = warned || warnings;
      }
    }
    if (!list.empty())
      html += fmt::format("<div class=\"card\"><h3>{}</h3><ul class=\"findings\">\n{}</ul></div>\n", title, list);
  }
  return html + "</section>\n";
}

std::string html_of_table(const Sheet::Table& t) {
  auto html = fmt::format("<div class=\"card numbers\" id=\"{}\"><table><caption>{}</caption><thead><tr>",
                          escaped_markup(t.id), escaped_markup(t.caption));
  for (const auto& column : t.columns) html += fmt::format("<th scope=\"col\">{}</th>", set_in_type(column));
  html += "</tr></thead><tbody>";
  for (const auto& row : t.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      html += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", set_in_type(row[i]))
                     : fmt::format("<td>{}</td>", set_in_type(row[i]));
    html += "</tr>";
  }
  return html + "</tbody></table></div>\n";
}

std::string html_of_tables(const Sheet& sheet) {
  if (sheet.tables.empty()) return {};
  std::string html = "<section id=\"tables\"><h2>Tables</h2>\n";
  for (const auto& t : sheet.tables) html += html_of_table(t);
  return html + "</section>\n";
}

}  // namespace

std::string shown(double value, int significant) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  auto text = fmt::format("{:.{}f}", value, std::max(0, significant - before));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  const auto point = std::min(text.find('.'), text.size());
  const std::size_t first = text[0] == '-' ? 1 : 0;
  if (point - first < 5) return text;  // four digits are read at once
  for (auto at = point; at > first + 3;) text.insert(at -= 3, kNarrowSpace);
  return text;
}

std::string to_html(const Sheet& sheet) {
  Told told;
  auto html = html_of_header(sheet, told);
  html += html_of_headlines(sheet, told);
  html += html_of_findings(sheet, told);
  return html + html_of_tables(sheet);
}

}  // namespace strandlab::report
