#include "simulator/calibration/yaml_numbers.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace aisle::sim {
namespace {

void Collect(const YAML::Node& node, std::vector<double>* numbers, bool* good) {
  if (node.IsMap() && node["data"]) return Collect(node["data"], numbers, good);
  if (node.IsSequence()) {
    for (const YAML::Node& part : node) Collect(part, numbers, good);
    return;
  }
  double value = 0;
  if (node.IsScalar() && YAML::convert<double>::decode(node, value) && std::isfinite(value)) {
    numbers->push_back(value);
  } else {
    *good = false;
  }
}

}  // namespace

void CalibrationFile::Fail(const std::string& key, const std::string& why) const {
  throw std::runtime_error(fmt::format("{}: {}: {}", name, key, why));
}

CalibrationFile OpenCalibration(const std::string& file) {
  constexpr std::uintmax_t kMostBytes = 1 << 20;
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw std::runtime_error(file + ": cannot be read: no such file");
  if (size > kMostBytes) throw std::runtime_error(file + ": is too large for a calibration");
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  std::string text = bytes.str();
  if (text.starts_with("%YAML:")) text.erase(0, text.find('\n') + 1);  // OpenCV's own dialect
  try {
    return {file, YAML::Load(text)};
  } catch (const YAML::Exception& wrong) {
    throw std::runtime_error(
        fmt::format("{}:{}: not YAML: {}", file, wrong.mark.line + 1, wrong.msg));
  }
}

std::vector<double> NumbersOf(const CalibrationFile& file, const YAML::Node& node,
                              const std::string& key, std::size_t count) {
  std::vector<double> numbers;
  bool good = node.IsDefined();
  if (good) Collect(node, &numbers, &good);
  if (!good || (count > 0 && numbers.size() != count)) {
    file.Fail(key, count > 0 ? fmt::format("expected {} numbers", count) : "expected numbers");
  }
  return numbers;
}

Eigen::Matrix3d RotationOf(const CalibrationFile& file, const std::vector<double>& numbers,
                           const std::string& key) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = numbers[static_cast<std::size_t>(i)];
  constexpr double kTolerance = 1e-3;  // files print a few digits
  if (!(rotation * rotation.transpose()).isIdentity(kTolerance)) {
    file.Fail(key, "not a rotation: its columns are not of unit length and orthogonal");
  }
  if (rotation.determinant() < 0) {
    file.Fail(key, "not a rotation: it mirrors; is a sign wrong?");
  }
  return rotation;
}

Eigen::Isometry3d MotionOf(const CalibrationFile& file, const YAML::Node& node,
                           const std::string& key) {
  const std::vector<double> numbers = NumbersOf(file, node, key, 16);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  const auto row = [&](std::size_t i) {
    return numbers.begin() + static_cast<std::ptrdiff_t>(4 * i);
  };
  std::vector<double> turn;
  for (std::size_t i = 0; i < 3; ++i) {
    turn.insert(turn.end(), row(i), row(i) + 3);
    motion.translation()(static_cast<int>(i)) = row(i)[3];
  }
  motion.linear() = RotationOf(file, turn, key);
  return motion;
}

}  // namespace aisle::sim
