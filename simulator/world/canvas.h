#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "simulator/world/dice.h"

namespace aisle::sim {

/// A grey picture being painted: values are sRGB-encoded, 0 black to 1 white. Noise repeats at the
/// borders, so that surfaces can be tiled.
class Canvas {
 public:
  Canvas(int width, int height, float grey) : image_(height, width, grey) {}

  int width() const { return image_.cols; }
  int height() const { return image_.rows; }

  /// Adds noise of `cells` × `cells_y` bumps, `amplitude` either way.
  void Noise(Dice dice, int cells_x, int cells_y, float amplitude);
  /// Adds noise at `octaves` scales, each twice as fine and `falloff` times as strong.
  void Fractal(Dice dice, int cells, int octaves, float amplitude, float falloff = 0.6f);
  /// Independent noise in every pixel.
  void Grain(Dice dice, float amplitude);

  // Shapes, in shares of the picture; `opacity` in [0, 1].
  void Fill(float x, float y, float w, float h, float grey, float opacity = 1);
  void Frame(float x, float y, float w, float h, float line, float grey);
  void Disc(float x, float y, float radius, float grey, float opacity = 1);
  void Line(float x0, float y0, float x1, float y1, float width, float grey, float opacity = 1);
  void Polygon(const std::vector<Eigen::Vector2f>& points, float grey);
  /// Text whose capitals are `height` tall, from its left baseline; squeezed to `max_width`.
  void Text(const std::string& text, float x, float baseline, float height, float grey,
            float max_width = 1);
  void Barcode(Dice dice, float x, float y, float w, float h, float grey);

  /// A part of the picture as a canvas of its own; painting it paints here.
  Canvas Part(float x, float y, float w, float h);

  cv::Mat1b Finish() const;

 private:
  explicit Canvas(cv::Mat1f image) : image_(std::move(image)) {}
  template <class Paint>
  void Draw(const Paint& paint, float grey, float opacity);
  cv::Point2f Pixel(float x, float y) const;

  cv::Mat1f image_;
};

}  // namespace aisle::sim
