#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace aisle {

/// The bytes are not of the compression they claim, or of another length.
class CompressionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One zstd frame; the same bytes for the same bytes on every machine with this libzstd.
std::string CompressZstd(std::string_view bytes, int level);

/// True where the bytes open as a zstd frame does.
bool IsZstd(std::string_view bytes);

/// `method` is "", "zstd" or "lz4" (frames), as MCAP names them. Throws CompressionError unless
/// exactly `size` bytes come out.
std::string Decompress(std::string_view bytes, std::string_view method, std::size_t size);

/// A zstd frame that states its length, at most `most` bytes. Throws CompressionError.
std::string DecompressZstdFrame(std::string_view bytes, std::size_t most);

}  // namespace aisle
