#pragma once

#include <string>
#include <utility>
#include <vector>

namespace aisle {

/// A ZIP archive of these files (name, bytes), stored without compression: the same files give the
/// same bytes, whenever they are written (PKWARE APPNOTE 6.3). Below 4 GiB.
std::string MakeZip(const std::vector<std::pair<std::string, std::string>>& files);

/// A NumPy array file, version 1.0, of one dimension, float64 little endian.
std::string MakeNpy(const std::vector<double>& values);

}  // namespace aisle
