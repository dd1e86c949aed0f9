#include "harness/io/mask_folder.h"

#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// The folder's image for the frame, empty where there is none.
cv::Mat1b Read(const fs::path& folder, const StereoFrame& frame,
               cv::Mat1b (*read)(const fs::path&)) {
  for (const std::string& name :
       {fmt::format("{}.png", frame.stamp_ns), fmt::format("{:06}.png", frame.id)}) {
    const fs::path path = folder / name;
    if (!fs::exists(path)) continue;
    const cv::Mat1b image = read(path);
    if (image.size() == frame.left.size()) return image;
    throw InputError(path.string(), 0,
                     fmt::format("has {}x{} pixels, but the rectified images have {}x{}",
                                 image.cols, image.rows, frame.left.cols, frame.left.rows));
  }
  return {};
}

cv::Mat1b ReadMask(const fs::path& folder, const StereoFrame& frame) {
  return Read(folder, frame, ReadMaskPng);
}

bool HoldsPng(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".png") return true;
  }
  return false;
}

}  // namespace

MaskFolder::MaskFolder(const fs::path& folder)
    : left_(fs::is_directory(folder / "left") ? folder / "left" : folder),
      right_(folder / "right"),
      confidence_(folder / "confidence") {
  if (!HoldsPng(left_) && !HoldsPng(confidence_))
    throw InputError(left_.string(), 0, "no PNG images in this folder");
}

ExternalMask MaskFolder::Find(const StereoFrame& frame) const {
  return {ReadMask(left_, frame), ReadMask(right_, frame), Read(confidence_, frame, ReadGreyPng)};
}

}  // namespace aisle
