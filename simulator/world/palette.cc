#include "simulator/world/palette.h"

#include "simulator/world/sheets.h"

namespace aisle::sim {
namespace {

/// Streams of the painted surfaces; values are part of what a seed means.
enum Stream : std::uint64_t { kFloor = 100, kLinePaint, kHatch };

/// Finish of a surface: reflectance at normal incidence and roughness, as in Material.
struct Finish {
  float f0 = 0;
  float roughness = 1;
};

/// How much of a sheet's mottle stays, and up to which difference in grey it is mottle.
constexpr float kMottle = 0.25f;
constexpr int kMottleLimit = 40;
constexpr int kBoardLimit = 24;  // on cartons, whose print differs by more

class Mixer {
 public:
  Mixer(const AssetLibrary& assets, WorldParts* parts) : assets_(assets), parts_(parts) {}

  std::uint16_t Painted(const std::string& name, cv::Mat1b picture, Finish finish = {}) {
    Material material;
    material.name = name;
    material.albedo = 1;
    material.albedo_texture = static_cast<int>(parts_->textures.size());
    material.specular_f0 = finish.f0;
    material.roughness = finish.roughness;
    parts_->textures.push_back({name, std::move(picture)});
    return Add(std::move(material));
  }

  /// A material that shows assets/textures/NAME.png.
  std::uint16_t Shown(const std::string& texture, Finish finish = {}) {
    return Painted(texture, assets_.Picture(texture), finish);
  }

  /// The same with less mottle than the authored sheet has.
  std::uint16_t ShownPlainer(const std::string& texture, Finish finish = {}) {
    return Painted(texture, Plainer(assets_.Picture(texture), kMottle, kMottleLimit), finish);
  }

  std::uint16_t Plain(const std::string& name, float albedo, float emission = 0) {
    Material material;
    material.name = name;
    material.albedo = albedo;
    material.emission = emission;
    return Add(std::move(material));
  }

 private:
  std::uint16_t Add(Material material) {
    parts_->materials.push_back(std::move(material));
    return static_cast<std::uint16_t>(parts_->materials.size() - 1);
  }

