#include "strandlab/core/nearest.hpp"

#include <algorithm>

namespace strandlab {
namespace {

// ASCII only: the names of keys and kinds do not depend on the user's locale.
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size();
  std::vector<int> before(n + 1), last(n + 1), now(n + 1);
  for (std::size_t j = 0; j <= n; ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= n; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[n];
}

std::string nearest(std::string_view given, const std::vector<std::string>& known) {
  std::string best;
  int best_distance = 0;
  for (const auto& name : known) {
    const int longer = static_cast<int>(std::max(given.size(), name.size()));
    const int shorter = static_cast<int>(std::min(given.size(), name.size()));
    if (longer - shorter > std::max(1, longer / 3)) continue;  // the distance is at least that: no need to measure it
    const int distance = edit_distance(given, name);
    const bool near = distance <= std::max(1, longer / 3) && distance < longer;
    if (near && (best.empty() || distance < best_distance)) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) {
    if (!text.empty()) text += ", ";
    text += '"' + name + '"';
  }
  return text;
}

}  // namespace strandlab
