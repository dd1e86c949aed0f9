#include <charconv>
#include <functional>
#include <string_view>

#include "harness/contract/rigid.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/trajectory_text.h"

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

/// The part of a quaternion that a column's title names: 'w' of "qw", "q_RS_w" or "qw[]"; 0: none.
char QuaternionPart(std::string_view title) {
  while (!title.empty() && std::isalnum(static_cast<unsigned char>(title.back())) == 0) {
    title.remove_suffix(1);
  }
  if (title.size() < 2 || std::tolower(static_cast<unsigned char>(title.front())) != 'q') return 0;
  const auto part = static_cast<char>(std::tolower(static_cast<unsigned char>(title.back())));
  return std::string_view("wxyz").find(part) != std::string_view::npos ? part : '\0';
}

/// The format whose order of a quaternion's parts the titles have; absent where they name none.
std::optional<TrajectoryFormat> FormatByTitles(const std::vector<std::string_view>& titles) {
  std::string parts;
  for (const std::string_view title : titles) {
    if (const char part = QuaternionPart(title); part != 0) parts += part;
  }
  if (parts == "wxyz") return TrajectoryFormat::kEuroc;
  if (parts == "xyzw") return TrajectoryFormat::kTum;
  return std::nullopt;
}

/// The data lines of a file, one after the other.
class Table {
 public:
  explicit Table(const TextFile& file) : text_(file.text), row_{file.name, 0, {}} { Restart(); }

  /// Before the first line again.
  void Restart() {
    at_ = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    row_.line = 0;
  }

  /// The next line that is neither empty nor a comment, valid until the next call; null at the end.
  const Row* Next() {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      Split(text_.substr(at_, end - at_));
      at_ = end + 1;
      ++row_.line;
      if (row_.fields.empty()) continue;
      if (row_.fields.front().front() != '#') return &row_;
      if (const auto told = FormatByTitles(row_.fields)) titles_ = told;
    }
    return nullptr;
  }

  /// By the last comment so far that names the parts of a quaternion; absent without one.
  std::optional<TrajectoryFormat> titles() const { return titles_; }

  /// The same where a file without data is a mistake.
  const Row& First() {
    const Row* row = Next();
    if (row == nullptr) throw InputError(row_.file.string(), 0, "no poses in this file");
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

  const std::string_view text_;
  std::size_t at_ = 0;
  Row row_;
  std::optional<TrajectoryFormat> titles_;
};

double Number(const Row& row, std::size_t index) {
  const std::string_view field = row.fields[index];
  const std::size_t skip = field.front() == '+' ? 1 : 0;  // from_chars knows no plus sign
  double value = 0;
  const auto [end, error] =
      std::from_chars(field.data() + skip, field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) {
    const bool is_word = std::isalpha(static_cast<unsigned char>(field.front())) != 0;
    row.Fail(fmt::format("field {} is '{}', not a number{}", index + 1,
                         Printable(std::string(field)),
                         row.line == 1 && is_word ? ": column titles must begin with '#'" : ""));
  }
  if (!std::isfinite(value)) {
    row.Fail(fmt::format("field {} is {}: poses must be finite", index + 1, field));
  }
  return value;
}

/// One coordinate of a position.
double Metres(const Row& row, std::size_t index) {
  const double value = Number(row, index);
  if (std::abs(value) > kFarthest_m) {
    row.Fail(
        fmt::format("field {} is {}: positions must be in metres and within {:g} of the origin",
                    index + 1, row.fields[index], kFarthest_m));
  }
  return value;
}

Eigen::Vector3d Position(const Row& row, std::size_t first) {
  return {Metres(row, first), Metres(row, first + 1), Metres(row, first + 2)};
}

/// Holds the order of stamps, row by row.
class StampOrder {
 public:
  explicit StampOrder(RowOrder order) : order_(order) {}

