#pragma once

#include <cstring>

namespace aisle::slam {

/// Eight numbers that go through the same instructions: wide ones where the machine has them, with
/// the same bits where it has not.
using Eight [[gnu::vector_size(32)]] = float;

inline void Load(const float* from, Eight& values) { std::memcpy(&values, from, sizeof values); }
inline void Store(const Eight& values, float* to) { std::memcpy(to, &values, sizeof values); }

/// In an order of its own, the same everywhere.
inline float Sum(const Eight& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

}  // namespace aisle::slam
