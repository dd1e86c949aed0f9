#include "simulator/world/props.h"

#include "simulator/scene/prop.h"
#include "simulator/world/labels.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {
namespace {

ObjectClass ClassOfProp(const std::string& asset) {
  for (const char* goods : {"kit/pallet", "kit/drum", "kit/tote"}) {
    if (asset.starts_with(goods)) return ObjectClass::kGoods;
  }
  return asset.starts_with("street/house") ? ObjectClass::kWall : ObjectClass::kFurniture;
}

/// The piece that a prop shows, what it is called and what it is.
struct Piece {
  std::shared_ptr<const Model> model;
  std::string name;
  ObjectClass object_class = ObjectClass::kFurniture;
};

Piece PieceOf(const PropSpec& prop, AssetLibrary* assets) {
  if (!prop.mesh.name.empty()) {
    return {assets->LoadStill(prop.mesh.file),
            std::filesystem::path(prop.mesh.file).stem().string(), ClassOfLabel(prop.label)};
  }
  const std::string asset = assets->Prop(prop.model);
  return {assets->Load(asset), prop.model, ClassOfProp(asset)};
}

}  // namespace

void AddProps(const Scene& scene, std::uint64_t seed, AssetLibrary* assets, Wardrobe* wardrobe,
              WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.props.size(); ++i) {
    const PropSpec& prop = scene.props[i];
    const Piece what = PieceOf(prop, assets);
    const TriangleMesh piece = wardrobe->Wear(what.model);
    const std::vector<Eigen::Vector2d> places = PlacesOf(prop);
    for (std::size_t k = 0; k < places.size(); ++k) {
      // In a row each is turned a little otherwise, as things are.
      Dice dice(seed, {320, i, k});
      const double turn = prop.heading_rad + (prop.to ? kPropTurn_rad * dice.Signed() : 0);
      const Eigen::Vector3f at(places[k].cast<float>().x(), places[k].cast<float>().y(),
                               static_cast<float>(prop.above_m));
      builder->Add(fmt::format("{}_{}_{}", what.name, i, k), what.object_class,
                   [&](TriangleMesh* mesh) {
                     AddMesh(mesh, At(at.x(), at.y(), at.z(), static_cast<float>(turn)), piece);
                   });
    }
  }
}

}  // namespace aisle::sim
