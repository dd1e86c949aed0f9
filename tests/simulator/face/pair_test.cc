// A rig's pairs: each is where its mount says, and sees through its own lens. OpenCV projects what
// the scene's file says of a column; the column's label must cover just that.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "simulator/scene_file.h"
#include "simulator/simulator.h"

namespace aisle::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

constexpr const char* kScene = R"(about: Two pairs on one vehicle, past a column.
frames: 2
camera: {size_px: [320, 240], focal_px: [200, 200], center_px: [160, 120]}
sensor: {noise: false}
rig:
  start: [0, 0]
  heading_deg: 30
  camera_height_m: 0.9
  camera_forward_m: 0.4
  camera_left_m: -0.1
  camera_pitch_deg: 4
  camera_yaw_deg: -12
  camera_roll_deg: 7
  pairs:
  - name: rear
    camera_height_m: 1.3
    camera_forward_m: -0.5
    camera_left_m: 0.2
    camera_pitch_deg: 6
    camera_yaw_deg: 160
    camera_roll_deg: -9
    camera:
      size_px: [400, 300]
      focal_px: [210, 205]
      center_px: [196, 154]
      baseline_m: 0.2
      distortion: radial-tangential
      distortion_coefficients: [-0.21, 0.05, 0.001, -0.002]
hall: {from: [-8, -8], to: [8, 8], height_m: 4}
lights: [{height_m: 3.8}]
columns:
- {at: [3.5, 1.2], size_m: 0.5}
- {at: [-3.2, -3.0], size_m: 0.4}
)";

/// A mount as the scene says it, and the rest of what this test needs of a pair.
struct Expected {
  std::string name;
  double height, forward, left, pitch, yaw, roll;  ///< metres, degrees
  cv::Matx33d k;
  std::vector<double> lens;
  double baseline;
  cv::Point2d column;
  double size;
  std::string instance;
};

const std::array<Expected, 2> kPairs = {{
    {"",
     0.9,
     0.4,
     -0.1,
     4,
     -12,
     7,
     {200, 0, 160, 0, 200, 120, 0, 0, 1},
     {},
     0.12,
     {3.5, 1.2},
     0.5,
     "column_0"},
    {"rear",
     1.3,
     -0.5,
     0.2,
     6,
     160,
     -9,
     {210, 0, 196, 0, 205, 154, 0, 0, 1},
     {-0.21, 0.05, 0.001, -0.002},
     0.2,
     {-3.2, -3.0},
     0.4,
     "column_1"},
}};

cv::Matx33d Turn(const cv::Vec3d& axis, double degrees) {
  cv::Matx33d matrix;
  cv::Rodrigues(axis * (degrees * kDegree), matrix);
  return matrix;
}

/// Of a camera in the world, as OpenCV takes it: x_camera = R x_world + t. Turns are about the
/// vehicle's axes, x ahead and z up, the last one first: another way round than the simulator's.
struct Extrinsics {
  cv::Matx33d R;
  cv::Vec3d t;
};
Extrinsics ExtrinsicsOf(const Expected& pair, int side) {
  const cv::Matx33d vehicle = Turn({0, 0, 1}, 30);
  const cv::Matx33d mount =
      Turn({0, 0, 1}, pair.yaw) * Turn({0, 1, 0}, pair.pitch) * Turn({1, 0, 0}, pair.roll);
  const cv::Matx33d optical(0, 0, 1, -1, 0, 0, 0, -1, 0);  // columns: right, down, ahead
  const cv::Matx33d world_camera = vehicle * mount * optical;
  const cv::Vec3d place = vehicle * cv::Vec3d(pair.forward, pair.left, pair.height) +
                          world_camera * cv::Vec3d(side * pair.baseline, 0, 0);
  return {world_camera.t(), -(world_camera.t() * place)};
}

/// The column's outline as OpenCV projects it, filled; edges in many pieces, since lenses bend.
cv::Mat1b Outline(const Expected& pair, int side, const cv::Size& size) {
  constexpr double kHall_m = 4;
  std::vector<cv::Point3d> points;
  for (int corner = 0; corner < 4; ++corner) {
    for (int k = 0; k <= 60; ++k) {
      points.emplace_back(pair.column.x + pair.size * ((corner & 1) - 0.5),
                          pair.column.y + pair.size * ((corner >> 1) - 0.5), kHall_m * k / 60);
    }
  }
  const Extrinsics extrinsics = ExtrinsicsOf(pair, side);
  std::vector<cv::Point3d> seen;  // what is behind or far aside is outside of the polynomial
  for (const cv::Point3d& point : points) {
    const cv::Vec3d in = extrinsics.R * cv::Vec3d(point.x, point.y, point.z) + extrinsics.t;
    if (in[2] > 0.2 && std::hypot(in[0], in[1]) < 1.3 * in[2]) seen.push_back(point);
  }
  cv::Vec3d rotation;
  cv::Rodrigues(extrinsics.R, rotation);
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(seen, rotation, extrinsics.t, pair.k, pair.lens, pixels);
  cv::Mat1b mask(size, std::uint8_t{0});
  // The outline of a column that bends: the hull of each slice between two heights.
  for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
    std::vector<cv::Point2f> slice;
    for (std::size_t j = 0; j < seen.size(); ++j) {
      const double above = (seen[j].z - seen[i].z) * 60 / kHall_m;
      if (above > -0.5 && above < 1.5) slice.emplace_back(pixels[j]);
    }
    std::vector<cv::Point2f> hull;
    cv::convexHull(slice, hull);
    std::vector<cv::Point> fixed;
    for (const cv::Point2f& point : hull) fixed.emplace_back(cvRound(point.x), cvRound(point.y));
    cv::fillConvexPoly(mask, fixed, cv::Scalar(255));
  }
  return mask;
}

