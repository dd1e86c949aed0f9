#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/bench/source.h"

namespace aisle {

/// What PictureStatistics say of one folder of pictures.
struct PictureSet {
  std::string name;
  std::size_t pictures = 0;    ///< that were looked at
  std::vector<double> values;  ///< medians, in the order of PictureStatistics; NaN: not known
};

/// The left pictures of a dataset in EuRoC's, KITTI's or TUM's layout, or a folder's own. Throws
/// InputError where there are none.
std::vector<std::filesystem::path> FindPictures(const std::filesystem::path& folder);

/// At most `most` pictures of a folder (FindPictures), evenly spread. Throws InputError.
PictureSet MeasurePictures(const std::string& name, const std::filesystem::path& folder, int most,
                           const BenchProgress& progress = {});

/// The sets of real cameras that are there in a folder laid out as the tests have it.
std::vector<PictureSet> MeasureRealPictures(const std::filesystem::path& data, int most,
                                            const BenchProgress& progress = {});

/// Of the sets that know a statistic, how many lie within the real ones.
struct WithinReal {
  int within = 0, known = 0;
};
WithinReal CountWithin(const std::vector<PictureSet>& real, const std::vector<PictureSet>& given,
                       std::size_t statistic);

}  // namespace aisle
