#include "harness/report/picture/stage_sheets.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "harness/io/image.h"

namespace aisle {
namespace {

const cv::Scalar kEmptyTile(38, 34, 30);

/// Half the size, both sides even as films want them.
cv::Mat3b ForFilm(const cv::Mat3b& sheet) {
  cv::Mat3b half;
  cv::resize(sheet, half, {sheet.cols / 4 * 2, sheet.rows / 4 * 2}, 0, 0, cv::INTER_AREA);
  return half;
}

}  // namespace

cv::Mat3b TileStages(const std::vector<StagePicture>& stages, int columns) {
  if (stages.empty()) return {};
  const int count = static_cast<int>(stages.size());
  columns = std::clamp(columns, 1, count);
  const cv::Size tile = stages.front().image.size();
  cv::Mat3b sheet(tile.height * ((count + columns - 1) / columns), tile.width * columns);
  sheet.setTo(kEmptyTile);
  for (int k = 0; k < count; ++k) {
    const cv::Mat3b& image = stages[static_cast<std::size_t>(k)].image;
    if (image.size() != tile) {
      throw std::invalid_argument(fmt::format("stage '{}' is drawn {}x{}, the first one {}x{}",
                                              stages[static_cast<std::size_t>(k)].name, image.cols,
                                              image.rows, tile.width, tile.height));
    }
    const cv::Point at(k % columns * tile.width, k / columns * tile.height);
    image.copyTo(sheet(cv::Rect(at, tile)));
  }
  return sheet;
}

std::vector<std::size_t> WorstFrames(const std::map<std::size_t, double>& value_of_frame,
                                     std::size_t count, std::size_t apart) {
  std::vector<std::pair<double, std::size_t>> ranked;
  for (const auto& [frame, value] : value_of_frame) {
    if (value > 0) ranked.push_back({-value, frame});
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::size_t> worst;
  for (const auto& [value, frame] : ranked) {
    const bool near = std::any_of(worst.begin(), worst.end(), [&, f = frame](std::size_t other) {
      return std::max(f, other) - std::min(f, other) < apart;
    });
    if (!near && worst.size() < count) worst.push_back(frame);
  }
  std::sort(worst.begin(), worst.end());
  return worst;
}

std::string StageSheetName(std::size_t index) { return fmt::format("stages/{:06}.jpg", index); }

StageSheets::StageSheets(StageSheetOptions options) : options_(std::move(options)) {
  if (options_.film && Video::Available()) {
    film_.emplace(options_.folder / "stages.mp4", options_.rate_hz);
  }
}

void StageSheets::See(std::size_t index, const FrameTruth* truth, const FrameEstimate& estimate,
                      const FrameFacts& facts) {
  if (!trouble_.empty() || !estimate.draw_stages) return;
  try {
    Draw(index, truth, estimate);
    if (facts.mask && wrong_px_.count(index) > 0) {
      wrong_px_[index] =
          static_cast<double>(facts.mask->false_positives + facts.mask->false_negatives);
    }
  } catch (const std::exception& error) {
    trouble_ = fmt::format("the stages are drawn up to frame {} only: {}", index, error.what());
  }
}

void StageSheets::Draw(std::size_t index, const FrameTruth* truth, const FrameEstimate& estimate) {
  const cv::Mat3b sheet = TileStages(estimate.draw_stages(truth));
  if (sheet.empty()) return;
  WriteImage(options_.folder / StageSheetName(index), sheet);
  wrong_px_[index] = 0;
  if (film_) film_->Add(ForFilm(sheet));
}

std::map<std::string, std::string> StageSheets::Finish() {
  std::map<std::string, std::string> shown;
  if (film_ && film_->Finish()) shown["stages_film"] = "stages.mp4";
  for (const std::size_t frame : WorstFrames(wrong_px_, options_.worst, options_.apart)) {
    shown[fmt::format("stages_{:06}", frame)] = StageSheetName(frame);
  }
  return shown;
}

}  // namespace aisle
