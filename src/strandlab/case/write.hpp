// A case as text: resolved, as a commented file to start from, and as the identity of a run's results.
#pragma once

#include <string>
#include <vector>

#include "strandlab/case/case.hpp"

namespace strandlab::cases {

// Every key with its value, a case file that reads back to the same case.
std::string resolved_text(const Case& c);

// The same with what each key means, its unit and what it may be: `strandlab init`. `title` opens the file as a
// comment.
std::string commented_text(const Case& c, const std::string& title);

// The reference page of all keys (Markdown): docs/cases.md.
std::string reference_text();

// Steps of the journey, in order; the page (report.html) shows the results of all the others.
enum class Step { kMat, kPress, kTest, kPage };

// What the results depend on, one "key = value" per line, up to a step of the journey; runs with the same lines have
// the same bits.
std::vector<std::string> identity(const Case& c, Step last);

// 16 hexadecimal digits that stand for identity() in result files.
std::string case_hash(const Case& c, Step last);

}  // namespace strandlab::cases
