#include "simulator/scene/issues.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace aisle::sim {
namespace {

/// Levenshtein's, two letters in each other's place counting as one mistake (optimal string
/// alignment): of `a` to i letters and `b` to j letters in cell (i, j).
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cell(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  std::iota(cell[0].begin(), cell[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    cell[i][0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = cell[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cell[i][j] = std::min({cell[i - 1][j] + 1, cell[i][j - 1] + 1, changed});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cell[i][j] = std::min(cell[i][j], cell[i - 2][j - 2] + 1);
    }
  }
  return cell.back().back();
}

/// Edits from a misspelt word to a known one, those that begin alike being one apart; `limit` where
/// they are no fewer. A huge word is not compared: it would make a huge table.
std::size_t EditsBelow(std::size_t limit, std::string_view word, std::string_view known) {
  if (word == known) return 0;
  const bool begins_alike =
      !word.empty() && !known.empty() && (known.starts_with(word) || word.starts_with(known));
  if (begins_alike) return std::min<std::size_t>(limit, 1);
  const auto [shorter, longer] = std::minmax({word.size(), known.size()});
  return longer - shorter >= limit ? limit : std::min(limit, EditDistance(word, known));
}

}  // namespace

void Issues::Add(Mark mark, std::string_view key, std::string_view what) {
  issues_.push_back({mark, fmt::format("{}: {}{}{}", PlaceText(files_, mark), key,
                                       key.empty() ? "" : ": ", what)});
}

std::vector<std::string> Issues::Messages() const {
  std::vector<Issue> sorted = issues_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Issue& a, const Issue& b) {
    return std::tuple(a.mark.file, a.mark.line, a.mark.column) <
           std::tuple(b.mark.file, b.mark.line, b.mark.column);
  });
  std::vector<std::string> messages;
  std::set<std::string_view> told;  // a key that several halls share is read with each of them
  for (const Issue& issue : sorted) {
    if (told.insert(issue.text).second) messages.push_back(issue.text);
  }
  return messages;
}

std::string NearestWord(std::string_view word, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t best = (word.size() + 1) / 3 + 1;  // further apart it is another word
  for (const std::string& candidate : known) {
    const std::size_t edits = EditsBelow(best, word, candidate);
    if (edits >= best) continue;
    best = edits;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace aisle::sim
