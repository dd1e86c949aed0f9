#include <charconv>
#include <sstream>

#include "harness/io/input_error.h"
#include "harness/report/record.h"

namespace aisle {
namespace {

constexpr const char* kHeader =
    "frame,stamp_ns,state,truth_x_m,truth_y_m,truth_z_m,live_x_m,live_y_m,live_z_m,live_error_m,"
    "final_x_m,final_y_m,final_z_m,final_error_m,movers_share,actors_share,features,"
    "features_on_movers,inliers_on_movers,mask_iou,corners_rejected,static_texture_share,flow_px,"
    "blur_px,parallax_px,render_ms,process_ms";
constexpr std::size_t kColumns = 27;

const char* Name(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return "initializing";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kLost:
      break;
  }
  return "lost";
}

TrackingState StateFromName(const std::string& name) {
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

/// The fields of one line, by column.
class Cells {
 public:
  Cells(const std::string& line, const std::string& file, std::size_t number)
      : file_(file), number_(number) {
    std::string cell;
    for (const char c : line + ",") {
      if (c == ',') {
        cells_.push_back(std::exchange(cell, {}));
      } else if (c != '\r') {
        cell += c;
      }
    }
    if (cells_.size() != kColumns) {
      throw InputError(file, number, fmt::format("{} columns, not {}", cells_.size(), kColumns));
    }
  }

  const std::string& Text(std::size_t i) const { return cells_[i]; }

  std::optional<double> Number(std::size_t i) const {
    if (cells_[i].empty()) return std::nullopt;
    return Parse<double>(i);
  }
  double Required(std::size_t i) const { return Parse<double>(i); }
  std::int64_t Whole(std::size_t i) const { return Parse<std::int64_t>(i); }

  std::optional<Eigen::Vector3d> Vector(std::size_t i) const {
    if (cells_[i].empty()) return std::nullopt;
    return Eigen::Vector3d(Required(i), Required(i + 1), Required(i + 2));
  }

 private:
  template <typename T>
  T Parse(std::size_t i) const {
    T value{};
    const std::string& cell = cells_[i];
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      throw InputError(file_, number_,
                       fmt::format("column {} is '{}', not a number", i + 1, Printable(cell)));
    }
    return value;
  }

  const std::string& file_;
  std::size_t number_;
  std::vector<std::string> cells_;
};

FrameRow RowFrom(const Cells& cells) {
  FrameRow row;
  row.id = cells.Whole(0);
  row.stamp_ns = cells.Whole(1);
  row.state = StateFromName(cells.Text(2));
  row.truth_m = cells.Vector(3).value_or(Eigen::Vector3d::Zero());
  row.live_m = cells.Vector(6);
  row.live_error_m = cells.Number(9);
  row.final_m = cells.Vector(10);
  row.final_error_m = cells.Number(13);
  row.movers_share = cells.Required(14);
  row.actors_share = cells.Required(15);
  row.features = static_cast<int>(cells.Whole(16));
  row.features_on_movers = static_cast<int>(cells.Whole(17));
  row.inliers_on_movers = static_cast<int>(cells.Whole(18));
  row.mask_iou = cells.Number(19);
  if (const auto corners = cells.Number(20)) row.corners_rejected = static_cast<int>(*corners);
  row.difficulty = {.static_texture_share = cells.Number(21),
                    .flow_px = cells.Number(22),
                    .blur_px = cells.Number(23),
                    .parallax_px = cells.Number(24)};
  row.render_ms = cells.Required(25);
  row.process_ms = cells.Required(26);
  return row;
}

}  // namespace

std::string ToCsv(const std::vector<FrameRow>& rows) {
  std::string text = std::string(kHeader) + "\n";
  for (const FrameRow& row : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.3f},{:.3f}\n",
                        row.id, row.stamp_ns, Name(row.state), Fields(row.truth_m),
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
  std::istringstream stream(text);
  std::string line;
  std::vector<FrameRow> rows;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (number == 1 || line.empty()) continue;
    rows.push_back(RowFrom(Cells(line, file, number)));
  }
  return rows;
}

}  // namespace aisle
