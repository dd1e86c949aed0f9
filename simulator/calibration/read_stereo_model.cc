#include <sstream>
#include <stdexcept>

#include "simulator/calibration/calibration_text.h"
#include "simulator/calibration/stereo_model.h"
#include "simulator/calibration/yaml_numbers.h"
#include "simulator/common/decimal.h"
#include "simulator/common/printable.h"

namespace aisle::sim {
namespace {

using Files = std::vector<CalibrationFile>;

void SetPinhole(const std::vector<double>& numbers, CameraModel* camera) {
  camera->fx = numbers[0];
  camera->fy = numbers[1];
  camera->cx = numbers[2];
  camera->cy = numbers[3];
}

/// Out of a 3x3 camera matrix.
void SetMatrix(const std::vector<double>& k, CameraModel* camera) {
  SetPinhole({k[0], k[4], k[2], k[5]}, camera);
}

void SetSize(const CalibrationFile& file, const std::string& key, double width, double height,
             CameraModel* camera) {
  constexpr double kMost = 16384;
  for (const double pixels : {width, height}) {
    if (pixels >= 1 && pixels <= kMost && pixels == std::floor(pixels)) continue;
    file.Fail(key, fmt::format("{:g} x {:g} is not an image size: expected whole numbers of "
                               "pixels from 1 to {:g}",
                               width, height, kMost));
  }
  camera->width = static_cast<int>(width);
  camera->height = static_cast<int>(height);
}

void SetSize(const CalibrationFile& file, const YAML::Node& resolution, const std::string& key,
             CameraModel* camera) {
  const std::vector<double> size = NumbersOf(file, resolution, key, 2);
  SetSize(file, key, size[0], size[1], camera);
}

/// Out of `image_width` and `image_height`.
void SetImageSize(const CalibrationFile& file, CameraModel* camera) {
  SetSize(file, "image_width, image_height",
          NumbersOf(file, file.root["image_width"], "image_width", 1)[0],
          NumbersOf(file, file.root["image_height"], "image_height", 1)[0], camera);
}

void SetLens(const CalibrationFile& file, const std::string& model, std::vector<double> numbers,
             const std::string& key, CameraModel* camera) {
  const bool polynomial = model == "radtan" || model == "radial-tangential" ||
                          model == "plumb_bob" || model == "rational_polynomial";
  camera->equidistant = model == "equidistant" || model == "fisheye";
  if (!polynomial && !camera->equidistant && model != "none" && !model.empty()) {
    file.Fail(key, fmt::format(
                       "unsupported model '{}'; supported: radtan (plumb_bob, radial-tangential), "
                       "rational_polynomial, equidistant and none",
                       model));
  }
  const std::size_t n = numbers.size();
  const bool fits = camera->equidistant ? n == 4 : n == 0 || n == 4 || n == 5 || n == 8;
  if (!fits) file.Fail(key, fmt::format("{} coefficients do not fit a {} lens", n, model));
  camera->distortion = std::move(numbers);
}

StereoModel::Stated StatedBy(const Eigen::Matrix3d& R_rectified_camera,
                             const std::vector<double>& projection) {
  StereoModel::Stated stated;
  stated.R_rectified_camera = R_rectified_camera;
  for (int i = 0; i < 12; ++i) {
    stated.projection(i / 4, i % 4) = projection[static_cast<std::size_t>(i)];
  }
  return stated;
}

std::string TextAt(const YAML::Node& node, const char* key) {
  return node[key] && node[key].IsScalar() ? node[key].Scalar() : "";
}

// --- Kalibr --------------------------------------------------------------------------------------

CameraModel KalibrCamera(const CalibrationFile& file, const std::string& name) {
  const YAML::Node node = file.root[name];
  if (!node || !node.IsMap()) file.Fail(name, "is missing: a camchain of two cameras is expected");
  CameraModel camera;
  const std::string model = TextAt(node, "camera_model");
  if (model != "pinhole") {
    file.Fail(name + ".camera_model", fmt::format("'{}': pinhole is read", model));
  }
  SetPinhole(NumbersOf(file, node["intrinsics"], name + ".intrinsics", 4), &camera);
  SetSize(file, node["resolution"], name + ".resolution", &camera);
  std::vector<double> lens;
  if (node["distortion_coeffs"]) {
    lens = NumbersOf(file, node["distortion_coeffs"], name + ".distortion_coeffs", 0);
  }
  SetLens(file, TextAt(node, "distortion_model"), lens, name + ".distortion_model", &camera);
  return camera;
}

StereoModel ReadKalibr(const CalibrationFile& file) {
  StereoModel model;
  model.left = KalibrCamera(file, "cam0");
  model.right = KalibrCamera(file, "cam1");
  const YAML::Node left = file.root["cam0"], right = file.root["cam1"];
  if (right["T_cn_cnm1"]) {
    model.T_right_left = MotionOf(file, right["T_cn_cnm1"], "cam1.T_cn_cnm1");
  } else {
    model.T_right_left = MotionOf(file, right["T_cam_imu"], "cam1.T_cam_imu") *
                         MotionOf(file, left["T_cam_imu"], "cam0.T_cam_imu").inverse();
  }
  return model;
}

// --- EuRoC ---------------------------------------------------------------------------------------

CameraModel EurocCamera(const CalibrationFile& file) {
  CameraModel camera;
  SetPinhole(NumbersOf(file, file.root["intrinsics"], "intrinsics", 4), &camera);
  SetSize(file, file.root["resolution"], "resolution", &camera);
  std::vector<double> lens;
  if (file.Has("distortion_coefficients")) {
    lens = NumbersOf(file, file.root["distortion_coefficients"], "distortion_coefficients", 0);
  }
  SetLens(file, TextAt(file.root, "distortion_model"), lens, "distortion_model", &camera);
  return camera;
}

StereoModel ReadEuroc(const Files& files) {
  StereoModel model;
  model.left = EurocCamera(files[0]);
  model.right = EurocCamera(files[1]);
  model.T_right_left = MotionOf(files[1], files[1].root["T_BS"], "T_BS").inverse() *
                       MotionOf(files[0], files[0].root["T_BS"], "T_BS");
  return model;
}

// --- camera_info ---------------------------------------------------------------------------------

CameraModel InfoCamera(const CalibrationFile& file) {
  CameraModel camera;
  SetMatrix(NumbersOf(file, file.root["camera_matrix"], "camera_matrix", 9), &camera);
  SetImageSize(file, &camera);
  SetLens(file, TextAt(file.root, "distortion_model"),
          NumbersOf(file, file.root["distortion_coefficients"], "distortion_coefficients", 0),
          "distortion_model", &camera);
  return camera;
}

StereoModel ReadCameraInfo(const Files& files) {
  StereoModel model;
  model.left = InfoCamera(files[0]);
  model.right = InfoCamera(files[1]);
  std::array<StereoModel::Stated, 2> stated;
  for (std::size_t side = 0; side < 2; ++side) {
    const CalibrationFile& file = files[side];
    const char* turn = "rectification_matrix";
    stated[side] =
        StatedBy(RotationOf(file, NumbersOf(file, file.root[turn], turn, 9), turn),
                 NumbersOf(file, file.root["projection_matrix"], "projection_matrix", 12));
  }
  model.stated = stated;
  return model;
}

// --- OpenCV --------------------------------------------------------------------------------------

/// The file that has a key, if one does.
const CalibrationFile* WithKey(const Files& files, const std::string& key) {
  const auto found =
      std::ranges::find_if(files, [&](const CalibrationFile& file) { return file.Has(key); });
  return found == files.end() ? nullptr : &*found;
}

std::vector<double> OpenCvNumbers(const Files& files, const std::string& key, std::size_t count) {
  const CalibrationFile* file = WithKey(files, key);
  if (file == nullptr) files.back().Fail(key, "is missing: M1 D1 M2 D2 and R T are expected");
  return NumbersOf(*file, file->root[key], key, count);
}

Eigen::Matrix3d OpenCvRotation(const Files& files, const std::string& key) {
  const std::vector<double> numbers = OpenCvNumbers(files, key, 9);
  return RotationOf(*WithKey(files, key), numbers, key);
}

StereoModel ReadOpenCv(const Files& files) {
  StereoModel model;
  SetMatrix(OpenCvNumbers(files, "M1", 9), &model.left);
  SetMatrix(OpenCvNumbers(files, "M2", 9), &model.right);
  SetLens(files[0], "plumb_bob", OpenCvNumbers(files, "D1", 0), "D1", &model.left);
  SetLens(files[0], "plumb_bob", OpenCvNumbers(files, "D2", 0), "D2", &model.right);
  const auto shift = OpenCvNumbers(files, "T", 3);
  model.T_right_left.linear() = OpenCvRotation(files, "R");
  model.T_right_left.translation() << shift[0], shift[1], shift[2];
  constexpr const char* kRectification[] = {"R1", "R2", "P1", "P2"};
  if (std::ranges::all_of(kRectification, [&](const char* key) { return WithKey(files, key); })) {
    model.stated = {StatedBy(OpenCvRotation(files, "R1"), OpenCvNumbers(files, "P1", 12)),
                    StatedBy(OpenCvRotation(files, "R2"), OpenCvNumbers(files, "P2", 12))};
  }
  if (const CalibrationFile* file = WithKey(files, "image_width")) {  // newer samples write it
    for (CameraModel* camera : {&model.left, &model.right}) SetImageSize(*file, camera);
  }
  return model;
}

// --- KITTI ---------------------------------------------------------------------------------------

/// The one row of that name.
std::vector<double> KittiRow(const std::string& file, const std::string& text,
                             const std::string& name) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("{}: {}: {}", file, name, why));
  };
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(name + ":")) continue;
    if (!numbers.empty()) fail("duplicate row; keep one of them");
    for (const std::string_view word : WordsOf(std::string_view(line).substr(name.size() + 1))) {
      const std::optional<double> number = DecimalOf(word);
      if (!number) fail(fmt::format("'{}' is not a number; expected 12 numbers", Printable(word)));
      numbers.push_back(*number);
    }
  }
  if (numbers.size() != 12 || !(numbers[0] > 0)) fail("expected a 3x4 projection");
  return numbers;
}

