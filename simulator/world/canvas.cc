#include "simulator/world/canvas.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace aisle::sim {
namespace {

constexpr int kShift = 4;  // sub-pixel bits of OpenCV's drawing functions

cv::Point Fixed(const cv::Point2f& point) {
  return {cvRound(point.x * (1 << kShift)), cvRound(point.y * (1 << kShift))};
}

/// Where a sample lies between two lattice nodes, with a smooth weight.
struct Between {
  int low, high;
  float weight;
};

std::vector<Between> Weights(int pixels, int cells) {
  std::vector<Between> weights(static_cast<std::size_t>(pixels));
  for (int i = 0; i < pixels; ++i) {
    const float at =
        (static_cast<float>(i) + 0.5f) * static_cast<float>(cells) / static_cast<float>(pixels);
    const int low = static_cast<int>(at);
    const float t = at - static_cast<float>(low);
    weights[static_cast<std::size_t>(i)] = {low % cells, (low + 1) % cells, t * t * (3 - 2 * t)};
  }
  return weights;
}

}  // namespace

void Canvas::Noise(Dice dice, int cells_x, int cells_y, float amplitude) {
  cv::Mat1f lattice(cells_y, cells_x);
  for (float& value : lattice) value = amplitude * static_cast<float>(dice.Signed());
  const std::vector<Between> columns = Weights(width(), cells_x);
  const std::vector<Between> rows = Weights(height(), cells_y);
  std::vector<float> line(static_cast<std::size_t>(cells_x));
  for (int y = 0; y < height(); ++y) {
    const Between& row = rows[static_cast<std::size_t>(y)];
    for (int c = 0; c < cells_x; ++c) {
      const float low = lattice(row.low, c);
      line[static_cast<std::size_t>(c)] = low + row.weight * (lattice(row.high, c) - low);
    }
    float* out = image_.ptr<float>(y);
    for (int x = 0; x < width(); ++x) {
      const Between& column = columns[static_cast<std::size_t>(x)];
      const float low = line[static_cast<std::size_t>(column.low)];
      out[x] += low + column.weight * (line[static_cast<std::size_t>(column.high)] - low);
    }
  }
}

void Canvas::Fractal(Dice dice, int cells, int octaves, float amplitude, float falloff) {
  for (int i = 0; i < octaves; ++i) {
    const int count = std::min(cells << i, width());
    const int count_y = std::max(1, count * height() / width());
    Noise(dice.Fork(), count, count_y, amplitude);
    amplitude *= falloff;
  }
}

void Canvas::Grain(Dice dice, float amplitude) {
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x) {
      image_(y, x) += amplitude * static_cast<float>(dice.Signed());
    }
  }
}

cv::Point2f Canvas::Pixel(float x, float y) const {
  return {x * static_cast<float>(width()) - 0.5f, y * static_cast<float>(height()) - 0.5f};
}

template <class Paint>
void Canvas::Draw(cv::Rect box, const Paint& paint, float grey, float opacity) {
  box &= cv::Rect(0, 0, width(), height());
  if (box.empty()) return;
  cv::Mat1b coverage(box.size(), std::uint8_t{0});
  paint(coverage, cv::Point2f(static_cast<float>(box.x), static_cast<float>(box.y)));
  for (int y = 0; y < box.height; ++y) {
    const std::uint8_t* cover = coverage.ptr<std::uint8_t>(y);
    float* out = image_.ptr<float>(box.y + y) + box.x;
    for (int x = 0; x < box.width; ++x) {
      out[x] += (grey - out[x]) * opacity * static_cast<float>(cover[x]) / 255;
    }
  }
}

void Canvas::Polygon(const std::vector<Eigen::Vector2f>& points, float grey) {
  std::vector<cv::Point> fixed;
  for (const auto& point : points) fixed.push_back(Fixed(Pixel(point.x(), point.y())));
  Draw(
      cv::Rect(0, 0, width(), height()),
      [&](cv::Mat1b& coverage, const cv::Point2f&) {
        cv::fillPoly(coverage, std::vector<std::vector<cv::Point>>{fixed}, cv::Scalar(255),
                     cv::LINE_AA, kShift);
      },
      grey, 1);
}

void Canvas::Fill(float x, float y, float w, float h, float grey, float opacity) {
  const int x0 = cvRound(x * static_cast<float>(width()));
  const int y0 = cvRound(y * static_cast<float>(height()));
  const int x1 = std::max(x0 + 1, cvRound((x + w) * static_cast<float>(width())));
  const int y1 = std::max(y0 + 1, cvRound((y + h) * static_cast<float>(height())));
  const cv::Rect box = cv::Rect(x0, y0, x1 - x0, y1 - y0) & cv::Rect(0, 0, width(), height());
  for (int row = box.y; row < box.y + box.height; ++row) {
    float* out = image_.ptr<float>(row);
    for (int col = box.x; col < box.x + box.width; ++col) out[col] += (grey - out[col]) * opacity;
  }
}

void Canvas::Disc(float x, float y, float radius, float grey, float opacity) {
  const cv::Point2f center = Pixel(x, y);
  const float pixels = radius * static_cast<float>(width());
  const int reach = cvCeil(pixels) + 2;
  Draw(
      cv::Rect(cvRound(center.x) - reach, cvRound(center.y) - reach, 2 * reach, 2 * reach),
      [&](cv::Mat1b& coverage, const cv::Point2f& corner) {
        cv::circle(coverage, Fixed(center - corner), cvRound(pixels * (1 << kShift)),
                   cv::Scalar(255), cv::FILLED, cv::LINE_AA, kShift);
      },
      grey, opacity);
}

void Canvas::Line(float x0, float y0, float x1, float y1, float thickness, float grey,
                  float opacity) {
  const int pixels = std::max(1, cvRound(thickness * static_cast<float>(width())));
  const cv::Point2f from = Pixel(x0, y0), to = Pixel(x1, y1);
  const int left = cvFloor(std::min(from.x, to.x)) - pixels - 2;
  const int top = cvFloor(std::min(from.y, to.y)) - pixels - 2;
  const int right = cvCeil(std::max(from.x, to.x)) + pixels + 2;
  const int bottom = cvCeil(std::max(from.y, to.y)) + pixels + 2;
  Draw(
      cv::Rect(left, top, right - left, bottom - top),
      [&](cv::Mat1b& coverage, const cv::Point2f& corner) {
        cv::line(coverage, Fixed(from - corner), Fixed(to - corner), cv::Scalar(255), pixels,
                 cv::LINE_AA, kShift);
      },
      grey, opacity);
}

cv::Mat1b Canvas::Finish() const {
  cv::Mat1b out(image_.size());
  for (int y = 0; y < image_.rows; ++y) {
    for (int x = 0; x < image_.cols; ++x) {
      out(y, x) =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(image_(y, x), 0.0f, 1.0f)));
    }
  }
  return out;
}

}  // namespace aisle::sim
