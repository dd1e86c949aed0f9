#include "simulator/world/palette.h"

#include "simulator/world/sheets.h"

namespace aisle::sim {
namespace {

/// Streams of the palette's textures; values are part of what a seed means.
enum Stream : std::uint64_t { kFloor = 100, kWall, kRoof, kGoods, kSteel, kSigns };

class Mixer {
 public:
  explicit Mixer(WorldParts* parts) : parts_(parts) {}

  /// A material that shows a picture; `f0` and `roughness` as in Material.
  std::uint16_t Painted(const std::string& name, cv::Mat1b picture, float f0 = 0,
                        float roughness = 1) {
    Material material;
    material.name = name;
    material.albedo = 1;
    material.albedo_texture = static_cast<int>(parts_->textures.size());
    material.specular_f0 = f0;
    material.roughness = roughness;
    parts_->textures.push_back({name, std::move(picture)});
    return Add(std::move(material));
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

  WorldParts* parts_;
};

/// Cell of a four-by-four atlas, a little inside its border so that neighbours do not bleed in.
UvRect Cell(int index) {
  constexpr float kInset = 0.004f;
  const Eigen::Vector2f corner(static_cast<float>(index % 4) / 4,
                               static_cast<float>(index / 4) / 4);
  return {corner + Eigen::Vector2f::Constant(kInset),
          Eigen::Vector2f::Constant(0.25f - 2 * kInset)};
}

}  // namespace

UvRect CartonSide(int kind) { return Cell(kind); }
UvRect CartonTop(int kind) { return Cell(kCartonSides + kind); }
UvRect SignFace(int kind) { return Cell(kind); }

Palette AddPalette(const Scene& scene, std::uint64_t seed, WorldParts* parts) {
  Mixer mix(parts);
  Palette palette;
  const HallSpec& hall = scene.hall;
  const bool glossy = hall.floor == FloorKind::kGlossy;
  const bool painted = hall.floor == FloorKind::kPainted;
  for (std::size_t i = 0; i < kFloorSheets; ++i) {
    palette.floor[i] = mix.Painted(fmt::format("floor_{}", i),
                                   FloorSheet(Dice(seed, {kFloor, i}), hall.floor, hall.wear),
                                   glossy    ? 0.06f
                                   : painted ? 0.04f
                                             : 0.02f,
                                   glossy    ? 0.12f
                                   : painted ? 0.4f
                                             : 0.6f);
  }
  palette.wall = mix.Painted("wall", WallSheet(Dice(seed, {kWall}), hall.walls));
  palette.plinth = mix.Plain("plinth", 0.22f);
  palette.roof = mix.Painted("roof", RoofSheet(Dice(seed, {kRoof})));
  palette.door = mix.Painted("door", DoorSheet(Dice(seed, {kWall, 1})));
  palette.steel = mix.Painted("steel", SteelSheet(Dice(seed, {kSteel, 0})), 0.04f, 0.45f);
  palette.upright = mix.Painted("upright", UprightSheet(Dice(seed, {kSteel, 1})), 0.04f, 0.5f);
  palette.beam = mix.Painted("beam", BeamSheet(Dice(seed, {kSteel, 2})), 0.04f, 0.4f);
  palette.wood = mix.Painted("wood", WoodSheet(Dice(seed, {kGoods, 0})));
  palette.carton = mix.Painted("carton", CartonSheet(Dice(seed, {kGoods, 1})));
  palette.wrap = mix.Painted("wrap", WrapSheet(Dice(seed, {kGoods, 2})), 0.05f, 0.25f);
  palette.drum = mix.Painted("drum", DrumSheet(Dice(seed, {kGoods, 3})), 0.04f, 0.35f);
  palette.tote = mix.Painted("tote", ToteSheet(Dice(seed, {kGoods, 4})), 0.04f, 0.5f);
  palette.stripes = mix.Painted("stripes", StripeSheet(Dice(seed, {kSteel, 3})));
  palette.line_paint =
      mix.Painted("line_paint", LinePaintSheet(Dice(seed, {kFloor, 50}), hall.wear));
  palette.hatch = mix.Painted("hatch", HatchSheet(Dice(seed, {kFloor, 51}), hall.wear));
  palette.sign = mix.Painted("sign", SignSheet(Dice(seed, {kSigns})));
  palette.lamp = mix.Plain("lamp", 0.8f, 1.0f);
  palette.lamp_housing = mix.Plain("lamp_housing", 0.6f);
  return palette;
}

}  // namespace aisle::sim
