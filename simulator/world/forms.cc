#include "simulator/world/forms.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

/// Four corners counter-clockwise seen from outside; turned round where `flip`.
void AddPatch(TriangleMesh* mesh, const std::array<std::uint32_t, 4>& v, std::uint16_t material,
              bool flip = false) {
  AddTriangle(mesh, v[0], v[flip ? 2 : 1], v[flip ? 1 : 2], material);
  AddTriangle(mesh, v[0], v[flip ? 3 : 2], v[flip ? 2 : 3], material);
}

Vector3f AnyAcross(const Vector3f& ahead) {
  const Vector3f up = std::abs(ahead.z()) < 0.9f ? Vector3f::UnitZ() : Vector3f::UnitX();
  return up.cross(ahead).normalized();
}

/// The lid of a tube: a fan about its end, facing `out`.
void AddLid(TriangleMesh* mesh, const Vector3f& middle, const Vector3f& out,
            const std::vector<std::uint32_t>& ring, bool flip, std::uint16_t material) {
  const std::uint32_t hub = AddVertex(mesh, middle, out, {0.5f, 0});
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    const std::uint32_t a = AddVertex(mesh, mesh->positions[ring[k]], out, {0.4f, 0});
    const std::uint32_t b = AddVertex(mesh, mesh->positions[ring[k + 1]], out, {0.6f, 0});
    AddTriangle(mesh, hub, flip ? b : a, flip ? a : b, material);
  }
}

}  // namespace

Eigen::Isometry3f Facing(const Vector3f& origin, const Vector3f& ahead, const Vector3f& up) {
  Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
  const Vector3f x = ahead.normalized(), y = up.cross(x).normalized();
  pose.linear().col(0) = x;
  pose.linear().col(1) = y;
  pose.linear().col(2) = x.cross(y);
  pose.translation() = origin;
  return pose;
}

void AddRounded(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Vector3f& size,
                float radius, std::uint16_t material, float tile_m, const Vector2f& offset) {
  const Vector3f half = size / 2;
  const float r = std::min(radius, half.minCoeff());
  const Vector3f inner = half - Vector3f::Constant(r);
  // Each side is a grid of four by four: flat within, bent half way round the edges.
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::array<std::uint32_t, 16> grid{};
      for (int i = 0; i < 16; ++i) {
        const int column = i % 4, row = i / 4;
        Vector3f normal = Vector3f::Zero(), at = Vector3f::Zero();
        normal[axis] = at[axis] = sign;
        normal[u] = column == 0 ? -1.0f : column == 3 ? 1.0f : 0.0f;
        normal[v] = row == 0 ? -1.0f : row == 3 ? 1.0f : 0.0f;
        normal.normalize();
        at[u] = column < 2 ? -1.0f : 1.0f;
        at[v] = row < 2 ? -1.0f : 1.0f;
        at = at.cwiseProduct(inner) + r * normal;
        const Vector2f flat = axis == 2   ? Vector2f(at.x(), -at.y())
                              : axis == 1 ? Vector2f(at.x(), -at.z())
                                          : Vector2f(at.y(), -at.z());
        grid[static_cast<std::size_t>(i)] =
            AddVertex(mesh, pose * at, pose.linear() * normal, offset + flat / tile_m);
      }
      for (std::size_t i = 0; i < 9; ++i) {
        const std::size_t k = 4 * (i / 3) + i % 3;
        AddPatch(mesh, {grid[k], grid[k + 1], grid[k + 5], grid[k + 4]}, material, sign < 0);
      }
    }
  }
}

