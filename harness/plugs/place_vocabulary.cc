#include "harness/plugs/place_vocabulary.h"

#include <cstdlib>

#include "slam/stereo_slam.h"

namespace aisle {

std::filesystem::path VocabularyFile() {
  const char* assets = std::getenv("AISLE_ASSETS");
  const bool elsewhere = assets != nullptr && *assets != '\0';
  const std::filesystem::path dir = elsewhere ? std::filesystem::path(assets)
                                              : std::filesystem::path(AISLE_SOURCE_DIR) / "assets";
  const std::filesystem::path file = dir / "places" / "warehouse.voc";
  return std::filesystem::exists(file) ? file : std::filesystem::path();
}

int TrainPlaceVocabulary(const std::vector<cv::Mat1b>& images, const std::filesystem::path& file) {
  return slam::TrainVocabulary(images, {}, file.string());
}

}  // namespace aisle
