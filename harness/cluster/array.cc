#include "harness/cluster/array.h"

#include <stdexcept>

namespace aisle {
namespace {

/// Ascending numbers: "0-3,7".
std::string Ranges(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (!text.empty()) text += ',';
    text += std::to_string(numbers[i]);
    if (last > i) text += fmt::format("-{}", numbers[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace

std::vector<ArrayPart> SplitArray(const std::vector<std::size_t>& tasks, std::size_t limit) {
  if (limit == 0) throw std::invalid_argument("an array of no index");
  std::vector<ArrayPart> parts;
  for (std::size_t i = 0; i < tasks.size();) {
    const std::size_t offset = tasks[i] / limit * limit;
    std::vector<std::size_t> indices;
    for (; i < tasks.size() && tasks[i] < offset + limit; ++i) indices.push_back(tasks[i] - offset);
    parts.push_back({offset, Ranges(indices)});
  }
  return parts;
}

}  // namespace aisle
