#pragma once

#include <string>
#include <utility>
#include <vector>

namespace aisle {

/// Round steps that cut [low, high] into about `count` parts: 1, 2 or 5 times a power of ten.
std::vector<double> Ticks(double low, double high, int count);

/// Maps values to pixels along one axis.
struct Axis {
  double low = 0, high = 1;         ///< values
  double from_px = 0, to_px = 100;  ///< pixels of low and high
  double operator()(double value) const {
    return from_px + (value - low) / (high - low) * (to_px - from_px);
  }
};

/// Collects SVG elements.
class Svg {
 public:
  Svg(double width, double height, const std::string& label);
  void Line(double x1, double y1, double x2, double y2, const std::string& css);
  void Rect(double x, double y, double width, double height, const std::string& css,
            const std::string& tip = "");
  void Circle(double x, double y, double radius, const std::string& css,
              const std::string& tip = "");
  /// A named line shows its values under the pointer where scripts may run. Drawn to 0.7 of a
  /// pixel.
  void Polyline(const std::vector<std::pair<double, double>>& points, const std::string& css,
                const std::string& name = "");
  /// What lies between a line and `base_y`.
  void Area(const std::vector<std::pair<double, double>>& points, double base_y,
            const std::string& css, const std::string& name = "");
  /// anchor: start, middle or end.
  void Text(double x, double y, const std::string& text, const std::string& css,
            const std::string& anchor = "start");
  struct GridOptions {
    bool x_labels = true;  ///< numbers under the grid lines of x
    int y_ticks = 4;       ///< about so many
  };
  /// Grid lines and tick labels of both axes around a plot.
  void Grid(const Axis& x, const Axis& y, const std::string& x_title, const std::string& y_title,
            const GridOptions& options);
  void Grid(const Axis& x, const Axis& y, const std::string& x_title, const std::string& y_title) {
    Grid(x, y, x_title, y_title, {});
  }
  /// Names and classes of lines, side by side from (x, y) on.
  void Legend(const std::vector<std::pair<std::string, std::string>>& entries, double x, double y);
  std::string Finish() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace aisle
