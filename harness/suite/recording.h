#pragma once

#include <optional>
#include <string>
#include <vector>

namespace aisle {

/// A recorded drive as a suite takes it beside its scenes: a bag, or a small file that says where
/// the recording is and what is known of it. Paths are as they can be opened.
struct RecordingSource {
  std::string file;    ///< as the suite names it: the bag itself, or the description
  std::string path;    ///< the bag or the dataset's folder
  std::string format;  ///< of a folder: euroc or kitti
  std::vector<std::string> topics = {};   ///< of a bag: left and right image; empty: found
  std::optional<double> baseline_m = {};  ///< of a bag whose camera_info lacks it
  std::string odometry = {};              ///< of a bag: topic of its wheels; empty: none
  std::string truth = {};  ///< a trajectory file, or BAG:/topic; empty: what the recording has
};

/// A bag by its name, or a file with the key `recording`; not a file that cannot be read: who opens
/// it says why.
bool IsRecording(const std::string& file);

/// Throws InputError with every mistake of the file, each with file:line:column.
RecordingSource ReadRecordingSource(const std::string& file);

}  // namespace aisle
