#include "harness/report/page/trends.h"

#include "harness/report/chart/svg.h"
#include "harness/report/markup/html.h"

namespace aisle {
namespace {

constexpr double kWidth = 860, kLeft = 52, kRight = 846;
constexpr const char* kShown = "ate_rmse_m";

/// Nights by system of one scene and twin; the colour is the order of the names.
using Nights = std::map<std::string, std::vector<std::pair<std::size_t, double>>>;

std::string TrendChart(const Nights& nights, std::size_t count) {
  double highest_cm = 0;
  for (const auto& [system, points] : nights) {
    for (const auto& [night, cm] : points) highest_cm = std::max(highest_cm, cm);
  }
  if (highest_cm <= 0) return "";
  const Axis x{0, static_cast<double>(count - 1), kLeft, kRight};
  const Axis y{0, 1.1 * highest_cm, 150, 24};
  Svg svg(kWidth, 206, "error by night");
  svg.Grid(x, y, "night", "ATE RMSE [cm], median over seeds");
  int color = 0;
  double legend_x = kLeft;
  for (const auto& [system, points] : nights) {
    std::vector<std::pair<double, double>> line;
    for (const auto& [night, cm] : points) line.emplace_back(x(static_cast<double>(night)), y(cm));
    svg.Polyline(line, fmt::format("line c{}", color % 6), system);
    for (std::size_t i = 0; i < points.size(); ++i) {
      svg.Circle(line[i].first, line[i].second, 3, fmt::format("dot d{}", color % 6),
                 fmt::format("{}: {:.2f} cm", system, points[i].second));
    }
    svg.Line(legend_x, 194, legend_x + 18, 194, fmt::format("line c{}", color % 6));
    svg.Text(legend_x + 24, 198, system, "legend");
    legend_x += 44 + 7.2 * static_cast<double>(system.size());
    ++color;
  }
  return svg.Finish();
}

}  // namespace

std::string TrendSection(const std::vector<TrendPoint>& points) {
  std::vector<std::pair<std::string, std::string>> nights;  // started, commit
  std::map<std::pair<std::string, std::string>, Nights> by_scene;
  for (const TrendPoint& point : points) {
    const std::pair night{point.started, point.commit};
    if (nights.empty() || nights.back() != night) nights.push_back(night);
    if (point.score != kShown || !point.median) continue;
    by_scene[{point.scene, point.twin}][point.system].emplace_back(nights.size() - 1,
                                                                   100 * *point.median);
  }
  if (nights.size() < 2) return "";
  std::string text = fmt::format(
      "<h1>{} nights</h1>\n<p class=\"soft small\">From {} to {}. Every score of every night is in "
      "the SQLite file beside the reports.</p>\n",
      nights.size(), Escape(nights.front().first), Escape(nights.back().first));
  for (const auto& [scene, of_scene] : by_scene) {
    text +=
        fmt::format("<h3>{} <span class=\"soft\">{}</span></h3>\n<figure>{}</figure>\n",
                    Escape(scene.first), Escape(scene.second), TrendChart(of_scene, nights.size()));
  }
  text +=
      "<details><summary>the nights</summary><div class=\"wide\"><table><tr><th>night</th>"
      "<th class=\"left\">started</th><th class=\"left\">commit</th></tr>\n";
  for (std::size_t i = 0; i < nights.size(); ++i) {
    text +=
        fmt::format("<tr><td>{}</td><td class=\"left\">{}</td><td class=\"left\">{}</td></tr>\n", i,
                    Escape(nights[i].first), Escape(nights[i].second));
  }
  return text + "</table></div></details>\n";
}

}  // namespace aisle
