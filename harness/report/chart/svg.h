#pragma once

#include <string>
#include <utility>
#include <vector>

namespace aisle {

/// Round steps that cut [low, high] into about `count` parts: 1, 2 or 5 times a power of ten.
std::vector<double> Ticks(double low, double high, int count);

/// Maps values to places along one axis.
struct Axis {
  double low = 0, high = 1;         ///< values
  double from_px = 0, to_px = 100;  ///< places of low and high
  double operator()(double value) const {
    return from_px + (value - low) / (high - low) * (to_px - from_px);
  }
};

/// How wide a stretched chart is to itself: places across are thousandths of what the page gives.
inline constexpr double kAcross = 1000;

/// Collects SVG elements, of one of two kinds of drawing.
///
/// A *chart* fills whatever width the page has: x runs from 0 to kAcross over the space beside the
/// names on its left, y is in pixels. Lines stretch; text, markers and strokes keep their size, so
/// that a phone shows the same chart laid out anew and not a smaller one.
///
/// A *map* has equal scales: x and y are units of its own, and all of it grows and shrinks.
class Svg {
 public:
  enum class Names { kNumbers, kSystems };  ///< what stands left of a chart: little or much
  static Svg Chart(double height_px, const std::string& label, Names names = Names::kNumbers);
  static Svg Map(double width, double height, const std::string& label);

  void Line(double x1, double y1, double x2, double y2, const std::string& css);
  void Rect(double x, double y, double width, double height, const std::string& css,
            const std::string& tip = "");
  /// A marker of the shape that belongs to a system's style, some 8 pixels wide; `link` makes it
  /// lead there.
  void Marker(double x, double y, int style, const std::string& tip = "",
              const std::string& link = "");
  /// A cross for what failed.
  void Cross(double x, double y, const std::string& tip, const std::string& link = "");
  void Circle(double x, double y, double radius, const std::string& css,
              const std::string& tip = "");
  /// A named line shows its values under the pointer where scripts may run. Drawn to 0.7 of a
  /// pixel.
  void Polyline(const std::vector<std::pair<double, double>>& points, const std::string& css,
                const std::string& name = "");
  /// A line with gaps: a named line per piece, and a dot for each piece of a single point. Whether
  /// anything was drawn.
  bool Pieces(const std::vector<std::vector<std::pair<double, double>>>& pieces,
              const std::string& css, const std::string& name = "");
  /// What lies between a line and `base_y`.
  void Area(const std::vector<std::pair<double, double>>& points, double base_y,
            const std::string& css, const std::string& name = "");
  /// What lies between two lines over the same places.
  void Band(const std::vector<std::pair<double, double>>& low,
            const std::vector<std::pair<double, double>>& high, const std::string& css);
  /// anchor: start, middle or end.
  void Text(double x, double y, const std::string& text, const std::string& css,
            const std::string& anchor = "start");
  /// A text that stands `px` pixels left of the chart's space.
  void NameAtLeft(double y, const std::string& text, const std::string& css, double px = 6);
  struct GridOptions {
    bool x_lines = true;   ///< grid lines of x
    bool x_labels = true;  ///< numbers under them
    int y_ticks = 4;       ///< about so many
  };
  /// Grid lines and tick labels of both axes around a plot.
  void Grid(const Axis& x, const Axis& y, const std::string& x_title, const std::string& y_title,
            const GridOptions& options);
  void Grid(const Axis& x, const Axis& y, const std::string& x_title, const std::string& y_title) {
    Grid(x, y, x_title, y_title, {});
  }
  /// The ticks of x alone: lines from `top` to `bottom` and numbers below.
  void GridAcross(const Axis& x, double top, double bottom, const std::string& title);
  std::string Finish() const;

 private:
  Svg(bool stretched, std::string open, double height)
      : stretched_(stretched), height_(height), open_(std::move(open)) {}
  /// A small drawing around a place, that leads somewhere.
  void Place(double x, double y, const std::string& drawing, const std::string& link);
  /// A place across as an attribute has it.
  std::string X(double x) const;

  bool stretched_;
  double height_;
  std::string open_;
  std::string lines_;  ///< what stretches
  std::string rest_;   ///< what keeps its size, above the lines
};

/// What the lines and areas of a chart are, for the page below it: a sample of each and its name.
std::string Legend(const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace aisle
