#pragma once

namespace aisle::slam {

/// Options of the whole system, composed of each stage's own.
struct SlamOptions {
  int threads = 0;  ///< 0: as many as the machine has; never changes a result
};

}  // namespace aisle::slam
