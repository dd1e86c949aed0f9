#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace aisle::sim {

/// Rougher lobes are so broad that they are counted as diffuse.
inline constexpr float kDullRoughness = 0.4f;

/// Surface of a triangle. The camera is monochrome, so every quantity is one band: the photopic
/// luminance of the authored colour (Rec. 709 weights on linear RGB), unless the importer is asked
/// for another band (the colour references of the tests render three).
struct Material {
  std::string name;
  float albedo = 0.5f;       ///< diffuse reflectance in [0, 1], linear; multiplies the texture
  int albedo_texture = -1;   ///< index into the owner's textures, -1: none
  int normal_texture = -1;   ///< tangent-space normal map, -1: none
  float normal_scale = 1;    ///< stretches the map's x and y beside its z
  float specular_f0 = 0.0f;  ///< reflectance at normal incidence, 0: purely diffuse
  float roughness = 1.0f;    ///< perceptual; GGX alpha is its square
  float emission = 0.0f;     ///< emitted radiance, relative units; > 0 marks a luminaire
  float transmission = 0;    ///< share of light that goes straight through; of movers only
};

/// One image: albedo textures are 8-bit grey with sRGB transfer, normal maps have x, y and z as
/// their channels, in this order (not OpenCV's B, G, R).
struct Texture {
  std::string name;
  cv::Mat image;  ///< CV_8UC1 (albedo) or CV_8UC3 (normal)
};

}  // namespace aisle::sim