  void Check(const Row& row, std::int64_t stamp_ns, const std::string& what) {
    // Published files repeat a stamp here and there; one that stands still was not written as time.
    constexpr std::size_t kMostEqual = 1000;
    equal_ = rows_ > 0 && stamp_ns == before_ns_ ? equal_ + 1 : 1;
    if (equal_ > kMostEqual) {
      row.Fail(
          fmt::format("{} is the same as in the previous {} rows: is the first column the time?",
                      what, kMostEqual));
    }
    if (order_ == RowOrder::kRising && rows_ > 0 && stamp_ns < before_ns_) {
      row.Fail(fmt::format("{} is earlier than on the previous line ({}): sort the file", what,
                           before_));
    }
    ++rows_;
    before_ns_ = stamp_ns;
    before_ = what.substr(what.find(' ') + 1);
  }

 private:
  const RowOrder order_;
  std::size_t rows_ = 0, equal_ = 0;
  std::int64_t before_ns_ = 0;
  std::string before_;
};

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

/// So many digits before the point are no seconds of any year.
constexpr std::size_t kLeastDigitsOfNanoseconds = 13;

bool IsWhole(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// The digits before a number's point where nothing else is before it, else none.
std::string_view DigitsBeforePoint(std::string_view text) {
  const std::string_view digits = text.substr(0, text.find('.'));
  return IsWhole(digits) ? digits : std::string_view();
}

/// Nanoseconds in TUM's columns: whole, or as ORB-SLAM3 writes EuRoC's stamps, as a real number
/// ("1403636579763555584.000000").
bool ParseNanoseconds(std::string_view text, std::int64_t* stamp_ns) {
  const std::string_view digits = DigitsBeforePoint(text);
  const std::string_view rest = text.substr(digits.size());
  const bool is_decimal = rest.empty() || rest.find_first_not_of("0123456789", 1) == rest.npos;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), *stamp_ns);
  return is_decimal && error == std::errc();
}

enum class StampUnit { kSeconds, kNanoseconds };

/// The unit of a table's stamps, by its first rows: nanoseconds have the digits of a date, or whole
/// numbers from a clock that began at 0 and steps that no frames in seconds have.
StampUnit UnitOfStamps(Table* table) {
  constexpr int kRowsThatTell = 100;
  constexpr std::int64_t kLeastStep = 1'000'000;  // 1 ms, or eleven days and a half
  constexpr std::size_t kDecimalsOfSeconds = 9;   // no program writes so many of nanoseconds
  std::optional<std::int64_t> before, least_step;
  table->Restart();
  for (int i = 0; i < kRowsThatTell; ++i) {
    const Row* row = table->Next();
    if (row == nullptr) break;
    const std::string_view stamp = row->fields[0], digits = DigitsBeforePoint(stamp);
    if (digits.size() >= kLeastDigitsOfNanoseconds) return StampUnit::kNanoseconds;
    const std::string_view rest = stamp.substr(digits.size());
    const bool of_seconds =
        rest.size() > kDecimalsOfSeconds || rest.find_first_not_of(".0") != rest.npos;
    std::int64_t now = 0;
    if (of_seconds || !ParseNanoseconds(stamp, &now)) return StampUnit::kSeconds;
    const std::int64_t step = std::abs(now - before.value_or(now));
    if (step > 0) least_step = std::min(step, least_step.value_or(step));
    before = now;
  }
  return least_step >= kLeastStep ? StampUnit::kNanoseconds : StampUnit::kSeconds;
}

std::int64_t StampField(const Row& row, StampUnit unit) {
  std::int64_t stamp_ns = 0;
  const std::string_view field = row.fields[0];
  const bool good = unit == StampUnit::kNanoseconds ? ParseNanoseconds(field, &stamp_ns)
                                                    : ParseSecondsToNs(field, &stamp_ns);
  if (!good) {
    row.Fail(fmt::format("'{}' is not a time in {}", Printable(std::string(field)),
                         unit == StampUnit::kNanoseconds ? "nanoseconds" : "seconds"));
  }
  return stamp_ns;
}

StampedPose TumPose(const Row& row, StampUnit unit) {
  if (row.fields.size() != 8) {
    row.Fail(fmt::format("{} fields; a TUM line has 8: timestamp tx ty tz qx qy qz qw",
                         row.fields.size()));
  }
  const Eigen::Quaterniond q(Number(row, 7), Number(row, 4), Number(row, 5), Number(row, 6));
  return {StampField(row, unit), Pose(row, Position(row, 1), q)};
}

