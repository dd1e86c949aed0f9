#include <cmath>
#include <numbers>

#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Mean reflectance of a hall, for what its surfaces send on of a beam's light.
constexpr double kReflectance = 0.35;
/// Full light within this share of a spot's half width.
constexpr double kFullShare = 0.55;

Vector3d Direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// A window's frame: half its width, half its height, and the normal into the hall.
struct Pane {
  Vector3d half_u, half_v, normal;
};
Pane PaneOf(const BeamSpec& beam) {
  const Vector3d facing = Direction(beam.facing_rad, 0);
  const Vector3d side = Vector3d::UnitZ().cross(facing);
  const double half_w = beam.size_m.x() / 2, half_h = beam.size_m.y() / 2;
  if (beam.is_roof) return {half_w * side, half_h * facing, -Vector3d::UnitZ()};
  return {half_w * side, half_h * Vector3d::UnitZ(), facing};
}

/// Where the sun stands, and the share of its light.
struct SunAt {
  double azimuth, elevation, share;
};
SunAt SunOf(const BeamSpec& beam, double time_s) {
  std::vector<JointMove> azimuth, elevation, share;
  for (const SunMove& move : beam.moves) {
    azimuth.push_back({move.at_s, move.azimuth_rad, move.over_s});
    elevation.push_back({move.at_s, move.elevation_rad, move.over_s});
    share.push_back({move.at_s, move.share, move.over_s});
  }
  return {Moved(azimuth, beam.azimuth_rad, time_s).value,
          Moved(elevation, beam.elevation_rad, time_s).value, Moved(share, 1, time_s).value};
}

Beam SpotAt(const BeamSpec& spec, double time_s) {
  const double azimuth = spec.azimuth_rad + Ran(spec.run, spec.rate_rad_s, time_s).value;
  Beam beam;
  beam.kind = Beam::Kind::kSpot;
  beam.origin = spec.at.cast<float>();
  beam.toward = Direction(azimuth, spec.elevation_rad).cast<float>();
  beam.power = static_cast<float>(spec.brightness);
  beam.cos_outer = static_cast<float>(std::cos(spec.width_rad / 2));
  beam.cos_inner = static_cast<float>(std::cos(kFullShare * spec.width_rad / 2));
  return beam;
}

Beam SunThrough(const BeamSpec& spec, double time_s) {
  const SunAt sun = SunOf(spec, time_s);
  const Pane pane = PaneOf(spec);
  Beam beam;
  beam.kind = Beam::Kind::kSun;
  beam.origin = spec.at.cast<float>();
  beam.toward = Direction(sun.azimuth, sun.elevation).cast<float>();
  beam.power = static_cast<float>(spec.brightness * sun.share);
  beam.half_u = pane.half_u.cast<float>();
  beam.half_v = pane.half_v.cast<float>();
  beam.columns = spec.columns;
  beam.rows = spec.rows;
  beam.bar_u = static_cast<float>(spec.bar_m * spec.columns / spec.size_m.x());
  beam.bar_v = static_cast<float>(spec.bar_m * spec.rows / spec.size_m.y());
  return beam;
}

/// What the beam brings into the hall, radiance units m².
double FluxOf(const BeamSpec& spec, const Beam& beam) {
  if (beam.kind == Beam::Kind::kSpot) {
    return 2 * std::numbers::pi * (1 - (beam.cos_inner + beam.cos_outer) / 2) * beam.power;
  }
  const double facing = std::max(0.0, -PaneOf(spec).normal.dot(beam.toward.cast<double>()));
  const auto open = [](float bar) { return std::max(0.0, 1 - double{bar}); };
  return facing * beam.power * spec.size_m.x() * spec.size_m.y() * open(beam.bar_u) *
         open(beam.bar_v);
}

/// Floor, roof and walls.
double InnerArea(const HallSpec& hall) {
  const Eigen::Vector2d size = hall.to - hall.from;
  return 2 * size.x() * size.y() + 2 * hall.height_m * (size.x() + size.y());
}

void AddWindow(TriangleMesh* mesh, const BeamSpec& beam, const Palette& palette,
               std::uint16_t shine) {
  const Pane pane = PaneOf(beam);
  const Vector3f at = (beam.at + 0.02 * pane.normal).cast<float>();
  const Vector3f u = pane.half_u.cast<float>(), v = pane.half_v.cast<float>();
  const Vector3f right = u.cross(v).dot(pane.normal.cast<float>()) > 0 ? u : Vector3f(-u);
  // As seen from inside: down × right is the normal.
  AddQuad(mesh, at - right + v, 2 * right, -2 * v, {}, shine);
  const Vector3f front = at + 0.03f * pane.normal.cast<float>();
  const auto thick = static_cast<float>(std::max(0.03, beam.bar_m));
  for (int i = 0; i <= beam.columns; ++i) {
    const Vector3f x =
        front + (2 * static_cast<float>(i) / static_cast<float>(beam.columns) - 1) * u;
    AddBar(mesh, x - v, x + v, thick, palette.lamp_housing);
  }
  for (int i = 0; i <= beam.rows; ++i) {
    const Vector3f y = front + (2 * static_cast<float>(i) / static_cast<float>(beam.rows) - 1) * v;
    AddBar(mesh, y - u, y + u, thick, palette.lamp_housing);
  }
}

}  // namespace

void AddWindows(const Scene& scene, const Palette& palette, WorldParts* parts,
                WorldBuilder* builder) {
  for (const BeamSpec& beam : scene.beams) {
    if (beam.kind != BeamKind::kSun) continue;
    // A pane lights as a dim lamp does, so that the light that is solved once has it too.
    const Pane pane = PaneOf(beam);
    const Vector3f u = pane.half_u.cast<float>(), v = pane.half_v.cast<float>();
    const bool inward = u.cross(v).dot(pane.normal.cast<float>()) > 0;
    parts->lights.push_back({(beam.at + 0.021 * pane.normal).cast<float>(),
                             inward ? u : Vector3f(-u), v, parts->materials[palette.sky].emission});
    builder->Add("window_" + beam.name, ObjectClass::kFurniture,
                 [&](TriangleMesh* mesh) { AddWindow(mesh, beam, palette, palette.sky); });
  }
}

std::vector<Beam> BeamsAt(const Scene& scene, double time_s, float* bounce) {
  std::vector<Beam> beams;
  double flux = 0;
  for (const BeamSpec& spec : scene.beams) {
    const Beam beam =
        spec.kind == BeamKind::kSpot ? SpotAt(spec, time_s) : SunThrough(spec, time_s);
    if (beam.power <= 0) continue;
    flux += FluxOf(spec, beam);
    beams.push_back(beam);
  }
  // As in an integrating sphere (Ulbricht 1900): all that is reflected at least once, spread
  // evenly.
  *bounce = static_cast<float>(flux * kReflectance / (1 - kReflectance) / InnerArea(scene.hall));
  return beams;
}

}  // namespace aisle::sim