void AddTube(TriangleMesh* mesh, const std::vector<Vector3f>& way, float radius, int sides,
             std::uint16_t material, float tile_m) {
  const std::size_t count = way.size();
  Vector3f across = AnyAcross((way[1] - way[0]).normalized());
  float along = 0;
  std::vector<std::uint32_t> ring, before;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3f ahead = (way[std::min(i + 1, count - 1)] - way[i == 0 ? 0 : i - 1]).normalized();
    across = (across - across.dot(ahead) * ahead).normalized();  // carried on without twist
    const Vector3f up = ahead.cross(across);
    if (i > 0) along += (way[i] - way[i - 1]).norm();
    ring.clear();
    for (int k = 0; k <= sides; ++k) {
      const float share = static_cast<float>(k) / static_cast<float>(sides);
      const Vector3f out = std::cos(kTurn * share) * across + std::sin(kTurn * share) * up;
      ring.push_back(AddVertex(mesh, way[i] + radius * out, out, {share, along / tile_m}));
    }
    for (std::size_t k = 0; i > 0 && k + 1 < ring.size(); ++k) {
      AddPatch(mesh, {before[k], before[k + 1], ring[k + 1], ring[k]}, material);
    }
    if (i == 0) AddLid(mesh, way[i], -ahead, ring, true, material);
    if (i + 1 == count) AddLid(mesh, way[i], ahead, ring, false, material);
    before = ring;
  }
}

void AddTurned(TriangleMesh* mesh, const Eigen::Isometry3f& pose,
               const std::vector<Turned>& outline, int sides, std::uint16_t material,
               float tile_m) {
  constexpr float kSharp = 0.77f;  // cosine of 40 degrees
  const std::size_t pieces = outline.size() - 1;
  const auto normal_of = [&](std::size_t i) -> Vector2f {
    return Vector2f(outline[i + 1].along - outline[i].along,
                    outline[i].radius - outline[i + 1].radius)
        .normalized();
  };
  float run = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    const Vector2f own = normal_of(i);
    const auto blend = [&](const Vector2f& other) -> Vector2f {
      return own.dot(other) < kSharp ? own : (own + other).normalized();
    };
    const std::array<Vector2f, 2> normals = {i == 0 ? own : blend(normal_of(i - 1)),
                                             i + 1 == pieces ? own : blend(normal_of(i + 1))};
    const float length = std::hypot(outline[i + 1].radius - outline[i].radius,
                                    outline[i + 1].along - outline[i].along);
    std::array<std::vector<std::uint32_t>, 2> rings;
    for (std::size_t end = 0; end < 2; ++end) {
      const Turned& at = outline[i + end];
      const float around = std::max(1.0f, std::round(kTurn * at.radius / tile_m));
      for (int k = 0; k <= sides; ++k) {
        const float share = static_cast<float>(k) / static_cast<float>(sides);
        const float x = std::cos(kTurn * share), y = std::sin(kTurn * share);
        const Vector3f normal(normals[end].x() * x, normals[end].x() * y, normals[end].y());
        rings[end].push_back(AddVertex(
            mesh, pose * Vector3f(at.radius * x, at.radius * y, at.along), pose.linear() * normal,
            {share * around, (run + (end == 0 ? 0 : length)) / tile_m}));
      }
    }
    run += length;
    for (std::size_t k = 0; k + 1 < rings[0].size(); ++k) {
      if (outline[i].radius > 0) {
        AddTriangle(mesh, rings[0][k], rings[0][k + 1], rings[1][k + 1], material);
      }
      if (outline[i + 1].radius > 0) {
        AddTriangle(mesh, rings[0][k], rings[1][k + 1], rings[1][k], material);
      }
    }
  }
}

void AddSheet(TriangleMesh* mesh, const std::vector<Vector3f>& points, std::size_t across,
              std::uint16_t material, const UvRect& uv, bool both_sides) {
  const std::size_t rows = points.size() / across;
  const auto at = [&](std::size_t row, std::size_t column) -> const Vector3f& {
    return points[std::min(row, rows - 1) * across + std::min(column, across - 1)];
  };
  for (const bool back : {false, true}) {
    if (back && !both_sides) break;
    const auto first = static_cast<std::uint32_t>(mesh->positions.size());
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < across; ++column) {
        const Vector3f right = at(row, column + 1) - at(row, column == 0 ? 0 : column - 1);
        const Vector3f next = at(row + 1, column) - at(row == 0 ? 0 : row - 1, column);
        const Vector2f share(static_cast<float>(column) / static_cast<float>(across - 1),
                             static_cast<float>(row) / static_cast<float>(rows - 1));
        const Vector3f normal = right.cross(next).normalized();
        AddVertex(mesh, at(row, column), back ? Vector3f(-normal) : normal,
                  uv.origin + uv.size.cwiseProduct(share));
      }
    }
    const auto w = static_cast<std::uint32_t>(across);
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
      for (std::uint32_t column = 0; column + 1 < w; ++column) {
        const std::uint32_t k = first + row * w + column;
        AddPatch(mesh, {k, k + 1, k + w + 1, k + w}, material, back);
      }
    }
  }
}

