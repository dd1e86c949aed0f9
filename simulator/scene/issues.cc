#include "simulator/scene/issues.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace aisle::sim {
namespace {

/// Levenshtein distance.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
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
  for (const Issue& issue : sorted) {  // a key that several halls share is read with each of them
    if (messages.empty() || messages.back() != issue.text) messages.push_back(issue.text);
  }
  return messages;
}

std::string NearestWord(std::string_view word, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t best = word.size() / 2 + 1;  // further apart it is another word
  for (const std::string& candidate : known) {
    const bool begins_alike = candidate.starts_with(word) || word.starts_with(candidate);
    const std::size_t distance = begins_alike ? 1 : EditDistance(word, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace aisle::sim
