#include "harness/bag/compression.h"

#include <lz4frame.h>
#include <zstd.h>

namespace aisle {
namespace {

void DecompressLz4(std::string_view bytes, std::string* to) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, &LZ4F_freeDecompressionContext);
  std::size_t done = 0, hint = 1;
  while (!bytes.empty() && hint != 0) {
    std::size_t room = to->size() - done, taken = bytes.size();
    hint = LZ4F_decompress(context, to->data() + done, &room, bytes.data(), &taken, nullptr);
    if (LZ4F_isError(hint)) throw CompressionError(LZ4F_getErrorName(hint));
    if (room == 0 && taken == 0) break;  // full, and more would come
    done += room;
    bytes.remove_prefix(taken);
  }
  if (hint != 0 || done != to->size())
    throw CompressionError("decompresses to another length than stated");
}

void DecompressZstd(std::string_view bytes, std::string* to) {
  const std::size_t size = ZSTD_decompress(to->data(), to->size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size)) throw CompressionError(ZSTD_getErrorName(size));
  if (size != to->size()) throw CompressionError("decompresses to another length than stated");
}

}  // namespace

std::string CompressZstd(std::string_view bytes, int level) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size)) throw CompressionError(ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

bool IsZstd(std::string_view bytes) { return bytes.starts_with("\x28\xB5\x2F\xFD"); }

std::string Decompress(std::string_view bytes, std::string_view method, std::size_t size) {
  std::string out;
  if (method.empty()) {
    if (bytes.size() != size) throw CompressionError("has another length than stated");
    return std::string(bytes);
  }
  if (method != "zstd" && method != "lz4") {
    throw CompressionError(
        fmt::format("unsupported compression '{}'; supported: zstd and lz4", method.substr(0, 20)));
  }
  // Neither shrinks further than this: a larger claim is a lie, and memory is not spent on it.
  constexpr std::size_t kMostShrunk = 40000;
  if (size / kMostShrunk > bytes.size()) throw CompressionError("states an impossible length");
  out.resize(size);
  method == "lz4" ? DecompressLz4(bytes, &out) : DecompressZstd(bytes, &out);
  return out;
}

std::string DecompressZstdFrame(std::string_view bytes, std::size_t most) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size > most) {
    throw CompressionError("states no length, or one that is too large");
  }
  return Decompress(bytes, "zstd", size);
}

}  // namespace aisle
