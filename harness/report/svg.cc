#include "harness/report/svg.h"

#include <cmath>

#include "harness/report/html.h"

namespace aisle {
namespace {

std::string Points(const std::vector<std::pair<double, double>>& points) {
  std::string text;
  for (const auto& [x, y] : points) text += fmt::format("{:.1f},{:.1f} ", x, y);
  return text;
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
  const std::string data = name.empty() ? "" : " data-name=\"" + Escape(name) + "\"";
  text_ += fmt::format("<polyline points=\"{}\" class=\"{}\"{}/>\n", Points(points), css, data);
}

void Svg::Polygon(const std::vector<std::pair<double, double>>& points, const std::string& css) {
  if (points.size() < 3) return;
  text_ += fmt::format("<polygon points=\"{}\" class=\"{}\"/>\n", Points(points), css);
}

void Svg::Text(double x, double y, const std::string& text, const std::string& css,
               const std::string& anchor) {
  text_ +=
      fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\" text-anchor=\"{}\">{}</text>\n", x,
                  y, css, anchor, Escape(text));
}

void Svg::Grid(const Axis& x, const Axis& y, const std::string& x_title,
               const std::string& y_title) {
  const auto numbers = [](const Axis& axis) {
    return fmt::format("{:g} {:g} {:g} {:g}", axis.low, axis.high, axis.from_px, axis.to_px);
  };
  text_ += fmt::format(
      "<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" class=\"panel\" "
      "data-x=\"{}\" data-y=\"{}\" data-title=\"{}\"/>\n",
      x.from_px, std::min(y.from_px, y.to_px), x.to_px - x.from_px, std::abs(y.to_px - y.from_px),
      numbers(x), numbers(y), Escape(x_title));
  for (const double tick : Ticks(x.low, x.high, 8)) {
    Line(x(tick), y.from_px, x(tick), y.to_px, "grid");
    Text(x(tick), std::max(y.from_px, y.to_px) + 15, fmt::format("{:g}", tick), "tick", "middle");
  }
  for (const double tick : Ticks(y.low, y.high, 4)) {
    Line(x.from_px, y(tick), x.to_px, y(tick), "grid");
    Text(x.from_px - 6, y(tick) + 4, fmt::format("{:g}", tick), "tick", "end");
  }
  Text(x.to_px, std::max(y.from_px, y.to_px) + 30, x_title, "axis", "end");
  Text(x.from_px, std::min(y.from_px, y.to_px) - 8, y_title, "axis");
}

}  // namespace aisle
