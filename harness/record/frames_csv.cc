#include "harness/record/frames_csv.h"

#include <charconv>
#include <map>

#include "harness/contract/state_name.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/score/mask_scores.h"

namespace aisle {
namespace {

constexpr const char* kHeader =
    "frame,stamp_ns,state,truth_x_m,truth_y_m,truth_z_m,live_x_m,live_y_m,live_z_m,live_error_m,"
    "final_x_m,final_y_m,final_z_m,final_error_m,movers_share,actors_share,features,"
    "features_on_movers,inliers_on_movers,mask_iou,corners_rejected,static_texture_share,flow_px,"
    "blur_px,parallax_px,render_ms,process_ms";
TrackingState StateFromName(std::string_view name) {
  if (name == "tracking") return TrackingState::kTracking;
  return name == "lost" ? TrackingState::kLost : TrackingState::kInitializing;
}

/// An absent number is an empty field.
std::string Field(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

std::string Fields(const std::optional<Eigen::Vector3d>& v) {
  return v ? fmt::format("{},{},{}", v->x(), v->y(), v->z()) : ",,";
}

/// The cells of a line, as parts of it.
void Split(std::string_view line, std::vector<std::string_view>* cells) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  cells->clear();
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(',', at), line.size());
    cells->push_back(line.substr(at, end - at));
    at = end + 1;
  }
}

/// Where each column stands, by its name: files of other versions have more of them, or fewer.
using Columns = std::map<std::string, std::size_t, std::less<>>;

/// The fields of one line, by name of column.
class Cells {
 public:
  Cells(const Columns& columns, std::string_view line, const std::string& file, std::size_t number,
        std::vector<std::string_view>* room)
      : columns_(columns), file_(file), number_(number), cells_(*room) {
    Split(line, room);
    if (cells_.size() != columns.size()) {
      throw InputError(file, number,
                       fmt::format("expected {1} columns, got {0}", cells_.size(), columns.size()));
    }
  }

  std::string_view Text(std::string_view name) const {
    const auto column = columns_.find(name);
    if (column == columns_.end()) {
      throw InputError(file_, 1,
                       fmt::format("no column {}: made by another version of aisle", name));
    }
    return cells_[column->second];
  }

  /// An empty field, or no such column: absent.
  std::optional<double> Number(std::string_view name) const {
    const auto column = columns_.find(name);
    if (column == columns_.end() || cells_[column->second].empty()) return std::nullopt;
    return Parse<double>(name, cells_[column->second]);
  }
  double Required(std::string_view name) const { return Parse<double>(name, Text(name)); }
  std::int64_t Whole(std::string_view name) const { return Parse<std::int64_t>(name, Text(name)); }
  int Count(std::string_view name) const { return Parse<int>(name, Text(name)); }

  std::optional<Eigen::Vector3d> Vector(std::string_view x, std::string_view y,
                                        std::string_view z) const {
    const std::optional<double> first = Number(x);
    if (!first) return std::nullopt;
    return Eigen::Vector3d(*first, Required(y), Required(z));
  }

 private:
  template <typename T>
  T Parse(std::string_view name, std::string_view cell) const {
    T value{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      throw InputError(file_, number_,
                       fmt::format("{} is '{}', expected {}", name, Printable(std::string(cell)),
                                   std::is_same_v<T, int> ? "a count" : "a number"));
    }
    return value;
  }

  const Columns& columns_;
  const std::string& file_;
  std::size_t number_;
  const std::vector<std::string_view>& cells_;
};

FrameRow RowFrom(const Cells& cells) {
  FrameRow row;
  row.id = cells.Whole("frame");
  row.stamp_ns = cells.Whole("stamp_ns");
  row.state = StateFromName(cells.Text("state"));
  row.truth_m =
      cells.Vector("truth_x_m", "truth_y_m", "truth_z_m").value_or(Eigen::Vector3d::Zero());
  row.live_m = cells.Vector("live_x_m", "live_y_m", "live_z_m");
  row.live_error_m = cells.Number("live_error_m");
  row.final_m = cells.Vector("final_x_m", "final_y_m", "final_z_m");
  row.final_error_m = cells.Number("final_error_m");
  row.movers_share = cells.Required("movers_share");
  row.actors_share = cells.Required("actors_share");
  row.features = cells.Count("features");
  row.features_on_movers = cells.Count("features_on_movers");
  row.inliers_on_movers = cells.Count("inliers_on_movers");
  row.mask_iou = cells.Number("mask_iou");
  if (cells.Number("corners_rejected")) row.corners_rejected = cells.Count("corners_rejected");
  row.difficulty = {.static_texture_share = cells.Number("static_texture_share"),
                    .flow_px = cells.Number("flow_px"),
                    .blur_px = cells.Number("blur_px"),
                    .parallax_px = cells.Number("parallax_px")};
  row.render_ms = cells.Required("render_ms");
  row.process_ms = cells.Required("process_ms");
  return row;
}

