#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "simulator/motion/recorded_path.h"
#include "simulator/motion/rig_mount.h"
#include "simulator/motion/route.h"
#include "simulator/motion/vehicle.h"
#include "simulator/scene/beam_spec.h"
#include "simulator/scene/crowd_spec.h"
#include "simulator/scene/drive_spec.h"
#include "simulator/scene/kinds.h"
#include "simulator/scene/mark.h"
#include "simulator/scene/mechanism_spec.h"
#include "simulator/scene/sensor_spec.h"

namespace aisle::sim {

enum class Distortion { kNone, kRadialTangential, kEquidistant };

struct CameraSpec {
  Mark mark;
  std::array<int, 2> size_px = {752, 480};
  Eigen::Vector2d focal_px = {435.2, 435.2};
  Eigen::Vector2d center_px = {367.2, 252.2};
  double baseline_m = 0.12;
  Distortion distortion = Distortion::kNone;
  std::array<double, 4> distortion_coefficients = {0, 0, 0, 0};
  bool colour = false;  ///< exports have colour pictures beside the grey ones
};

/// A route with the places of its parts in the file.
struct RouteSpec {
  struct StepMarks {
    Mark step;
    std::vector<Mark> go;
  };
  Mark mark;
  RoutePlan plan;
  RouteLimits limits;
  std::vector<StepMarks> marks;  ///< per step of the plan
};

/// Whose poses a trajectory file holds.
enum class TrajectoryBody {
  kCamera,   ///< the left camera: x right, y down, z ahead
  kVehicle,  ///< the point the route moves: x ahead, y to the left, z up
};

/// A calibration of a stereo pair: one file of the user's, or one a camera, as the scene names
/// them.
struct CalibrationSpec {
  Mark left_mark, right_mark;  ///< of their keys; scenes that extend one another may give one each
  std::string left, right;     ///< empty: none
};

/// Another stereo pair of the rig.
struct PairSpec {
  Mark mark;
  std::string name;
  RigMount mount;
  bool has_camera = false;  ///< else it is as the scene's
  CameraSpec camera;
  CalibrationSpec calibration;
};

struct RigSpec {
  Mark mark;
  RigMount mount;               ///< of the pair that is shown
  std::vector<PairSpec> pairs;  ///< besides the one of `camera`
  std::string pair;             ///< which of them is shown; empty: that of `camera`
  Mark pair_mark;
  /// Of the pair of `camera`, whose poses a trajectory of the camera holds; where another is shown.
  std::optional<RigMount> first_mount;
  RouteSpec route;
  CalibrationSpec calibration;   ///< of the pair of `camera`
  Mark trajectory_mark;          ///< of the key
  std::string trajectory;        ///< TUM, or FILE.mcap:/topic; instead of the route; empty: none
  std::vector<TimedPose> poses;  ///< what it holds, from 0 s on
  TrajectoryBody body = TrajectoryBody::kCamera;
  std::vector<Bump> bumps;
};

/// What a thing of a user's own is, in labels; as ObjectClass (simulator/world) from floor on.
enum class MeshLabel { kFloor, kWall, kColumn, kRack, kGoods, kLuminaire, kFurniture };

/// A mesh of a user's own.
struct MeshSpec {
  Mark mark;         ///< of the key that names it
  std::string name;  ///< as the scene does; empty: none
  std::string file;  ///< where that is
};

/// Nodes of a mesh whose names match a pattern, and what they are.
struct LabelRule {
  std::string nodes;  ///< * stands for anything, ? for one character; upper case is as lower case
  MeshLabel label = MeshLabel::kFurniture;
};

enum class FloorKind { kConcrete, kPainted, kGlossy, kAsphalt, kResin, kBlocks };
enum class WallKind { kPanels, kBrick, kPlain, kSky, kCassettes, kInsulated, kConcrete };
enum class RoofKind { kTrusses, kPortal, kFlat, kRibs };

/// The building: a box on the floor z = 0. Walls of sky make it a place in the open: walls, roof
/// and lamps are then an overcast sky.
struct HallSpec {
  Mark mark;
  std::string use;  ///< the file whose hall this is, as the scene names it; empty: its own
  Eigen::Vector2d from = {-5, -8};  ///< the corner with the smallest x and y
  Eigen::Vector2d to = {20, 8};     ///< the corner with the largest x and y
  double height_m = 6.5;
  FloorKind floor = FloorKind::kConcrete;
  WallKind walls = WallKind::kPanels;
  RoofKind roof = RoofKind::kTrusses;
  double wear = 0.5;   ///< how stained and scratched the floor is, 0 to 1
  double clutter = 0;  ///< how much lies about where nobody passes, 0 to 1
  double cloud = 0;    ///< share of the daylight that passing clouds take at most
  double cloud_s = 9;  ///< about from one cloud to the next
  MeshSpec mesh;       ///< instead of floor, walls and roof
  std::vector<LabelRule> labels;
};

enum class RackPaint { kBlue, kOrange, kSteel };

/// A row of racking: bays side by side, from one end along its heading.
struct RackSpec {
  Mark mark;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< one end of the centre line
  double heading_rad = 0;
  int bays = 4;
  double bay_m = 2.7;
  double depth_m = 1.1;
  int levels = 3;  ///< of beams; goods stand on the floor too
  double level_m = 1.6;
  double fill = 0.85;  ///< share of the places that are taken
  GoodsKind goods = GoodsKind::kMixed;
  RackPaint paint = RackPaint::kBlue;  ///< of its posts
};

/// Goods on a pallet on the floor.
struct StackSpec {
  Mark mark;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double heading_rad = 0;
  double height_m = 1.2;  ///< of the goods above the pallet
  GoodsKind goods = GoodsKind::kCartons;
};

enum class ColumnKind { kSquare, kSteel, kRound };

struct ColumnSpec {
  Mark mark;
  ColumnKind kind = ColumnKind::kSquare;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double size_m = 0.4;
  bool striped = true;
};

/// A painted line, a hatched box or a crossing on the floor; or a pavement with its kerb.
struct MarkingSpec {
  Mark mark;
  enum class Kind { kLine, kBox, kCrossing, kPavement } kind = Kind::kLine;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double width_m = 0.1;
};

/// A piece of the kit: a model of assets/kit or assets/street that stands there. With `to`, a row
/// of them from `at` on.
struct PropSpec {
  Mark mark;
  Mark model_mark;  ///< of the key that names the model
  std::string model;
  MeshSpec mesh;  ///< instead of the model
  MeshLabel label = MeshLabel::kFurniture;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> to;
  double every_m = 10;  ///< in a row
  double heading_rad = 0;
  double above_m = 0;  ///< stands that high above the floor
};

/// A platform on columns over the floor, with a railing around it.
struct MezzanineSpec {
  Mark mark;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< corner with the smallest x and y
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< corner with the largest x and y
  double height_m = 2.8;                           ///< of its deck
};

enum class WallSide { kNorth, kSouth, kEast, kWest };  ///< +y, -y, +x, -x

struct DoorSpec {
  Mark mark;
  WallSide wall = WallSide::kEast;
  double at_m = 0;  ///< world x or y of its middle, along the wall
  double width_m = 3;
  double height_m = 3.5;
  double daylight = 0;  ///< radiance of the day outside where it stands open; 0: it is closed
};

/// What a hall has besides goods: machines, curtains, ducts.
enum class FixtureKind {
  kStripCurtain,
  kPanelWall,
  kEvaporator,
  kLathe,
  kMill,
  kDrill,
  kBench,
  kToolWall,
  kToolCart,
  kLocker,
  kGasBottles,
  kDuct,
  kCableTray,
  kCableDrop,
  kCrane,
  kLeveller,
  kGuideRail
};

struct FixtureSpec {
  Mark mark;
  FixtureKind kind = FixtureKind::kBench;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< its middle
  double heading_rad = 0;                        ///< where its front looks; its length lies across
  double length_m = 0;                           ///< 0: as such a thing usually is
  double height_m = 0;                           ///< its top, or where it hangs; 0: as usually
};

/// A time during which lamps are off.
struct Blackout {
  double from_s = 0;
  double to_s = 0;
};

/// A grid of luminaires over a rectangle.
struct LightsSpec {
  Mark mark;
  std::optional<Eigen::Vector2d> from, to;  ///< absent: over the whole hall
  int rows = 2;
  int per_row = 4;
  double height_m = 6;
  Eigen::Vector2d size_m = {1.5, 0.3};
  double brightness = 1;
  std::vector<Blackout> off;
};

/// How far a seed may change an actor.
struct VarySpec {
  double time_s = 0;  ///< start earlier or later by up to this
  double speed = 0;   ///< faster or slower by up to this share
  double path_m = 0;  ///< inner points of the path moved by up to this
  bool look = false;  ///< of a person: each seed shows another one
};

/// Whether an actor waits for the vehicle of a closed drive.
struct YieldSpec {
  bool yields = false;
  double within_m = 2;  ///< while the vehicle is that near and under way
};

/// What a person of the user's own brings.
struct CaptureSpec {
  MeshSpec bvh;         ///< a recorded motion, instead of the route's steps
  MeshSpec mesh;        ///< a skinned model, instead of `model`
  std::string clip;     ///< of the mesh's animations the one it plays; empty: the only one
  double stride_m = 0;  ///< way during one turn of that clip; 0: it plays by the clock
};

struct PersonSpec {
  Mark mark;
  std::size_t place = 0;  ///< in the file's list, whoever of it is left out
  std::string name;
  std::string model = "worker_anton";
  Mark model_mark;  ///< of the key that names it, or of the person
  CaptureSpec capture;
  Dynamics level = Dynamics::kLow;
  RouteSpec route;
  VarySpec vary;
  YieldSpec yields;
  int crowd = 0;         ///< which of the crowd it is, from 1; 0: one of the file's list
  double limp = 0;       ///< share by which the right leg's stance is shorter
  bool natural = false;  ///< leans as it speeds up and turns, and looks where it is going
};

struct VehicleSpec {
  Mark mark;
  std::size_t place = 0;  ///< in the file's list, whoever of it is left out
  std::string name;
  std::string model = "forklift";
  Mark model_mark;  ///< of the key that names it, or of the vehicle
  Dynamics level = Dynamics::kLow;
  RouteSpec route;
  VarySpec vary;
  std::vector<MastMove> mast;
  GoodsKind load = GoodsKind::kNothing;
  YieldSpec yields;
  std::string pushed_by;  ///< a person behind its handle: it has that person's route
  std::string towed_by;   ///< a vehicle whose way it follows, `behind_m` of that way behind it
  double behind_m = 0;
};

/// A place from which a hall is looked at, by a level camera unless it pitches.
struct ViewSpec {
  Mark mark;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double heading_rad = 0;
  double height_m = 1.4;
  double pitch_rad = 0;  ///< positive looks down
};

/// The building and all that stands still in it: what a hall's file holds.
struct Premises {
  HallSpec hall;
  std::vector<RackSpec> racks;
  std::vector<StackSpec> stacks;
  std::vector<ColumnSpec> columns;
  std::vector<MarkingSpec> markings;
  std::vector<PropSpec> props;
  std::vector<MezzanineSpec> mezzanines;
  std::vector<DoorSpec> doors;
  std::vector<FixtureSpec> fixtures;
  std::vector<LightsSpec> lights;
  std::vector<ViewSpec> views;
};

/// A scene file as a plain description. Angles are radians here and degrees in the file. A hall's
/// file is a scene, too: nobody is there, and the rig stands at each of its views, a frame each.
struct Scene : Premises {
  std::string file;
  /// That one and those it extends, nearest first, each hall's file behind them; then others.
  std::vector<std::string> files;
  std::vector<std::string> mesh_files;    ///< of them, the user's own meshes
  std::vector<std::string> motion_files;  ///< and recorded motions
  std::string extends;  ///< the scene whose keys hold where it has none, as the file says it
  std::string about;    ///< the sentence on what it tests
  int frames = 300;
  double rate_hz = 20;
  double dynamic_threshold_mps = 0.05;  ///< a surface faster than this moves
  Dynamics dynamics = Dynamics::kHigh;
  CameraSpec camera;
  SensorSpec sensor;
  RigSpec rig;
  DriveSpec drive;
  std::vector<std::string> varied_halls;  ///< files that seeds deal from, as the scene names them
  std::vector<Premises> dealt;            ///< what is there with each of them; empty: none varies
  std::vector<PersonSpec> people;
  std::vector<VehicleSpec> vehicles;
  std::vector<MechanismSpec> mechanisms;
  std::vector<BeamSpec> beams;
  CrowdSpec crowd;
  bool frozen = false;  ///< actors and beams stay as they are at time 0; lamps and clouds go on

  double duration_s() const { return frames / rate_hz; }
};

/// "file:line:column" of a mark in a scene's files.
std::string PlaceText(const std::vector<std::string>& files, Mark mark);

/// A camera that the scene describes, and the path of its keys.
struct DescribedCamera {
  std::string key;
  CameraSpec camera;
};
/// The scene's own and those of the rig's pairs that have one.
std::vector<DescribedCamera> DescribedCameras(const Scene& scene);

/// The same scene as the rig's pair of that name sees it; of "" as `camera` does.
Scene WithPair(Scene scene, const std::string& name);
/// The same scene with nobody in it; mechanisms stand still.
Scene WithoutActors(Scene scene);
/// The same scene with everybody standing where they are at time 0.
Scene Frozen(Scene scene);
/// The same scene with those actors only whose level is at most `dynamics`; mechanisms above it
/// stand still.
Scene WithDynamics(Scene scene, Dynamics dynamics);

}  // namespace aisle::sim
