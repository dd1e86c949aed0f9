#pragma once

#include <filesystem>

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"

namespace aisle::slam {

/// What one drive leaves behind for the next.
struct SavedMap {
  StereoCamera camera;   ///< that all of it was seen with
  KeyframeId reference;  ///< the rig stood near it at the end; the first to be asked where it is
  Map map;
};

/// Writes a map: versioned, with a checksum, whole or not at all. Throws std::runtime_error that
/// names the file.
void SaveMap(const SavedMap& saved, const std::filesystem::path& file);

/// Reads one back, to the last bit. Throws std::runtime_error that names the file and what is wrong
/// with it.
SavedMap LoadMap(const std::filesystem::path& file);

}  // namespace aisle::slam
