#include "simulator/mesh/stated_frame.h"

#include <cmath>
#include <pugixml.hpp>

namespace aisle::sim {
namespace {

StatedFrame ColladaFrame(std::string_view text) {
  StatedFrame stated{ModelFormat::kCollada, std::nullopt, std::nullopt};
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size())) return stated;  // its checker will say why
  const pugi::xml_node asset = document.child("COLLADA").child("asset");
  const float unit_m = asset.child("unit").attribute("meter").as_float(0);
  if (std::isfinite(unit_m) && unit_m > 0) stated.unit_m = unit_m;
  const std::string_view up = asset.child("up_axis").text().get();
  if (up == "X_UP") stated.up = UpAxis::kX;
  if (up == "Y_UP") stated.up = UpAxis::kY;
  if (up == "Z_UP") stated.up = UpAxis::kZ;
  return stated;
}

}  // namespace

StatedFrame FrameStatedIn(ModelFormat format, std::string_view text) {
  if (format == ModelFormat::kCollada) return ColladaFrame(text);
  if (format == ModelFormat::kObj) return {format, std::nullopt, std::nullopt};
  return {format, 1.0f, UpAxis::kY};
}

void RequireStated(const StatedFrame& stated, const ImportOptions& options) {
  const bool no_unit = !stated.unit_m && options.unit_m == 0;
  const bool no_up = !stated.up && options.up == UpAxis::kAsStated;
  if (!no_unit && !no_up) return;
  const char* what = stated.format == ModelFormat::kObj ? "an OBJ file" : "this file";
  if (no_unit && no_up) {
    throw ImportError(
        fmt::format("{} says neither its unit nor which axis is up; give both: --unit m, cm, mm, "
                    "in or ft, and --up y, z or x",
                    what));
  }
  throw ImportError(no_unit ? fmt::format("{} does not say its unit; give it: --unit m, cm, mm, in "
                                          "or ft",
                                          what)
                            : fmt::format("{} does not say which axis is up; give it: --up y, z "
                                          "or x",
                                          what));
}

}  // namespace aisle::sim