  const AssetLibrary& assets_;
  WorldParts* parts_;
};

struct FloorLook {
  const char* texture;
  Finish finish;
};

FloorLook LookOf(FloorKind kind) {
  switch (kind) {
    case FloorKind::kPainted:
      return {"floor_polished", {0.04f, 0.38f}};
    case FloorKind::kGlossy:
      return {"floor_polished", {0.06f, 0.12f}};
    case FloorKind::kAsphalt:
      return {"asphalt", {}};
    case FloorKind::kResin:
      return {"floor_resin", {0.05f, 0.28f}};
    case FloorKind::kBlocks:
      return {"floor_blocks", {0.03f, 0.5f}};
    case FloorKind::kConcrete:
      break;
  }
  return {"floor_concrete", {0.02f, 0.6f}};
}

struct WallLook {
  const char* texture;
  float wide_m;
  bool plainer;  ///< less mottled than it was authored
};

WallLook LookOf(WallKind kind) {
  switch (kind) {
    case WallKind::kPlain:
      return {"plain", kWallSheet_m, true};
    case WallKind::kBrick:
      return {"wall_painted", kWallSheet_m, true};
    case WallKind::kCassettes:
      return {"wall_cassette", kWallSheet_m, false};
    case WallKind::kInsulated:
      return {"wall_insulated", 4.6f, false};
    case WallKind::kConcrete:
      return {"wall_concrete", 4.8f, false};
    case WallKind::kPanels:
    case WallKind::kSky:
      break;
  }
  return {"wall_panel", kWallSheet_m, true};
}

const char* LookOf(RoofKind kind) {
  return kind == RoofKind::kFlat   ? "wall_insulated"
         : kind == RoofKind::kRibs ? "wall_concrete"
                                   : "wall_panel";
}

/// A rectangle of an atlas, a little inside its border so that neighbours do not bleed in.
UvRect Inset(const std::array<float, 4>& rect) {
  constexpr float kInset = 0.012f;
  const Eigen::Vector2f origin(rect[0], rect[1]), size(rect[2], rect[3]);
  return {origin + kInset * size, (1 - 2 * kInset) * size};
}

/// The sheet of cartons with each side's board plainer; its print stays.
cv::Mat1b PlainerCartons(const AssetLibrary& assets) {
  const cv::Mat1b sheet = assets.Picture("cartons");
  cv::Mat1b plainer = sheet.clone();
  const auto calm = [&](const std::string& name) {
    const std::array<float, 4> rect = assets.Rect("cartons", name);
    const auto pixels = [](float share, int size) {
      return cvRound(share * static_cast<float>(size));
    };
    const cv::Rect box(pixels(rect[0], sheet.cols), pixels(rect[1], sheet.rows),
                       pixels(rect[2], sheet.cols), pixels(rect[3], sheet.rows));
    const cv::Rect inside = box & cv::Rect({}, sheet.size());
    Plainer(sheet(inside), kMottle, kBoardLimit).copyTo(plainer(inside));
  };
  for (std::size_t i = 0; i < kCartonSides; ++i) calm(fmt::format("side_{}", i));
  for (std::size_t i = 0; i < kCartonTops; ++i) calm(fmt::format("top_{}", i));
  return plainer;
}

void FindPictures(const AssetLibrary& assets, Palette* palette) {
  const auto find = [&](const std::string& texture, const std::string& name) {
    return Inset(assets.Rect(texture, name));
  };
  for (std::size_t i = 0; i < kCartonSides; ++i) {
    palette->carton_sides[i] = find("cartons", fmt::format("side_{}", i));
  }
  for (std::size_t i = 0; i < kCartonTops; ++i) {
    palette->carton_tops[i] = find("cartons", fmt::format("top_{}", i));
  }
  for (std::size_t i = 0; i < kAisleSigns; ++i) {
    palette->aisle_signs[i] = find("signs", fmt::format("aisle_{:c}", static_cast<int>('a' + i)));
  }
  for (std::size_t i = 0; i < kBayLabels; ++i) {
    palette->bay_labels[i] = find("signs", fmt::format("bay_{}", i + 1));
  }
  for (const char* name :
       {"forklifts", "hazard", "vest", "helmet", "no_walking", "extinguisher", "first_aid", "speed",
        "dock_1", "dock_2", "poster_1", "poster_2", "poster_3", "poster_4"}) {
    palette->wall_signs.push_back(find("signs", name));
  }
}

/// Under the open sky `lights` are parts of it: all of it is as bright as the first of them.
float SkyOf(const Scene& scene) {
  const bool stated = scene.hall.walls == WallKind::kSky && !scene.lights.empty();
  return stated ? static_cast<float>(scene.lights.front().brightness) : kOvercast;
}

}  // namespace

Palette AddPalette(const Scene& scene, std::uint64_t seed, const AssetLibrary& assets,
                   WorldParts* parts) {
  Mixer mix(assets, parts);
  Palette palette;
  const HallSpec& hall = scene.hall;
  const FloorLook floor = LookOf(hall.floor);
  cv::Mat1b clean = assets.Picture(floor.texture);
  // Roads are as mottled as their sheet; floors under a roof are swept.
  const bool finer = hall.floor == FloorKind::kResin || hall.floor == FloorKind::kBlocks;
  if (hall.floor != FloorKind::kAsphalt && !finer) clean = Plainer(clean, kMottle, kMottleLimit);
  if (finer) clean = cv::repeat(clean, 2, 2);  // these show half as much of the floor
  for (std::size_t i = 0; i < kFloorSheets; ++i) {
    palette.floor[i] =
        mix.Painted(fmt::format("floor_{}", i),
                    WornFloor(clean, Dice(seed, {kFloor, i}), hall.wear), floor.finish);
  }
  const WallLook wall = LookOf(hall.walls);
  palette.wall = wall.plainer ? mix.ShownPlainer(wall.texture) : mix.Shown(wall.texture);
  palette.wall_wide_m = wall.wide_m;
  palette.plinth = mix.Plain("plinth", 0.22f);
  palette.roof =
      hall.walls == WallKind::kPanels && LookOf(hall.roof) == std::string_view(wall.texture)
          ? palette.wall
          : mix.ShownPlainer(LookOf(hall.roof));
  palette.door = mix.Shown("dock_door");
  palette.steel = mix.ShownPlainer("steel", {0.04f, 0.45f});
  palette.upright = mix.ShownPlainer("rack_blue", {0.04f, 0.5f});
  palette.beam = mix.ShownPlainer("rack_beam", {0.04f, 0.4f});
  palette.wood = mix.ShownPlainer("wood_pallet");
  palette.carton = mix.Painted("cartons", PlainerCartons(assets));
  palette.wrap = mix.ShownPlainer("shrink_wrap", {0.05f, 0.25f});
  palette.drum = mix.Shown("drum", {0.04f, 0.35f});
  palette.tote = mix.Shown("tote", {0.04f, 0.5f});
  palette.stripes = mix.Shown("column_stripes");
  palette.line_paint =
      mix.Painted("line_paint", LinePaintSheet(Dice(seed, {kLinePaint}), hall.wear));
  palette.hatch = mix.Painted("hatch", HatchSheet(Dice(seed, {kHatch}), hall.wear));
  palette.sign = mix.Shown("signs");
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    palette.lamps.push_back(
        mix.Plain(fmt::format("lamp_{}", i), 0.8f, static_cast<float>(scene.lights[i].brightness)));
  }
  palette.sky = mix.Plain("sky", 0.8f, SkyOf(scene));
  palette.pavement = hall.walls == WallKind::kSky ? mix.Shown("floor_concrete") : palette.plinth;
  palette.lamp_housing = mix.Plain("lamp_housing", 0.6f);
  palette.posts.fill(palette.upright);
  const auto painted = [&](RackPaint paint) {
    return std::ranges::any_of(scene.racks,
                               [&](const RackSpec& rack) { return rack.paint == paint; });
  };
  if (painted(RackPaint::kOrange)) {
    palette.posts[static_cast<std::size_t>(RackPaint::kOrange)] =
        mix.ShownPlainer("rack_orange", {0.04f, 0.5f});
  }
  if (painted(RackPaint::kSteel)) {
    palette.posts[static_cast<std::size_t>(RackPaint::kSteel)] =
        mix.ShownPlainer("steel", {0.08f, 0.4f});
  }
  for (std::size_t i = 0; i < scene.doors.size(); ++i) {
    const auto day = static_cast<float>(scene.doors[i].daylight);
    palette.days.emplace_back();
    if (day <= 0) continue;
    palette.days.back() = {mix.Plain(fmt::format("day_{}", i), 0.8f, day),
                           mix.Plain(fmt::format("day_yard_{}", i), 0.4f, kYardShare * day)};
  }
  FindPictures(assets, &palette);
  return palette;
}

}  // namespace aisle::sim
