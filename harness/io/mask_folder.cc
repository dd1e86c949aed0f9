#include "harness/io/mask_folder.h"

#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

cv::Mat1b Read(const fs::path& folder, const StereoFrame& frame) {
  for (const std::string& name :
       {fmt::format("{}.png", frame.stamp_ns), fmt::format("{:06}.png", frame.id)}) {
    const fs::path path = folder / name;
    if (!fs::exists(path)) continue;
    cv::Mat1b mask;
    cv::compare(ReadGreyPng(path), 0, mask, cv::CMP_NE);
    if (mask.size() == frame.left.size()) return mask;
    throw InputError(path.string(), 0,
                     fmt::format("is {}x{}, the rectified images are {}x{}", mask.cols, mask.rows,
                                 frame.left.cols, frame.left.rows));
  }
  return {};
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
      right_(folder / "right") {
  if (!HoldsPng(left_)) throw InputError(left_.string(), 0, "holds no PNG images");
}

ExternalMask MaskFolder::Find(const StereoFrame& frame) const {
  return {Read(left_, frame), Read(right_, frame)};
}

}  // namespace aisle
