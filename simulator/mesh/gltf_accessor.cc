#include "simulator/mesh/gltf_accessor.h"

#include <cstring>

namespace aisle::sim {
namespace {

enum ComponentType : std::size_t {
  kInt8 = 5120,
  kUint8 = 5121,
  kInt16 = 5122,
  kUint16 = 5123,
  kUint32 = 5125,
  kFloat = 5126,
};

std::size_t SizeOf(const GltfValue& accessor, std::size_t component) {
  switch (component) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kUint32:
    case kFloat:
      return 4;
    default:
      accessor.Fail(fmt::format("componentType {} does not exist in glTF", component));
  }
}

std::size_t WidthOf(const GltfValue& accessor, const std::string& type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kWidths = {{{"SCALAR", 1},
                                                                                {"VEC2", 2},
                                                                                {"VEC3", 3},
                                                                                {"VEC4", 4},
                                                                                {"MAT2", 4},
                                                                                {"MAT3", 9},
                                                                                {"MAT4", 16}}};
  for (const auto& [name, width] : kWidths) {
    if (name == type) return width;
  }
  accessor.Fail(fmt::format("type '{}' does not exist in glTF", type));
}

template <class Stored>
Stored Load(const std::uint8_t* from) {
  Stored value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}

/// A whole number as the share of its range that it stands for (glTF 2.0, 3.11).
template <class Stored>
float LoadShare(const std::uint8_t* from, bool normalized) {
  const float value = static_cast<float>(Load<Stored>(from));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<Stored>::max()), -1.0f);
}

float FloatFrom(const std::uint8_t* from, std::size_t component, bool normalized) {
  switch (component) {
    case kInt8:
      return LoadShare<std::int8_t>(from, normalized);
    case kUint8:
      return LoadShare<std::uint8_t>(from, normalized);
    case kInt16:
      return LoadShare<std::int16_t>(from, normalized);
    case kUint16:
      return LoadShare<std::uint16_t>(from, normalized);
    case kUint32:
      return LoadShare<std::uint32_t>(from, normalized);
    default:
      return Load<float>(from);
  }
}

std::uint32_t IndexFrom(const std::uint8_t* from, std::size_t component) {
  if (component == kUint8) return Load<std::uint8_t>(from);
  return component == kUint16 ? Load<std::uint16_t>(from) : Load<std::uint32_t>(from);
}

/// How the elements of an accessor lie in their bytes.
struct Layout {
  std::size_t component = kFloat;
  std::size_t width = 1;
  bool normalized = false;
};

Layout LayoutOf(const GltfValue& accessor, const char* wanted_type) {
  Layout layout;
  layout.component = accessor.Get("componentType").Whole();
  const std::string type = accessor.Get("type").Text();
  if (type != wanted_type) {
    accessor.Fail(fmt::format("its type is {}, {} is needed here", type, wanted_type));
  }
  layout.width = WidthOf(accessor, type);
  layout.normalized = accessor.Flag("normalized", false);
  if (type.starts_with("MAT") && layout.component != kFloat) {
    accessor.Fail("its matrices must be floats");
  }
  return layout;
}

/// `count` elements from `at` bytes into a view on; the view's stride is heeded. `take` is given
/// the number and where its bytes are.
template <class Take>
void WalkView(const GltfDocument& document, const GltfValue& holder, std::size_t count,
              const Layout& layout, const Take& take) {
  const std::size_t views = document.root().Count("bufferViews");
  const std::size_t index = holder.Get("bufferView").IndexBelow(views, "bufferView");
  const std::span<const std::uint8_t> bytes = ViewBytes(document, index);
  const std::size_t size = SizeOf(holder, layout.component), element = size * layout.width;
  const std::size_t stride =
      document.root().Item("bufferViews", index).Whole("byteStride", element);
  const std::size_t offset = holder.Whole("byteOffset", 0);
  if (stride < element || stride > 252) {
    holder.Fail(fmt::format("bufferView {} has a byteStride of {}, it must be {} to 252", index,
                            stride, element));
  }
  if (offset > bytes.size() || element > bytes.size() - offset ||
      (count - 1) > (bytes.size() - offset - element) / stride) {
    holder.Fail(
        fmt::format("{} elements of {} bytes from byte {} on do not fit into the {} bytes "
                    "of bufferView {}",
                    count, element, offset, bytes.size(), index));
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < layout.width; ++k) {
      take(i * layout.width + k, bytes.data() + offset + i * stride + k * size);
    }
  }
}

