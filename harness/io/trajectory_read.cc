#include <charconv>
#include <sstream>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// A data line of a text table, split at blanks and commas.
struct Row {
  const fs::path& file;
  std::size_t line = 0;
  std::vector<std::string> fields;

  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(file.string(), line, message);
  }
};

std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields;
  std::string field;
  for (const char c : line + " ") {
    if (c == ' ' || c == '\t' || c == ',' || c == '\r') {
      if (!field.empty()) fields.push_back(std::exchange(field, {}));
    } else {
      field += c;
    }
  }
  return fields;
}

std::vector<Row> ReadRows(const fs::path& path) {
  std::string text = ReadFile(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  std::istringstream stream(text);
  std::vector<Row> rows;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    Row row{path, number, Fields(line)};
    if (!row.fields.empty() && row.fields.front().front() != '#') rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError(path.string(), 0, "holds no poses");
  return rows;
}

double Number(const Row& row, std::size_t index) {
  const std::string& field = row.fields[index];
  const std::size_t skip = field.front() == '+' ? 1 : 0;  // from_chars knows no plus sign
  double value = 0;
  const auto [end, error] =
      std::from_chars(field.data() + skip, field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) {
    row.Fail(fmt::format("field {} is '{}', not a number", index + 1, Printable(field)));
  }
  if (!std::isfinite(value)) {
    row.Fail(fmt::format("field {} is {}: poses must be finite", index + 1, field));
  }
  return value;
}

Eigen::Vector3d Position(const Row& row, std::size_t first) {
  return {Number(row, first), Number(row, first + 1), Number(row, first + 2)};
}

Eigen::Isometry3d Pose(const Row& row, const Eigen::Vector3d& position, Eigen::Quaterniond q) {
  constexpr double kNormTolerance = 0.05;  // files with three decimals are still rotations
  if (std::abs(q.norm() - 1) > kNormTolerance) {
    row.Fail(fmt::format("the quaternion has norm {:.4g}, not 1: check the order of the columns",
                         q.norm()));
  }
  q.normalize();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.toRotationMatrix();
  pose.translation() = position;
  return pose;
}

std::int64_t SecondsField(const Row& row) {
  std::int64_t stamp_ns = 0;
  if (!ParseSecondsToNs(row.fields[0], &stamp_ns)) {
    row.Fail(fmt::format("'{}' is not a time in seconds", Printable(row.fields[0])));
  }
  return stamp_ns;
}

StampedPose TumPose(const Row& row) {
  if (row.fields.size() != 8) {
    row.Fail(fmt::format("{} fields; a TUM line has 8: timestamp tx ty tz qx qy qz qw",
                         row.fields.size()));
  }
  const Eigen::Quaterniond q(Number(row, 7), Number(row, 4), Number(row, 5), Number(row, 6));
  return {SecondsField(row), Pose(row, Position(row, 1), q)};
}

StampedPose EurocPose(const Row& row) {
  if (row.fields.size() < 8) {
    row.Fail(fmt::format("{} fields; a EuRoC line has at least 8: stamp [ns], p x y z, q w x y z",
                         row.fields.size()));
  }
  const std::string& stamp = row.fields[0];
  std::int64_t stamp_ns = 0;
  const auto [end, error] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), stamp_ns);
  if (error != std::errc() || end != stamp.data() + stamp.size()) {
    row.Fail(fmt::format("'{}' is not a stamp in whole nanoseconds", Printable(stamp)));
  }
  const Eigen::Quaterniond q(Number(row, 4), Number(row, 5), Number(row, 6), Number(row, 7));
  return {stamp_ns, Pose(row, Position(row, 1), q)};
}

