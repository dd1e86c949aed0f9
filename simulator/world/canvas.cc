#include "simulator/world/canvas.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace aisle::sim {
namespace {

constexpr int kShift = 4;  // sub-pixel bits of OpenCV's drawing functions
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;

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

/// Draws coverage with OpenCV's antialiasing, then blends the grey in.
template <class Paint>
void Canvas::Draw(const Paint& paint, float grey, float opacity) {
  cv::Mat1b coverage(image_.size(), std::uint8_t{0});
  const cv::Rect touched = paint(coverage) & cv::Rect(0, 0, width(), height());
  for (int y = touched.y; y < touched.y + touched.height; ++y) {
    const std::uint8_t* cover = coverage.ptr<std::uint8_t>(y);
    float* out = image_.ptr<float>(y);
    for (int x = touched.x; x < touched.x + touched.width; ++x) {
      out[x] += (grey - out[x]) * opacity * static_cast<float>(cover[x]) / 255;
    }
  }
}

void Canvas::Polygon(const std::vector<Eigen::Vector2f>& points, float grey) {
  std::vector<cv::Point> fixed;
  for (const auto& point : points) fixed.push_back(Fixed(Pixel(point.x(), point.y())));
  Draw(
      [&](cv::Mat1b& coverage) {
        cv::fillPoly(coverage, std::vector<std::vector<cv::Point>>{fixed}, cv::Scalar(255),
                     cv::LINE_AA, kShift);
        return cv::Rect(0, 0, width(), height());
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

void Canvas::Frame(float x, float y, float w, float h, float line, float grey) {
  const float line_y = line * static_cast<float>(width()) / static_cast<float>(height());
  Fill(x, y, w, line_y, grey);
  Fill(x, y + h - line_y, w, line_y, grey);
  Fill(x, y, line, h, grey);
  Fill(x + w - line, y, line, h, grey);
}

void Canvas::Disc(float x, float y, float radius, float grey, float opacity) {
  const cv::Point2f center = Pixel(x, y);
  const float pixels = radius * static_cast<float>(width());
  Draw(
      [&](cv::Mat1b& coverage) {
        cv::circle(coverage, Fixed(center), cvRound(pixels * (1 << kShift)), cv::Scalar(255),
                   cv::FILLED, cv::LINE_AA, kShift);
        const int reach = cvCeil(pixels) + 2;
        return cv::Rect(cvRound(center.x) - reach, cvRound(center.y) - reach, 2 * reach, 2 * reach);
      },
      grey, opacity);
}

void Canvas::Line(float x0, float y0, float x1, float y1, float thickness, float grey,
                  float opacity) {
  const int pixels = std::max(1, cvRound(thickness * static_cast<float>(width())));
  Draw(
      [&](cv::Mat1b& coverage) {
        cv::line(coverage, Fixed(Pixel(x0, y0)), Fixed(Pixel(x1, y1)), cv::Scalar(255), pixels,
                 cv::LINE_AA, kShift);
        return cv::Rect(0, 0, width(), height());
      },
      grey, opacity);
}

void Canvas::Text(const std::string& text, float x, float baseline, float tall, float grey,
                  float max_width) {
  const double pixels = tall * static_cast<float>(height());
  const int thickness = std::max(1, cvRound(pixels / 9));
  double scale = pixels / 22;  // capitals of this font are 22 pixels tall at scale 1
  int below = 0;
  const cv::Size size = cv::getTextSize(text, kFont, scale, thickness, &below);
  const double room = max_width * static_cast<float>(width());
  if (size.width > room) scale *= room / size.width;
  const cv::Point2f at = Pixel(x, baseline);
  Draw(
      [&](cv::Mat1b& coverage) {
        cv::putText(coverage, text, at, kFont, scale, cv::Scalar(255), thickness, cv::LINE_AA);
        const int up = cvCeil(pixels * 1.4) + 2;
        return cv::Rect(cvRound(at.x) - 2, cvRound(at.y) - up, size.width + up, 2 * up);
      },
      grey, 1);
}

void Canvas::Barcode(Dice dice, float x, float y, float w, float h, float grey) {
  const float module = w / 60;
  for (float at = 0; at < w - 4 * module;) {
    const float bar = module * static_cast<float>(1 + dice.Pick(3));
    Fill(x + at, y, bar, h, grey);
    at += bar + module * static_cast<float>(1 + dice.Pick(3));
  }
}

Canvas Canvas::Part(float x, float y, float w, float h) {
  const cv::Rect box(
      cvRound(x * static_cast<float>(width())), cvRound(y * static_cast<float>(height())),
      cvRound(w * static_cast<float>(width())), cvRound(h * static_cast<float>(height())));
  return Canvas(cv::Mat1f(image_, box & cv::Rect(0, 0, width(), height())));
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
