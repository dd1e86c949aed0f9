#pragma once

#include "simulator/mesh/gltf_document.h"

namespace aisle::sim {

/// The numbers of an accessor, element by element, as its type lists them (matrices by columns).
template <class Number>
struct GltfArray {
  std::size_t count = 0;  ///< elements
  std::size_t width = 0;  ///< numbers an element
  std::vector<Number> numbers;

  const Number* operator[](std::size_t element) const { return &numbers[element * width]; }
};

/// What is asked of an accessor.
struct GltfWanted {
  const char* type = "VEC3";
  std::size_t max_count = 0;  ///< elements
};

/// Accessors[index] as floats; whole numbers that are marked as normalized become [0, 1] or
/// [-1, 1]. Sparse values are put in, absent views are zeros (glTF 2.0, 3.6.2). Throws ImportError
/// when the type is another, bytes lie outside their view or a number is not finite.
GltfArray<float> ReadFloats(const GltfDocument& document, std::size_t index, GltfWanted wanted);

/// The same for indices: unsigned whole numbers, not normalized.
GltfArray<std::uint32_t> ReadIndices(const GltfDocument& document, std::size_t index,
                                     GltfWanted wanted);

}  // namespace aisle::sim
