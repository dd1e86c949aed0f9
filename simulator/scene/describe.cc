#include <limits>

#include "simulator/scene/degree.h"
#include "simulator/scene/extend.h"
#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

// What bodies and vehicles of each kind can do unless the file says less.
constexpr RouteLimits kAgvLimits = {.acceleration_mps2 = 0.5,
                                    .lateral_acceleration_mps2 = 0.6,
                                    .turn_rate_rad_s = 50 * kDegree,
                                    .turn_acceleration_rad_s2 = 90 * kDegree,
                                    .turns_on_the_spot = true,
                                    .curvature_rate_per_m_s = 3,
                                    .lateral_jerk_mps3 = 4};
constexpr RouteLimits kPersonLimits = {.acceleration_mps2 = 0.9,
                                       .lateral_acceleration_mps2 = 1.2,
                                       .turn_rate_rad_s = 110 * kDegree,
                                       .turn_acceleration_rad_s2 = 250 * kDegree,
                                       .turns_on_the_spot = true};
constexpr RouteLimits kVehicleLimits = {.acceleration_mps2 = 0.7,
                                        .lateral_acceleration_mps2 = 1.2,
                                        .turn_rate_rad_s = 45 * kDegree,
                                        .turn_acceleration_rad_s2 = 90 * kDegree,
                                        .turns_on_the_spot = false,
                                        .curvature_rate_per_m_s = 0.5,
                                        .lateral_jerk_mps3 = 4};

constexpr std::initializer_list<const char*> kDynamics = {"none", "low", "mid", "high"};

void DescribeCamera(Fields& f, CameraSpec& camera) {
  camera.mark = f.mark();
  f.Integers({"size_px", "width and height of the image", "[752, 480]"}, camera.size_px.data(), 2,
             kCameraRanges.size_px);
  f.Numbers({"focal_px", "focal lengths fx and fy", "[435.2, 435.2]"}, camera.focal_px.data(), 2,
            kCameraRanges.focal_px);
  f.Numbers(
      {"center_px", "principal point cx and cy; the first pixel's centre is 0", "[367.2, 252.2]"},
      camera.center_px.data(), 2, kCameraRanges.center_px);
  f.Number({"baseline_m", "distance between the two cameras", "0.12"}, &camera.baseline_m,
           kCameraRanges.baseline_m);
  f.Choice({"distortion", "distortion model of both lenses", "radial-tangential"},
           &camera.distortion, {"none", "radial-tangential", "equidistant"});
  f.Numbers({"distortion_coefficients",
             "distortion coefficients: k1 k2 p1 p2, or k1 k2 k3 k4 of an equidistant lens",
             "[-0.28, 0.07, 0, 0]"},
            camera.distortion_coefficients.data(), 4, {-10, 10});
  f.Flag({"colour", "exports have colour images beside the grey ones; systems see grey", "true"},
         &camera.colour);
}

void DescribeExposure(Fields& f, SensorSpec& sensor) {
  f.Number({"exposure_ms", "exposure time", "8"}, &sensor.exposure_ms, {0.01, 200});
  f.Number({"gain_db", "analogue gain, of light and noise", "3"}, &sensor.gain_db, {0, 48});
  f.Flag({"auto_exposure", "let the camera choose exposure and gain, frame by frame", "true"},
         &sensor.auto_exposure);
  f.Number({"auto_target_grey",
            "mean grey level that automatic exposure aims at, of the light alone; `black_level`, "
            "lifted in the shadows where the tone is companded, comes on top",
            "110"},
           &sensor.auto_target_grey, {10, 240});
  f.Number({"auto_meter_from",
            "share of the image's height, from the top, that is not metered: the sky", "0.5"},
           &sensor.auto_meter_from, {0, 0.9});
  f.Number({"auto_longest_ms", "longest automatic exposure; beyond it gain rises, to 12 dB", "12"},
           &sensor.auto_longest_ms, {0.2, 200});
  f.Number({"auto_step_ev", "step of the automatic exposure in stops; 0: continuous", "0.5"},
           &sensor.auto_step_ev, {0, 4});
  f.OnlyWith("auto_exposure",
             {"auto_target_grey", "auto_meter_from", "auto_longest_ms", "auto_step_ev"});
  f.Flag({"motion_blur", "integrate the light over the exposure time", "true"},
         &sensor.motion_blur);
  f.Number({"readout_ms", "rolling shutter: time from the first row to the last; 0: global shutter",
            "16"},
           &sensor.readout_ms, {0, 100});
}

