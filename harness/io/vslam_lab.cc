#include "harness/io/vslam_lab.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "harness/io/file.h"
#include "harness/io/imu.h"
#include "harness/io/input_error.h"
#include "harness/io/shell_word.h"
#include "harness/io/trajectory.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string Camera(const StereoCalibration& c, double rate_hz, int side) {
  return fmt::format(
      "- cam_name: rgb_{}\n  cam_type: gray\n  cam_model: pinhole\n  distortion_type: radtan4\n"
      "  focal_length: [{}, {}]\n  principal_point: [{}, {}]\n"
      "  distortion_coefficients: [0.0, 0.0, 0.0, 0.0]\n  image_dimension: [{}, {}]\n"
      "  fps: {:g}\n  T_BS: [1.0, 0.0, 0.0, {}, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, "
      "0.0, 1.0]\n",
      side, c.fx, c.fy, c.cx, c.cy, c.width, c.height, rate_hz, side * c.baseline_m);
}

std::string Imu(double rate_hz) {
  return fmt::format(
      "imus:\n- imu_name: imu_0\n  a_max: 176.0\n  g_max: 7.8\n"
      "  sigma_g_c: 1.6968e-04\n  sigma_a_c: 2.0000e-3\n  sigma_gw_c: 1.9393e-05\n"
      "  sigma_aw_c: 3.0000e-3\n  fps: {:g}\n"
      "  T_BS: [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]\n",
      rate_hz);
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

/// A stamp in nanoseconds: whole, with a point, or with an exponent as NumPy writes by default.
/// None where it is too small to be that.
std::optional<std::int64_t> Nanoseconds(const std::string& stamp) {
  constexpr std::int64_t kLeast = 100'000'000'000;  // in seconds, the year 5138
  const std::size_t e = std::min(stamp.find_first_of("eE"), stamp.size());
  int exponent = 0;
  if (e < stamp.size()) {
    const std::size_t digits = e + (stamp.substr(e + 1, 1) == "+" ? 2 : 1);
    const char *from = stamp.data() + digits, *to = stamp.data() + stamp.size();
    const auto [end, error] = std::from_chars(from, to, exponent);
    if (error != std::errc() || end != to || std::clamp(exponent, -99, 99) != exponent) {
      return std::nullopt;
    }
  }
  std::int64_t stamp_ns = 0;  // digit by digit: a double would round them
  const std::string seconds = fmt::format("{}e{}", stamp.substr(0, e), exponent - 9);
  if (!ParseSecondsToNs(seconds, &stamp_ns) || stamp_ns < kLeast) return std::nullopt;
  return stamp_ns;
}

/// As TUM has it: seconds first.
std::string TumLine(std::vector<std::string> fields) {
  if (const auto stamp_ns = Nanoseconds(fields[0])) fields[0] = FormatSeconds(*stamp_ns);
  return fmt::format("{}\n", fmt::join(fields, " "));
}

}  // namespace

void WriteVslamLabFiles(const fs::path& dataset, const StereoCalibration& calibration,
                        double rate_hz, const std::vector<FrameRequest>& frames,
                        const PathOfRig& path, const ExportOptions& options) {
  std::string images = "ts_rgb_0 (ns),path_rgb_0,ts_rgb_1 (ns),path_rgb_1\n";
  for (const FrameRequest& frame : frames) {
    images +=
        fmt::format("{0},rgb_0/{0}.png,{0},rgb_1/{0}.png\n", frame.stamp_ns + options.epoch_ns);
  }
  std::string imu =
      "ts (ns),wx (rad s^-1),wy (rad s^-1),wz (rad s^-1),ax (m s^-2),ay (m s^-2),az (m s^-2)\n";
  for (const ImuSample& sample :
       IdealImu(path, frames.front().stamp_ns, frames.back().stamp_ns, options.imu_rate_hz)) {
    const Eigen::Vector3d &w = sample.angular_velocity, &a = sample.specific_force;
    imu += fmt::format("{},{},{},{},{},{},{}\n", sample.stamp_ns + options.epoch_ns, w.x(), w.y(),
                       w.z(), a.x(), a.y(), a.z());
  }
  WriteFileAtomically(dataset / "rgb.csv", images);
  WriteFileAtomically(dataset / "imu_0.csv", imu);
  WriteFileAtomically(dataset / "calibration.yaml",
                      "%YAML 1.2\n---\ncameras:\n" + Camera(calibration, rate_hz, 0) +
                          Camera(calibration, rate_hz, 1) + Imu(options.imu_rate_hz));
}

void LinkVslamLabImages(const fs::path& dataset) {
  for (int side = 0; side < 2; ++side) {
    std::error_code error;
    fs::create_directory_symlink(fmt::format("mav0/cam{}/data", side),
                                 dataset / fmt::format("rgb_{}", side), error);
    if (error) throw MachineError(dataset.string() + ": cannot link: " + error.message());
  }
}

std::string VslamLabArguments(const VslamLabRun& run, VslamLabStyle style) {
  const fs::path dataset = fs::absolute(run.dataset), output = fs::absolute(run.output);
  const bool python = style == VslamLabStyle::kPython;
  std::string line;
  for (const auto& [key, value] :
       {std::pair<const char*, std::string>("sequence_path", dataset.string()),
        {"calibration_yaml", (dataset / "calibration.yaml").string()},
        {"rgb_csv", (dataset / "rgb.csv").string()},
        {"exp_folder", output.string()},
        {python ? "exp_it" : "exp_id", "00000"},
        {"mode", "stereo"}}) {
    if (!line.empty()) line += ' ';
    line += python ? fmt::format("--{} {}", key, ShellWord(value))
                   : ShellWord(fmt::format("{}:{}", key, value));
  }
  return line;
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
  return ReadTrajectory(as_tum, TrajectoryFormat::kTum, {}, RowOrder::kAny);
}

}  // namespace aisle
