#include "slam/picture/draw_stages.h"

#include "slam/picture/draw_paper.h"
#include "slam/picture/draw_regions.h"
#include "slam/picture/draw_robust.h"

namespace aisle::slam {

std::vector<StagePicture> DrawStages(const DynamicStages& stages, const StageTruth& truth) {
  std::vector<StagePicture> pictures;
  if (stages.paper) {
    pictures = picture::DrawPaper(stages.left, *stages.paper, stages.regions.regions);
  } else if (stages.robust && !stages.robust->residual.empty()) {
    pictures = picture::DrawRobust(stages.left, *stages.robust, stages.regions);
  } else {
    return {};
  }
  const int number = static_cast<int>(pictures.size()) + 1;
  pictures.push_back(picture::DrawRegions(stages, truth, number));
  return pictures;
}

}  // namespace aisle::slam
