#include <charconv>
#include <string_view>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// A data line of a text table, split at blanks and commas. The fields point into the table's text.
struct Row {
  const fs::path& file;
  std::size_t line = 0;
  std::vector<std::string_view> fields;

  [[noreturn]] void Fail(const std::string& message) const {
    throw InputError(file.string(), line, message);
  }
};

/// The data lines of a file, one after the other.
class Table {
 public:
  explicit Table(const fs::path& path) : text_(ReadFile(path)), row_{path, 0, {}} {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  /// The next line that is neither empty nor a comment, valid until the next call; null at the end.
  const Row* Next() {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      Split(std::string_view(text_).substr(at_, end - at_));
      at_ = end + 1;
      ++row_.line;
      if (!row_.fields.empty() && row_.fields.front().front() != '#') return &row_;
    }
    return nullptr;
  }

  /// The same where a file without data is a mistake.
  const Row& First() {
    const Row* row = Next();
    if (row == nullptr) throw InputError(row_.file.string(), 0, "holds no poses");
    return *row;
  }

 private:
  void Split(std::string_view line) {
    constexpr std::string_view kBetween = " \t,\r";
    row_.fields.clear();
    for (std::size_t begin = line.find_first_not_of(kBetween); begin != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBetween, begin), line.size());
      row_.fields.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(kBetween, end);
    }
  }

  const std::string text_;
  std::size_t at_ = 0;
  Row row_;
};

double Number(const Row& row, std::size_t index) {
  const std::string_view field = row.fields[index];
  const std::size_t skip = field.front() == '+' ? 1 : 0;  // from_chars knows no plus sign
  double value = 0;
  const auto [end, error] =
      std::from_chars(field.data() + skip, field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) {
    row.Fail(
        fmt::format("field {} is '{}', not a number", index + 1, Printable(std::string(field))));
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
    row.Fail(fmt::format("'{}' is not a time in seconds", Printable(std::string(row.fields[0]))));
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
  const std::string_view stamp = row.fields[0];
  std::int64_t stamp_ns = 0;
  const auto [end, error] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), stamp_ns);
  if (error != std::errc() || end != stamp.data() + stamp.size()) {
    row.Fail(
        fmt::format("'{}' is not a stamp in whole nanoseconds", Printable(std::string(stamp))));
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
  Table table(times);
  for (std::size_t i = 0; i < count; ++i) {
    const Row* row = table.Next();
    if (row == nullptr) {
      throw InputError(
          times.string(), 0,
          fmt::format("holds {} times but {} holds {} poses", i, poses.string(), count));
    }
    stamps[i] = SecondsField(*row);
  }
  return stamps;
}

Trajectory ReadKitti(const fs::path& path, const fs::path& times) {
  Table table(path);
  Trajectory trajectory;
  for (const Row* row = &table.First(); row != nullptr; row = table.Next()) {
    trajectory.push_back({0, KittiPose(*row)});
  }
  const std::vector<std::int64_t> stamps = KittiStamps(times, path, trajectory.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) trajectory[i].stamp_ns = stamps[i];
  return trajectory;
}

Trajectory ReadStamped(const fs::path& path, StampedPose (*pose)(const Row&)) {
  Table table(path);
  Trajectory trajectory;
  std::string_view before;
  for (const Row* row = &table.First(); row != nullptr; row = table.Next()) {
    trajectory.push_back(pose(*row));
    const std::string_view stamp = row->fields.front();
    const std::size_t n = trajectory.size();
    if (n > 1 && trajectory[n - 1].stamp_ns < trajectory[n - 2].stamp_ns) {
      row->Fail(fmt::format("stamp {} is earlier than the line before ({}): sort the file",
                            Printable(std::string(stamp)), Printable(std::string(before))));
    }
    before = stamp;
  }
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
  Table table(path);
  const Row& row = table.First();
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
