// What report.html says without any script: head, findings, tables, as HTML.
#pragma once

#include <string>
#include <vector>

#include "strandlab/report/findings.hpp"

namespace strandlab::report {

// "13 764", "3.677", "0.0105": so many significant digits, groups of three set apart by a narrow space that does not
// break; whole numbers keep all their digits.
std::string shown(double value, int significant = 3);

struct Sheet {
  struct Fact {
    std::string name, text;
  };
  struct Headline {
    std::string name, value, unit;
    std::string context;  // what the number is to be held against
  };
  struct Table {
    std::string id;  // of the element, unique in the page: letters, digits, - and _
    std::string caption;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;  // the first cell heads its row
  };

  std::string title;
  std::vector<Fact> board;          // layup, strands, ... in words
  std::vector<std::string> limits;  // of validity, a line each
  std::vector<Headline> headlines;
  std::vector<Finding> findings;
  std::vector<Table> tables;
};

// The elements of the page's main part: a header with a chip that leads to the warnings, the headlines, the findings
// about the board and those about the calculation, warnings first, and the tables. All texts of the sheet stay text.
std::string to_html(const Sheet& sheet);

}  // namespace strandlab::report
