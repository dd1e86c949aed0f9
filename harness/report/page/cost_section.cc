#include "harness/report/page/cost_section.h"

#include "harness/judge/twins.h"
#include "harness/report/markup/html.h"

namespace aisle {
namespace {

std::string Centimetres(const std::optional<double>& metres, const char* format) {
  return metres ? fmt::format(fmt::runtime(format), 100 * *metres) : "-";
}

}  // namespace

std::string CostSection(const std::vector<SceneRuns>& scenes) {
  const std::vector<CostSplit> splits = SplitCosts(scenes);
  if (splits.empty()) return "";
  std::string text =
      "<h2 id=\"causes\">Where the error comes from</h2>\n<p class=\"soft small\">ATE RMSE in "
      "centimetres, each system compared with its own drives. Alone: the same scene with nobody in "
      "it. Occlusion: the cost of people and vehicles in the view (frozen minus alone). Motion: "
      "the "
      "cost of their moving (live minus frozen). Rejection: the effect of rejecting what moves, "
      "where the same system without rejection was run too (negative: an improvement). Penalty: "
      "live over alone.</p>\n<div class=\"wide\"><table><tr>"
      "<th>scene<th class=\"left\">system<th>live<th>alone<th>occlusion<th>motion<th>rejection"
      "<th>penalty\n";
  for (const CostSplit& split : splits) {
    text += fmt::format(
        "<tr><td>{}<td class=\"left\"><span class=\"chip c{}\"></span>{}<td>{}"
        "<td>{}<td>{}<td>{}<td>{}<td>{}\n",
        Escape(split.scene), split.color, Escape(split.system), Centimetres(split.live_m, "{:.2f}"),
        Centimetres(split.empty_m, "{:.2f}"), Centimetres(split.occlusion_m, "{:+.2f}"),
        Centimetres(split.motion_m, "{:+.2f}"), Centimetres(split.rejection_m, "{:+.2f}"),
        split.penalty ? fmt::format("×{:.2f}", *split.penalty) : "-");
  }
  return text + "</table></div>\n";
}

}  // namespace aisle
