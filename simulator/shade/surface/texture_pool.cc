#include "simulator/shade/surface/texture_pool.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace aisle::sim {
namespace {

constexpr float kMaxTaps = 8;

float LinearFromSrgb(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

cv::Mat1f LinearImage(const cv::Mat& image) {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) {
    table[static_cast<std::size_t>(i)] = LinearFromSrgb(static_cast<float>(i) / 255.0f);
  }
  cv::Mat1f linear(image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) linear(y, x) = table[image.at<std::uint8_t>(y, x)];
  }
  return linear;
}

/// One of an 8-bit picture, as shares of full.
cv::Mat1f ChannelOf(const cv::Mat& image, int channel) {
  cv::Mat one;
  cv::extractChannel(image, one, channel);
  cv::Mat1f share;
  one.convertTo(share, CV_32F, 1.0 / 255);
  return share;
}

int PowerOfTwo(int size) {
  return std::min(8192, static_cast<int>(std::bit_ceil(static_cast<unsigned>(size))));
}

/// Appends one level; every row and the image itself end with their first texel resp. row.
void AppendLevel(const cv::Mat1f& level, bool is_normal_map, std::vector<std::uint8_t>* bytes) {
  for (int y = 0; y <= level.rows; ++y) {
    for (int x = 0; x <= level.cols; ++x) {
      const float share = std::max(0.0f, level(y % level.rows, x % level.cols));
      const float value = is_normal_map ? share : std::sqrt(share);
      bytes->push_back(static_cast<std::uint8_t>(std::lround(std::min(value, 1.0f) * 255.0f)));
    }
  }
}

/// What a texture takes with its pyramid.
std::size_t PoolBytes(const Texture& texture) {
  std::size_t bytes = 0;
  for (int w = PowerOfTwo(texture.image.cols), h = PowerOfTwo(texture.image.rows);;
       w = std::max(1, w / 2), h = std::max(1, h / 2)) {
    bytes += static_cast<std::size_t>(w + 1) * static_cast<std::size_t>(h + 1);
    if (w == 1 && h == 1) break;
  }
  return texture.image.channels() == 1 ? bytes : 2 * bytes;
}

/// Refuses textures that together are too large.
void CheckBytes(std::span<const Texture> textures, std::size_t most_bytes) {
  constexpr std::size_t kNamed = 3;
  constexpr double kMega = 1e6;
  std::size_t sum = 0;
  std::vector<std::pair<std::size_t, const Texture*>> sizes;
  for (const Texture& texture : textures) {
    if (texture.image.empty()) continue;
    sizes.emplace_back(PoolBytes(texture), &texture);
    sum += sizes.back().first;
  }
  if (sum <= most_bytes) return;
  std::ranges::stable_sort(sizes, std::greater(), &std::pair<std::size_t, const Texture*>::first);
  std::string largest;
  for (const auto& [bytes, texture] : std::span(sizes).first(std::min(kNamed, sizes.size()))) {
    largest += fmt::format("{}'{}' ({} x {})", largest.empty() ? "" : ", ", texture->name,
                           texture->image.cols, texture->image.rows);
  }
  throw std::runtime_error(fmt::format(
      "its {} textures take {:.0f} MB with their smaller levels, the limit is {:.0f} MB; make them "
      "smaller, the largest first: {}",
      sizes.size(), static_cast<double>(sum) / kMega, static_cast<double>(most_bytes) / kMega,
      largest));
}

}  // namespace

TexturePool::TexturePool(std::span<const Texture> textures, std::size_t most_bytes) {
  CheckBytes(textures, most_bytes);
  const auto append = [&](const cv::Mat1f& base, bool is_normal_map) {
    sizes_.push_back(std::countr_zero(static_cast<unsigned>(base.cols)) |
                     std::countr_zero(static_cast<unsigned>(base.rows)) << 8);
    cv::Mat1f level = base;
    for (int i = 0; i < kLevels; ++i) {
      offsets_.push_back(static_cast<std::int32_t>(bytes_.size()));
      AppendLevel(level, is_normal_map, &bytes_);
      const cv::Size half(std::max(1, level.cols / 2), std::max(1, level.rows / 2));
      if (half == level.size()) {  // 1 × 1: all further levels are this one
        for (int j = i + 1; j < kLevels; ++j) offsets_.push_back(offsets_.back());
        break;
      }
      cv::Mat1f smaller;
      cv::resize(level, smaller, half, 0, 0, cv::INTER_AREA);
      level = smaller;
    }
  };
  append(cv::Mat1f(1, 1, 1.0f), false);  // what "no texture" samples
  const auto append_resized = [&](cv::Mat1f linear, bool is_normal_map) {
    const cv::Size size(PowerOfTwo(linear.cols), PowerOfTwo(linear.rows));
    if (size != linear.size()) cv::resize(linear, linear, size, 0, 0, cv::INTER_LINEAR);
    append(linear, is_normal_map);
  };
  // Of a normal map the x stands where a texture would, the y behind all textures.
  std::vector<cv::Mat1f> seconds;
  for (const Texture& texture : textures) {
    second_.push_back(-1);
    if (texture.image.empty()) {
      append(cv::Mat1f(1, 1, 1.0f), false);
    } else if (texture.image.type() == CV_8UC1) {
      append_resized(LinearImage(texture.image), false);
    } else {
      second_.back() = static_cast<int>(textures.size() + seconds.size());
      append_resized(ChannelOf(texture.image, 0), true);
      seconds.push_back(ChannelOf(texture.image, 1));
    }
  }
  for (const cv::Mat1f& second : seconds) append_resized(second, true);
  bytes_.resize(bytes_.size() + 8);  // the gathers read four bytes
}