void DescribePixels(Fields& f, SensorSpec& sensor) {
  f.Flag({"noise", "shot and read noise", "true"}, &sensor.noise);
  f.Flag({"fixed_pattern", "sensitivity and dark signal that differ from pixel to pixel", "true"},
         &sensor.fixed_pattern);
  f.Number({"sensitivity_e_per_ms", "electrons per millisecond that radiance 1 frees in a pixel",
            "226000"},
           &sensor.sensitivity_e_per_ms, {1, 1e8});
  f.Number({"full_well_e", "electrons per pixel at white, at 0 dB", "18400"}, &sensor.full_well_e,
           {100, 1e6});
  f.Number({"read_noise_e", "temporal noise in the dark, electrons rms", "20"},
           &sensor.read_noise_e, {0, 1000});
  f.Number({"prnu", "spread of the pixels' sensitivity about their mean, share rms", "0.01"},
           &sensor.prnu, {0, 0.2});
  f.Number({"dsnu_e", "spread of the pixels' dark signal about its mean, electrons rms", "10"},
           &sensor.dsnu_e, {0, 1000});
  f.Number({"black_level", "grey level of black, before the tone curve", "2.5"},
           &sensor.black_level, {0, 64});
  f.Choice({"tone", "tone curve from light to grey; companded: 12 to 10 bit as in the MT9V034",
            "linear"},
           &sensor.tone, {"linear", "companded"});
}

void DescribeLens(Fields& f, SensorSpec& sensor) {
  f.Number({"vignetting", "share of the light that is lost in the corners", "0.25"},
           &sensor.vignetting, {0, 0.9});
  f.Number({"blur_px", "standard deviation of the lens blur in the middle", "0.38"},
           &sensor.blur_px, {0, 5});
  f.Number({"field_blur_px", "blur that is added in the farthest corner, in quadrature", "0.505"},
           &sensor.field_blur_px, {0, 5});
  f.Number({"glare", "share of the light that veils the whole image", "0.04"}, &sensor.glare,
           {0, 0.5});
}

void DescribeSensor(Fields& f, SensorSpec& sensor) {
  f.Choice({"preset", "camera whose values hold for every key that is not given", "ideal"},
           &sensor.preset, {"mt9v034", "ideal"});
  sensor = MakeSensor(sensor.preset);
  sensor.mark = f.mark();
  DescribeExposure(f, sensor);
  DescribePixels(f, sensor);
  DescribeLens(f, sensor);
}
void DescribeStep(Fields& f, RouteStep& step, RouteSpec::StepMarks& marks) {
  marks.step = f.mark();
  f.Points({"go", "points to go through", "[[5, 0], [5, 3]]"}, &step.go, &marks.go);
  f.Number({"speed_mps", "cruising speed of this `go`", "0.9"}, &step.speed_mps, {0.02, 20});
  f.Number(
      {"corner_radius_m", "smallest radius in the corners of this `go`; 0: stop and turn", "0.5"},
      &step.corner_radius_m, {0, 1000});
  f.Flag({"reverse", "drive backwards", "true"}, &step.reverse);
  f.OptionalNumber({"wait_s", "time to stand still", "2.5"}, &step.wait_s, {0, 3600});
  std::optional<double> degrees;
  f.OptionalNumber({"turn_to_deg", "world heading to turn to on the spot", "90"}, &degrees,
                   {-360, 360});
  if (degrees) step.turn_to_rad = *degrees * kDegree;
  f.Name({"play", "clip that the model plays meanwhile", "wave"}, &step.play);
}