/// Of the truth's frames, by index: where the estimate lies after alignment and how far off.
struct TrackOnTruth {
  std::vector<std::optional<Eigen::Vector3d>> position_m;
  std::vector<std::optional<double>> error_m;
};

TrackOnTruth LayOnTruth(std::size_t frames, const Trajectory& estimate,
                        const TrajectoryScore& score) {
  TrackOnTruth track{std::vector<std::optional<Eigen::Vector3d>>(frames),
                     std::vector<std::optional<double>>(frames)};
  for (const PoseError& error : score.errors) {
    const StampedPose& pose = estimate[error.pair.estimate];
    track.position_m[error.pair.truth] = Apply(score.alignment, pose.T_world_rig).translation();
    track.error_m[error.pair.truth] = error.translation_m;
  }
  return track;
}

}  // namespace

std::vector<FrameRow> MakeFrameRows(const RunResult& run, const RunScore& score) {
  // More truth than frames: of those that a run that ended early was never shown.
  const bool has_truth = run.truth.size() >= run.facts.size();
  const TrackOnTruth live = LayOnTruth(run.truth.size(), run.trajectory.live, score.live);
  const TrackOnTruth final = LayOnTruth(run.truth.size(), run.trajectory.final, score.final);
  std::vector<FrameRow> rows;
  for (std::size_t i = 0; i < run.facts.size(); ++i) {
    const FrameFacts& facts = run.facts[i];
    FrameRow row{
        .id = run.estimates[i].id,
        .stamp_ns = facts.stamp_ns,
        .state = run.estimates[i].state,
        .truth_m = facts.T_world_rig.translation(),
        .movers_share = facts.movers_share,
        .actors_share = facts.actors_share,
        .features = facts.features,
        .features_on_movers = facts.features_on_movers,
        .inliers_on_movers = facts.inliers_on_movers,
        .mask_iou = facts.mask ? PixelDetection(*facts.mask).iou.value : std::nullopt,
        .corners_rejected = facts.mask ? std::optional(facts.mask->corners_rejected) : std::nullopt,
        .difficulty = facts.difficulty,
        .render_ms = facts.render_ms,
        .process_ms = facts.process_ms};
    if (has_truth) {
      row.live_m = live.position_m[i];
      row.live_error_m = live.error_m[i];
      row.final_m = final.position_m[i];
      row.final_error_m = final.error_m[i];
    }
    rows.push_back(row);
  }
  return rows;
}

std::string ToCsv(const std::vector<FrameRow>& rows) {
  std::string text = std::string(kHeader) + "\n";
  for (const FrameRow& row : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.3f},{:.3f}\n",
                        row.id, row.stamp_ns, StateName(row.state), Fields(row.truth_m),
                        Fields(row.live_m), Field(row.live_error_m), Fields(row.final_m),
                        Field(row.final_error_m), row.movers_share, row.actors_share, row.features,
                        row.features_on_movers, row.inliers_on_movers, Field(row.mask_iou),
                        Field(row.corners_rejected), Field(row.difficulty.static_texture_share),
                        Field(row.difficulty.flow_px), Field(row.difficulty.blur_px),
                        Field(row.difficulty.parallax_px), row.render_ms, row.process_ms);
  }
  return text;
}

std::vector<FrameRow> FrameRowsFromCsv(const std::string& text, const std::string& file) {
  std::string_view rest = text;
  const auto next_line = [&] {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return line;
  };
  std::vector<std::string_view> cells;
  Split(next_line(), &cells);
  Columns columns;
  for (const std::string_view name : cells) columns.emplace(name, columns.size());
  std::vector<FrameRow> rows;
  for (std::size_t number = 2; !rest.empty(); ++number) {
    const std::string_view line = next_line();
    if (!line.empty()) rows.push_back(RowFrom(Cells(columns, line, file, number, &cells)));
  }
  return rows;
}

FrameFile ReadFrameFile(const RunRecord& run, const std::filesystem::path& report_dir) {
  const auto artifact = run.artifacts.find("frames");
  if (artifact == run.artifacts.end()) return {};
  const std::filesystem::path path = report_dir / artifact->second;
  if (!std::filesystem::exists(path)) return {};
  try {
    return {FrameRowsFromCsv(ReadFile(path), path.string()), ""};
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
}

}  // namespace aisle
