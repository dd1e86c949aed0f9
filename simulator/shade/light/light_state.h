#pragma once

#include <vector>

#include "simulator/shade/light/light_volume.h"

namespace aisle::sim {

/// Light on the static world under one setting of the lamps. Irradiance by slot of
/// StaticLight::grid(). Luminaires are read at reflectance 1: what they carry is π · emission +
/// albedo · irradiance.
struct LightState {
  std::vector<float> total;   ///< direct + indirect
  std::vector<float> direct;  ///< of it, straight from the luminaires
  LightVolume volume;         ///< indirect light in free space, for what moves
};

}  // namespace aisle::sim
