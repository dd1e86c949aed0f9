#pragma once

#include <filesystem>

#include "harness/contract/frame.h"

namespace aisle {

/// Masks that somebody else made, one PNG a frame: anything but 0 is to be rejected. Left masks lie
/// in DIR or DIR/left, right ones in DIR/right (optional); each is named by the frame's stamp in
/// nanoseconds or by its number in six digits, as the recording's own images are. In the same way
/// DIR/confidence (optional) says how far each left pixel is trusted: 255 fully, 0 hardly at all.
class MaskFolder {
 public:
  /// Throws InputError where there is no such folder or no PNG in it.
  explicit MaskFolder(const std::filesystem::path& folder);

  /// Images are empty where there is none for the frame. Throws InputError for a file that is
  /// no image of the frame's size.
  ExternalMask Find(const StereoFrame& frame) const;

 private:
  std::filesystem::path left_, right_, confidence_;
};

}  // namespace aisle
