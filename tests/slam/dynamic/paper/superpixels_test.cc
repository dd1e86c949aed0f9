#include "slam/dynamic/paper/superpixels.h"

#include <gtest/gtest.h>

#include "tests/slam/dynamic/synthetic_stereo.h"

namespace aisle::slam::dynamic {
namespace {

cv::Mat1b Scene() {
  auto panels = test::StaticHall();
  panels.push_back(test::Walker({0.2, 0.1, 3.5}, {0, 0, 0}));
  return test::Render(panels, StereoCamera{}, Eigen::Isometry3d::Identity(), 0).left;
}

/// SLIC as section III-B tells it, centre by centre, without any short cut.
cv::Mat1i SlicByTheBook(const cv::Mat1b& image, double nc, const SuperpixelOptions& options) {
  const double step = options.step_px;
  const int columns = cvCeil(image.cols / step), rows = cvCeil(image.rows / step);
  cv::Mat1i labels(image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      labels(y, x) = static_cast<int>(y / step) * columns + static_cast<int>(x / step);
    }
  }
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    std::vector<std::array<double, 4>> sums(static_cast<std::size_t>(columns * rows), {0, 0, 0, 0});
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        auto& sum = sums[static_cast<std::size_t>(labels(y, x))];
        sum[0] += x, sum[1] += y, sum[2] += image(y, x), sum[3] += 1;
      }
    }
    cv::Mat1d best(image.size(), 1e300);
    for (std::size_t j = 0; j < sums.size(); ++j) {
      if (sums[j][3] == 0) continue;
      const double cx = sums[j][0] / sums[j][3], cy = sums[j][1] / sums[j][3],
                   cg = sums[j][2] / sums[j][3];
      for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
          if (std::abs(x - cx) > step || std::abs(y - cy) > step) continue;
          const double colour = (image(y, x) - cg) / nc, space = std::hypot(x - cx, y - cy) / step;
          const double distance = std::hypot(colour, space);
          if (distance < best(y, x) - 1e-12) {
            best(y, x) = distance;
            labels(y, x) = static_cast<int>(j);
          }
        }
      }
    }
  }
  return labels;
}

/// The modified SLIC as section III-B tells it: flags on an image, every centre tried for every
/// flagged pixel.
cv::Mat1i ModifiedSlicByTheBook(const cv::Mat1b& image, double nc,
                                const SuperpixelOptions& options) {
  const double step = options.step_px;
  const int columns = cvCeil(image.cols / step), rows = cvCeil(image.rows / step);
  const cv::Rect area({}, image.size());
  const std::array<cv::Point, 4> four = {cv::Point(1, 0), {-1, 0}, {0, 1}, {0, -1}};
  cv::Mat1i labels(image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      labels(y, x) = static_cast<int>(y / step) * columns + static_cast<int>(x / step);
    }
  }
  cv::Mat1b flag(image.size(), static_cast<unsigned char>(0));  // step (1): edges are unstable
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      for (const cv::Point& d : four) {
        const cv::Point p(x + d.x, y + d.y);
        if (area.contains(p) && labels(p) != labels(y, x)) flag(y, x) = 1;
      }
    }
  }
  std::vector<cv::Vec3d> centres(static_cast<std::size_t>(columns * rows));
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    std::vector<cv::Vec4d> sums(centres.size());
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        sums[static_cast<std::size_t>(labels(y, x))] += cv::Vec4d(x, y, image(y, x), 1);
      }
    }
    for (std::size_t j = 0; j < sums.size(); ++j) {
      if (sums[j][3] > 0) {
        centres[j] = cv::Vec3d(sums[j][0], sums[j][1], sums[j][2]) / sums[j][3];
      }
    }
    const cv::Mat1i before = labels.clone();
    for (int y = 0; y < image.rows; ++y) {  // step (2)
      for (int x = 0; x < image.cols; ++x) {
        if (flag(y, x) == 0) continue;
        double best = 1e300;
        for (std::size_t j = 0; j < centres.size(); ++j) {
          const cv::Vec3d& c = centres[j];
          if (sums[j][3] == 0 || std::abs(x - c[0]) > step || std::abs(y - c[1]) > step) continue;
          const double distance =
              std::hypot((image(y, x) - c[2]) / nc, std::hypot(x - c[0], y - c[1]) / step);
          if (distance >= best - 1e-12) continue;
          best = distance;
          labels(y, x) = static_cast<int>(j);
        }
      }
    }
    cv::Mat1b next(image.size(), static_cast<unsigned char>(0));
    for (int y = 0; y < image.rows; ++y) {  // step (3), equation (7)
      for (int x = 0; x < image.cols; ++x) {
        if (flag(y, x) == 0) continue;
        const bool changed = labels(y, x) != before(y, x);
        if (changed) next(y, x) = 1;
        for (const cv::Point& d : four) {
          const cv::Point p(x + d.x, y + d.y);
          if (area.contains(p) && (changed || labels(p) != labels(y, x))) next(p) = 1;
        }
      }
    }
    flag = next;
  }
  return labels;
}

