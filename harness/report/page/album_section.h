#pragma once

#include <filesystem>
#include <string>

#include "harness/record/group.h"

namespace aisle {

/// The frames of each system's worst run that kept any: stills with what can be said of them, which
/// the script turns into one picture under a slider. Reads the runs' frames.csv.
std::string AlbumSection(const SceneRuns& scene, const std::filesystem::path& report_dir,
                         const std::string& root);

/// The frame that a kept picture shows, by its file's name ("frame_000123_worst_error.jpg"), and
/// what it leads in ("worst error"); nothing for other names.
struct FramePicture {
  std::size_t frame = 0;
  std::string lead;
};
std::optional<FramePicture> PictureOf(const std::string& path);

}  // namespace aisle
