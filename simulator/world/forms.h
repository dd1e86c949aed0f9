#pragma once

#include <vector>

#include "simulator/scene/dice.h"
#include "simulator/world/shapes.h"

namespace aisle::sim {

// Things as they are made: edges are broken, pipes are round. All are appended to a mesh; normals
// are smooth where the thing is.

/// A box about the origin of `pose` whose twelve edges are rounded by `radius` metres (at most half
/// the shortest side), its texture at `tile_m` metres a repeat, shifted by `offset`.
void AddRounded(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Eigen::Vector3f& size,
                float radius, std::uint16_t material, float tile_m = 1,
                const Eigen::Vector2f& offset = Eigen::Vector2f::Zero());

/// A round bar along a way of at least two points, closed at both ends: a pipe, hose or cable. The
/// texture is once around it and repeats every `tile_m` along.
void AddTube(TriangleMesh* mesh, const std::vector<Eigen::Vector3f>& way, float radius, int sides,
             std::uint16_t material, float tile_m = 0.5f);

/// A point of a turned thing's outline.
struct Turned {
  float radius = 0, along = 0;
};

/// A turned thing about the z axis of `pose`: its outline from one end to the other, radii zero
/// where it closes. Corners of the outline over 40° stay sharp.
void AddTurned(TriangleMesh* mesh, const Eigen::Isometry3f& pose,
               const std::vector<Turned>& outline, int sides, std::uint16_t material,
               float tile_m = 0.5f);

/// A sheet through equal rows of points, `across` points wide, seen from both sides unless told
/// otherwise; its front looks along (right in the row) × (to the next row).
void AddSheet(TriangleMesh* mesh, const std::vector<Eigen::Vector3f>& points, std::size_t across,
              std::uint16_t material, const UvRect& uv = {}, bool both_sides = true);

/// A smooth way through points, `parts` pieces from each to the next (Catmull and Rom's spline).
std::vector<Eigen::Vector3f> Smooth(const std::vector<Eigen::Vector3f>& points, int parts);

/// A cable or chain between two points that hangs through by `sag` metres in the middle.
std::vector<Eigen::Vector3f> Hanging(const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                                     float sag, int parts = 14);

/// A flat patch of paint, water or dust on the floor of `pose`: a ragged disc of about `radius`
/// along x and y, `rough` its rim's share of that.
void AddSpot(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Eigen::Vector2f& radius,
             float rough, Dice dice, std::uint16_t material);

/// A rolled steel beam of I section along a line, `depth` high towards `up`.
void AddSection(TriangleMesh* mesh, const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                const Eigen::Vector3f& up, float width, float depth, float plate,
                std::uint16_t material);

/// The pose that turns x onto `ahead` and keeps z as near to `up` as it can.
Eigen::Isometry3f Facing(const Eigen::Vector3f& origin, const Eigen::Vector3f& ahead,
                         const Eigen::Vector3f& up);

}  // namespace aisle::sim