/// What vehicles cannot do at once.
void DescribeSteering(Fields& f, RouteLimits& limits) {
  f.Number({"curvature_rate_per_m_s", "steering: rate of change of the path's curvature, 1/(m s)",
            "0.5"},
           &limits.curvature_rate_per_m_s, {0.01, 1000});
  f.Number({"lateral_jerk_mps3", "rate of change of the lateral acceleration, m/s^3", "4"},
           &limits.lateral_jerk_mps3, {0.05, 1000});
  std::optional<double> jerk;
  f.OptionalNumber(
      {"jerk_mps3", "rate of change of the acceleration along the path, m/s^3; absent: unlimited",
       "4"},
      &jerk, {0.05, 1000});
  if (jerk) limits.jerk_mps3 = *jerk;
}

/// `unless` is a key in whose place the start may be missing.
void DescribeRoute(Fields& f, RouteSpec& route, const char* unless = nullptr) {
  route.mark = f.mark();
  f.Point({"start", "initial position, x and y in metres", "[0, 0]", true, unless},
          &route.plan.start);
  f.Degrees({"heading_deg", "initial heading, counter-clockwise from x", "90"},
            &route.plan.heading_rad);
  f.Number({"start_s", "time at which it sets out", "1.5"}, &route.plan.start_s, {0, 3600});
  f.Number({"acceleration_mps2", "acceleration and braking", "0.5"},
           &route.limits.acceleration_mps2, {0.05, 10});
  f.Number({"lateral_acceleration_mps2",
            "largest lateral acceleration, which limits the speed in corners", "0.8"},
           &route.limits.lateral_acceleration_mps2, {0.05, 10});
  f.Degrees({"turn_rate_deg_s", "highest turn rate", "45"}, &route.limits.turn_rate_rad_s,
            {1, 360});
  f.List(
      {"steps", "steps of the route, one after the other", "[{go: [[5, 0]], speed_mps: 0.9}]"},
      [&](std::size_t count) {
        route.plan.steps.resize(count);
        route.marks.resize(count);
      },
      [&](Fields& step, std::size_t i) {
        DescribeStep(step, route.plan.steps[i], route.marks[i]);
      });
}

void DescribeBump(Fields& f, Bump& bump) {
  f.Number({"at_s", "time of the bump", "4", true}, &bump.at_s, {0, 3600});
  f.Number({"height_m", "amplitude of the height", "0.01"}, &bump.height_m, {-0.2, 0.2});
  f.Degrees({"pitch_deg", "amplitude of the pitch", "0.6"}, &bump.pitch_rad, {-20, 20});
  f.Number({"frequency_hz", "frequency of the oscillation", "4"}, &bump.frequency_hz, {0.2, 50});
  f.Number({"decay_s", "time constant with which it decays", "0.25"}, &bump.decay_s, {0.02, 10});
}

/// Keys that name the calibration of a pair, of the rig's or of another one.
void DescribeCalibration(Fields& f, CalibrationSpec& calibration) {
  f.Sentence({"calibration",
              "a real rig's calibration, whose rectified pair is the camera: Kalibr's camchain, "
              "OpenCV's, KITTI's calib.txt, or the left camera's EuRoC sensor.yaml or ROS "
              "camera_info; instead of camera.focal_px, center_px and baseline_m",
              "camchain.yaml"},
             &calibration.left);
  f.Sentence({"calibration_right",
              "calibration of the right camera, or OpenCV's extrinsics, if that is a separate file",
              "right.yaml"},
             &calibration.right);
  calibration.left_mark = f.MarkOf("calibration");
  calibration.right_mark = f.MarkOf("calibration_right");
}

