#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "slam/map/frame.h"
#include "slam/map/ids.h"

namespace aisle::slam {

/// Landmark `landmark` is seen by feature `feature` of keyframe `keyframe`.
struct Observation {
  KeyframeId keyframe;
  int feature = -1;
  auto operator<=>(const Observation&) const = default;
};

/// A frame the map remembers.
struct Keyframe {
  KeyframeId id;
  std::shared_ptr<const Frame> frame;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
  KeyframeId parent;  ///< the older keyframe it was tracked from; none for the first
  std::vector<LandmarkId> landmarks;  ///< per feature of the frame; invalid where none
};

/// A point of the world.
struct Landmark {
  LandmarkId id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  std::vector<Observation> observations;               ///< by rising keyframe, at most one of each
  KeyframeId created_by;                               ///< keyframe that brought it
  int predicted = 0;  ///< tracked frames that should have seen it since it was created
  int found = 0;      ///< tracked frames whose pose it took part in

  // Derived from the observations by the map itself.
  Descriptor descriptor{};                           ///< the observation nearest to all others
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< mean unit direction it is seen along
  double reference_distance_m = 0;                   ///< from its first keyframe ...
  int reference_level = 0;                           ///< ... and the pyramid level it has there
};

/// A loop that was closed: two keyframes that saw one place on two visits. How they stand to each
/// other their poses tell.
struct ClosedLoop {
  KeyframeId current, matched;
  auto operator<=>(const ClosedLoop&) const = default;
};

/// What to change in a map; the only way to change one. Parts are carried out in the order they
/// stand here.
struct MapEdit {
  struct Pose {
    KeyframeId keyframe;
    Eigen::Isometry3d T_world_rig;
  };
  struct Parent {
    KeyframeId keyframe, parent;
  };
  struct Position {
    LandmarkId landmark;
    Eigen::Vector3d position;
  };
  struct Link {
    LandmarkId landmark;
    Observation observation;
  };
  struct Merge {
    LandmarkId gone, kept;
  };
  struct Count {
    LandmarkId landmark;
    int predicted, found;
  };

  std::vector<Keyframe> new_keyframes;  ///< their `landmarks` are linked as observations
  std::vector<Landmark> new_landmarks;  ///< ids are the map's to give; observations are linked
  std::vector<Pose> poses;
  std::vector<Parent> parents;  ///< older than their children; ignored where either is gone
  std::vector<Position> positions;
  std::vector<Link> links;               ///< ignored where feature or keyframe is already taken
  std::vector<Merge> merges;             ///< observations move to `kept` where they find room
  std::vector<Link> cuts;                ///< observations that end
  std::vector<Count> counts;             ///< added to predicted and found
  std::vector<ClosedLoop> closed_loops;  ///< ignored where either keyframe is gone
  std::vector<LandmarkId> removed_landmarks;
  std::vector<KeyframeId> removed_keyframes;  ///< children and closed loops go to their parent
};

/// A keyframe that is gone: the older keyframe to ask instead, and how the two stood.
struct RetiredKeyframe {
  KeyframeId id, heir;
  Eigen::Isometry3d T_heir_rig = Eigen::Isometry3d::Identity();
};

/// All of a map as plain lists: what a file holds of it.
struct MapContents {
  std::vector<Keyframe> keyframes;        ///< by rising id
  std::vector<Landmark> landmarks;        ///< by rising slot, with what the map has derived of them
  std::vector<std::int32_t> generations;  ///< of each slot's next tenant
  std::vector<std::int32_t> vacant;       ///< slots, the one to be given next last
  std::vector<RetiredKeyframe> retired;   ///< by rising id
  std::vector<ClosedLoop> closed_loops;   ///< rising
  std::int64_t next_keyframe = 0;
};

/// Keyframes and landmarks and who sees whom: a value. Copies share what neither changes, so that
/// a background worker's copy costs a table of pointers.
///
/// Invariants, whatever edit is applied: keyframe k's feature f names landmark l exactly where l's
/// observations name (k, f); every landmark has an observation; parents exist and are older; closed
/// loops are between two keyframes that exist.
class Map {
 public:
  Map() = default;
  /// The map that was taken apart, to the last bit. Throws std::invalid_argument that says which
  /// invariant the lists break.
  explicit Map(const MapContents& contents);
  MapContents Contents() const;

