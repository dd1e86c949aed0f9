#include "simulator/calibration/yaml_numbers.h"

#include <stdexcept>

#include "simulator/calibration/calibration_text.h"
#include "simulator/common/yaml_faults.h"

namespace aisle::sim {
namespace {

constexpr std::size_t kMostNumbers = 64;  // a motion has 16

/// Stops at the first thing that is no number, and at one number too many.
void Collect(const YAML::Node& node, std::vector<double>* numbers, bool* good) {
  if (!*good) return;
  if (node.IsMap() && node["data"]) return Collect(node["data"], numbers, good);
  if (node.IsSequence()) {
    for (const YAML::Node& part : node) Collect(part, numbers, good);
    return;
  }
  double value = 0;
  if (numbers->size() < kMostNumbers && node.IsScalar() &&
      YAML::convert<double>::decode(node, value) && std::isfinite(value)) {
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
  std::string text = CalibrationText(file);
  // OpenCV's own dialect. The line stays, empty, so that those below keep their numbers.
  if (text.starts_with("%YAML:")) text.erase(0, std::min(text.find('\n'), text.size()));
  if (const std::vector<YamlFault> faults = YamlFaults(text); !faults.empty()) {
    const auto& [line, column, key, what] = faults.front();
    throw std::runtime_error(
        fmt::format("{}:{}:{}: {}{}{}", file, line, column, key, key.empty() ? "" : ": ", what));
  }
  return {file, YAML::Load(text)};
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
  constexpr double kTolerance = 1e-6;
  if (!Eigen::Map<const Eigen::RowVector4d>(&numbers[12])
           .isApprox(Eigen::RowVector4d(0, 0, 0, 1), kTolerance)) {
    file.Fail(key, "not a rigid motion: its last row must be 0 0 0 1; is it transposed?");
  }
  return motion;
}

}  // namespace aisle::sim
