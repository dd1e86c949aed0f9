#pragma once

#include <optional>
#include <string>
#include <vector>

namespace aisle {

/// The paper whose experiment the scenes `paper/*` follow, for whoever reads of "the paper".
inline constexpr const char* kThePaper =
    "\"Robust Stereo Visual SLAM for Dynamic Environments With Moving Object\"";

/// A row of the paper that this project follows, as printed: what one system got on one sequence.
struct PrintedRow {
  const char* row;     ///< our scene of that number; the paper's own name where we have none
  const char* system;  ///< ours that stands for theirs: orbslam2, semantic (DynaSLAM) or paper
  std::vector<std::optional<double>> values;  ///< in the order of the table's columns
};

inline constexpr int kFigure11 = 11;  ///< asks for the numbers the text gives for Fig. 11

/// Rows of the paper's table 1 to 6, in its order; empty for other numbers. Source: tables 1
/// to 6 and section IV-B of kThePaper.
const std::vector<PrintedRow>& PrintedTable(int number);

}  // namespace aisle