/// The elements that a sparse accessor changes, rising.
std::vector<std::uint32_t> SparsePlaces(const GltfDocument& document, const GltfValue& sparse,
                                        std::size_t count) {
  const GltfValue indices = sparse.Get("indices");
  const Layout layout{indices.Get("componentType").Whole(), 1, false};
  if (layout.component != kUint8 && layout.component != kUint16 && layout.component != kUint32) {
    indices.Fail("its componentType must be an unsigned one");
  }
  std::vector<std::uint32_t> places(sparse.Get("count").Whole());
  WalkView(document, indices, places.size(), layout, [&](std::size_t i, const std::uint8_t* from) {
    places[i] = IndexFrom(from, layout.component);
    if (places[i] >= count || (i > 0 && places[i] <= places[i - 1])) {
      indices.Fail(
          fmt::format("index {} at place {} is not rising or not below {}", places[i], i, count));
    }
  });
  return places;
}

template <class Number, class Convert>
GltfArray<Number> Read(const GltfDocument& document, const GltfValue& accessor,
                       const Layout& layout, GltfWanted wanted, const Convert& convert) {
  GltfArray<Number> array{accessor.Get("count").Whole(), layout.width, {}};
  if (array.count == 0 || array.count > wanted.max_count) {
    accessor.Fail(
        fmt::format("its count is {}; it must be 1 to {}", array.count, wanted.max_count));
  }
  SizeOf(accessor, layout.component);
  const bool has_view = accessor.Has("bufferView");
  if (!has_view) array.numbers.resize(array.count * array.width);
  if (has_view) {
    WalkView(document, accessor, array.count, layout, [&](std::size_t i, const std::uint8_t* from) {
      if (i == 0) array.numbers.resize(array.count * array.width);
      array.numbers[i] = convert(from);
    });
  }
  if (!accessor.Has("sparse")) return array;
  const GltfValue sparse = accessor.Get("sparse");
  if (const std::size_t count = sparse.Get("count").Whole(); count == 0 || count > array.count) {
    sparse.Fail(fmt::format("its count is {}; it must be 1 to {}", count, array.count));
  }
  const std::vector<std::uint32_t> places = SparsePlaces(document, sparse, array.count);
  WalkView(document, sparse.Get("values"), places.size(), layout,
           [&](std::size_t i, const std::uint8_t* from) {
             array.numbers[places[i / array.width] * array.width + i % array.width] = convert(from);
           });
  return array;
}

}  // namespace

GltfArray<float> ReadFloats(const GltfDocument& document, std::size_t index, GltfWanted wanted) {
  const GltfValue accessor = document.root().Item("accessors", index);
  const Layout layout = LayoutOf(accessor, wanted.type);
  GltfArray<float> array =
      Read<float>(document, accessor, layout, wanted, [&](const std::uint8_t* from) {
        return FloatFrom(from, layout.component, layout.normalized);
      });
  const auto bad = std::ranges::find_if(array.numbers, [](float x) { return !std::isfinite(x); });
  if (bad != array.numbers.end()) {
    accessor.Fail(fmt::format("element {} is not finite",
                              static_cast<std::size_t>(bad - array.numbers.begin()) / array.width));
  }
  return array;
}

GltfArray<std::uint32_t> ReadIndices(const GltfDocument& document, std::size_t index,
                                     GltfWanted wanted) {
  const GltfValue accessor = document.root().Item("accessors", index);
  const Layout layout = LayoutOf(accessor, wanted.type);
  if (layout.component != kUint8 && layout.component != kUint16 && layout.component != kUint32) {
    accessor.Fail("its componentType must be an unsigned one: indices are whole numbers");
  }
  return Read<std::uint32_t>(document, accessor, layout, wanted, [&](const std::uint8_t* from) {
    return IndexFrom(from, layout.component);
  });
}

}  // namespace aisle::sim