/// Where a pair sits on its vehicle.
void DescribeMount(Fields& f, RigMount& mount) {
  f.Number({"camera_height_m", "height of the left camera above the floor", "0.8"}, &mount.height_m,
           {0.05, 10});
  f.Number({"camera_forward_m", "distance of the left camera ahead of the axle", "0.3"},
           &mount.forward_m, {-5, 5});
  f.Number(
      {"camera_left_m", "distance of the left camera to the left of the axle's middle", "0.06"},
      &mount.left_m, {-5, 5});
  f.Degrees({"camera_pitch_deg", "pitch of the camera, positive down", "2"}, &mount.pitch_rad,
            {-60, 60});
  f.Degrees({"camera_yaw_deg", "yaw of the camera, positive to the left", "180"}, &mount.yaw_rad);
  f.Degrees({"camera_roll_deg", "roll of the camera, positive with its right side down", "1.5"},
            &mount.roll_rad, {-180, 180});
}

void DescribePair(Fields& f, PairSpec& pair) {
  pair.mark = f.mark();
  f.Name({"name", "name of the pair, for rig.pair and render --pair", "rear", true}, &pair.name);
  DescribeMount(f, pair.mount);
  pair.has_camera = f.Has("camera");
  f.Group({"camera", "cameras of the pair; absent: those of the scene", "{focal_px: [300, 300]}"},
          [&](Fields& part) { DescribeCamera(part, pair.camera); });
  DescribeCalibration(f, pair.calibration);
}

void DescribeRigFiles(Fields& f, RigSpec& rig) {
  DescribeCalibration(f, rig.calibration);
  f.Sentence(
      {"trajectory",
       "TUM file, or FILE.mcap:/topic of a bag, with the rig's trajectory, instead of start, steps "
       "and bumps: exactly its poses at its times, from the first on, and smooth in between",
       "drive.txt"},
      &rig.trajectory);
  rig.trajectory_mark = f.MarkOf("trajectory");
  f.Choice({"trajectory_of",
            "frame of these poses: camera (the left one; x right, y down, z ahead) or vehicle (x "
            "ahead, z up)",
            "vehicle"},
           &rig.body, {"camera", "vehicle"});
}

void DescribeRig(Fields& f, RigSpec& rig) {
  rig.mark = f.mark();
  rig.route.limits = kAgvLimits;
  DescribeMount(f, rig.mount);
  DescribeRigFiles(f, rig);
  f.ListOf(
      {"pairs", "more stereo pairs on the same vehicle", "[{name: rear, camera_yaw_deg: 180}]"},
      &rig.pairs, DescribePair);
  f.Name({"pair", "pair that systems are shown; absent: the rig's own", "rear"}, &rig.pair);
  rig.pair_mark = f.MarkOf("pair");
  if (f.Has("trajectory")) return;  // its poses are all of the motion
  DescribeRoute(f, rig.route, "trajectory");
  DescribeSteering(f, rig.route.limits);
  f.ListOf({"bumps", "jolts of the vehicle", "[{at_s: 4, height_m: 0.01}]"}, &rig.bumps,
           DescribeBump);
}

void DescribeVary(Fields& f, VarySpec& vary) {
  f.Number({"time_s", "largest shift of the start in time", "0.5"}, &vary.time_s, {0, 60});
  f.Number({"speed", "largest change of the speed, as a share", "0.1"}, &vary.speed, {0, 0.5});
  f.Number({"path_m", "largest shift of the path's points", "0.2"}, &vary.path_m, {0, 2});
}

/// Absent keys leave an actor as blind to the vehicle as its script is.
void DescribeYields(Fields& f, YieldSpec& yields) {
  f.Flag({"yields", "wait while the vehicle of a closed drive is near and moving", "true"},
         &yields.yields);
  f.Number({"yields_within_m", "distance from its footprint that counts as near", "2"},
           &yields.within_m, {0.1, 50});
}

