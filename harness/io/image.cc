#include "harness/io/image.h"

#include <bit>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/png_palette.h"
#include "harness/io/png_size.h"

namespace aisle {
namespace {

constexpr std::uint32_t kMaxSide = 16384;
constexpr std::uint64_t kMostPixels = 1U << 26;  // a few bytes of zeros may claim to be any number

void CheckPngHeader(const std::string& bytes, const std::string& file) {
  const std::optional<PictureSize> size = SizeOfPng(bytes);
  if (!size) throw InputError(file, 0, "not a PNG image");
  const auto [width, height] = *size;
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide) {
    throw InputError(file, 0,
                     fmt::format("has {}x{} pixels; at most {} in each direction are allowed",
                                 width, height, kMaxSide));
  }
  if (std::uint64_t{width} * height > kMostPixels) {
    throw InputError(
        file, 0,
        fmt::format("has {}x{} pixels; at most {} in all are allowed", width, height, kMostPixels));
  }
}

cv::Mat Decoded(const std::string& bytes) {
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8U,
                        const_cast<char*>(bytes.data()));  // imdecode only reads
  return cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
}

/// An index that the palette has no colour for is decoded as black: a mover would be static.
void CheckPalette(const std::string& bytes, const std::string& file) {
  std::size_t entries = 0;
  const auto greys = WithIndicesForColours(bytes, &entries);
  if (!greys) return;
  const cv::Mat decoded = Decoded(*greys);
  if (decoded.empty()) throw InputError(file, 0, "damaged PNG image");
  cv::Mat1b indices;
  cv::extractChannel(decoded, indices, 0);
  double most = 0;
  cv::Point at;
  cv::minMaxLoc(indices, nullptr, &most, nullptr, &at);
  if (most < static_cast<double>(entries)) return;
  throw InputError(file, 0,
                   fmt::format("the pixel ({}, {}) has the index {:g}, "
                               "but the palette has only {} entries: save the image with its whole "
                               "palette, or as grey",
                               at.x, at.y, most, entries));
}

/// Whatever the PNG holds, as it is.
cv::Mat ReadPng(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  CheckPngHeader(bytes, path.string());
  const cv::Mat image = Decoded(bytes);
  if (image.empty()) throw InputError(path.string(), 0, "damaged PNG image");
  CheckPalette(bytes, path.string());
  return image;
}

/// The upper byte of 16-bit pixels, as of those in bags.
cv::Mat UpperBytes(const cv::Mat& image) {
  cv::Mat bytes(image.size(), CV_8UC(image.channels()));
  const int across = image.cols * image.channels();
  for (int y = 0; y < image.rows; ++y) {
    const auto* from = image.ptr<std::uint16_t>(y);
    std::transform(from, from + across, bytes.ptr(y),
                   [](std::uint16_t value) { return static_cast<unsigned char>(value >> 8); });
  }
  return bytes;
}

/// A portable float map: rows from the bottom, channels as they come. OpenCV encodes it by way of a
/// temporary file, which a killed program leaves behind.
std::string EncodePfm(const cv::Mat& image) {
  static_assert(std::endian::native == std::endian::little);  // as the minus says
  std::string bytes =
      fmt::format("P{}\n{} {}\n-1\n", image.channels() == 3 ? 'F' : 'f', image.cols, image.rows);
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  bytes.reserve(bytes.size() + row_bytes * static_cast<std::size_t>(image.rows));
  for (int y = image.rows - 1; y >= 0; --y) {
    bytes.append(reinterpret_cast<const char*>(image.ptr(y)), row_bytes);
  }
  return bytes;
}

/// OpenCV leaves OpenEXR off unless it is told otherwise before it meets the first such file.
void AllowExr() { setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0); }

}  // namespace

void WriteImage(const std::filesystem::path& path, const cv::Mat& image) {
  constexpr int kJpegQuality = 88;  // overlays stay crisp
  // Pictures are noise and truth is flat: looking for repetitions in the one finds none, and runs
  // are all there is in the other.
  constexpr int kPngCompression = 1, kPngStrategy = cv::IMWRITE_PNG_STRATEGY_RLE;
  if (path.extension() == ".pfm" && image.type() == CV_32FC1) {
    return WriteFileAtomically(path, EncodePfm(image));
  }
  if (path.extension() == ".pfm" && image.type() == CV_32FC3) {
    cv::Mat3f rgb;
    cv::cvtColor(image, rgb, cv::COLOR_BGR2RGB);
    return WriteVectorPfm(path, rgb);
  }
  AllowExr();
  std::vector<unsigned char> bytes;
  const std::vector<int> options = {cv::IMWRITE_JPEG_QUALITY,    kJpegQuality,
                                    cv::IMWRITE_PNG_COMPRESSION, kPngCompression,
                                    cv::IMWRITE_PNG_STRATEGY,    kPngStrategy};
  bool encoded = false;
  try {
    encoded = cv::imencode(path.extension().string(), image, bytes, options);
  } catch (const cv::Exception&) {  // it has no encoder of this name
  }
  if (!encoded) throw MachineError(path.string() + ": cannot encode the image");
  WriteFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void CheckImageName(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  for (const char* known : {".png", ".jpg", ".jpeg"}) {
    if (ending == known) return;
  }
  throw InputError(path.string(), 0, "expected a file name that ends with .png, .jpg or .jpeg");
}

void WriteVectorPfm(const std::filesystem::path& path, const cv::Mat3f& vectors) {
  WriteFileAtomically(path, EncodePfm(vectors));
}

cv::Mat1b ReadMaskPng(const std::filesystem::path& path) {
  const cv::Mat image = ReadPng(path);
  const int colours = std::min(image.channels(), 3);  // how opaque it is is no colour
  cv::Mat1b mask(image.size(), 0), set;
  cv::Mat band;
  for (int k = 0; k < colours; ++k) {
    cv::extractChannel(image, band, k);
    cv::compare(band, 0, set, cv::CMP_NE);
    cv::bitwise_or(mask, set, mask);
  }
  return mask;
}

cv::Mat1b ReadGreyPng(const std::filesystem::path& path) {
  cv::Mat image = ReadPng(path);
  if (image.depth() == CV_16U) image = UpperBytes(image);
  if (image.type() == CV_8UC1) return image;
  cv::Mat1b grey;
  if (image.type() == CV_8UC3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  if (image.type() == CV_8UC4) cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY);
  if (grey.empty()) throw InputError(path.string(), 0, "neither grey nor colour");
  return grey;
}

cv::Mat3f ReadLinearImage(const std::filesystem::path& path) {
  AllowExr();
  ReadFile(path);  // says what keeps it from being read; OpenCV does not
  const std::string ending = path.extension().string();
  if (ending != ".exr" && ending != ".pfm") {
    throw InputError(path.string(), 0, "expected a .pfm or .exr file");
  }
  // From the file: of bytes it makes a file of its own, which it leaves behind if they are broken.
  cv::Mat image;
  try {
    image = cv::imread(path.string(), cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
  } catch (const cv::Exception&) {  // told like any other that cannot be decoded
  }
  if (image.empty()) throw InputError(path.string(), 0, "cannot decode it");
  if (image.type() != CV_32FC3)
    throw InputError(path.string(), 0, "does not have three float channels");
  return image;
}

}  // namespace aisle
