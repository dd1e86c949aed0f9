#include "slam/feature/extract.h"
#include "slam/place/vocabulary.h"
#include "slam/stereo_slam.h"

namespace aisle::slam {

int TrainVocabulary(const std::vector<cv::Mat1b>& images, const FeatureOptions& options,
                    const std::string& file) {
  std::vector<std::vector<Descriptor>> descriptors;
  for (const cv::Mat1b& image : images) {
    descriptors.push_back(ExtractFeatures(image, {}, options).features.descriptors);
  }
  const Vocabulary vocabulary = Vocabulary::Train(descriptors, {});
  vocabulary.Save(file);
  return vocabulary.words();
}

}  // namespace aisle::slam
