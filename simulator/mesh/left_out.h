#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace aisle::sim {

/// Collects phrases about what was left out: "1 camera", "2 lights".
class LeftOut {
 public:
  void Add(std::size_t count, const std::string& one, const std::string& many = "") {
    if (count == 0) return;
    Add(fmt::format("{} {}", count, count == 1 ? one : many.empty() ? one + "s" : many));
  }
  void Add(std::string phrase) { phrases_.push_back(std::move(phrase)); }
  std::vector<std::string> Take() { return std::move(phrases_); }

 private:
  std::vector<std::string> phrases_;
};

}  // namespace aisle::sim
