#pragma once

#include <string>
#include <vector>

#include "harness/bag/mcap_writer.h"

namespace aisle {

/// metadata.yaml of rosbag2, version 5, which Humble and all after it read: with it the folder
/// around `file_name` is a bag by itself.
std::string RosbagMetadata(const McapWriter& bag, const std::string& file_name);

/// A layout for Foxglove: the left picture with boxes and masks, and the hall from above with the
/// paths and poses of truth and of these systems, their states and their events; beside the plan
/// the stills of these topics. File: "Import from file…" in its layout menu.
std::string FoxgloveLayout(const std::vector<std::string>& systems,
                           const std::vector<std::string>& stills = {});

/// Whether a file that a scene names goes along as an attachment: texts do, meshes and bags do not.
bool IsAttached(const std::filesystem::path& file);

/// Writes the two beside the bag: metadata.yaml and foxglove_layout.json.
void WriteBesideBag(const std::filesystem::path& bag_file, const McapWriter& bag,
                    const std::vector<std::string>& systems,
                    const std::vector<std::string>& stills = {});

}  // namespace aisle
