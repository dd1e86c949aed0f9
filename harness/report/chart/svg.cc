#include "harness/report/chart/svg.h"

#include <cmath>

#include "harness/report/chart/simplify.h"
#include "harness/report/markup/html.h"

namespace aisle {
namespace {

/// Lines are drawn in halves of a pixel and told as steps: a report holds hundreds of them. What
/// is left out lies within 0.7 pixels of what is drawn.
constexpr double kPerPixel = 2;
constexpr double kTolerancePx = 0.7;

std::string PathData(const std::vector<std::pair<double, double>>& points) {
  std::vector<Eigen::Vector3d> exact;
  for (const auto& [x, y] : points) exact.emplace_back(x, y, 0);
  std::string data;
  long at_x = 0, at_y = 0;
  for (const std::size_t i : Simplify(exact, kTolerancePx)) {
    const long x = std::lround(kPerPixel * exact[i].x()), y = std::lround(kPerPixel * exact[i].y());
    if (data.empty()) {
      data = fmt::format("M{} {}l", x, y);
    } else if (x != at_x || y != at_y) {
      const char* between = data.back() == 'l' || x < at_x ? "" : " ";
      data += fmt::format("{}{}{}{}", between, x - at_x, y < at_y ? "" : " ", y - at_y);
    }
    at_x = x;
    at_y = y;
  }
  return data.back() == 'l' ? data + "0 0" : data;
}

std::string Path(const std::string& data, const std::string& css, const std::string& name) {
  const std::string named = name.empty() ? "" : " data-name=\"" + Escape(name) + "\"";
  return fmt::format("<path transform=\"scale(.5)\" d=\"{}\" class=\"{}\"{}/>\n", data, css, named);
}

std::string Tip(const std::string& tip) {
  return tip.empty() ? "" : "<title>" + Escape(tip) + "</title>";
}

}  // namespace

std::vector<double> Ticks(double low, double high, int count) {
  const double raw = (high - low) / std::max(count, 1);
  if (!(raw > 0) || !std::isfinite(raw)) return {low};
  const double power = std::pow(10, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * 0.999) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks;
  const auto first = static_cast<long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long>(std::floor(high / step + 1e-9));
  for (long i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

Svg::Svg(double width, double height, const std::string& label) {
  text_ = fmt::format("<svg viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{}\">\n", width,
                      height, Escape(label));
}

void Svg::Line(double x1, double y1, double x2, double y2, const std::string& css) {
  text_ +=
      fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n",
                  x1, y1, x2, y2, css);
}

void Svg::Rect(double x, double y, double width, double height, const std::string& css,
               const std::string& tip) {
  text_ += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"{}\">{}</rect>\n",
      x, y, width, height, css, Tip(tip));
}

void Svg::Circle(double x, double y, double radius, const std::string& css,
                 const std::string& tip) {
  text_ +=
      fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" class=\"{}\">{}</circle>\n", x,
                  y, radius, css, Tip(tip));
}

void Svg::Polyline(const std::vector<std::pair<double, double>>& points, const std::string& css,
                   const std::string& name) {
  if (points.size() < 2) return;
  text_ += Path(PathData(points), css, name);
}

void Svg::Area(const std::vector<std::pair<double, double>>& points, double base_y,
               const std::string& css, const std::string& name) {
  if (points.size() < 2) return;
  std::vector<std::pair<double, double>> outline = points;
  outline.insert(outline.begin(), {points.front().first, base_y});
  outline.emplace_back(points.back().first, base_y);
  text_ += Path(PathData(outline) + "z", css, name);
}

void Svg::Text(double x, double y, const std::string& text, const std::string& css,
               const std::string& anchor) {
  if (text.empty()) return;
  // A class and not an attribute: a night has thousands of labels.
  const std::string anchored = anchor == "start" ? css : css + " " + anchor;
  text_ += fmt::format("<text x=\"{:.4g}\" y=\"{:.4g}\" class=\"{}\">{}</text>\n", x, y, anchored,
                       Escape(text));
}

void Svg::Grid(const Axis& x, const Axis& y, const std::string& x_title, const std::string& y_title,
               const GridOptions& options) {
  const auto numbers = [](const Axis& axis) {
    return fmt::format("{:g} {:g} {:g} {:g}", axis.low, axis.high, axis.from_px, axis.to_px);
  };
  text_ += fmt::format(
      "<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" class=\"panel\" "
      "data-x=\"{}\" data-y=\"{}\" data-title=\"{}\"/>\n",
      x.from_px, std::min(y.from_px, y.to_px), x.to_px - x.from_px, std::abs(y.to_px - y.from_px),
      numbers(x), numbers(y), Escape(y_title));
  std::string lines;
  for (const double tick : Ticks(x.low, x.high, 8)) {
    lines += fmt::format("M{:.1f} {:g}V{:g}", x(tick), y.from_px, y.to_px);
    if (!options.x_labels) continue;
    Text(x(tick), std::max(y.from_px, y.to_px) + 15, fmt::format("{:g}", tick), "tick", "middle");
  }
  for (const double tick : Ticks(y.low, y.high, options.y_ticks)) {
    lines += fmt::format("M{:g} {:.1f}H{:g}", x.from_px, y(tick), x.to_px);
    Text(x.from_px - 6, y(tick) + 4, fmt::format("{:g}", tick), "tick", "end");
  }
  text_ += fmt::format("<path d=\"{}\" class=\"grid\"/>\n", lines);
  Text(x.to_px, std::max(y.from_px, y.to_px) + 30, x_title, "axis", "end");
  Text(x.from_px, std::min(y.from_px, y.to_px) - 8, y_title, "axis");
}

void Svg::Legend(const std::vector<std::pair<std::string, std::string>>& entries, double x,
                 double y) {
  for (const auto& [name, css] : entries) {
    Line(x, y - 4, x + 18, y - 4, css);
    Text(x + 24, y, name, "legend");
    x += 44 + 7.2 * static_cast<double>(name.size());
  }
}

}  // namespace aisle
