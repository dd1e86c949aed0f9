#pragma once

#include <optional>
#include <utility>

#include "slam/common/parallel.h"

namespace aisle::slam::dynamic {

/// The values of two independent computations, made at the same time.
template <typename First, typename Second>
auto InParallel(const First& first, const Second& second) {
  std::optional<decltype(first())> a;
  std::optional<decltype(second())> b;
  ParallelInvoke([&] { a.emplace(first()); }, [&] { b.emplace(second()); });
  return std::pair(*std::move(a), *std::move(b));
}

}  // namespace aisle::slam::dynamic
