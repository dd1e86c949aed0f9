#pragma once

#include <algorithm>
#include <vector>

namespace aisle::slam {

/// The middle value, of an even number the upper of the two in the middle; 0 of none.
template <class Number>
Number Median(std::vector<Number> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace aisle::slam
