#pragma once

#include <filesystem>
#include <string>

namespace aisle {

struct ForeignOptions {
  std::string scene;          ///< the JSON file
  std::string reference;      ///< .exr or .pfm to compare with; empty: none
  std::filesystem::path out;  ///< folder of the picture
  int samples = 256;          ///< paths a pixel
  int depth = 8;              ///< surfaces a path may touch
  int threads = 0;            ///< 0: all
};

/// Path-traces a scene of another renderer, writes it as PFM and, given a picture of that renderer,
/// compares means and blocks. Returns an exit code. Throws InputError.
int BenchForeign(const ForeignOptions& options);

}  // namespace aisle