StampedPose EurocPose(const Row& row) {
  if (row.fields.size() < 8) {
    row.Fail(
        fmt::format("{} fields; a EuRoC line has at least 8: timestamp [ns], p x y z, q w x y z",
                    row.fields.size()));
  }
  const std::string_view stamp = row.fields[0];
  std::int64_t stamp_ns = 0;
  const auto [end, error] = std::from_chars(stamp.data(), stamp.data() + stamp.size(), stamp_ns);
  if (error != std::errc() || end != stamp.data() + stamp.size()) {
    row.Fail(fmt::format(
        "expected a timestamp in integer nanoseconds, got '{}' (ORB-SLAM3's output has format tum)",
        Printable(std::string(stamp))));
  }
  const Eigen::Quaterniond q(Number(row, 4), Number(row, 5), Number(row, 6), Number(row, 7));
  return {stamp_ns, Pose(row, Position(row, 1), q)};
}

constexpr std::size_t kKittiNumbers = 12;

Eigen::Isometry3d KittiPose(const Row& row) {
  if (row.fields.size() != kKittiNumbers && row.fields.size() != kKittiNumbers + 1) {
    row.Fail(
        fmt::format("{} fields; a KITTI line has 12: three rows of a 3x4 pose", row.fields.size()));
  }
  const std::size_t first = row.fields.size() - kKittiNumbers;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t k = 0; k < kKittiNumbers; ++k) {
    const bool is_position = k % 4 == 3;
    pose.matrix()(static_cast<int>(k / 4), static_cast<int>(k % 4)) =
        is_position ? Metres(row, first + k) : Number(row, first + k);
  }
  const double off = (pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity())
                         .cwiseAbs()
                         .maxCoeff();
  constexpr double kOrthonormalTolerance = 0.01;
  if (off > kOrthonormalTolerance || pose.linear().determinant() < 0) {
    row.Fail(fmt::format("the left 3x3 block is not a rotation (R·Rᵀ is off by {:.2g})", off));
  }
  return pose;
}

/// The frame that a row is about: the number before the pose, else how many rows stand above.
std::size_t KittiFrame(const Row& row, std::size_t rows_above) {
  if (row.fields.size() == kKittiNumbers) return rows_above;
  const std::string_view field = row.fields.front();
  std::uint32_t frame = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), frame);
  if (error != std::errc() || end != field.data() + field.size()) {
    row.Fail(fmt::format("'{}' before the 12 numbers of the pose is not a frame number",
                         Printable(std::string(field))));
  }
  return frame;
}

/// The time of every frame that the file lists.
std::vector<std::int64_t> KittiTimes(const TextFile& times) {
  std::vector<std::int64_t> stamps;
  Table table(times);
  const StampUnit unit = UnitOfStamps(&table);
  table.Restart();
  for (const Row* row = table.Next(); row != nullptr; row = table.Next()) {
    stamps.push_back(StampField(*row, unit));
  }
  return stamps;
}

Trajectory ReadKitti(const TextFile& file, const std::optional<TextFile>& times) {
  Table table(file);
  Trajectory trajectory;
  StampOrder order(RowOrder::kRising);
  const std::vector<std::int64_t> stamps = times ? KittiTimes(*times) : std::vector<std::int64_t>{};
  for (const Row* row = &table.First(); row != nullptr; row = table.Next()) {
    const std::size_t frame = KittiFrame(*row, trajectory.size());
    if (times && frame >= stamps.size()) {
      row->Fail(fmt::format("frame {} has no time: {} has {}", frame, times->name.string(),
                            stamps.size()));
    }
    const std::int64_t stamp_ns =
        times ? stamps[frame] : static_cast<std::int64_t>(frame) * kKittiStepNs;
    order.Check(*row, stamp_ns, fmt::format("frame {}", frame));
    trajectory.push_back({stamp_ns, KittiPose(*row)});
  }
  return trajectory;
}

Trajectory ReadStamped(Table* table, const std::function<StampedPose(const Row&)>& pose,
                       RowOrder order) {
  Trajectory trajectory;
  StampOrder stamps(order);
  table->Restart();
  for (const Row* row = &table->First(); row != nullptr; row = table->Next()) {
    trajectory.push_back(pose(*row));
    stamps.Check(*row, trajectory.back().stamp_ns,
                 "stamp " + Printable(std::string(row->fields.front())));
  }
  std::stable_sort(
      trajectory.begin(), trajectory.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.stamp_ns < b.stamp_ns; });
  return trajectory;
}

}  // namespace

