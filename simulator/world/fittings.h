#pragma once

#include "simulator/world/forms.h"
#include "simulator/world/palette.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {

/// Materials of machines, curtains and what lies about, beside those of the warehouse kit.
struct Fittings {
  std::uint16_t enamel = 0;  ///< machines' pale paint, oily
  std::uint16_t dark = 0;    ///< black paint and plastic
  std::uint16_t rubber = 0, chrome = 0, glass = 0, white = 0, brass = 0;
  std::uint16_t panel = 0;  ///< cold-store panels: a sheet of 4.6 m by 4 m
  std::uint16_t pvc = 0;    ///< a curtain's strip
  std::uint16_t checker = 0, peg = 0;
  std::uint16_t fins = 0;  ///< of evaporators
  std::uint16_t film = 0, puddle = 0, oil = 0, chalk = 0, dust = 0, card = 0;
};

/// Adds them to the world's materials.
Fittings AddFittings(const AssetLibrary& assets, WorldParts* parts);

/// Everything that a hall's fixtures are made with.
struct Kit {
  const Palette& palette;
  const Fittings& fittings;
};

/// Puts parts of one thing together in its own frame: x to its front, y to its left, z up.
class Maker {
 public:
  Maker(const Kit& made_of, const Eigen::Isometry3f& pose, TriangleMesh* mesh)
      : kit(made_of), p(made_of.palette), f(made_of.fittings), pose_(pose), mesh_(mesh) {}

  /// A block with broken edges about a middle.
  void Block(const Eigen::Vector3f& middle, const Eigen::Vector3f& size, std::uint16_t material,
             float radius = 0.012f, float tile_m = 1) const {
    AddRounded(mesh_, At(middle), size, radius, material, tile_m,
               middle.head<2>() * 0.37f + Eigen::Vector2f(0, 0.21f * middle.z()));
  }
  void Pipe(std::vector<Eigen::Vector3f> way, float radius, std::uint16_t material,
            int sides = 10) const {
    for (Eigen::Vector3f& point : way) point = pose_ * point;
    AddTube(mesh_, way, radius, sides, material);
  }
  /// Turned about an axis through `foot`.
  void Turn(const Eigen::Vector3f& foot, const Eigen::Vector3f& axis,
            const std::vector<Turned>& outline, std::uint16_t material, int sides = 20) const {
    const Eigen::Vector3f across =
        std::abs(axis.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
    Eigen::Isometry3f at = Facing(foot, across.cross(axis), across);
    at.linear().col(2) = axis.normalized();
    at.linear().col(0) = across.cross(axis).normalized();
    at.linear().col(1) = at.linear().col(2).cross(at.linear().col(0));
    AddTurned(mesh_, pose_ * at, outline, sides, material);
  }
  /// A disc with a rim: a wheel, a knob, a cap.
  void Disc(const Eigen::Vector3f& foot, const Eigen::Vector3f& axis, float radius, float thick,
            std::uint16_t material, int sides = 20) const {
    const float edge = std::min({0.25f * thick, 0.2f * radius, 0.01f});
    Turn(foot, axis,
         {{0, 0},
          {radius - edge, 0},
          {radius, edge},
          {radius, thick - edge},
          {radius - edge, thick},
          {0, thick}},
         material, sides);
  }
  /// A rim of round bar about an axis: a guard, a handwheel.
  void Ring(const Eigen::Vector3f& middle, const Eigen::Vector3f& axis, float radius, float bar,
            std::uint16_t material, int parts = 24) const;

  Eigen::Isometry3f At(const Eigen::Vector3f& middle) const {
    Eigen::Isometry3f at = pose_;
    at.translate(middle);
    return at;
  }
  TriangleMesh* mesh() const { return mesh_; }
  const Eigen::Isometry3f& pose() const { return pose_; }

  const Kit& kit;
  const Palette& p;
  const Fittings& f;

 private:
  Eigen::Isometry3f pose_;
  TriangleMesh* mesh_;
};

// One file a trade; sizes are (depth, length, height) as SizeOf gives them.

void AddStripCurtain(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddPanelWall(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddEvaporator(const Maker& make, const Eigen::Vector3f& size, float roof, Dice dice);

void AddLathe(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddMill(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddDrill(const Maker& make, const Eigen::Vector3f& size, Dice dice);

void AddBench(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddToolWall(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddToolCart(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddLocker(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddGasBottles(const Maker& make, const Eigen::Vector3f& size, Dice dice);

void AddDuct(const Maker& make, const Eigen::Vector3f& size, float roof, Dice dice);
void AddCableTray(const Maker& make, const Eigen::Vector3f& size, float roof, Dice dice);
void AddCableDrop(const Maker& make, const Eigen::Vector3f& size, float roof, Dice dice);
void AddCrane(const Maker& make, const Eigen::Vector3f& size, float roof, Dice dice);
void AddLeveller(const Maker& make, const Eigen::Vector3f& size, Dice dice);
void AddGuideRail(const Maker& make, const Eigen::Vector3f& size, Dice dice);

void AddFixtures(const Scene& scene, const Kit& kit, std::uint64_t seed, WorldBuilder* builder);

/// What lies about beside the ways: density `hall.clutter`, places and kinds from the seed.
void AddClutter(const Scene& scene, const Kit& kit, std::uint64_t seed, WorldBuilder* builder);

}  // namespace aisle::sim
