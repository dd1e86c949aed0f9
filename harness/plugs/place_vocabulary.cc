#include "harness/plugs/place_vocabulary.h"

#include "harness/io/places.h"
#include "slam/stereo_slam.h"

namespace aisle {

std::filesystem::path VocabularyFile() {
  const std::filesystem::path file = AssetsDir() / "places" / "warehouse.voc";
  return std::filesystem::exists(file) ? file : std::filesystem::path();
}

int TrainPlaceVocabulary(const std::vector<cv::Mat1b>& images, const std::filesystem::path& file) {
  return slam::TrainVocabulary(images, {}, file.string());
}

}  // namespace aisle
