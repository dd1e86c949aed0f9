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
    case FloorKind::kConcrete:
      break;
  }
  return {"floor_concrete", {0.02f, 0.6f}};
}

const char* LookOf(WallKind kind) {
  return kind == WallKind::kPlain   ? "plain"
         : kind == WallKind::kBrick ? "wall_painted"
                                    : "wall_panel";
}

/// A rectangle of an atlas, a little inside its border so that neighbours do not bleed in.
UvRect Inset(const std::array<float, 4>& rect) {
  constexpr float kInset = 0.012f;
  const Eigen::Vector2f origin(rect[0], rect[1]), size(rect[2], rect[3]);
  return {origin + kInset * size, (1 - 2 * kInset) * size};
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

}  // namespace

Palette AddPalette(const Scene& scene, std::uint64_t seed, const AssetLibrary& assets,
                   WorldParts* parts) {
  Mixer mix(assets, parts);
  Palette palette;
  const HallSpec& hall = scene.hall;
  const FloorLook floor = LookOf(hall.floor);
  const cv::Mat1b clean = assets.Picture(floor.texture);
  for (std::size_t i = 0; i < kFloorSheets; ++i) {
    palette.floor[i] =
        mix.Painted(fmt::format("floor_{}", i),
                    WornFloor(clean, Dice(seed, {kFloor, i}), hall.wear), floor.finish);
  }
  palette.wall = mix.Shown(LookOf(hall.walls));
  palette.plinth = mix.Plain("plinth", 0.22f);
  palette.roof = hall.walls == WallKind::kPanels ? palette.wall : mix.Shown("wall_panel");
  palette.door = mix.Shown("dock_door");
  palette.steel = mix.Shown("steel", {0.04f, 0.45f});
  palette.upright = mix.Shown("rack_blue", {0.04f, 0.5f});
  palette.beam = mix.Shown("rack_beam", {0.04f, 0.4f});
  palette.wood = mix.Shown("wood_pallet");
  palette.carton = mix.Shown("cartons");
  palette.wrap = mix.Shown("shrink_wrap", {0.05f, 0.25f});
  palette.drum = mix.Shown("drum", {0.04f, 0.35f});
  palette.tote = mix.Shown("tote", {0.04f, 0.5f});
  palette.stripes = mix.Shown("column_stripes");
  palette.line_paint =
      mix.Painted("line_paint", LinePaintSheet(Dice(seed, {kLinePaint}), hall.wear));
  palette.hatch = mix.Painted("hatch", HatchSheet(Dice(seed, {kHatch}), hall.wear));
  palette.sign = mix.Shown("signs");
  palette.lamp = mix.Plain("lamp", 0.8f, 1.0f);
  palette.sky = mix.Plain("sky", 0.8f, 0.28f);
  palette.pavement = hall.walls == WallKind::kSky ? mix.Shown("floor_concrete") : palette.plinth;
  palette.lamp_housing = mix.Plain("lamp_housing", 0.6f);
  FindPictures(assets, &palette);
  return palette;
}

}  // namespace aisle::sim
