#include "harness/io/vslam_lab.h"

#include <sstream>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string Camera(const StereoCalibration& c, double rate_hz, int side) {
  return fmt::format(
      "- cam_name: rgb_{}\n  cam_type: gray\n  cam_model: pinhole\n  distortion_type: radtan4\n"
      "  focal_length: [{}, {}]\n  principal_point: [{}, {}]\n"
      "  distortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n  image_dimension: [{}, {}]\n"
      "  fps: {:g}\n  T_BS: [1.0, 0.0, 0.0, {}, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, "
      "0.0, 1.0]\n",
      side, c.fx, c.fy, c.cx, c.cy, c.width, c.height, rate_hz, side * c.baseline_m);
}

/// The numbers of one row, or none for a header or a comment.
std::vector<std::string> Fields(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream stream(line);
  std::vector<std::string> fields;
  for (std::string field; stream >> field;) fields.push_back(field);
  const bool number =
      !fields.empty() && fields[0].find_first_not_of("0123456789.+-eE") == std::string::npos;
  return number ? fields : std::vector<std::string>{};
}

/// As TUM has it: seconds first.
std::string TumLine(std::vector<std::string> fields) {
  constexpr std::size_t kDigitsOfSeconds = 11;  // more before the point: nanoseconds
  const std::string& stamp = fields[0];
  if (stamp.find_first_of(".eE") == std::string::npos && stamp.size() > kDigitsOfSeconds) {
    fields[0] = FormatSeconds(std::stoll(stamp));
  }
  return fmt::format("{}\n", fmt::join(fields, " "));
}

}  // namespace

void WriteVslamLabFiles(const fs::path& dataset, const StereoCalibration& calibration,
                        double rate_hz, const std::vector<FrameRequest>& frames,
                        std::int64_t epoch_ns) {
  std::string images = "ts_rgb_0 (ns),path_rgb_0,ts_rgb_1 (ns),path_rgb_1\n";
  std::string truth = "ts (ns),tx (m),ty (m),tz (m),qx,qy,qz,qw\n";
  for (const FrameRequest& frame : frames) {
    const std::int64_t stamp_ns = frame.stamp_ns + epoch_ns;
    images += fmt::format("{0},mav0/cam0/data/{0}.png,{0},mav0/cam1/data/{0}.png\n", stamp_ns);
    const Eigen::Vector3d p = frame.T_world_rig.translation();
    const Eigen::Quaterniond q(frame.T_world_rig.linear());
    truth += fmt::format("{},{},{},{},{},{},{},{}\n", stamp_ns, p.x(), p.y(), p.z(), q.x(), q.y(),
                         q.z(), q.w());
  }
  WriteFileAtomically(dataset / "rgb.csv", images);
  WriteFileAtomically(dataset / "groundtruth.csv", truth);
  WriteFileAtomically(dataset / "calibration.yaml", "cameras:\n" + Camera(calibration, rate_hz, 0) +
                                                        Camera(calibration, rate_hz, 1));
}

std::string VslamLabArguments(const VslamLabRun& run) {
  const fs::path dataset = fs::absolute(run.dataset), output = fs::absolute(run.output);
  return fmt::format(
      "{} {} {} {} exp_id:00000 mode:stereo", Quoted("sequence_path:" + dataset.string()),
      Quoted("calibration_yaml:" + (dataset / "calibration.yaml").string()),
      Quoted("rgb_csv:" + (dataset / "rgb.csv").string()), Quoted("exp_folder:" + output.string()));
}

fs::path VslamLabTrajectoryPath(const VslamLabRun& run) {
  return run.output / "00000_KeyFrameTrajectory.csv";
}

Trajectory ReadVslamLabTrajectory(const fs::path& file) {
  std::istringstream stream(ReadFile(file));
  std::string line, tum;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const std::vector<std::string> fields = Fields(line);
    if (fields.empty()) {
      tum += "#\n";  // keeps the line numbers of complaints
    } else if (fields.size() != 8) {
      throw InputError(
          file.string(), number,
          fmt::format("{} columns: expected stamp, tx, ty, tz, qx, qy, qz, qw", fields.size()));
    } else {
      tum += TumLine(fields);
    }
  }
  fs::path as_tum = file;
  as_tum.replace_extension(".tum");
  WriteFileAtomically(as_tum, tum);
  return ReadTrajectory(as_tum, TrajectoryFormat::kTum);
}

}  // namespace aisle
