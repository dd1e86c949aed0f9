#pragma once

#include <string>

namespace aisle {

struct DoctorBitsOptions {
  bool json = false;      ///< the hashes for programs, instead of the table
  std::string json_file;  ///< where they go; empty: stdout
  std::string against;    ///< list of known makes; empty: reports/baselines/bits.json of the tree
  bool pictures = false;  ///< the simulator's stages alone
  bool keep = false;      ///< put this machine's hashes into the list
  int threads = 0;        ///< 0: all; never changes a bit
};

/// Hashes what every stage of a small drive makes on this processor, holds it against the makes of
/// processor in the list, and names the first stage that differs. Returns the exit code.
int DoctorBits(const DoctorBitsOptions& options);

}  // namespace aisle
