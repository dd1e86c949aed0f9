#pragma once

#include "simulator/mesh/import.h"
#include "tests/fuzz/fuzz.h"

namespace aisle::fuzz {

/// Reads the bytes as a model file of this name, small enough that a fuzzer gets on.
inline void ReadAsModel(const std::uint8_t* data, std::size_t size, const std::string& name) {
  sim::ImportOptions small;
  small.max_texture_px = 512;
  small.max_triangles = 100'000;
  try {
    sim::ImportModel(AsFile(Text(data, size), name), small);
    ++taken;
  } catch (const sim::ImportError&) {
  }
}

}  // namespace aisle::fuzz
