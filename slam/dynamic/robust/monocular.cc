#include "slam/dynamic/robust/monocular.h"

#include "slam/common/parallel.h"

namespace aisle::slam::dynamic {
namespace {

// Half-size pixels: no static disparity is beyond, and from one to the other the place moves by a
// pixel at most where it is asked for. Over more than that, nothing tells who moves from who is
// near.
constexpr float kFarthest = 0.5F, kNearest = 100, kMostLine = 1 / (kNearest - kFarthest);

/// By how much of disparity the place must go on along its epipolar line to come closest to the
/// flow, by the information G of its window; 0 where there is no line, as the rig only turns.
float WayToClosest(float xx, float xy, float yy, const cv::Vec2f& line, const cv::Vec2f& off) {
  constexpr float kLeastInformation = 1e-6F;
  const cv::Vec2f weighed(xx * line[0] + xy * line[1], xy * line[0] + yy * line[1]);
  const float information = weighed.dot(line);
  return information > kLeastInformation ? weighed.dot(off) / information : 0;
}

}  // namespace

int MonocularColumns(const float* disparity, int columns) {
  constexpr int kRun = 6;
  int known = 0;
  for (int x = 0; x < columns; ++x) {
    known = disparity[x] > 0 ? known + 1 : 0;
    if (known == kRun) return x + 1 - kRun;
  }
  return 0;
}

cv::Mat1f ExplainMonocular(const DenseFrame& now, const cv::Mat2f& flow, const Texture& texture,
                           StaticField* expected) {
  cv::Mat1f disparity = now.disparity.clone();
  ParallelFor(0, disparity.rows, [&](int y) {
    float* of_row = disparity[y];
    const int columns = MonocularColumns(now.disparity[y], disparity.cols);
    for (int x = 0; x < columns; ++x) {
      if (of_row[x] > 0) continue;
      cv::Vec2f &place = expected->place(y, x), &line = expected->per_disparity(y, x);
      const float assumed = now.filled(y, x);
      if (line.dot(line) > kMostLine * kMostLine) continue;
      const float way = WayToClosest(texture.xx(y, x), texture.xy(y, x), texture.yy(y, x), line,
                                     flow(y, x) - place);
      const float closest = std::clamp(assumed + way, kFarthest, kNearest);
      place += (closest - assumed) * line;
      line = {0, 0};
      // That of the earlier frame: to first order a turn scales all disparities of a ray alike.
      expected->disparity(y, x) =
          assumed > 0 ? expected->disparity(y, x) * (closest / assumed) : closest;
      of_row[x] = closest;
    }
  });
  return disparity;
}

}  // namespace aisle::slam::dynamic