Eigen::Isometry3d KittiPose(const Row& row) {
  if (row.fields.size() != 12) {
    row.Fail(
        fmt::format("{} fields; a KITTI line has 12: three rows of a 3x4 pose", row.fields.size()));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t k = 0; k < 12; ++k) {
    pose.matrix()(static_cast<int>(k / 4), static_cast<int>(k % 4)) = Number(row, k);
  }
  const double off = (pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity())
                         .cwiseAbs()
                         .maxCoeff();
  constexpr double kOrthonormalTolerance = 0.01;
  if (off > kOrthonormalTolerance || pose.linear().determinant() < 0) {
    row.Fail(fmt::format("the left 3x3 block is no rotation (R·Rᵀ is off by {:.2g})", off));
  }
  return pose;
}

std::vector<std::int64_t> KittiStamps(const fs::path& times, const fs::path& poses,
                                      std::size_t count) {
  constexpr std::int64_t kNominalStepNs = 100'000'000;  // the benchmark's 10 Hz
  std::vector<std::int64_t> stamps(count);
  if (times.empty()) {
    for (std::size_t i = 0; i < count; ++i)
      stamps[i] = static_cast<std::int64_t>(i) * kNominalStepNs;
    return stamps;
  }
  const std::vector<Row> rows = ReadRows(times);
  if (rows.size() < count) {
    throw InputError(
        times.string(), 0,
        fmt::format("holds {} times but {} holds {} poses", rows.size(), poses.string(), count));
  }
  for (std::size_t i = 0; i < count; ++i) stamps[i] = SecondsField(rows[i]);
  return stamps;
}

Trajectory ReadKitti(const fs::path& path, const fs::path& times) {
  const std::vector<Row> rows = ReadRows(path);
  const std::vector<std::int64_t> stamps = KittiStamps(times, path, rows.size());
  Trajectory trajectory;
  trajectory.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    trajectory.push_back({stamps[i], KittiPose(rows[i])});
  }
  return trajectory;
}

void CheckStampsDoNotFall(const Trajectory& trajectory, const std::vector<Row>& rows) {
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (trajectory[i].stamp_ns >= trajectory[i - 1].stamp_ns) continue;
    rows[i].Fail(fmt::format("stamp {} is earlier than the line before ({}): sort the file",
                             Printable(rows[i].fields[0]), Printable(rows[i - 1].fields[0])));
  }
}

Trajectory ReadStamped(const fs::path& path, StampedPose (*pose)(const Row&)) {
  const std::vector<Row> rows = ReadRows(path);
  Trajectory trajectory;
  trajectory.reserve(rows.size());
  for (const Row& row : rows) trajectory.push_back(pose(row));
  CheckStampsDoNotFall(trajectory, rows);
  return trajectory;
}

}  // namespace

TrajectoryFormat TrajectoryFormatFromName(const std::string& name) {
  if (name == "tum") return TrajectoryFormat::kTum;
  if (name == "kitti") return TrajectoryFormat::kKitti;
  if (name == "euroc") return TrajectoryFormat::kEuroc;
  throw InputError("trajectory format '" + Printable(name) + "': expected tum, kitti or euroc");
}

TrajectoryFormat GuessTrajectoryFormat(const fs::path& path) {
  const Row row = ReadRows(path).front();
  const std::size_t count = row.fields.size();
  if (count == 12) return TrajectoryFormat::kKitti;
  // A EuRoC stamp is whole nanoseconds; TUM seconds of a plausible year are 10 digits at most.
  const bool whole = row.fields[0].find_first_not_of("0123456789") == std::string::npos;
  if (count >= 8 && whole && (count > 8 || row.fields[0].size() > 12)) {
    return TrajectoryFormat::kEuroc;
  }
  if (count == 8) return TrajectoryFormat::kTum;
  row.Fail(fmt::format("{} fields: neither TUM (8), KITTI (12) nor EuRoC (8 to 17, stamp in ns)",
                       count));
}

Trajectory ReadTrajectory(const fs::path& path, TrajectoryFormat format, const fs::path& times) {
  switch (format) {
    case TrajectoryFormat::kTum:
      return ReadStamped(path, TumPose);
    case TrajectoryFormat::kEuroc:
      return ReadStamped(path, EurocPose);
    case TrajectoryFormat::kKitti:
      break;
  }
  return ReadKitti(path, times);
}

}  // namespace aisle
