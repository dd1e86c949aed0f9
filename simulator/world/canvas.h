#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "simulator/scene/dice.h"

namespace aisle::sim {

/// A grey picture being painted: values are sRGB-encoded, 0 black to 1 white. Noise repeats at the
/// borders, so that surfaces can be tiled. Places and sizes are shares of the picture.
class Canvas {
 public:
  Canvas(int width, int height, float grey) : image_(height, width, grey) {}
  explicit Canvas(const cv::Mat1b& picture) { picture.convertTo(image_, CV_32F, 1.0 / 255); }

  int width() const { return image_.cols; }
  int height() const { return image_.rows; }

  /// Adds smooth noise of `cells_x` × `cells_y` bumps, `amplitude` either way.
  void Noise(Dice dice, int cells_x, int cells_y, float amplitude);
  /// Adds noise at `octaves` scales, each twice as fine and `falloff` times as strong.
  void Fractal(Dice dice, int cells, int octaves, float amplitude, float falloff = 0.6f);
  /// Independent noise in every pixel.
  void Grain(Dice dice, float amplitude);

  void Fill(float x, float y, float w, float h, float grey, float opacity = 1);
  void Disc(float x, float y, float radius, float grey, float opacity = 1);
  void Line(float x0, float y0, float x1, float y1, float width, float grey, float opacity = 1);
  void Polygon(const std::vector<Eigen::Vector2f>& points, float grey);

  cv::Mat1b Finish() const;

 private:
  /// Blends grey in where `paint` covers an 8-bit mask of the box; `paint` is given the mask and
  /// the box's corner.
  template <class Paint>
  void Draw(cv::Rect box, const Paint& paint, float grey, float opacity);
  cv::Point2f Pixel(float x, float y) const;

  cv::Mat1f image_;
};

}  // namespace aisle::sim
