#pragma once

#include <cstdio>
#include <filesystem>
#include <opencv2/core.hpp>

namespace aisle {

/// A short film of a run through ffmpeg; does nothing where there is none.
class Video {
 public:
  /// Frames of any one even size, `rate_hz` of them a second.
  Video(std::filesystem::path file, double rate_hz);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// There is an ffmpeg to be had.
  static bool Available();
  void Add(const cv::Mat3b& picture);
  /// True if the film is whole and stands under its name.
  bool Finish();

 private:
  const std::filesystem::path file_, aside_;
  const double rate_hz_;
  std::FILE* pipe_ = nullptr;
  cv::Size size_;
  bool failed_ = false;
};

}  // namespace aisle
