#pragma once

#include <algorithm>
#include <cmath>

#include "simulator/mesh/material.h"
#include "simulator/shade/lanes/wide.h"

/// The glossy lobe that both kinds of light share: GGX microfacets with Smith's shadowing and
/// Schlick's Fresnel term, over a diffuse base that gets what the lobe leaves. Written once for one
/// lane (float) and for eight (F8). Directions are unit vectors in a frame whose z is the normal.
namespace aisle::sim {

inline float Sqrt(float x) { return std::sqrt(x); }
inline float Max(float a, float b) { return std::max(a, b); }
inline float Select(bool mask, float yes, float no) { return mask ? yes : no; }

/// A surface's finish. f0 = 0: no lobe.
struct Finish {
  float f0 = 0, roughness = 1;
};

inline Finish FinishOf(const Material& material) {
  if (material.emission > 0 || material.roughness >= kDullRoughness) return {};
  // Below, the lobe is narrower than a pixel.
  return {material.specular_f0, std::max(material.roughness, 0.05f)};
}

/// (1 - cosine)⁵, Schlick 1994.
template <typename T>
T SchlickWeight(T cosine) {
  const T x = Max(1 - cosine, 0 * cosine), squared = x * x;
  return squared * squared * x;
}

template <typename T>
T Fresnel(T f0, T cosine) {
  return f0 + (1 - f0) * SchlickWeight(cosine);
}

/// Share of the light from `cosine` that the lobe sends back, about; the base gets the rest
/// (Lagarde's roughness-aware Schlick term).
template <typename T>
T GlossShare(T f0, T roughness, T cosine) {
  return f0 + (Max(1 - roughness, f0) - f0) * SchlickWeight(cosine);
}

/// Smith's masking of one direction.
template <typename T>
T SmithMasking(T cosine, T alpha) {
  const T a2 = alpha * alpha, c2 = cosine * cosine;
  return 2 * cosine / Max(cosine + Sqrt(a2 + (1 - a2) * c2), 0 * cosine + 1e-9f);
}

/// A microfacet's normal among those that `out` sees (Heitz 2018), from a point of the unit disk:
/// the radius is the square root of one random number, the angle stems from another.
template <typename T>
Triple<T> SampleFacet(const Triple<T>& out, T alpha, T radius, T cos_phi, T sin_phi) {
  const T vx = alpha * out.x, vy = alpha * out.y;
  const T scale = 1 / Sqrt(vx * vx + vy * vy + out.z * out.z);
  const Triple<T> v = {vx * scale, vy * scale, out.z * scale};
  const T across = v.x * v.x + v.y * v.y, zero = 0 * across;
  const T inverse = 1 / Sqrt(Max(across, zero + 1e-12f));
  const auto upright = across < 1e-12f;
  const Triple<T> t1 = {Select(upright, zero + 1, -v.y * inverse),
                        Select(upright, zero, v.x * inverse), zero};
  const Triple<T> t2 = {-v.z * t1.y, v.z * t1.x, v.x * t1.y - v.y * t1.x};
  const T a = radius * cos_phi, s = 0.5f * (1 + v.z);
  const T b = (1 - s) * Sqrt(Max(1 - a * a, zero)) + s * radius * sin_phi;
  const T c = Sqrt(Max(1 - a * a - b * b, zero));
  const T nx = alpha * (a * t1.x + b * t2.x + c * v.x),
          ny = alpha * (a * t1.y + b * t2.y + c * v.y);
  const T nz = Max(b * t2.z + c * v.z, zero + 1e-6f);
  const T unit = 1 / Sqrt(nx * nx + ny * ny + nz * nz);
  return {nx * unit, ny * unit, nz * unit};
}

/// Density of facets of that normal, GGX.
template <typename T>
T FacetDensity(T cosine, T alpha) {
  const T a2 = alpha * alpha, k = cosine * cosine * (a2 - 1) + 1;
  return a2 / (3.14159265f * k * k);
}

/// The lobe's value times the cosine of `in`, and the density with which SampleFacet and mirroring
/// find `in`, per solid angle. Both are 0 where a direction lies below the surface.
template <typename T>
struct LobeValueOf {
  T reflected{}, density{};
};
using LobeValue = LobeValueOf<float>;

template <typename T>
LobeValueOf<T> EvaluateLobe(T f0, T roughness, const Triple<T>& out, const Triple<T>& in) {
  const T zero = 0 * f0;
  const Triple<T> sum = {out.x + in.x, out.y + in.y, out.z + in.z};
  const T length = Sqrt(Dot(sum, sum)), inverse = 1 / Max(length, zero + 1e-6f);
  const Triple<T> half = {sum.x * inverse, sum.y * inverse, sum.z * inverse};
  const T alpha = roughness * roughness;
  const T visible =
      FacetDensity(half.z, alpha) * SmithMasking(out.z, alpha) / (4 * Max(out.z, zero + 1e-6f));
  const auto lit = (f0 > zero) & (out.z > zero) & (in.z > zero) & (length >= 1e-6f);
  return {Select(lit, visible * Fresnel(f0, Dot(out, half)) * SmithMasking(in.z, alpha), zero),
          Select(lit, visible, zero)};
}

inline LobeValue EvaluateLobe(const Finish& finish, const Triple<float>& out,
                              const Triple<float>& in) {
  return EvaluateLobe(finish.f0, finish.roughness, out, in);
}

}  // namespace aisle::sim
