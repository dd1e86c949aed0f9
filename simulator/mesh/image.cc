#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "simulator/mesh/import.h"

namespace aisle::sim {
namespace {

constexpr int kEncodeSteps = 4096;

float SrgbToLinear(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float LinearToSrgb(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

struct TransferTables {
  std::array<float, 256> to_linear;
  std::array<std::uint8_t, kEncodeSteps + 1> to_srgb;

  TransferTables() {
    for (std::size_t i = 0; i < to_linear.size(); ++i) {
      to_linear[i] = SrgbToLinear(static_cast<float>(i) / 255);
    }
    for (std::size_t i = 0; i < to_srgb.size(); ++i) {
      const float linear = static_cast<float>(i) / kEncodeSteps;
      to_srgb[i] = static_cast<std::uint8_t>(std::lround(255 * LinearToSrgb(linear)));
    }
  }
};

const TransferTables& Tables() {
  static const TransferTables tables;
  return tables;
}

struct ImageSize {
  std::uint32_t width = 0, height = 0;
};

std::uint32_t BigEndian(const std::vector<std::uint8_t>& bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[at + static_cast<std::size_t>(i)];
  return value;
}

/// Size as a PNG's header states it; 0 x 0 when it is no PNG.
ImageSize PngSize(const std::vector<std::uint8_t>& bytes) {
  constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A};
  if (bytes.size() < 33 || !std::equal(kSignature.begin(), kSignature.end(), bytes.begin())) {
    return {};
  }
  return {BigEndian(bytes, 16, 4), BigEndian(bytes, 20, 4)};
}

/// Size as a JPEG's frame header states it; 0 x 0 when it is no JPEG.
ImageSize JpegSize(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return {};
  for (std::size_t at = 2; at + 9 < bytes.size() && bytes[at] == 0xFF;) {
    const std::uint8_t marker = bytes[at + 1];
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) return {BigEndian(bytes, at + 7, 2), BigEndian(bytes, at + 5, 2)};
    at += 2 + BigEndian(bytes, at + 2, 2);
  }
  return {};
}

}  // namespace

float LinearOf(std::uint8_t srgb) { return Tables().to_linear[srgb]; }

float GreyOf(const Eigen::Vector3f& linear_rgb, Band band) {
  switch (band) {
    case Band::kRed:
      return linear_rgb.x();
    case Band::kGreen:
      return linear_rgb.y();
    case Band::kBlue:
      return linear_rgb.z();
    case Band::kLuminance:
      break;
  }
  return linear_rgb.dot(Eigen::Vector3f(0.2126f, 0.7152f, 0.0722f));
}

cv::Mat1b GreyOf(const cv::Mat& image, Band band) {
  if (image.channels() == 1) return image.clone();
  cv::Mat bgr = image;
  if (image.channels() == 4) cv::cvtColor(image, bgr, cv::COLOR_BGRA2BGR);
  const TransferTables& tables = Tables();
  cv::Mat1b grey(bgr.size());
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* from = bgr.ptr<cv::Vec3b>(y);
    std::uint8_t* to = grey.ptr<std::uint8_t>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      const Eigen::Vector3f linear(tables.to_linear[from[x][2]], tables.to_linear[from[x][1]],
                                   tables.to_linear[from[x][0]]);
      const float value = std::clamp(GreyOf(linear, band), 0.0f, 1.0f);
      to[x] = tables.to_srgb[static_cast<std::size_t>(value * kEncodeSteps + 0.5f)];
    }
  }
  return grey;
}

cv::Mat DecodeImage(const std::vector<std::uint8_t>& bytes, const std::string& name,
                    int max_side_px) {
  const ImageSize png = PngSize(bytes);
  const auto [width, height] = png.width > 0 ? png : JpegSize(bytes);
  if (width == 0 || height == 0) {
    throw ImportError(name + ": it is neither PNG nor JPEG; save the texture as PNG");
  }
  const auto limit = static_cast<std::uint32_t>(max_side_px);
  if (width > limit || height > limit) {
    throw ImportError(fmt::format("{}: the image is {}x{} pixels, the limit is {} a side", name,
                                  width, height, max_side_px));
  }
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw ImportError(name + ": the image cannot be decoded: " + error.err);
  }
  if (image.empty()) throw ImportError(name + ": the image cannot be decoded");
  if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 1.0 / 257);
  return image;
}

}  // namespace aisle::sim
