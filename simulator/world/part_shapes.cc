#include "simulator/world/part_shapes.h"

#include <cmath>
#include <numbers>

#include "simulator/world/goods.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

/// A ring of round wire, longer in z than in x; `size` is the box around it.
void AddLink(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Vector3f& size,
             std::uint16_t material) {
  constexpr int kAround = 14, kAcross = 7;
  const float wire = size.y() / 2;
  const float wide = size.x() / 2 - wire, tall = size.z() / 2 - size.x() / 2;
  const auto first = static_cast<std::uint32_t>(mesh->positions.size());
  for (int i = 0; i <= kAround; ++i) {
    const float phi = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kAround;
    const Vector3f out(std::cos(phi), 0, std::sin(phi));
    const Vector3f middle = wide * out + Vector3f(0, 0, out.z() >= 0 ? tall : -tall);
    for (int k = 0; k <= kAcross; ++k) {
      const float psi = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / kAcross;
      const Vector3f normal = std::cos(psi) * out + std::sin(psi) * Vector3f::UnitY();
      mesh->positions.push_back(pose * (middle + wire * normal));
      mesh->normals.push_back(pose.linear() * normal);
      mesh->uvs.emplace_back(static_cast<float>(i) / kAround, static_cast<float>(k) / kAcross);
    }
  }
  for (int i = 0; i < kAround; ++i) {
    for (int k = 0; k < kAcross; ++k) {
      const auto a = first + static_cast<std::uint32_t>(i * (kAcross + 1) + k);
      const auto b = a + kAcross + 1;
      mesh->triangles.push_back({a, b, a + 1});
      mesh->triangles.push_back({a + 1, b, b + 1});
      mesh->materials.insert(mesh->materials.end(), 2, material);
    }
  }
}

/// Both lids; AddCylinder has but the upper one.
void AddDrum(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Vector3f& size,
             std::uint16_t material) {
  constexpr int kSegments = 24;
  const Eigen::Isometry3f foot = pose * At(0, 0, -size.z() / 2);
  AddCylinder(mesh, foot, size.x() / 2, size.z(), kSegments, material, {}, {});
  Eigen::Isometry3f below = pose * At(0, 0, size.z() / 2);
  below.rotate(Eigen::AngleAxisf(std::numbers::pi_v<float>, Vector3f::UnitX()));
  AddCylinder(mesh, below, size.x() / 2, size.z(), kSegments, material, {}, {});
}

BoxPaint PaintBox(PartPaint paint, std::uint16_t material, const Vector3f& size,
                  const Palette& palette, Dice* dice) {
  switch (paint) {
    case PartPaint::kCarton: {
      BoxPaint carton = BoxPaint::Whole(
          material, palette.carton_sides[static_cast<std::size_t>(dice->Pick(kCartonSides))]);
      carton.uvs[kTop] = palette.carton_tops[static_cast<std::size_t>(dice->Pick(kCartonTops))];
      return carton;
    }
    case PartPaint::kTote:
    case PartPaint::kDoor:
      return BoxPaint::Whole(material);
    case PartPaint::kStripes:
      return BoxPaint::Tiled(material, size, 0.4f);
    case PartPaint::kWall:
      return BoxPaint::Tiled(material, size, 4);
    default:
      return BoxPaint::Tiled(material, size, 1,
                             {static_cast<float>(dice->Unit()), static_cast<float>(dice->Unit())});
  }
}

}  // namespace

std::uint16_t PartPaints::Of(PartPaint paint) {
  switch (paint) {
    case PartPaint::kSteel:
      return palette_.steel;
    case PartPaint::kWood:
      return palette_.wood;
    case PartPaint::kCarton:
      return palette_.carton;
    case PartPaint::kWrap:
      return palette_.wrap;
    case PartPaint::kStripes:
      return palette_.stripes;
    case PartPaint::kTote:
      return palette_.tote;
    case PartPaint::kDoor:
      return palette_.door;
    case PartPaint::kWall:
      return palette_.wall;
    default:
      break;
  }
  const auto [entry, is_new] =
      own_.try_emplace(paint, static_cast<std::uint16_t>(parts_->materials.size()));
  if (!is_new) return entry->second;
  Material material;
  switch (paint) {
    case PartPaint::kFilm:  // aluminium behind polyester
      material = {.name = "film", .albedo = 0.3f, .specular_f0 = 0.5f, .roughness = 0.14f};
      break;
    case PartPaint::kGlass:  // two faces of n = 1.5
      material = {.name = "glass",
                  .albedo = 0.1f,
                  .specular_f0 = 0.08f,
                  .roughness = 0.04f,
                  .transmission = 0.74f};
      break;
    case PartPaint::kGlow:
      material = {.name = "glow", .albedo = 0.8f, .emission = 3};
      break;
    case PartPaint::kDark:
      material = {.name = "dark", .albedo = 0.06f, .specular_f0 = 0.04f, .roughness = 0.5f};
      break;
    default:
      material = {.name = "white", .albedo = 0.75f, .specular_f0 = 0.04f, .roughness = 0.4f};
      break;
  }
  parts_->materials.push_back(std::move(material));
  return entry->second;
}

TriangleMesh DrawPart(const PartSpec& part, int copy, AssetLibrary* assets, Wardrobe* wardrobe,
                      PartPaints* paints, Dice dice) {
  TriangleMesh mesh;
  Eigen::Isometry3f at = Eigen::Isometry3f::Identity();
  at.translation() = part.center_m.cast<float>();
  const Vector3f size = part.size_m.cast<float>();
  switch (part.shape) {
    case PartShape::kBox:
      AddBox(&mesh, at, size,
             PaintBox(part.paint, paints->Of(part.paint), size, paints->palette(), &dice));
      break;
    case PartShape::kCylinder:
      AddDrum(&mesh, at, size, paints->Of(part.paint));
      break;
    case PartShape::kLink:
      if (copy % 2) at.rotate(Eigen::AngleAxisf(std::numbers::pi_v<float> / 2, Vector3f::UnitZ()));
      AddLink(&mesh, at, size, paints->Of(part.paint));
      break;
    case PartShape::kModel:
      AddMesh(&mesh, at, wardrobe->Wear(assets->Load(assets->Prop(part.model))));
      break;
    case PartShape::kPallet:
      AddLoadedPallet(&mesh, paints->palette(), at, static_cast<float>(part.goods_m), part.goods,
                      std::move(dice));
      break;
  }
  return mesh;
}

}  // namespace aisle::sim