void DescribePerson(Fields& f, PersonSpec& person) {
  person.mark = f.mark();
  person.route.limits = kPersonLimits;
  f.Name({"name", "name in labels and reports, unique", "walker", true}, &person.name);
  f.Name({"model", "file in assets/people, without .glb", "worker_anton"}, &person.model);
  person.model_mark = f.MarkOf("model");
  f.Choice({"level", "lowest level of dynamics at which the person is present", "low"},
           &person.level, kDynamics);
  DescribePersonFiles(f, person);
  DescribeRoute(f, person.route);
  DescribeYields(f, person.yields);
  f.Number({"limp", "share by which the right leg's stance is shorter", "0.3"}, &person.limp,
           {0, 0.7});
  f.Flag({"natural", "lean when accelerating and turning, and look ahead along the path", "true"},
         &person.natural);
  f.Group({"vary", "variation between seeds", "{time_s: 0.5, speed: 0.1, look: true}"},
          [&](Fields& vary) {
            DescribeVary(vary, person.vary);
            vary.Flag(
                {"look", "each seed shows another model of assets/people; seed 1 shows `model`",
                 "true"},
                &person.vary.look);
          });
}

void DescribeMast(Fields& f, MastMove& move) {
  f.Number({"at_s", "time at which the forks begin to move", "3", true}, &move.at_s, {0, 3600});
  f.Number({"height_m", "height of the forks above their start afterwards", "1.2", true},
           &move.height_m, {0, 6});
}

void DescribeVehicle(Fields& f, VehicleSpec& vehicle) {
  vehicle.mark = f.mark();
  vehicle.route.limits = kVehicleLimits;
  f.Name({"name", "name in labels and reports, unique", "truck", true}, &vehicle.name);
  f.Name({"model", "file in assets/vehicles, without .glb", "forklift"}, &vehicle.model);
  vehicle.model_mark = f.MarkOf("model");
  f.Choice({"level", "lowest level of dynamics at which the vehicle is present", "low"},
           &vehicle.level, kDynamics);
  DescribeRoute(f, vehicle.route);
  DescribeYields(f, vehicle.yields);
  DescribeSteering(f, vehicle.route.limits);
  f.Flag({"turns_on_the_spot", "turn on the spot, as a differential-drive vehicle does", "false"},
         &vehicle.route.limits.turns_on_the_spot);
  f.ListOf({"mast", "moves of the forks", "[{at_s: 3, height_m: 1.2}]"}, &vehicle.mast,
           DescribeMast);
  f.Name({"pushed_by", "person who holds its handle and whose route it follows", "fitter"},
         &vehicle.pushed_by);
  f.Name({"towed_by", "vehicle whose path it follows, as a trailer does", "tractor"},
         &vehicle.towed_by);
  f.Number({"behind_m",
            "with `towed_by`: distance between that vehicle's origin and its own, along the path",
            "1.78"},
           &vehicle.behind_m, {0, 100});
  f.OnlyWith("towed_by", {"behind_m"});
  f.Choice({"load", "goods on its forks", "cartons"}, &vehicle.load, kGoodsNames);
  f.Group({"vary", "variation between seeds", "{time_s: 0.5, speed: 0.1}"},
          [&](Fields& vary) { DescribeVary(vary, vehicle.vary); });
}

}  // namespace

void Fields::Degrees(const Key& key, double* radians, Range range) {
  double degrees = *radians / kDegree;
  Number(key, &degrees, range);
  *radians = degrees * kDegree;
}

void Fields::OptionalNumber(const Key& key, std::optional<double>* value, Range range) {
  // Not a number is in no range: what is absent has no default to tell of.
  double number = value->value_or(std::numeric_limits<double>::quiet_NaN());
  Number(key, &number, range);
  if (Has(key.name)) *value = number;
}

