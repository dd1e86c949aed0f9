#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// A joint of a recorded skeleton. An end site is a joint without channels.
struct BvhJoint {
  std::string name;
  int parent = -1;                                   ///< before it in the list; -1: the root
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< from the parent, the file's unit
  std::string channels;  ///< x y z: position along that axis, X Y Z: rotation about it, in order
  std::size_t first_value = 0;  ///< of its channels in a frame
};

/// A Biovision hierarchy: a skeleton and how it moves.
struct Bvh {
  std::vector<BvhJoint> joints;             ///< parents before children
  double frame_s = 0;                       ///< from one frame to the next
  std::size_t values = 0;                   ///< of a frame
  std::vector<std::vector<double>> frames;  ///< positions in the file's unit, angles in degrees

  double duration_s() const { return frame_s * static_cast<double>(frames.size() - 1); }
};

/// Where each joint is, in the file's own axes and unit.
using BvhPose = std::vector<Eigen::Isometry3d>;

/// Reads a text: two frames at least, numbers finite, no more than a thousand joints and a hundred
/// thousand frames. Throws ImportError, "line N: what".
Bvh ParseBvh(std::string_view text);

/// The same of a file; its name stands before the message.
Bvh ReadBvh(const std::filesystem::path& file);

/// The skeleton in a frame; rotations are applied in the order of the channels, a position takes
/// the place of the joint's offset.
BvhPose PoseOf(const Bvh& bvh, std::size_t frame);
/// With every channel 0: as the offsets draw it.
BvhPose ZeroPose(const Bvh& bvh);

}  // namespace aisle::sim
