#include "harness/bag/grey_image.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/bag/picture_size.h"
#include "harness/ros/cdr.h"

namespace aisle {
namespace {

constexpr std::uint32_t kMostSide = 16384;
/// Of a compressed image, which is short however many they are.
constexpr std::uint64_t kMostPixels = std::uint64_t{64} << 20;
constexpr int kAsItIs = -1;  ///< no conversion
constexpr int kUpperByte = -2;

struct Encoding {
  const char* name;
  int type;     ///< OpenCV's, of the pixels as they come
  int to_grey;  ///< cv::cvtColor's code
};
// ROS names a Bayer pattern by the first two pixels of the first rows, OpenCV by those of the
// second row from its second pixel on.
constexpr Encoding kEncodings[] = {{"mono8", CV_8UC1, kAsItIs},
                                   {"8UC1", CV_8UC1, kAsItIs},
                                   {"mono16", CV_16UC1, kUpperByte},
                                   {"16UC1", CV_16UC1, kUpperByte},
                                   {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY},
                                   {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY},
                                   {"8UC3", CV_8UC3, cv::COLOR_BGR2GRAY},
                                   {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY},
                                   {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY},
                                   {"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2GRAY},
                                   {"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2GRAY},
                                   {"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2GRAY},
                                   {"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2GRAY},
                                   {"yuv422", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
                                   {"uyvy", CV_8UC2, cv::COLOR_YUV2GRAY_UYVY},
                                   {"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2},
                                   {"yuyv", CV_8UC2, cv::COLOR_YUV2GRAY_YUY2}};

const Encoding& EncodingOf(const std::string& name) {
  const auto* found = std::ranges::find(kEncodings, name, &Encoding::name);
  if (found != std::end(kEncodings)) return *found;
  std::string known;
  for (const Encoding& one : kEncodings) known += std::string(known.empty() ? "" : ", ") + one.name;
  throw ros::CdrError(
      fmt::format("unsupported encoding '{}'; supported: {}", name.substr(0, 40), known));
}

cv::Mat1b ToGrey(const cv::Mat& image, const Encoding& encoding) {
  if (encoding.to_grey == kAsItIs) return image.clone();
  cv::Mat1b grey;
  if (encoding.to_grey == kUpperByte) {
    grey.create(image.size());
    std::transform(image.begin<std::uint16_t>(), image.end<std::uint16_t>(), grey.begin(),
                   [](std::uint16_t value) { return static_cast<unsigned char>(value >> 8); });
  } else {
    cv::cvtColor(image, grey, encoding.to_grey);
  }
  return grey;
}

/// "bayer_rggb8; png compressed " -> "bayer_rggb8"; nothing where the format names a codec alone.
std::string PackedEncoding(const std::string& format) {
  const std::size_t end = format.find(';');
  return end == std::string::npos ? "" : format.substr(0, end);
}

cv::Mat1b Grey(const ros::Image& message) {
  const Encoding& encoding = EncodingOf(message.encoding);
  const std::size_t row = message.width * static_cast<std::size_t>(CV_ELEM_SIZE(encoding.type));
  const std::size_t needed =
      message.height == 0 ? 0 : message.step * (message.height - std::size_t{1}) + row;
  if (message.width == 0 || message.height == 0 || message.width > kMostSide ||
      message.height > kMostSide || message.step < row || message.data.size() < needed) {
    throw ros::CdrError(fmt::format("states {}x{} {} in rows of {} bytes, but has {}",
                                    message.width, message.height, message.encoding, message.step,
                                    message.data.size()));
  }
  if (message.step % CV_ELEM_SIZE1(encoding.type) != 0) {
    throw ros::CdrError(
        fmt::format("states rows of {} bytes, which is not a whole number of {} values",
                    message.step, message.encoding));
  }
  const auto size = cv::Size(static_cast<int>(message.width), static_cast<int>(message.height));
  const cv::Mat image(size, encoding.type, const_cast<unsigned char*>(message.data.data()),
                      message.step);  // only read
  if (encoding.type != CV_16UC1 || message.is_bigendian == 0) return ToGrey(image, encoding);
  cv::Mat1b grey(size);  // the upper byte comes first
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) grey(y, x) = image.ptr(y)[2 * x];
  }
  return grey;
}

cv::Mat1b Grey(const ros::CompressedImage& message) {
  if (message.data.empty()) throw ros::CdrError("is empty");
  const auto [width, height] = SizeOfPicture(message.data);
  if (width > kMostSide || height > kMostSide || std::uint64_t{width} * height > kMostPixels) {
    throw ros::CdrError(fmt::format("states {}x{} pixels, at most {} a side and {} in all are read",
                                    width, height, kMostSide, kMostPixels));
  }
  cv::Mat image;
  try {
    // OpenCV has decoders of many more kinds, which no recorder of images needs.
    if (width > 0 && height > 0) image = cv::imdecode(message.data, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // told like any other that cannot be decoded
  }
  if (image.empty()) {
    throw ros::CdrError(fmt::format("cannot decode it ('{}'): PNG and JPEG are supported",
                                    message.format.substr(0, 40)));
  }
  const std::string packed = PackedEncoding(message.format);
  if (image.type() == CV_8UC1) {
    return packed.starts_with("bayer_") ? ToGrey(image, EncodingOf(packed)) : cv::Mat1b(image);
  }
  if (image.type() == CV_16UC1) return ToGrey(image, EncodingOf("mono16"));
  if (image.type() == CV_8UC3) return ToGrey(image, EncodingOf("bgr8"));  // as imdecode has it
  if (image.type() == CV_8UC4) return ToGrey(image, EncodingOf("bgra8"));
  throw ros::CdrError("unsupported kind of pixels");
}

/// What OpenCV refuses (pairs of pixels in rows of an odd length) is the message's fault.
template <class T>
cv::Mat1b GreyOrCdrError(const T& message) {
  try {
    return Grey(message);
  } catch (const cv::Exception& error) {
    throw ros::CdrError("cannot be turned into grey: " + error.err);
  }
}

}  // namespace

cv::Mat1b GreyImage(const ros::Image& message) { return GreyOrCdrError(message); }

cv::Mat1b GreyImage(const ros::CompressedImage& message) { return GreyOrCdrError(message); }

}  // namespace aisle
