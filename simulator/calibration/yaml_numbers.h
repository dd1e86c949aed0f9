#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace aisle::sim {

/// A YAML file whose parts are numbers, with the file's name for messages.
struct CalibrationFile {
  std::string name;
  YAML::Node root;

  /// Throws std::runtime_error: "file: key: why".
  [[noreturn]] void Fail(const std::string& key, const std::string& why) const;
  bool Has(const std::string& key) const { return root.IsMap() && root[key]; }
};

/// Opens one, OpenCV's own first line included. Throws std::runtime_error, also where its YAML is
/// at fault as such (YamlFaults).
CalibrationFile OpenCalibration(const std::string& file);

/// All finite numbers of a list, of lists of lists, or of a map's `data`. Throws where there are
/// not `count` of them (0: any number, at most 64).
std::vector<double> NumbersOf(const CalibrationFile& file, const YAML::Node& node,
                              const std::string& key, std::size_t count);

/// A rotation out of nine numbers, row major. Throws where it is none, or mirrors.
Eigen::Matrix3d RotationOf(const CalibrationFile& file, const std::vector<double>& numbers,
                           const std::string& key);

/// A rigid motion out of 16 numbers, row major. Throws where its turn or its last row is none.
Eigen::Isometry3d MotionOf(const CalibrationFile& file, const YAML::Node& node,
                           const std::string& key);

}  // namespace aisle::sim
