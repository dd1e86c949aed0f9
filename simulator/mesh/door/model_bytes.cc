#include "simulator/mesh/door/model_bytes.h"

#include <xxhash.h>

#include <bit>
#include <cstring>
#include <limits>
#include <new>

#include "simulator/mesh/check_model.h"

namespace aisle::sim {
namespace {

static_assert(std::endian::native == std::endian::little, "model bytes are little-endian");

constexpr std::array<char, 8> kMagic = {'a', 'i', 's', 'l', 'e', 'm', 'd', 'l'};
constexpr std::uint32_t kVersion = 2;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion, unused = 0;
  std::uint64_t size = 0, checksum = 0;  ///< of the bytes that follow
};

/// What is carried as the bytes it lies in memory with: numbers, and fixed groups of them without
/// gaps.
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_same_v<T, Eigen::Vector2f> ||
    std::is_same_v<T, Eigen::Vector3f> || std::is_same_v<T, std::array<std::uint32_t, 3>> ||
    std::is_same_v<T, VertexWeights>;
static_assert(sizeof(Eigen::Vector2f) == 8 && sizeof(Eigen::Vector3f) == 12 &&
              sizeof(VertexWeights) == 24);

class Writer {
 public:
  void Put(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }
  std::size_t Count(const auto& list, std::size_t /*least_bytes*/, std::size_t /*most*/ = 0) {
    const std::uint64_t count = list.size();
    Put(&count, sizeof(count));
    return list.size();
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// How many bytes a Writer would write.
class Counter {
 public:
  void Put(const void* /*from*/, std::size_t size) { size_ += size; }
  std::size_t Count(const auto& list, std::size_t /*least_bytes*/, std::size_t /*most*/ = 0) {
    size_ += sizeof(std::uint64_t);
    return list.size();
  }
  std::size_t size() const { return size_; }

 private:
  std::size_t size_ = 0;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  void Need(std::size_t size) const {
    if (bytes_.size() < size) throw ImportError("its bytes end too early");
  }
  void Put(void* to, std::size_t size) {
    Need(size);
    std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  /// Resizes a list whose elements take at least so many bytes each, so that no count makes it
  /// larger than a few times the bytes that are there.
  std::size_t Count(auto& list, std::size_t least_bytes,
                    std::size_t most = std::numeric_limits<std::size_t>::max()) {
    std::uint64_t count = 0;
    Put(&count, sizeof(count));
    if (count > bytes_.size() / least_bytes) throw ImportError("a list is longer than its bytes");
    if (count > most) throw ImportError(fmt::format("a list is longer than {}", most));
    list.resize(static_cast<std::size_t>(count));
    return list.size();
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

// One description of the bytes serves both directions: `file` is a Writer, a Counter or a Reader,
// and what is carried is const or not.

template <class T>
requires Plain<std::remove_const_t<T>>
void Carry(auto& file, T& value) { file.Put(&value, sizeof(value)); }

void CarryText(auto& file, auto& text) {
  const std::size_t count = file.Count(text, 1);  // moves the text's bytes
  file.Put(text.data(), count);
}

/// Plain elements in one go.
void CarryPlain(auto& file, auto& list) {
  using Element = typename std::remove_cvref_t<decltype(list)>::value_type;
  static_assert(Plain<Element>);
  const std::size_t count = file.Count(list, sizeof(Element));
  if (count > 0) file.Put(list.data(), count * sizeof(Element));
}

/// The bytes of an element whose own texts and lists are empty.
template <class Element>
std::size_t LeastBytes(const auto& carry_one) {
  static const std::size_t bytes = [&] {
    Counter counter;
    const Element least{};
    carry_one(counter, least);
    return counter.size();
  }();
  return bytes;
}

void CarryEach(auto& file, auto& list, const auto& carry_one,
               std::size_t most = std::numeric_limits<std::size_t>::max()) {
  using Element = typename std::remove_cvref_t<decltype(list)>::value_type;
  file.Count(list, LeastBytes<Element>(carry_one), most);
  for (auto& one : list) carry_one(file, one);
}

void CarryVector(auto& file, auto& vector) {
  if constexpr (requires { vector.coeffs(); }) {  // a quaternion
    for (int i = 0; i < 4; ++i) Carry(file, vector.coeffs()[i]);
  } else {
    Carry(file, vector);
  }
}

/// An enumeration or an index, in 32 bits.
void CarryWhole(auto& file, auto& value) {
  auto whole = static_cast<std::int32_t>(value);
  Carry(file, whole);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(value)>>) {
    value = static_cast<std::remove_cvref_t<decltype(value)>>(whole);
  }
}

constexpr std::size_t kMostSurfaces = 65535;  ///< a triangle says its material in 16 bits
constexpr std::size_t kMostBands = 3;

constexpr auto kCurve = [](auto& file, auto& curve) {
  CarryEach(file, curve.keys, [](auto& to, auto& key) {
    Carry(to, key.first);
    CarryVector(to, key.second);
  });
  CarryWhole(file, curve.interpolation);
  CarryEach(file, curve.slopes, [](auto& to, auto& slopes) {
    for (auto& slope : slopes) CarryVector(to, slope);
  });
};

constexpr auto kChannel = [](auto& file, auto& channel) {
  CarryWhole(file, channel.node);
  kCurve(file, channel.translations);
  kCurve(file, channel.rotations);
  kCurve(file, channel.scales);
};

constexpr auto kClip = [](auto& file, auto& clip) {
  CarryText(file, clip.name);
  Carry(file, clip.duration_s);
  CarryEach(file, clip.channels, kChannel);
};

constexpr auto kNode = [](auto& file, auto& node) {
  CarryText(file, node.name);
  CarryWhole(file, node.parent);
  CarryVector(file, node.rest.translation);
  CarryVector(file, node.rest.rotation);
  CarryVector(file, node.rest.scale);
};

constexpr auto kJoint = [](auto& file, auto& joint) {
  CarryWhole(file, joint.node);
  for (int i = 0; i < 12; ++i) Carry(file, joint.bind_to_node.matrix()(i / 4, i % 4));
};

constexpr auto kMaterial = [](auto& file, auto& material) {
  CarryText(file, material.name);
  CarryWhole(file, material.albedo_texture);
  CarryWhole(file, material.normal_texture);
  for (auto* value : {&material.albedo, &material.normal_scale, &material.specular_f0,
                      &material.roughness, &material.emission}) {
    Carry(file, *value);
  }
};

/// Width, height, channels, then the rows of 8-bit pixels.
void CarryImage(Writer& file, const cv::Mat& image) {
  const std::array<std::uint32_t, 3> shape = {static_cast<std::uint32_t>(image.cols),
                                              static_cast<std::uint32_t>(image.rows),
                                              static_cast<std::uint32_t>(image.channels())};
  Carry(file, shape);
  for (int y = 0; y < image.rows; ++y) {
    file.Put(image.ptr(y), static_cast<std::size_t>(image.cols) * image.elemSize());
  }
}

void CarryImage(Counter& file, const cv::Mat& /*image*/) {
  constexpr std::size_t kPixel = 1;  // that an image has at least
  file.Put(nullptr, sizeof(std::array<std::uint32_t, 3>) + kPixel);
}

void CarryImage(Reader& file, cv::Mat& image) {
  constexpr std::uint32_t kMostPixels = 1u << 15;  // a side; the options say how many are taken
  std::array<std::uint32_t, 3> shape{};
  Carry(file, shape);
  const auto [width, height, channels] = shape;
  if (width == 0 || width > kMostPixels || height == 0 || height > kMostPixels ||
      (channels != 1 && channels != 3)) {
    throw ImportError("a texture has a shape that does not exist");
  }
  const std::size_t row_bytes = std::size_t{width} * channels;
  file.Need(row_bytes * height);
  image.create(static_cast<int>(height), static_cast<int>(width),
               channels == 1 ? CV_8UC1 : CV_8UC3);
  for (int y = 0; y < image.rows; ++y) file.Put(image.ptr(y), row_bytes);
}

constexpr auto kTexture = [](auto& file, auto& texture) {
  CarryText(file, texture.name);
  CarryImage(file, texture.image);
};

constexpr auto kSurfaces = [](auto& file, auto& surfaces) {
  CarryEach(file, surfaces.materials, kMaterial, kMostSurfaces);
  CarryEach(file, surfaces.textures, kTexture, kMostSurfaces);
};

constexpr auto kModel = [](auto& file, auto& model) {
  CarryText(file, model.name);
  CarryPlain(file, model.mesh.positions);
  CarryPlain(file, model.mesh.normals);
  CarryPlain(file, model.mesh.uvs);
  CarryPlain(file, model.mesh.triangles);
  CarryPlain(file, model.mesh.materials);
  CarryPlain(file, model.bind_positions);
  CarryPlain(file, model.bind_normals);
  CarryPlain(file, model.weights);
  CarryEach(file, model.joints, kJoint);
  CarryEach(file, model.nodes, kNode);
  CarryEach(file, model.clips, kClip);
  CarryEach(file, model.materials, kMaterial, kMostSurfaces);
  CarryEach(file, model.textures, kTexture, kMostSurfaces);
  CarryEach(file, model.colour, kSurfaces, kMostBands);
  CarryEach(file, model.left_out, [](auto& to, auto& phrase) { CarryText(to, phrase); });
};

}  // namespace

std::string EncodeModel(const Model& model) {
  Writer body;
  kModel(body, model);
  const std::string bytes = body.Take();
  Header header;
  header.size = bytes.size();
  header.checksum = XXH3_64bits(bytes.data(), bytes.size());
  return std::string(reinterpret_cast<const char*>(&header), sizeof(header)) + bytes;
}

Model DecodeModel(std::string_view bytes, const ImportOptions& options) {
  Header header;
  if (bytes.size() < sizeof(header)) throw ImportError("its bytes end too early");
  std::memcpy(&header, bytes.data(), sizeof(header));
  bytes.remove_prefix(sizeof(header));
  if (header.magic != kMagic) throw ImportError("its bytes are not a model's");
  if (header.version != kVersion || header.unused != 0) {
    throw ImportError("its bytes are of another version");
  }
  if (header.size != bytes.size()) throw ImportError("its bytes are not as many as they say");
  if (header.checksum != XXH3_64bits(bytes.data(), bytes.size())) {
    throw ImportError("its bytes are damaged: checksum");
  }
  Reader file(bytes);
  Model model;
  try {
    kModel(file, model);
  } catch (const std::bad_alloc&) {
    throw ImportError("it needs more memory than there is");
  }
  if (!file.at_end()) throw ImportError("something follows its bytes");
  CheckModel(model, options);
  return model;
}

}  // namespace aisle::sim
