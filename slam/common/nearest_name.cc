#include "slam/common/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace aisle::slam {
namespace {

/// The last parts of `name`, as many as `like` has.
std::string LastParts(const std::string& name, const std::string& like) {
  auto begin = name.size();
  for (auto dots = std::count(like.begin(), like.end(), '.'); dots >= 0; --dots) {
    begin = begin == 0 ? std::string::npos : name.rfind('.', begin - 1);
    if (begin == std::string::npos) return name;
  }
  return name.substr(begin + 1);
}

}  // namespace

int EditDistance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string DidYouMean(const std::string& name, const std::vector<std::string>& names) {
  int least = static_cast<int>(name.size() + 2) / 3;
  const std::string* nearest = nullptr;
  for (const std::string& other : names) {
    const int distance =
        std::min(EditDistance(name, other), EditDistance(name, LastParts(other, name)));
    if (distance > least || (nearest && distance == least)) continue;
    least = distance;
    nearest = &other;
  }
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

}  // namespace aisle::slam