class Pairs : public testing::Test {
 protected:
  Pairs() : folder_(std::filesystem::path(testing::TempDir()) / fmt::format("pairs-{}", getpid())) {
    std::filesystem::create_directories(folder_);
    Write(kScene);
  }
  ~Pairs() override { std::filesystem::remove_all(folder_); }
  void Write(const std::string& text) { std::ofstream(File()) << text; }
  std::string File() const { return (folder_ / "pairs.yaml").string(); }
  Simulator Open(const std::string& pair) const {
    SimulatorOptions options;
    options.pair = pair;
    options.keep_light = false;
    options.light_spacing = 8;
    return Simulator::Load(File(), std::string(AISLE_SOURCE_DIR) + "/assets", options);
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(Pairs, SeeAColumnWhereOpenCvProjectsIt) {
  for (const Expected& pair : kPairs) {
    const Simulator simulator = Open(pair.name);
    const RenderedFrame frame = simulator.Render(0, 0, simulator.PlannedPose(0));
    for (const int side : {0, 1}) {
      const cv::Mat1w& labels = side == 0 ? frame.truth.instance : frame.truth.instance_right;
      cv::Mat1b shown(labels.size(), std::uint8_t{0});
      for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
          if (simulator.instances()[labels(y, x)].name == pair.instance) shown(y, x) = 255;
        }
      }
      const cv::Mat1b expected = Outline(pair, side, labels.size());
      const int both = cv::countNonZero(shown & expected);
      const int either = cv::countNonZero(shown | expected);
      EXPECT_GT(cv::countNonZero(shown), 2000) << pair.name << " " << side;
      // Plinth, stripes and sign stand out by centimetres; a degree is an eighth of its width.
      EXPECT_GT(static_cast<double>(both) / either, 0.94) << pair.name << " " << side;
    }
  }
}

TEST_F(Pairs, DepthIsThatOfTheFloorAlongEachRay) {
  for (const Expected& pair : kPairs) {
    const Simulator simulator = Open(pair.name);
    const RenderedFrame frame = simulator.Render(0, 0, simulator.PlannedPose(0));
    const Extrinsics extrinsics = ExtrinsicsOf(pair, 0);
    const cv::Vec3d place = -(extrinsics.R.t() * extrinsics.t);
    int compared = 0;
    for (int y = 5; y < frame.truth.depth.rows; y += 23) {
      for (int x = 5; x < frame.truth.depth.cols; x += 29) {
        if (frame.truth.object_class(y, x) != 1) continue;  // floor
        std::vector<cv::Point2d> pixel = {cv::Point2d(x, y)}, ray;
        cv::undistortPoints(pixel, ray, pair.k, pair.lens, cv::noArray(), cv::noArray(),
                            {cv::TermCriteria::EPS | cv::TermCriteria::MAX_ITER, 100, 1e-12});
        const cv::Vec3d along = extrinsics.R.t() * cv::Vec3d(ray[0].x, ray[0].y, 1);
        EXPECT_NEAR(frame.truth.depth(y, x), -place[2] / along[2], 2e-3);
        ++compared;
      }
    }
    EXPECT_GT(compared, 10) << pair.name;
  }
}

TEST_F(Pairs, EachHasNoiseOfItsOwn) {
  std::string text = kScene;
  text.replace(text.find("sensor: {noise: false}\n"), 23, "");
  text.replace(text.find("  - name: rear"), std::string::npos,
               "  - {name: beside, camera_height_m: 0.9, camera_forward_m: 0.4, "
               "camera_left_m: -0.1, camera_pitch_deg: 4, camera_yaw_deg: -12, "
               "camera_roll_deg: 7}\n"
               "hall: {from: [-8, -8], to: [8, 8], height_m: 4}\nlights: [{height_m: 3.8}]\n");
  Write(text);
  const auto shown = [&](const std::string& pair) {
    const Simulator simulator = Open(pair);
    return simulator.Render(0, 0, simulator.PlannedPose(0));
  };
  const RenderedFrame one = shown(""), other = shown("beside");
  EXPECT_EQ(cv::norm(one.truth.instance, other.truth.instance, cv::NORM_L1), 0);
  cv::Mat1f difference;
  cv::subtract(one.left, other.left, difference, cv::noArray(), CV_32F);
  cv::Scalar mean, deviation;
  cv::meanStdDev(difference, mean, deviation);
  EXPECT_NEAR(mean[0], 0, 0.2);
  EXPECT_GT(deviation[0], 0.5) << "grey levels";
}

TEST_F(Pairs, TheSceneSaysWhichOneSystemsAreShown) {
  std::string text = kScene;
  text.replace(text.find("  pairs:"), 0, "  pair: rear\n");
  Write(text);
  EXPECT_EQ(Open("").rig().width, 400);
  EXPECT_EQ(Open("").pair(), "rear");
  text.replace(text.find("pair: rear"), 10, "pair: side");
  Write(text);
  const std::vector<std::string> errors = CheckSceneFile(File());
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors.front().find("no pair named 'side'"), std::string::npos);
}

TEST_F(Pairs, NoPixelOfAnyIsWithoutARay) {
  std::string text = kScene;
  text.replace(text.find("[-0.21, 0.05"), 12, "[-5, 0");
  Write(text);
  const std::vector<std::string> errors = CheckSceneFile(File());
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors.front().find("rig.pairs[0].camera.distortion_coefficients: "), std::string::npos)
      << errors.front();
  EXPECT_THROW(Open("rear"), std::runtime_error);
}

}  // namespace
}  // namespace aisle::sim
