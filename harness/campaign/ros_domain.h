#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/io/file_lock.h"

namespace aisle {

/// A domain of ROS 2 for one run: nodes of runs at the same time do not hear each other, nor the
/// network. No other run has its number while this stands.
class RosDomain {
 public:
  /// `locks`: a folder that all runs share, of one lock for each number. Where it cannot be
  /// written, the number is only unlikely to be another's.
  explicit RosDomain(const std::filesystem::path& locks);

  int number() const { return number_; }  ///< 1 to 101, which are safe on every system

  /// "NAME=VALUE" each: ROS_DOMAIN_ID and ROS_LOCALHOST_ONLY, but what this process's environment
  /// says already: a user's choice stays.
  std::vector<std::string> Variables() const;

 private:
  std::optional<FileLock> lock_;
  int number_;
};

}  // namespace aisle
