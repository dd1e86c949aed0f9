#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace aisle::slam::dynamic {

/// Memory of the given size whose content is whatever was left there. After use it is kept for
/// whoever next needs as much, in any thread: megabytes that the system takes back and maps anew
/// for every image cost as much as the work on them.
class SpareMemory {
 public:
  explicit SpareMemory(std::size_t bytes);
  ~SpareMemory();
  SpareMemory(const SpareMemory&) = delete;
  SpareMemory& operator=(const SpareMemory&) = delete;

  std::uint8_t* data() { return bytes_.data(); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace aisle::slam::dynamic