StereoModel ReadKitti(const std::string& file, const std::string& text) {
  const Eigen::Matrix3d none = Eigen::Matrix3d::Identity();
  const auto left = KittiRow(file, text, "P0"), right = KittiRow(file, text, "P1");
  StereoModel model;
  SetPinhole({left[0], left[5], left[2], left[6]}, &model.left);
  SetPinhole({right[0], right[5], right[2], right[6]}, &model.right);
  model.T_right_left.translation().x() = right[3] / right[0];
  model.stated = {StatedBy(none, left), StatedBy(none, right)};
  return model;
}

bool IsKitti(const std::string& text) {
  std::istringstream stream(text);
  std::string word;
  return stream >> word && word == "P0:";
}

// --- All of them ---------------------------------------------------------------------------------

StereoModel ReadAny(const std::vector<std::string>& names) {
  if (names.size() == 1) {
    const std::string text = CalibrationText(names[0]);
    if (IsKitti(text)) return ReadKitti(names[0], text);
  }
  Files files;
  for (const std::string& name : names) files.push_back(OpenCalibration(name));
  const CalibrationFile& first = files[0];
  if (names.size() == 1 && first.Has("cam0")) return ReadKalibr(first);
  if (WithKey(files, "M1")) return ReadOpenCv(files);
  const auto both = [&](const char* key) {
    return files.size() == 2 && files[0].Has(key) && files[1].Has(key);
  };
  if (both("T_BS")) return ReadEuroc(files);
  if (both("projection_matrix")) return ReadCameraInfo(files);
  first.Fail("calibration",
             "is none that is read: Kalibr's camchain (cam0, cam1), OpenCV's (M1 D1 M2 D2, R T) or "
             "KITTI's calib.txt (P0, P1) alone, or the left and the right of EuRoC's sensor.yaml "
             "(T_BS) or camera_info (projection_matrix)");
}

