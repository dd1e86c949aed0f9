#include "simulator/mesh/texture_store.h"

#include <opencv2/imgproc.hpp>

namespace aisle::sim {
namespace {

cv::Mat Rgb(const cv::Mat& image) {
  cv::Mat rgb;
  const int channels = image.channels();
  cv::cvtColor(image, rgb,
               channels == 1   ? cv::COLOR_GRAY2RGB
               : channels == 4 ? cv::COLOR_BGRA2RGB
                               : cv::COLOR_BGR2RGB);
  return rgb;
}

}  // namespace

int TextureStore::Add(const std::string& key, bool is_normal_map,
                      const std::function<std::vector<std::uint8_t>()>& bytes) {
  const auto known = known_.find({key, is_normal_map});
  if (known != known_.end()) return known->second;
  const cv::Mat image = DecodeImage(bytes(), "texture " + key, options_.max_texture_px);
  const int index = static_cast<int>(model_->textures.size());
  model_->textures.push_back({std::filesystem::path(key).filename().string(),
                              is_normal_map ? Rgb(image) : cv::Mat(GreyOf(image, options_.band))});
  known_[{key, is_normal_map}] = index;
  return index;
}

}  // namespace aisle::sim