  /// Ids of the keyframes now in the map, rising.
  const std::map<KeyframeId, std::shared_ptr<const Keyframe>>& keyframes() const {
    return keyframes_;
  }
  /// Keyframes that are gone, by rising id. They grow with driving, not with the place: copies of a
  /// map have them in common until one of them loses a keyframe.
  const std::map<KeyframeId, RetiredKeyframe>& retired() const;
  /// They hold together what may share too few landmarks to do so itself.
  const std::set<ClosedLoop>& closed_loops() const { return closed_loops_; }
  bool empty() const { return keyframes_.empty(); }
  int landmark_count() const { return landmark_count_; }
  /// Keyframes without a parent: the parts of the map, see RootOf.
  int part_count() const { return part_count_; }
  /// The slots of all landmarks lie below it.
  int slot_count() const { return static_cast<int>(landmarks_.size()); }

  /// Null where there is no such keyframe (any more).
  const Keyframe* Find(KeyframeId id) const;
  /// Null where there is no such landmark (any more).
  const Landmark* Find(LandmarkId id) const;
  /// The keyframe, which must exist.
  const Keyframe& At(KeyframeId id) const;
  const Landmark& At(LandmarkId id) const;

  /// Every landmark, by slot.
  std::vector<const Landmark*> Landmarks() const;

  /// The keyframe itself, or the present one that stands for a former one.
  KeyframeId StandIn(KeyframeId id) const;
  /// Pose of a present or former keyframe, the latter carried along by its heirs.
  Eigen::Isometry3d PoseOf(KeyframeId id) const;

  /// The id that the next keyframe must carry.
  KeyframeId NextKeyframeId() const { return {next_keyframe_}; }

  void Apply(const MapEdit& edit);

 private:
  Keyframe* Change(KeyframeId id);
  Landmark* Change(LandmarkId id);
  void Insert(const Keyframe& keyframe);
  void Insert(Landmark landmark);
  void LinkUp(LandmarkId landmark, const Observation& observation);
  void Cut(LandmarkId landmark, const Observation& observation);
  void MergeInto(LandmarkId gone, LandmarkId kept);
  void Remove(LandmarkId id);
  void Remove(KeyframeId id);
  void Retire(const RetiredKeyframe& one);
  void SetParent(Keyframe& keyframe, KeyframeId parent);
  void Close(const ClosedLoop& loop);
  void HandDownLoops(KeyframeId from, KeyframeId heir);

  std::map<KeyframeId, std::shared_ptr<const Keyframe>> keyframes_;
  std::vector<std::shared_ptr<const Landmark>> landmarks_;  // by slot; null where vacant
  std::vector<std::int32_t> generations_;                   // of each slot's next tenant
  std::vector<std::int32_t> vacant_;
  std::shared_ptr<const std::map<KeyframeId, RetiredKeyframe>> retired_;  // null where none
  std::set<ClosedLoop> closed_loops_;
  int landmark_count_ = 0;
  int part_count_ = 0;
  std::int64_t next_keyframe_ = 0;
};

/// How many of the landmarks each keyframe sees, by the keyframe's id; 0 for former ones.
std::vector<int> CountSeen(const Map& map, std::span<const LandmarkId> landmarks);

/// A keyframe and how many landmarks it shares with another.
struct Covisible {
  KeyframeId keyframe;
  int shared = 0;
};

/// Fewer shared landmarks make no neighbours: from so many on ORB-SLAM joins two keyframes in its
/// covisibility graph (Mur-Artal et al. 2015).
inline constexpr int kLeastCovisible = 15;

/// Keyframes that share landmarks with `id`, most first, then older first.
std::vector<Covisible> CovisibleKeyframes(const Map& map, KeyframeId id, int least_shared);

/// The keyframe without a parent that this one descends from. Keyframes of one root are one part of
/// the map: what lies where between two parts is not known.
KeyframeId RootOf(const Map& map, KeyframeId id);

/// The root of every keyframe.
std::map<KeyframeId, KeyframeId> Roots(const Map& map);

/// The root of the part with most keyframes, the older one on a tie; the map must not be empty.
KeyframeId LargestPart(const Map& map);

/// Sum over observations, one with depth counting twice: it fixes the landmark by itself.
int ObservationWeight(const Map& map, const Landmark& landmark);

}  // namespace aisle::slam
