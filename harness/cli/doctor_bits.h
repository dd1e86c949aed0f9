#pragma once

#include <map>
#include <string>
#include <vector>

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

/// What a make of processor computed, and the program that did.
struct BitsOfMake {
  std::string commit;
  std::vector<std::pair<std::string, std::string>> stages;  ///< name and hash, in their order
};

struct BitsVerdict {
  std::string said;      ///< "every stage equal", or the first that differs
  bool differs = false;  ///< the same program computes otherwise there
};

/// Holds this processor against a make of the list. Another commit's program may compute otherwise
/// on any processor: that it differs says nothing of the make, that it does not all the more.
BitsVerdict HoldAgainst(const BitsOfMake& own, const BitsOfMake& known);

}  // namespace aisle
