#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "simulator/mesh/model.h"

namespace aisle::sim {

/// A box that a clip holds, in the object's frame at the clip's start.
struct BoxFacts {
  Eigen::Vector3f size_m, centre_m;
};

/// What the manifest says of a clip.
struct ClipFacts {
  double duration_s = 1;
  double stride_m = 0;  ///< > 0: the model walks; move it by this much a cycle
  double speed_mps = 0;
  double turn_deg = 0;        ///< turned a cycle
  double handle_ahead_m = 0;  ///< where the hands hold a handle bar; 0: none
  std::optional<BoxFacts> box;
};

struct PersonFacts {
  std::map<std::string, ClipFacts> clips;
};

/// A rider who pedals: once every development the cranks and the rider's clip go round.
struct RiddenFacts {
  std::string clip;
  double development_m = 5;
  std::string crank_node;
  std::vector<std::string> pedal_nodes;  ///< below the crank; they stay level
};

struct VehicleFacts {
  std::map<std::string, double> wheel_radius_m;  ///< by node
  std::vector<std::string> steer_nodes;
  std::map<std::string, double> lift_shares;  ///< node -> share of the lift it slides by
  double lift_travel_m = 0;                   ///< how far it lifts; 0: it does not
  double fork_top_m = 0.085, fork_heel_x_m = 0.56;
  std::string fork_node;
  double handle_m = 0;  ///< x of the bar it is pushed by
  std::optional<RiddenFacts> ridden;
};

/// The folder of models and what its manifest.json says of them. Models are read once: those of
/// this project's own tree, whose bytes its tests hold to the manifest, in this process; others in
/// one of their own (simulator/mesh/door), which costs a fifth of a second each.
class AssetLibrary {
 public:
  /// With `colour`, models come with theirs. Throws std::runtime_error when the manifest is missing
  /// or not as expected.
  explicit AssetLibrary(std::filesystem::path folder, bool colour = false);

  /// Facts of people/NAME or vehicles/NAME. Throws std::runtime_error naming what there is.
  const PersonFacts& Person(const std::string& name) const;
  const VehicleFacts& Vehicle(const std::string& name) const;
  /// The names that Person knows, sorted.
  std::vector<std::string> PeopleNames() const;
  /// The names that Vehicle knows, sorted.
  std::vector<std::string> VehicleNames() const;
  /// Folder and name of a piece of assets/kit or assets/street, as Load takes it. Throws likewise.
  const std::string& Prop(const std::string& name) const;
  /// The picture assets/textures/NAME.png in grey. Throws ImportError.
  cv::Mat1b Picture(const std::string& texture) const;
  /// The same as it is stored: of one channel or three; empty where there is none of that name.
  cv::Mat ColourPicture(const std::string& texture) const;
  /// A named rectangle of an atlas: left, top, width, height in shares of the picture.
  std::array<float, 4> Rect(const std::string& texture, const std::string& name) const;
  /// A mesh of the user's own, as it stands at rest. Throws ImportError.
  std::shared_ptr<const Model> LoadStill(const std::string& file);
  /// A skinned model of the user's own, with its animations. Throws ImportError.
  std::shared_ptr<const Model> LoadSkinned(const std::string& file);
  /// Of the manifest and of the models that were loaded: any other byte of them gives another.
  std::uint64_t Digest() const;
  /// The model of "people/NAME", "vehicles/NAME", "kit/NAME" or "street/NAME".
  std::shared_ptr<const Model> Load(const std::string& asset);

 private:
  std::filesystem::path folder_;
  bool is_own_ = false;  ///< the project's own tree
  bool colour_ = false;
  std::map<std::string, PersonFacts> people_;
  std::map<std::string, VehicleFacts> vehicles_;
  std::map<std::string, std::string> props_;
  std::map<std::string, std::array<float, 4>> rects_;  ///< by texture/name
  std::map<std::string, std::shared_ptr<const Model>> models_;
  std::map<std::string, std::uint64_t> digests_;  ///< by file as the library names it
};

}  // namespace aisle::sim