double ShareOfEqualLabels(const cv::Mat1i& a, const cv::Mat1i& b) {
  return static_cast<double>(cv::countNonZero(a == b)) / static_cast<double>(a.total());
}

TEST(SegmentFully, IsSlicByTheBook) {
  const cv::Mat1b image = Scene()(cv::Rect(300, 150, 120, 90)).clone();
  SuperpixelOptions options;
  options.iterations = 4;
  const double nc = ColourScale(image, options);
  const Superpixels fast = SegmentFully(image, nc, options);
  // Centres may leave the reach of the 3x3 search by a hair, and roots may order ties otherwise.
  EXPECT_GT(ShareOfEqualLabels(fast.labels, SlicByTheBook(image, nc, options)), 0.999);
}

TEST(SegmentUnstable, IsTheModifiedSlicByTheBook) {
  const cv::Mat1b image = Scene()(cv::Rect(300, 150, 120, 90)).clone();
  SuperpixelOptions options;
  options.iterations = 6;
  const double nc = ColourScale(image, options);
  EXPECT_GT(ShareOfEqualLabels(SegmentUnstable(image, nc, options).labels,
                               ModifiedSlicByTheBook(image, nc, options)),
            0.999);
}

TEST(ColourScale, IsAShareOfTheRangeOfTheMiddleNineTenths) {
  const cv::Mat1b image = Scene();
  std::vector<unsigned char> greys(image.begin(), image.end());
  std::sort(greys.begin(), greys.end());
  const auto at = [&](double share) {
    return greys[static_cast<std::size_t>(share * static_cast<double>(greys.size()))];
  };
  const SuperpixelOptions options;
  EXPECT_NEAR(ColourScale(image, options), options.colour_share * (at(0.95) - at(0.05)),
              options.colour_share);
  EXPECT_EQ(ColourScale(cv::Mat1b(20, 20, 90), options), 1);
}

TEST(SegmentUnstable, HasTheCentresOfEquationSix) {
  const SuperpixelOptions options;
  const cv::Mat1b image(480, 752, 90);
  const auto wanted = static_cast<double>(image.total()) / (options.step_px * options.step_px);
  const auto centres = static_cast<double>(SegmentUnstable(image, 10, options).centres.size());
  EXPECT_NEAR(centres / wanted, 1, 0.05);
}

TEST(SegmentUnstable, AgreesWithFullSlicAndLooksAtFarFewerPixels) {
  const cv::Mat1b image = Scene();
  const SuperpixelOptions options;
  const double nc = ColourScale(image, options);
  const Superpixels full = SegmentFully(image, nc, options);
  const Superpixels modified = SegmentUnstable(image, nc, options);
  const double equal = ShareOfEqualLabels(full.labels, modified.labels);
  const double touched =
      static_cast<double>(modified.pixels_classified) / static_cast<double>(full.pixels_classified);
  RecordProperty("equal_labels", std::to_string(equal));
  RecordProperty("pixels_touched", std::to_string(touched));
  std::cout << "equal labels " << equal << ", pixels touched " << touched << " of full SLIC's\n";
  EXPECT_GT(equal, 0.85);
  EXPECT_LT(touched, 0.5);
}

TEST(SegmentUnstable, LabelsAndCentresAgree) {
  const cv::Mat1b image = Scene()(cv::Rect(250, 130, 203, 151)).clone();
  const SuperpixelOptions options;
  const Superpixels s = SegmentUnstable(image, ColourScale(image, options), options);
  std::vector<std::array<double, 4>> sums(s.centres.size(), {0, 0, 0, 0});
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      auto& sum = sums.at(static_cast<std::size_t>(s.labels(y, x)));
      sum[0] += x, sum[1] += y, sum[2] += image(y, x), sum[3] += 1;
    }
  }
  for (std::size_t j = 0; j < sums.size(); ++j) {
    ASSERT_EQ(s.centres[j].pixels, static_cast<int>(sums[j][3]));
    if (sums[j][3] == 0) continue;
    EXPECT_NEAR(s.centres[j].x, sums[j][0] / sums[j][3], 1e-9);
    EXPECT_NEAR(s.centres[j].y, sums[j][1] / sums[j][3], 1e-9);
    EXPECT_NEAR(s.centres[j].grey, sums[j][2] / sums[j][3], 1e-9);
  }
}

TEST(SegmentUnstable, AStepEdgeBecomesABoundary) {
  cv::Mat1b image(120, 120, 60);
  image.colRange(65, 120).setTo(180);  // inside a square of the initial grid
  const SuperpixelOptions options;
  const Superpixels s = SegmentUnstable(image, ColourScale(image, options), options);
  for (int y = 0; y < image.rows; ++y) EXPECT_NE(s.labels(y, 64), s.labels(y, 65)) << "row " << y;
}

TEST(Segment, TakesImagesSmallerThanASuperpixel) {
  const SuperpixelOptions options;
  const cv::Mat1b image(3, 5, 40);
  EXPECT_EQ(SegmentUnstable(image, 10, options).centres.size(), 1U);
  EXPECT_TRUE(SegmentUnstable(cv::Mat1b(), 10, options).centres.empty());
}

}  // namespace
}  // namespace aisle::slam::dynamic