std::vector<GivenKey> Fields::Given(std::initializer_list<const char*> keys) const {
  std::vector<GivenKey> given;
  for (const char* key : keys) {
    if (Has(key)) given.push_back({key, MarkOf(key), "", 0});
  }
  return given;
}

void Fields::OptionalPoint(const Key& key, std::optional<Eigen::Vector2d>* value) {
  Eigen::Vector2d point = value->value_or(Eigen::Vector2d::Zero());
  Point(key, &point);
  if (Has(key.name)) *value = point;
}

void Describe(Fields& f, Scene& scene) {
  // A hall's file says where it is looked at from instead of who drives there.
  const bool drives = f.Has("rig") || !f.Has(kViewsKey);
  f.Sentence({kExtendKey,
              "scene file whose keys hold where this one has none, by its path from this file's "
              "folder or by its name among the scenes that come with the program; maps are merged "
              "key by key, lists are replaced",
              "paper/scene2"},
             &scene.extends);
  f.Sentence({"about", "one sentence on what the scene tests", "\"A person crosses.\"", true},
             &scene.about);
  f.Integer({"frames", "number of stereo pairs", "300"}, &scene.frames, {1, 100000});
  f.Number({"rate_hz", "stereo pairs per second", "20"}, &scene.rate_hz, {0.5, 200});
  f.Number({"dynamic_threshold_mps", "speed from which a surface counts as moving", "0.05"},
           &scene.dynamic_threshold_mps, {0.001, 1});
  f.Choice({"dynamics", "level of dynamics; actors above this level are absent", "high"},
           &scene.dynamics, kDynamics);
  f.Group({"camera", "the rectified stereo pair", "{baseline_m: 0.12}"},
          [&](Fields& part) { DescribeCamera(part, scene.camera); });
  f.Group({"sensor", "what the cameras do to the light", "{exposure_ms: 8}"},
          [&](Fields& part) { DescribeSensor(part, scene.sensor); });
  f.Group({"rig", "the vehicle that carries the cameras", "{start: [0, 0], steps: []}", drives},
          [&](Fields& part) { DescribeRig(part, scene.rig); });
  f.Group({"drive", "vehicle that the rig is, steered by the system's estimates", "{}"},
          [&](Fields& part) { DescribeDrive(part, scene.drive); });
  DescribePremises(f, scene);
  f.Group({kVaryKey, "variation between seeds", "{hall: [halls/new.yaml, halls/cold_store.yaml]}"},
          [&](Fields& vary) {
            vary.Sentences({"hall",
                            "files to draw the hall from: seed 1 has the first, each further seed "
                            "the next, cyclically; instead of hall.use",
                            "[halls/new.yaml, halls/cold_store.yaml]"},
                           &scene.varied_halls);
          });
  f.ListOf({"people", "people in the scene", "[{name: walker, start: [5, 2]}]"}, &scene.people,
           DescribePerson);
  f.ListOf({"vehicles", "vehicles in the scene", "[{name: truck, start: [9, 4]}]"}, &scene.vehicles,
           DescribeVehicle);
  f.ListOf({"mechanisms",
            "other moving objects: doors, chains, conveyors, things that are pushed and carried",
            "[{name: gate, at: [6, 1], parts: [{size_m: [0.1, 2, 2], joint: {kind: slider, "
            "moves: [{at_s: 3, to_m: 2}]}}]}]"},
           &scene.mechanisms, DescribeMechanism);
  f.ListOf({"beams", "moving lights: beacons, and sunlight through windows",
            "[{name: beacon, at_m: [7, 1.5, 2.2], rate_hz: 1.2}]"},
           &scene.beams, DescribeBeam);
  f.Group({"crowd", "people who walk to and fro and avoid one another",
           "{people: 12, in: [2, -1.2, 14, 1.2]}"},
          [&](Fields& part) { DescribeCrowd(part, scene.crowd); });
}

}  // namespace aisle::sim
