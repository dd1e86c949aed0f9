// Linked into programs that ThreadSanitizer watches. OpenCV hands its loops to oneTBB inside its
// own packaged library, where the sanitizer cannot be told how they are ordered, and its setting
// for the environment does not reach that back end.

#include <opencv2/core/utility.hpp>

namespace {
[[maybe_unused]] const bool kOnOneThread = [] {
  cv::setNumThreads(1);
  return true;
}();
}  // namespace