std::vector<Vector3f> Smooth(const std::vector<Vector3f>& points, int parts) {
  std::vector<Vector3f> way;
  const auto at = [&](std::ptrdiff_t i) -> const Vector3f& {
    return points[static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(i, 0, std::ssize(points) - 1))];
  };
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(points); ++i) {
    const Vector3f &a = at(i - 1), &b = at(i), &c = at(i + 1), &d = at(i + 2);
    for (int k = 0; k < parts; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(parts);
      way.push_back(0.5f * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) +
                            t * t * t * (3 * b - a - 3 * c + d)));
    }
  }
  way.push_back(points.back());
  return way;
}

std::vector<Vector3f> Hanging(const Vector3f& from, const Vector3f& to, float sag, int parts) {
  std::vector<Vector3f> way;
  for (int i = 0; i <= parts; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(parts);
    way.push_back(from + t * (to - from) - Vector3f(0, 0, 4 * sag * t * (1 - t)));
  }
  return way;
}

void AddSpot(TriangleMesh* mesh, const Eigen::Isometry3f& pose, const Vector2f& radius, float rough,
             Dice dice, std::uint16_t material) {
  constexpr int kRim = 40;
  std::array<Vector2f, 6> waves;
  for (Vector2f& wave : waves) {
    wave.x() = static_cast<float>(dice.Signed());
    wave.y() = static_cast<float>(dice.Signed());
  }
  const Vector3f up = pose.linear() * Vector3f::UnitZ();
  const std::uint32_t middle = AddVertex(mesh, pose.translation(), up, {0.5f, 0.5f});
  for (int i = 0; i <= kRim; ++i) {
    const float angle = kTurn * static_cast<float>(i % kRim) / kRim;
    float reach = 1;
    for (std::size_t k = 0; k < waves.size(); ++k) {
      const float turn = static_cast<float>(k + 2) * angle;
      reach += rough * (waves[k].x() * std::cos(turn) + waves[k].y() * std::sin(turn)) /
               static_cast<float>(k + 1);
    }
    const Vector2f out = std::max(reach, 0.15f) * Vector2f(std::cos(angle), std::sin(angle));
    const Vector2f at = out.cwiseProduct(radius);
    const std::uint32_t rim =
        AddVertex(mesh, pose * Vector3f(at.x(), at.y(), 0), up, Vector2f(0.5f, 0.5f) + out / 3);
    if (i > 0) AddTriangle(mesh, middle, rim - 1, rim, material);
  }
}

void AddSection(TriangleMesh* mesh, const Vector3f& from, const Vector3f& to, const Vector3f& up,
                float width, float depth, float plate, std::uint16_t material) {
  const Eigen::Isometry3f pose = Facing((from + to) / 2, to - from, up);
  const float length = (to - from).norm();
  const auto bar = [&](float z, const Vector3f& size) {
    Eigen::Isometry3f at = pose;
    at.translate(Vector3f(0, 0, z));
    AddBox(mesh, at, size, BoxPaint::Tiled(material, size, 1.1f, {0.31f * from.x(), 0.17f * z}));
  };
  bar(depth / 2 - plate / 2, {length, width, plate});
  bar(-depth / 2 + plate / 2, {length, width, plate});
  bar(0, {length, plate * 0.8f, depth - 2 * plate});
}

}  // namespace aisle::sim