template <bool kNormals>
F8 TexturePool::Bilinear(I8 texture, I8 size, I8 level, F8 u, F8 v) const {
  const I8 zero = I8{};
  const I8 log_w = MaxInt((size & 255) - level, zero), log_h = MaxInt((size >> 8) - level, zero);
  const I8 w = ShiftLeft(WideInt(1), log_w), h = ShiftLeft(WideInt(1), log_h);
  const F8 x = u * ToFloat(w) - 0.5f, y = v * ToFloat(h) - 0.5f;
  const F8 x_floor = Floor(x), y_floor = Floor(y);
  const F8 fx = x - x_floor, fy = y - y_floor;
  const I8 xi = ToInt(x_floor) & (w - 1), yi = ToInt(y_floor) & (h - 1);
  const I8 pitch = w + 1;
  const I8 at = GatherInt(offsets_.data(), texture * kLevels + level) + yi * pitch + xi;
  const I8 top = GatherBytes(bytes_.data(), at), bottom = GatherBytes(bytes_.data(), at + pitch);
  const auto decode = [](I8 byte) {
    const F8 value = ToFloat(byte & 255);
    return kNormals ? value : value * value;
  };
  constexpr float kWhole = kNormals ? 255.0f : 255.0f * 255.0f;
  const F8 a = decode(top), b = decode(top >> 8), c = decode(bottom), d = decode(bottom >> 8);
  const F8 upper = a + (b - a) * fx, lower = c + (d - c) * fx;
  return (upper + (lower - upper) * fy) * (1.0f / kWhole);
}

F8 TexturePool::Sample(I8 texture, F8 u, F8 v, F8 du_dx, F8 dv_dx, F8 du_dy, F8 dv_dy) const {
  return SampleBytes<false>(texture, u, v, du_dx, dv_dx, du_dy, dv_dy);
}

template <bool kNormals>
F8 TexturePool::SampleBytes(I8 index, F8 u, F8 v, F8 du_dx, F8 dv_dx, F8 du_dy, F8 dv_dy) const {
  const I8 texture = index + 1;
  if (!Any(texture > 0)) return Wide(1);
  // Texel indices must fit in 32 bits whatever a mesh says.
  u = u - Floor(u);
  v = v - Floor(v);
  const I8 size = GatherInt(sizes_.data(), texture);
  const F8 width = ToFloat(ShiftLeft(WideInt(1), size & 255));
  const F8 height = ToFloat(ShiftLeft(WideInt(1), size >> 8));
  const F8 ax = du_dx * width, ay = dv_dx * height, bx = du_dy * width, by = dv_dy * height;
  const F8 a = ax * ax + ay * ay, b = bx * bx + by * by;
  const F8 tiny = Wide(1e-6f), huge = Wide(1e6f);  // bounds, also where a footprint is not finite
  const F8 major = Max(Min(Sqrt(Max(a, b)), huge), tiny);
  const F8 minor = Abs(ax * by - ay * bx) / major;
  const F8 taps =
      Max(Min(Min(Ceil(major / Max(minor, tiny)), Ceil(major)), Wide(kMaxTaps)), Wide(1));
  const F8 lod = Max(FastLog2(Max(major / taps, tiny)), Wide(0));
  const F8 level_floor = Min(Floor(lod), Wide(kLevels - 1));
  const F8 between = Min(lod - level_floor, Wide(1));
  const I8 level = ToInt(level_floor), next = MinInt(level + 1, WideInt(kLevels - 1));
  // A comparison with what is not a number is false: such a footprint becomes a point.
  const auto finite = [](F8 step) { return Select(Abs(step) < 1e6f, step, Wide(0)); };
  const F8 step_u = finite(Select(a > b, du_dx, du_dy));
  const F8 step_v = finite(Select(a > b, dv_dx, dv_dy));
  const bool blend = Any(between > 0.02f);

  F8 sum = Wide(0);
  for (float i = 0; Any(taps > i); i += 1) {
    const F8 along = (i + 0.5f) / taps - 0.5f;
    const F8 tap_u = u + step_u * along, tap_v = v + step_v * along;
    F8 value = Bilinear<kNormals>(texture, size, level, tap_u, tap_v);
    if (blend) value += (Bilinear<kNormals>(texture, size, next, tap_u, tap_v) - value) * between;
    sum += Select(taps > i, value, Wide(0));
  }
  return sum / taps;
}

float TexturePool::SampleWide(int texture, float u, float v, float width) const {
  const F8 zero = Wide(0), step = Wide(width);
  return Sample(WideInt(texture), Wide(u), Wide(v), step, zero, zero, step)[0];
}

std::array<Eigen::Vector2f, kMapPoints> TexturePool::SampleNormals(
    std::span<const MapPoint> points) const {
  I8 texture = WideInt(-1);
  F8 u = Wide(0), v = Wide(0), width = Wide(0);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const MapPoint& point = points[k];
    const int second = second_[static_cast<std::size_t>(point.texture)];
    if (second < 0) continue;
    for (const std::size_t lane : {2 * k, 2 * k + 1}) {
      texture[lane] = lane % 2 == 0 ? point.texture : second;
      u[lane] = point.u;
      v[lane] = point.v;
      width[lane] = point.width;
    }
  }
  const F8 zero = Wide(0);
  const F8 share = SampleBytes<true>(texture, u, v, width, zero, zero, width);
  std::array<Eigen::Vector2f, kMapPoints> bends;
  for (std::size_t k = 0; k < kMapPoints; ++k) {
    const bool read = texture[2 * k] >= 0;
    bends[k] = read ? Eigen::Vector2f(2 * share[2 * k] - 1, 2 * share[2 * k + 1] - 1)
                    : Eigen::Vector2f(0, 0);
  }
  return bends;
}

}  // namespace aisle::sim