void Check(const StereoModel& model, const std::string& file) {
  const auto fail = [&](const std::string& why) { throw std::runtime_error(file + ": " + why); };
  for (const CameraModel* camera : {&model.left, &model.right}) {
    if (!(camera->fx > 0 && camera->fy > 0)) fail("a focal length is not positive");
  }
  const double baseline_m =
      model.stated ? -(*model.stated)[1].projection(0, 3) / (*model.stated)[1].projection(0, 0)
                   : model.T_right_left.inverse().translation().x();
  constexpr double kLongest = 5;  // metres: nobody's robot
  if (!(baseline_m > 0)) {
    fail(
        fmt::format("the right camera is {:g} m to the right of the left one: are the two swapped, "
                    "or is the baseline missing?",
                    baseline_m));
  }
  if (baseline_m > kLongest) {
    fail(
        fmt::format("the baseline is {:g}: metres are expected, and this looks like millimetres; "
                    "calibrate with the board's size in metres, or scale T and P2",
                    baseline_m));
  }
}

}  // namespace

StereoModel ReadStereoModel(const std::vector<std::string>& files) {
  if (files.empty() || files.size() > 2) {
    throw std::runtime_error("calibration: one file of the rig, or two of left and right");
  }
  StereoModel model = ReadAny(files);
  Check(model, files[0]);
  return model;
}

}  // namespace aisle::sim