std::string Describe(TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::kTum:
      return "TUM, qw last";
    case TrajectoryFormat::kEuroc:
      return "EuRoC, qw first";
    case TrajectoryFormat::kKitti:
      break;
  }
  return "KITTI";
}

TrajectoryFormat TrajectoryFormatFromName(const std::string& name) {
  if (name == "tum") return TrajectoryFormat::kTum;
  if (name == "kitti") return TrajectoryFormat::kKitti;
  if (name == "euroc") return TrajectoryFormat::kEuroc;
  throw InputError("trajectory format '" + Printable(name) + "': expected tum, kitti or euroc");
}

TextFile ReadTextFile(const fs::path& path) { return {.name = path, .text = ReadFile(path)}; }

std::optional<TrajectoryFormat> TellTrajectoryFormat(const fs::path& path) {
  return TellTrajectoryFormat(ReadTextFile(path));
}

std::optional<TrajectoryFormat> TellTrajectoryFormat(const TextFile& file) {
  Table table(file);
  const Row& row = table.First();
  const std::size_t count = row.fields.size();
  if (count == kKittiNumbers) return TrajectoryFormat::kKitti;
  const bool whole = IsWhole(row.fields[0]);
  constexpr std::size_t kDigitsOfFrames = 9;  // fewer than any stamp in nanoseconds
  if (count == kKittiNumbers + 1 && whole && row.fields[0].size() <= kDigitsOfFrames) {
    return TrajectoryFormat::kKitti;
  }
  const std::optional<TrajectoryFormat> titles = table.titles();
  if (count > 8 && whole) return titles.value_or(TrajectoryFormat::kEuroc);
  if (count == 8) {
    const bool in_ns = UnitOfStamps(&table) == StampUnit::kNanoseconds && whole;
    if (titles == TrajectoryFormat::kEuroc && !in_ns) {
      throw InputError(
          file.name.string(), 0,
          "its titles put qw first, as EuRoC's do, but its first column is not a time in integer "
          "nanoseconds: use EuRoC's times, or TUM's columns, seconds and 'tx ty tz qx qy qz qw'");
    }
    return titles || in_ns ? titles : TrajectoryFormat::kTum;
  }
  row.Fail(fmt::format(
      "{} fields: neither TUM (8), KITTI (12) nor EuRoC (8 to 17, timestamp in ns)", count));
}

TrajectoryFormat GuessTrajectoryFormat(const fs::path& path) {
  if (const auto format = TellTrajectoryFormat(path)) return *format;
  throw InputError(path.string(), 0,
                   "8 columns, the first in nanoseconds: qw may be the first number of the "
                   "quaternion (EuRoC) or the last (TUM); choose by the format, or by a comment "
                   "above them: '# timestamp tx ty tz qx qy qz qw'");
}

fs::path KittiTimesBeside(const fs::path& poses) {
  const fs::path root = fs::absolute(poses).lexically_normal().parent_path().parent_path();
  const fs::path times = root / "sequences" / poses.stem() / "times.txt";
  return fs::is_regular_file(times) ? times : fs::path();
}

Trajectory ReadTrajectory(const fs::path& path, TrajectoryFormat format, const fs::path& times,
                          RowOrder order) {
  const TextFile file = ReadTextFile(path);
  std::optional<TextFile> stamps;
  if (format == TrajectoryFormat::kKitti && !times.empty()) stamps = ReadTextFile(times);
  return ReadTrajectory(file, format, stamps, order);
}

Trajectory ReadTrajectory(const TextFile& file, TrajectoryFormat format,
                          const std::optional<TextFile>& times, RowOrder order) {
  if (format == TrajectoryFormat::kKitti) return ReadKitti(file, times);
  Table table(file);
  if (format == TrajectoryFormat::kEuroc) return ReadStamped(&table, EurocPose, order);
  const StampUnit unit = UnitOfStamps(&table);
  return ReadStamped(
      &table, [unit](const Row& row) { return TumPose(row, unit); }, order);
}

}  // namespace aisle
