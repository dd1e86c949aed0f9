#pragma once

#include <tbb/parallel_invoke.h>

#include <optional>
#include <utility>

namespace aisle::slam::dynamic {

/// The values of two independent computations, made at the same time.
template <typename First, typename Second>
auto InParallel(const First& first, const Second& second) {
  std::optional<decltype(first())> a;
  std::optional<decltype(second())> b;
  tbb::parallel_invoke([&] { a.emplace(first()); }, [&] { b.emplace(second()); });
  return std::pair(*std::move(a), *std::move(b));
}

}  // namespace aisle::slam::dynamic
