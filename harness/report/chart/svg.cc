#include "harness/report/chart/svg.h"

#include <cmath>

#include "harness/report/chart/simplify.h"
#include "harness/report/markup/html.h"

namespace aisle {
namespace {

using Points = std::vector<std::pair<double, double>>;

/// Lines are drawn in halves of a pixel and told as steps: a report holds hundreds of them. What
/// is left out lies within 0.7 pixels of what is drawn.
constexpr double kPerPixel = 2;
constexpr double kTolerancePx = 0.7;

std::string PathData(const Points& points) {
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

/// Around (0, 0): a circle, square, triangle, diamond, cross or a triangle that points down.
std::string MarkerPath(int style) {
  constexpr const char* kShapes[] = {"M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0",
                                     "M-3.5-3.5h7v7h-7z",
                                     "M0-4.5L4.5 3.5h-9z",
                                     "M0-5L5 0L0 5L-5 0z",
                                     "M-1.5-4.5h3v3h3v3h-3v3h-3v-3h-3v-3h3z",
                                     "M0 4.5L4.5-3.5h-9z"};
  return kShapes[style % 6];
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

Svg Svg::Chart(double height_px, const std::string& label, Names names) {
  return {true,
          fmt::format("<svg class=\"chart{}\" height=\"{:g}\" role=\"img\" aria-label=\"{}\">\n",
                      names == Names::kSystems ? " named" : "", height_px, Escape(label)),
          height_px};
}

Svg Svg::Map(double width, double height, const std::string& label) {
  return {false,
          fmt::format("<svg class=\"map\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" "
                      "aria-label=\"{}\">\n",
                      width, height, Escape(label)),
          height};
}

std::string Svg::X(double x) const {
  return stretched_ ? fmt::format("{:.5g}%", 100 * x / kAcross) : fmt::format("{:.4g}", x);
}

void Svg::Line(double x1, double y1, double x2, double y2, const std::string& css) {
  rest_ += fmt::format("<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" class=\"{}\"/>\n",
                       X(x1), y1, X(x2), y2, css);
}

void Svg::Rect(double x, double y, double width, double height, const std::string& css,
               const std::string& tip) {
  rest_ += fmt::format(
      "<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" class=\"{}\">{}</rect>\n", X(x),
      y, X(width), height, css, Tip(tip));
}

void Svg::Place(double x, double y, const std::string& drawing, const std::string& link) {
  // A nested drawing of no size is what a share of the width can be given to.
  const std::string nested =
      fmt::format("<svg x=\"{}\" y=\"{:.1f}\" class=\"at\">{}</svg>", X(x), y, drawing);
  rest_ +=
      link.empty() ? nested + "\n" : fmt::format("<a href=\"{}\">{}</a>\n", Escape(link), nested);
}

void Svg::Marker(double x, double y, int style, const std::string& tip, const std::string& link) {
  Place(
      x, y,
      fmt::format("<path d=\"{}\" class=\"dot d{}\">{}</path>", MarkerPath(style), style, Tip(tip)),
      link);
}

void Svg::Cross(double x, double y, const std::string& tip, const std::string& link) {
  Place(x, y, fmt::format("<path d=\"M-5-5L5 5M-5 5L5-5\" class=\"cross\">{}</path>", Tip(tip)),
        link);
}

void Svg::Circle(double x, double y, double radius, const std::string& css,
                 const std::string& tip) {
  rest_ += fmt::format("<circle cx=\"{}\" cy=\"{:.1f}\" r=\"{:.1f}\" class=\"{}\">{}</circle>\n",
                       X(x), y, radius, css, Tip(tip));
}

void Svg::Polyline(const Points& points, const std::string& css, const std::string& name) {
  if (points.size() < 2) return;
  lines_ += Path(PathData(points), css, name);
}

bool Svg::Pieces(const std::vector<Points>& pieces, const std::string& css,
                 const std::string& name) {
  std::string dots;  // one path of all: a track with a pose in every second frame has hundreds
  for (const Points& piece : pieces) {
    Polyline(piece, css, name);
    if (piece.size() == 1) dots += PathData(piece);
  }
  if (!dots.empty()) lines_ += Path(dots, css + " point", "");
  return std::any_of(pieces.begin(), pieces.end(), [](const Points& p) { return !p.empty(); });
}

void Svg::Area(const Points& points, double base_y, const std::string& css,
               const std::string& name) {
  if (points.size() < 2) return;
  Points outline = points;
  outline.insert(outline.begin(), {points.front().first, base_y});
  outline.emplace_back(points.back().first, base_y);
  lines_ += Path(PathData(outline) + "z", css, name);
}

void Svg::Band(const Points& low, const Points& high, const std::string& css) {
  if (low.size() < 2 || low.size() != high.size()) return;
  Points outline = high;
  outline.insert(outline.end(), low.rbegin(), low.rend());
  lines_ += Path(PathData(outline) + "z", css, "");
}

void Svg::Text(double x, double y, const std::string& text, const std::string& css,
               const std::string& anchor) {
  if (text.empty()) return;
  // A class and not an attribute: a night has thousands of labels.
  const std::string anchored = anchor == "start" ? css : css + " " + anchor;
  rest_ += fmt::format("<text x=\"{}\" y=\"{:.4g}\" class=\"{}\">{}</text>\n", X(x), y, anchored,
                       Escape(text));
}

void Svg::NameAtLeft(double y, const std::string& text, const std::string& css, double px) {
  rest_ += fmt::format("<text x=\"{:g}\" y=\"{:.4g}\" class=\"{} end\">{}</text>\n", -px, y, css,
                       Escape(text));
}

void Svg::Grid(const Axis& x, const Axis& y, const std::string& x_title, const std::string& y_title,
               const GridOptions& options) {
  const double top = std::min(y.from_px, y.to_px), bottom = std::max(y.from_px, y.to_px);
  std::string lines;
  int number = 0;
  for (const double tick : Ticks(x.low, x.high, 8)) {
    if (!options.x_lines) break;
    lines += fmt::format("M{:.1f} {:g}V{:g}", x(tick), y.from_px, y.to_px);
    if (!options.x_labels) continue;
    // A narrow page leaves every second number out.
    Text(x(tick), bottom + (stretched_ ? 15 : 24), fmt::format("{:g}", tick),
         number++ % 2 ? "tick alt" : "tick", "middle");
  }
  for (const double tick : Ticks(y.low, y.high, options.y_ticks)) {
    lines += fmt::format("M{:g} {:.1f}H{:g}", x.from_px, y(tick), x.to_px);
    if (stretched_) {
      NameAtLeft(y(tick) + 4, fmt::format("{:g}", tick), "tick");
    } else {
      Text(x.from_px - 6, y(tick) + 4, fmt::format("{:g}", tick), "tick", "end");
    }
  }
  lines_ += fmt::format("<path d=\"{}\" class=\"grid\"/>\n", lines);
  Text(x.to_px, bottom + (stretched_ ? 31 : 54), x_title, "axis", "end");
  Text(x.from_px, top - 8, y_title, "axis");
  rest_ += fmt::format(
      "<rect x=\"{}\" y=\"{:g}\" width=\"{}\" height=\"{:g}\" class=\"panel\" data-x=\"{:g} {:g} "
      "{:g} {:g}\" data-y=\"{:g} {:g} {:g} {:g}\" data-title=\"{}\"{}/>\n",
      X(x.from_px), top, X(x.to_px - x.from_px), bottom - top, x.low, x.high, x.from_px, x.to_px,
      y.low, y.high, y.from_px, y.to_px, Escape(y_title), options.x_lines ? "" : " data-bare");
}

void Svg::GridAcross(const Axis& x, double top, double bottom, const std::string& title) {
  std::string lines;
  int number = 0;
  for (const double tick : Ticks(x.low, x.high, 8)) {
    lines += fmt::format("M{:.1f} {:g}V{:g}", x(tick), top, bottom);
    Text(x(tick), bottom + 15, fmt::format("{:g}", tick), number++ % 2 ? "tick alt" : "tick",
         "middle");
  }
  lines_ += fmt::format("<path d=\"{}\" class=\"grid\"/>\n", lines);
  Text(x.to_px, bottom + 31, title, "axis", "end");
}

std::string Svg::Finish() const {
  if (!stretched_) return open_ + lines_ + rest_ + "</svg>\n";
  return fmt::format(
      "{}<svg viewBox=\"0 0 {:g} {:g}\" preserveAspectRatio=\"none\" width=\"100%\" "
      "height=\"{:g}\">\n{}</svg>\n{}</svg>\n",
      open_, kAcross, height_, height_, lines_, rest_);
}

std::string Legend(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string text = "<p class=\"legend\">";
  for (const auto& [name, css] : entries) {
    text += fmt::format(
        "<span><svg class=\"key\"><line x1=\"0\" y1=\"5\" x2=\"26\" y2=\"5\" class=\"{}\"/></svg>"
        "{}</span>\n",
        css, Escape(name));
  }
  return text + "</p>\n";
}

}  // namespace aisle
