#pragma once

#include <cstring>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace aisle {

/// Appends plain values in the machine's byte order; for caches that never leave it.
class ByteWriter {
 public:
  template <typename T>
  void Put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void PutText(const std::string& text) {
    Put(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
  }
  /// Pixels as they are.
  void PutRaw(const cv::Mat1b& image) {
    PutSize(image);
    for (int y = 0; y < image.rows; ++y) {
      bytes_.append(image.ptr<char>(y), static_cast<std::size_t>(image.cols));
    }
  }
  /// Runs of equal pixels: masks and labels are mostly that.
  template <typename T>
  void PutRuns(const cv::Mat_<T>& image) {
    PutSize(image);
    std::uint32_t length = 0;
    T value{};
    for (const T pixel : image) {
      if (length > 0 && pixel != value) {
        Put(length);
        Put(value);
        length = 0;
      }
      value = pixel;
      ++length;
    }
    if (length > 0) {
      Put(length);
      Put(value);
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  void PutSize(const cv::Mat_<T>& image) {
    Put(image.rows);
    Put(image.cols);
  }
  std::string bytes_;
};

/// Reads what ByteWriter wrote. Throws std::out_of_range when the bytes run out or make no sense.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T Get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, Take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string GetText() { return std::string(Take(Get<std::uint32_t>())); }

  cv::Mat1b GetRaw() {
    cv::Mat1b image = MakeImage<unsigned char>();
    for (int y = 0; y < image.rows; ++y) {
      const auto width = static_cast<std::size_t>(image.cols);
      std::memcpy(image.ptr(y), Take(width).data(), width);
    }
    return image;
  }
  template <typename T>
  cv::Mat_<T> GetRuns() {
    cv::Mat_<T> image = MakeImage<T>();
    const std::size_t total = image.total();
    for (std::size_t filled = 0; filled < total;) {
      const std::size_t length = Get<std::uint32_t>();
      const T value = Get<T>();
      if (length == 0 || length > total - filled) throw std::out_of_range("run too long");
      T* const first = image.template ptr<T>() + filled;
      std::fill(first, first + length, value);
      filled += length;
    }
    return image;
  }
  bool AtEnd() const { return bytes_.empty(); }

 private:
  static constexpr int kMaxSide = 16384;

  std::string_view Take(std::size_t count) {
    if (count > bytes_.size()) throw std::out_of_range("bytes run out");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  template <typename T>
  cv::Mat_<T> MakeImage() {
    const int rows = Get<int>(), cols = Get<int>();
    if (rows < 0 || cols < 0 || rows > kMaxSide || cols > kMaxSide) {
      throw std::out_of_range("image too large");
    }
    return cv::Mat_<T>(rows, cols);
  }
  std::string_view bytes_;
};

}  // namespace aisle
