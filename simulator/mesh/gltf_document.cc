#include "simulator/mesh/gltf_document.h"

#include <cstring>

#include "simulator/mesh/confined_files.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;  // "JSON", "BIN\0"

/// Extensions that may be required and still leave geometry that is read as it is meant; how a
/// surface shines is approximated anyway.
constexpr std::array<std::string_view, 2> kGeometryExtensions = {"KHR_mesh_quantization",
                                                                 "KHR_lights_punctual"};

std::uint32_t LittleEndian(const Bytes& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

struct Chunks {
  std::string_view json;
  std::optional<Bytes> binary;
};

Chunks SplitGlb(const Bytes& bytes) {
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) {
    throw ImportError(fmt::format("it is cut: {} bytes are too few for a .glb", bytes.size()));
  }
  if (const std::uint32_t version = LittleEndian(bytes, 4); version != 2) {
    throw ImportError(fmt::format("it is glTF version {}; export it as glTF 2.0", version));
  }
  const std::uint32_t length = LittleEndian(bytes, 8);
  if (length > bytes.size()) {
    throw ImportError(fmt::format("it is cut: its header speaks of {} bytes, there are {}", length,
                                  bytes.size()));
  }
  Chunks chunks;
  for (std::size_t at = kHeaderBytes, index = 0; at + kChunkHeaderBytes <= length; ++index) {
    const std::size_t size = LittleEndian(bytes, at);
    const std::uint32_t kind = LittleEndian(bytes, at + 4);
    at += kChunkHeaderBytes;
    if (size > length - at) {
      throw ImportError(
          fmt::format("chunk {} speaks of {} bytes, {} are left", index, size, length - at));
    }
    if ((index == 0) != (kind == kJsonChunk)) {
      throw ImportError("the first chunk of a .glb, and no other, must be its JSON");
    }
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    if (index == 0) chunks.json = {reinterpret_cast<const char*>(bytes.data()) + at, size};
    if (index == 1 && kind == kBinaryChunk) {
      chunks.binary = Bytes(begin, begin + static_cast<std::ptrdiff_t>(size));
    }
    at += size;
  }
  return chunks;
}

int Base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

Bytes DecodeBase64(const GltfValue& value, std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  Bytes bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const int digit = Base64Digit(c);
    if (digit < 0) value.Fail("its data URI is not base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> held));
  }
  return bytes;
}

/// A relative URI as a path: %20 and the like replaced.
std::string PathOf(const std::string& uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
                         std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0;
    path += escaped ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (escaped) i += 2;
  }
  std::ranges::replace(path, '\\', '/');
  return path;
}

void CheckPromises(const GltfValue& root) {
  const std::string version = root.Get("asset").Text("version", "");
  if (!version.starts_with("2.")) {
    root.Get("asset").Fail(
        fmt::format("version is '{}'; it must be 2.0: export it as glTF 2.0", version));
  }
  for (const GltfValue& required : root.Items("extensionsRequired")) {
    const std::string name = required.Text();
    if (name.starts_with("KHR_materials_") ||
        std::ranges::find(kGeometryExtensions, name) != kGeometryExtensions.end()) {
      continue;
    }
    required.Fail(fmt::format("the extension {} is not read; export the model without it", name));
  }
}

void ReadBuffers(std::optional<Bytes> binary, const fs::path& file, const ImportOptions& options,
                 GltfDocument* document) {
  std::size_t total = 0;
  for (const GltfValue& buffer : document->root().Items("buffers")) {
    const std::size_t length = buffer.Get("byteLength").Whole();
    const bool is_binary_chunk = document->buffers.empty() && !buffer.Has("uri");
    if (is_binary_chunk && !binary) buffer.Fail("it has neither a uri nor a chunk in the file");
    if (!is_binary_chunk && !buffer.Has("uri")) buffer.Fail("'uri' is missing");
    document->buffers.push_back(is_binary_chunk ? std::move(*binary)
                                                : UriBytes(buffer.Get("uri"), file, options));
    if (document->buffers.back().size() < length) {
      buffer.Fail(fmt::format("byteLength is {}, but there are only {} bytes", length,
                              document->buffers.back().size()));
    }
    document->buffers.back().resize(length);
    total += length;
    if (total > options.max_file_bytes) {
      buffer.Fail(fmt::format("the buffers are larger than {} bytes", options.max_file_bytes));
    }
  }
}

}  // namespace

Bytes UriBytes(const GltfValue& value, const fs::path& file, const ImportOptions& options) {
  const std::string uri = value.Text();
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) value.Fail("its data URI is not base64");
    return DecodeBase64(value, std::string_view(uri).substr(comma + 8));
  }
  if (options.one_file) {
    value.Fail(
        fmt::format("it names a separate file, {}; save the model as one .glb, or make one file of "
                    "it: aisle import-mesh {}",
                    PathOf(uri), file.filename().string()));
  }
  const fs::path path = file.parent_path() / PathOf(uri);
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) {
    value.Fail(fmt::format("{} is missing beside the model", PathOf(uri)));
  }
  if (!IsInside(path, options.root) || fs::file_size(path, failed) > options.max_file_bytes) {
    value.Fail(
        fmt::format("{} lies outside {} or is too large", PathOf(uri), options.root.string()));
  }
  return ReadBytes(path);
}

GltfDocument ParseGltf(const Bytes& file_bytes, const fs::path& file,
                       const ImportOptions& options) {
  const std::string_view whole(reinterpret_cast<const char*>(file_bytes.data()), file_bytes.size());
  Chunks chunks{whole, std::nullopt};
  if (whole.starts_with("glTF")) chunks = SplitGlb(file_bytes);
  while (chunks.json.ends_with('\0')) chunks.json.remove_suffix(1);  // some pad with zeros
  GltfDocument document;
  try {
    document.json = nlohmann::json::parse(chunks.json);
  } catch (const nlohmann::json::exception& error) {
    throw ImportError(fmt::format("its JSON is broken: {}", error.what()));
  }
  CheckPromises(document.root());
  ReadBuffers(std::move(chunks.binary), file, options, &document);
  return document;
}

std::span<const std::uint8_t> ViewBytes(const GltfDocument& document, std::size_t index) {
  const GltfValue view = document.root().Item("bufferViews", index);
  const Bytes& buffer =
      document.buffers[view.Get("buffer").IndexBelow(document.buffers.size(), "buffer")];
  const std::size_t offset = view.Whole("byteOffset", 0), length = view.Get("byteLength").Whole();
  if (offset > buffer.size() || length > buffer.size() - offset) {
    view.Fail(fmt::format("bytes {} to {} are asked for, its buffer has {}", offset,
                          offset + length, buffer.size()));
  }
  return std::span(buffer).subspan(offset, length);
}

}  // namespace aisle::sim
