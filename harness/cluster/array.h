#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace aisle {

/// A part of the tasks that fits into one job array: array index + offset is the task's.
struct ArrayPart {
  std::size_t offset = 0;
  std::string indices;  ///< as sbatch takes them: "0-3,7"

  bool operator==(const ArrayPart&) const = default;
};

/// `tasks` ascending. Slurm's MaxArraySize, `limit`, is one more than the largest index of an array
/// (1001 unless the site says otherwise), so a long list needs several. Throws
/// std::invalid_argument for a limit of 0.
std::vector<ArrayPart> SplitArray(const std::vector<std::size_t>& tasks, std::size_t limit);

}  // namespace aisle
