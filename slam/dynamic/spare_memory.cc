#include "slam/dynamic/spare_memory.h"

#include <mutex>

namespace aisle::slam::dynamic {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What is not in use. Sizes are those of images, of which a process knows few.
class Shelf {
 public:
  Bytes Take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    for (Bytes& spare : spare_) {
      if (spare.size() != bytes) continue;
      Bytes taken = std::move(spare);
      spare = std::move(spare_.back());
      spare_.pop_back();
      return taken;
    }
    return {};
  }
  void Give(Bytes bytes) {
    const std::lock_guard lock(mutex_);
    if (spare_.size() == kMostKept) spare_.erase(spare_.begin());
    spare_.push_back(std::move(bytes));
  }

 private:
  static constexpr std::size_t kMostKept = 8;
  std::mutex mutex_;  // of spare_
  std::vector<Bytes> spare_;
};

Shelf& TheShelf() {
  static Shelf shelf;
  return shelf;
}

}  // namespace

SpareMemory::SpareMemory(std::size_t bytes) : bytes_(TheShelf().Take(bytes)) {
  bytes_.resize(bytes);
}

SpareMemory::~SpareMemory() { TheShelf().Give(std::move(bytes_)); }

}  // namespace aisle::slam::dynamic
