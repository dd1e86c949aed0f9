#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

namespace aisle {

/// The visual words our SLAM recognises places by: places/warehouse.voc in $AISLE_ASSETS, or in
/// assets/ of the source tree this program was built from. Empty where there is none: the SLAM then
/// closes no loops.
std::filesystem::path VocabularyFile();

/// Trains such words from images of places like those that will be seen. The same images in the
/// same order give the same file. Returns the number of words.
int TrainPlaceVocabulary(const std::vector<cv::Mat1b>& images, const std::filesystem::path& file);

}  // namespace aisle
