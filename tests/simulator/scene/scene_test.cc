#include "simulator/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "simulator/scene/load.h"
#include "tests/support/yaml_json.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path kScenes = fs::path(AISLE_SOURCE_DIR) / "scenes";
const fs::path kSchema = kScenes / "scene.schema.json";

const std::string kGood = R"(about: A person crosses.
frames: 100
rig:
  start: [0, 0]
  steps:
    - {go: [[8, 0]], speed_mps: 0.9}
hall: {from: [-5, -8], to: [20, 8], height_m: 6}
lights:
  - {rows: 2, per_row: 4, height_m: 5}
racks:
  - {from: [0, 3], bays: 4}
people:
  - name: walker
    start: [5, 1.5]
    heading_deg: -90
    steps:
      - {go: [[5, -1.5]], speed_mps: 1.2}
      - {wait_s: 1}
)";

std::vector<std::string> MessagesOf(const std::string& text) {
  try {
    ParseScene(text, "s.yaml");
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

/// The good scene with the first match of `what` replaced.
std::string With(const std::string& what, const std::string& by) {
  const std::size_t at = kGood.find(what);
  if (at == std::string::npos) throw std::invalid_argument("not in the good scene: " + what);
  std::string text = kGood.substr(0, at);
  text += by;
  text += kGood.substr(at + what.size());
  return text;
}

std::vector<fs::path> AllScenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kScenes)) {
    const bool is_suite = entry.path().parent_path().filename() == "suites";
    if (entry.path().extension() == ".yaml" && !is_suite) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

TEST(LoadScene, ReadsWhatIsWrittenAndKeepsDefaultsElsewhere) {
  const Scene scene = ParseScene(kGood, "s.yaml");
  EXPECT_EQ(scene.frames, 100);
  EXPECT_EQ(scene.rate_hz, 20);
  EXPECT_EQ(scene.camera.size_px[0], 752);
  ASSERT_EQ(scene.people.size(), 1u);
  EXPECT_EQ(scene.people[0].mark.line, 13);
  EXPECT_EQ(scene.people[0].route.marks[1].step.line, 18);
  EXPECT_DOUBLE_EQ(scene.people[0].route.plan.heading_rad, -std::numbers::pi / 2);
  EXPECT_EQ(scene.people[0].route.plan.steps[1].wait_s, 1.0);
}

TEST(LoadScene, EverySceneOfTheProjectIsGood) {
  const std::vector<fs::path> scenes = AllScenes();
  EXPECT_FALSE(scenes.empty());
  for (const fs::path& scene : scenes) EXPECT_THAT(CheckScene(scene), testing::IsEmpty());
}

TEST(LoadScene, EverySceneSaysWhatItTestsAndNamesItsSchema) {
  for (const fs::path& file : AllScenes()) {
    std::ifstream stream(file);
    std::string first;
    std::getline(stream, first);
    EXPECT_THAT(first, HasSubstr("yaml-language-server: $schema=../scene.schema.json")) << file;
    EXPECT_GT(LoadScene(file).about.size(), 30u) << file;
  }
}

TEST(SceneSchema, TheShippedFileIsTheReadersOwn) {
  if (std::getenv("AISLE_WRITE_SCHEMA") != nullptr) std::ofstream(kSchema) << SceneSchema();
  std::ifstream stream(kSchema);
  const std::string shipped((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_EQ(shipped, SceneSchema()) << "behind: cmake --build build/release --target reference";
}

TEST(SceneSchema, AnIndependentValidatorAcceptsEverySceneAndRefusesAMisspeltOne) {
  const nlohmann::json json = nlohmann::json::parse(SceneSchema());
  valijson::Schema schema;
  valijson::adapters::NlohmannJsonAdapter adapter(json);
  valijson::SchemaParser().populateSchema(adapter, schema);
  const auto accepts = [&](const YAML::Node& node) {
    const nlohmann::json document = test::ToJson(node);
    return valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(document),
                                          nullptr);
  };
  for (const fs::path& file : AllScenes()) EXPECT_TRUE(accepts(YAML::LoadFile(file))) << file;
  EXPECT_TRUE(accepts(YAML::Load(kGood)));
  EXPECT_FALSE(accepts(YAML::Load(With("frames:", "frame:"))));
  EXPECT_FALSE(accepts(YAML::Load(With("height_m: 6", "height_m: -6"))));
}

TEST(Routes, OfEverySceneObeyTheirVehiclesLimits) {
  const auto obeys = [](const RouteSpec& spec, const fs::path& file) {
    const Route route(spec.plan, spec.limits);
    const double h = 1e-4;
    for (double t = 0; t < std::min(route.duration_s(), 400.0); t += 0.05) {
      const RouteState now = route.At(t), next = route.At(t + h);
      const Eigen::Vector2d step = next.position - now.position;
      const double sideways =
          std::cos(now.heading_rad) * step.y() - std::sin(now.heading_rad) * step.x();
      EXPECT_NEAR(sideways / h, 0, 2e-2) << file << " at " << t;
      EXPECT_LE(std::abs(now.acceleration_mps2), spec.limits.acceleration_mps2 + 1e-9) << file;
      EXPECT_LE(std::abs(now.yaw_rate_rad_s), spec.limits.turn_rate_rad_s + 1e-9) << file;
      EXPECT_LE(std::abs(now.yaw_rate_rad_s * now.speed_mps),
                spec.limits.lateral_acceleration_mps2 + 1e-9)
          << file;
      if (!spec.limits.turns_on_the_spot) {
        EXPECT_TRUE(now.speed_mps != 0 || now.yaw_rate_rad_s == 0) << file;
      }
    }
  };
  for (const fs::path& file : AllScenes()) {
    const Scene scene = LoadScene(file);
    obeys(scene.rig.route, file);
    for (const PersonSpec& person : scene.people) obeys(person.route, file);
    for (const VehicleSpec& vehicle : scene.vehicles) obeys(vehicle.route, file);
  }
}

/// Everything of a scene that steers, by its name.
std::map<std::string, RouteSpec> SteeredRoutes(const fs::path& file) {
  const Scene scene = LoadScene(file);
  std::map<std::string, RouteSpec> routes = {{file.stem().string() + " rig", scene.rig.route}};
  for (const VehicleSpec& vehicle : scene.vehicles) {
    if (vehicle.pushed_by.empty() && vehicle.towed_by.empty()) {
      routes[file.stem().string() + " " + vehicle.name] = vehicle.route;
    }
  }
  return routes;
}

/// The times at which a route passes from one law to the next.
std::vector<double> Seams(const Route& route) {
  std::vector<double> seams;
  for (const Route::Leg& leg : route.legs()) {
    seams.push_back(leg.start_s);
    for (const auto& phase : leg.profile.phases()) seams.push_back(leg.start_s + phase.start_s);
    for (const Path::Segment& segment : leg.path.segments()) {
      double low = 0, high = leg.duration_s;
      for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (leg.profile.At(middle).distance_m < segment.start_m ? low : high) = middle;
      }
      seams.push_back(leg.start_s + high);
    }
  }
  seams.push_back(route.duration_s());
  return seams;
}

TEST(Routes, OfASteeredVehicleAskForNothingItsWheelCannotDo) {
  const auto drive = [](const std::string& steps, const std::string& vehicle) {
    return MessagesOf("about: A vehicle turns.\nrig: {start: [0, 0], steps: [" + steps +
                      "]}\nhall: {from: [-3, -6], to: [12, 9]}\n" +
                      "lights: [{height_m: 5}]\ndrive: {" + vehicle + "}\n");
  };
  const std::string corner = "{go: [[4, 0], [4, 4]], speed_mps: 0.8, corner_radius_m: 0.9}";
  const std::string spot = "{go: [[4, 0]], speed_mps: 0.8}, {turn_to_deg: 90}";
  EXPECT_THAT(drive(spot, "kind: tricycle"),
              ElementsAre(HasSubstr("rig.steps[1]: it would have to turn by 90 degrees on the "
                                    "spot, which this vehicle cannot; let it begin with "
                                    "heading_deg: 90, or round the corner")));
  EXPECT_THAT(drive(spot, "kind: differential"), IsEmpty());
  EXPECT_THAT(drive(spot, "kind: tricycle, max_steering_deg: 90"), IsEmpty());
  EXPECT_THAT(drive(corner, "kind: tricycle, wheelbase_m: 1.6, max_steering_deg: 45"),
              ElementsAre(HasSubstr("this vehicle's smallest is 1.6 m")));
  EXPECT_THAT(drive(corner, "kind: tricycle"), IsEmpty());
}

TEST(Routes, OfEveryVehicleNeitherSteerNorSpeedUpAtOnce) {
  constexpr double kAround_s = 2e-8;
  for (const fs::path& file : AllScenes()) {
    for (const auto& [name, spec] : SteeredRoutes(file)) {
      for (const double jerk : {spec.limits.jerk_mps3, 4.0}) {
        RouteLimits limits = spec.limits;
        limits.jerk_mps3 = jerk;
        const Route route(spec.plan, limits);
        for (const double seam : Seams(route)) {
          const RouteState before = route.At(seam - kAround_s), after = route.At(seam + kAround_s);
          const double t = seam;
          EXPECT_NEAR(before.curvature_per_m, after.curvature_per_m, 1e-6) << name << " " << t;
          EXPECT_NEAR(before.speed_mps, after.speed_mps, 1e-6) << name << " " << t;
          EXPECT_NEAR(before.yaw_rate_rad_s, after.yaw_rate_rad_s, 1e-6) << name << " " << t;
          EXPECT_NEAR(before.heading_rad, after.heading_rad, 1e-6) << name << " " << t;
          if (!std::isfinite(jerk)) continue;
          EXPECT_NEAR(before.acceleration_mps2, after.acceleration_mps2, 1e-6) << name << " " << t;
        }
      }
    }
  }
}

TEST(Routes, OfEveryVehicleKeepWithinSteeringJerkRadiusAndSpeed) {
  for (const fs::path& file : AllScenes()) {
    for (const auto& [name, spec] : SteeredRoutes(file)) {
      const Route route(spec.plan, spec.limits);
      double tightest = 1e9, fastest = 0;
      for (const RouteStep& step : spec.plan.steps) {
        if (step.corner_radius_m > 0) tightest = std::min(tightest, step.corner_radius_m);
        if (!step.go.empty()) fastest = std::max(fastest, step.speed_mps);
      }
      const double h = 1e-4;
      for (double t = 0; t < std::min(route.duration_s(), 400.0); t += 0.0103) {
        const RouteState before = route.At(t - h), now = route.At(t), after = route.At(t + h);
        const double steering = (after.curvature_per_m - before.curvature_per_m) / (2 * h);
        const double speed = std::abs(now.speed_mps);
        EXPECT_LE(std::abs(steering), spec.limits.curvature_rate_per_m_s * (1 + 1e-6)) << name;
        EXPECT_LE(speed * speed * std::abs(steering), spec.limits.lateral_jerk_mps3 * (1 + 1e-6))
            << name << " " << t;
        EXPECT_LE(std::abs(now.curvature_per_m), (1 + 1e-12) / tightest) << name << " " << t;
        EXPECT_LE(speed, fastest + 1e-12) << name << " " << t;
        if (speed > 0.01) {
          const double turned = after.heading_rad - before.heading_rad;
          const double driven = after.odometer_m - before.odometer_m;
          EXPECT_NEAR(turned / driven, now.curvature_per_m,
                      spec.limits.curvature_rate_per_m_s * h / speed + 1e-9)
              << name << " " << t;
          EXPECT_NEAR((after.position - before.position).norm(), std::abs(driven), 1e-8) << name;
        }
      }
    }
  }
}

TEST(Twins, DifferInTheirActorsAlone) {
  const Scene scene = ParseScene(kGood, "s.yaml");
  EXPECT_TRUE(WithoutActors(scene).people.empty());
  EXPECT_EQ(WithoutActors(scene).racks.size(), scene.racks.size());
  EXPECT_TRUE(Frozen(scene).frozen);
  EXPECT_EQ(WithDynamics(scene, Dynamics::kLow).people.size(), 1u);
  EXPECT_TRUE(WithDynamics(scene, Dynamics::kNone).people.empty());
}

struct Mistake {
  std::string what, by;     ///< edit of the good scene
  std::string place, text;  ///< what the one message must hold
};

void PrintTo(const Mistake& mistake, std::ostream* stream) {
  *stream << mistake.what << " -> " << mistake.by;
}

class OneMistake : public testing::TestWithParam<Mistake> {};

TEST_P(OneMistake, GivesOnePreciseMessage) {
  const Mistake& mistake = GetParam();
  EXPECT_THAT(MessagesOf(With(mistake.what, mistake.by)),
              ElementsAre(AllOf(HasSubstr("s.yaml:" + mistake.place), HasSubstr(mistake.text))));
}

INSTANTIATE_TEST_SUITE_P(
    Scene, OneMistake,
    testing::Values(
        Mistake{"frames: 100", "frame: 100", "2:1", "did you mean frames?"},
        Mistake{"frames: 100", "frames: 0100", "2:9", "expected an integer"},
        Mistake{"frames: 100", "frames: 1_00", "2:9", "expected an integer"},
        Mistake{"frames: 100", "frames: \"100\"", "2:9", "expected an integer"},
        Mistake{"frames: 100", "frames: 10.5", "2:9", "from 1 to 100000, got '10.5'"},
        Mistake{"frames: 100", "frames: 100\nframes: 200", "3:1", "duplicate key"},
        Mistake{"frames: 100", "frames: &n 100", "2:9", "anchors"},
        Mistake{"frames: 100", "frames: 100\n \ttwin: live", "3:2", "indented by a tab"},
        Mistake{"frames: 100", "frames: *n", "2:9", ""},
        Mistake{"about: A person crosses.\n", "", "1:1", "about: missing key"},
        Mistake{"start: [0, 0]", "start: [0]", "4:10", "expected a list of 2 numbers"},
        Mistake{"speed_mps: 0.9", "speed_mps: -1", "6:33", "rig.steps[0].speed_mps: expected"},
        Mistake{"go: [[8, 0]]", "go: [[8, 0, 1]]", "6:13", "a point [x, y]"},
        Mistake{"[[8, 0]], speed_mps: 0.9", "[[80, 0]]", "6:7", "runs into a wall or leaves"},
        Mistake{"[[8, 0]], speed_mps: 0.9", "[[8, 3]]", "6:7", "runs through racks[0]"},
        Mistake{"[[8, 0]], speed_mps: 0.9", "[[8, 0]], wait_s: 1", "6:7",
                "expected one of go, wait_s"},
        Mistake{"[[8, 0]], speed_mps: 0.9", "[[8, 0], [8, 1]], corner_radius_m: 5", "6:7",
                "a corner radius of 5 m does not fit"},
        Mistake{"[[8, 0]], speed_mps: 0.9", "[[8, 0], [8, 1.5], [4, 1.5]], corner_radius_m: 0.9",
                "6:7", "its corners need 1.8"},
        Mistake{"start: [0, 0]", "start: [0, 0]\n  jerk_mps3: 0", "5:14", "rig.jerk_mps3"},
        Mistake{"height_m: 6", "height_m: 4", "9:5", "above the roof"},
        Mistake{"height_m: 6", "height_m: -6", "7:47", "hall.height_m: expected a number from 2.2"},
        Mistake{"bays: 4", "bays: -4", "11:26", "racks[0].bays: expected an integer from 1"},
        Mistake{"bays: 4", "bays: 4, depth_m: -1", "11:38", "racks[0].depth_m: expected a number"},
        Mistake{"frames: 100", "frames: 100\ncamera: {size_px: [-752, 480]}", "3:19",
                "camera.size_px"},
        Mistake{"frames: 100", "frames: 100\ncamera: {distortion_coefficients: [-0.2, 0, 0, 0]}",
                "3:9", "without a distortion model"},
        Mistake{"frames: 100", "frames: 100\ncamera: {size_px: [320.9, 200]}", "3:19",
                "camera.size_px: expected a list of 2 integers from 64 to 4096"},
        Mistake{"start: [0, 0]",
                "start: [0, 0]\n  pairs:\n  - name: rear\n    camera: {distortion_coefficients: "
                "[-0.2, 0, 0, 0]}",
                "7:13", "rig.pairs[0].camera.distortion: distortion_coefficients without"},
        Mistake{"frames: 100", "frames: 100\nsensor: {readout_ms: 45}", "3:9",
                "frames are 50 ms apart"},
        Mistake{"frames: 100", "frames: 100\nsensor: {preset: perfect}", "3:18",
                "expected one of mt9v034, ideal"},
        Mistake{"to: [20, 8]", "to: [-20, 8]", "7:7", "must be at least 2 m beyond"},
        Mistake{"  - {rows: 2, per_row: 4, height_m: 5}", "  []", "9:3", "expected at least one"},
        Mistake{"lights:", "light:", "8:1", "did you mean lights?"},
        Mistake{"bays: 4", "bays: 40", "11:5", "is outside the hall"},
        Mistake{"bays: 4", "goods: apples", "11:27", "expected one of mixed, cartons"},
        Mistake{"name: walker", "name: ../etc", "13:11", "a name of letters"},
        Mistake{"name: walker", "level: low", "13:5", "people[0].name: missing key"},
        Mistake{"start: [5, 1.5]", "start: [5, 2.5]", "13:5", "people[0].start"},
        Mistake{"wait_s: 1", "wait_s: 1, play: \"a b\"", "18:27", "a name of letters"},
        Mistake{"go: [[5, -1.5]]", "go: [[3, 0]]", "17:9", "m from the rig, middle to middle"},
        Mistake{"    steps:\n      - {go: [[5, -1.5]], speed_mps: 1.2}\n      - {wait_s: 1}\n",
                "  - {name: bystander, start: [5.3, 1.5]}\n", "16:5", "0.30 m from walker"},
        Mistake{"    heading_deg: -90", "    vary: {path_m: 2}\n    heading_deg: -90", "18:9",
                "people[0]: with seed 8 "},
        Mistake{"people:", "persons:", "12:1", "unknown key"}));

SensorSpec SensorOf(const std::string& sensor) {
  return ParseScene(With("frames: 100", "frames: 100\n" + sensor), "s.yaml").sensor;
}

TEST(Sensor, WithoutAWordIsACameraThatOneCanBuy) {
  const SensorSpec sensor = SensorOf("");
  EXPECT_EQ(sensor.preset, SensorPreset::kMt9v034);
  EXPECT_EQ(sensor.full_well_e, 18400);
  EXPECT_GT(sensor.glare, 0);
}

TEST(Sensor, IdealIsSharpAndLinear) {
  const SensorSpec sensor = SensorOf("sensor: {preset: ideal}");
  EXPECT_EQ(sensor.tone, ToneSpec::kLinear);
  EXPECT_EQ(sensor.glare, 0);
  EXPECT_EQ(sensor.field_blur_px, 0);
  EXPECT_EQ(sensor.blur_px, 0.38);
  EXPECT_EQ(sensor.gain_db, 0);
  // What the white share a millisecond was before there were presets; its bits must not change.
  EXPECT_EQ(sensor.sensitivity_e_per_ms / sensor.full_well_e, 32.0);
}

TEST(Sensor, AKeyOverridesThePresetWhereverItStands) {
  for (const char* text : {"sensor: {preset: ideal, blur_px: 1.25, gain_db: 3}",
                           "sensor: {gain_db: 3, blur_px: 1.25, preset: ideal}"}) {
    const SensorSpec sensor = SensorOf(text);
    EXPECT_EQ(sensor.preset, SensorPreset::kIdeal);
    EXPECT_EQ(sensor.blur_px, 1.25);
    EXPECT_EQ(sensor.gain_db, 3);
    EXPECT_EQ(sensor.full_well_e, 10000);
  }
}

TEST(Mistakes, AreAllReportedInOneGo) {
  std::string text = With("frames: 100", "frames: many");
  text += "rate_hz: 0\nsensor: {noise: maybe}\n";
  EXPECT_THAT(MessagesOf(text), ElementsAre(HasSubstr("2:9: frames: expected an integer"),
                                            HasSubstr("19:10: rate_hz: expected a number"),
                                            HasSubstr("20:17: sensor.noise: expected true")));
}

TEST(Mistakes, KeysWithoutTheOneTheyNeedAreTold) {
  const auto sensor = [](const std::string& keys) {
    return MessagesOf("sensor: {" + keys + "}\n" + kGood);
  };
  EXPECT_THAT(
      sensor("auto_target_grey: 90, auto_step_ev: 0.5"),
      ElementsAre(HasSubstr("s.yaml:1:10: sensor.auto_target_grey: it has no effect without "
                            "`auto_exposure`; add that, or remove this"),
                  HasSubstr("sensor.auto_step_ev: it has no effect")));
  EXPECT_THAT(sensor("auto_meter_from: 0.4, auto_exposur: true"),
              ElementsAre(HasSubstr("unknown key; did you mean auto_exposure?")));
  // A scene may switch off what the one it extends has set.
  EXPECT_THAT(sensor("auto_longest_ms: 6, auto_exposure: false"), IsEmpty());
  EXPECT_THAT(MessagesOf(kGood + "props: [{model: drum, at: [9, -5], every_m: 2}]\n"),
              ElementsAre(HasSubstr("props[0].every_m: it has no effect without `to`")));
  EXPECT_THAT(MessagesOf(kGood + "vehicles: [{name: v, start: [9, -5], behind_m: 2}]\n"),
              ElementsAre(HasSubstr("vehicles[0].behind_m: it has no effect without `towed_by`")));
  EXPECT_THAT(MessagesOf(With("    start: [5, 1.5]\n", "    start: [5, 1.5]\n    clip: Walk\n")),
              ElementsAre(HasSubstr("people[0].clip: it has no effect without `mesh`")));
}

TEST(Mistakes, HostileFilesAreRefusedQuickly) {
  EXPECT_THAT(MessagesOf("&a [*a]"), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(MessagesOf(std::string(100'000, '[')), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(MessagesOf(""), ElementsAre(HasSubstr("expected a map")));
  EXPECT_THAT(MessagesOf("{a: 1} trailing"), testing::SizeIs(1));
  std::string many = "about: [";
  for (int i = 0; i < 200'000; ++i) many += "1,";
  EXPECT_THAT(MessagesOf(many + "]"), ElementsAre(HasSubstr("more than 100000 values")));
  EXPECT_THAT(CheckScene("nowhere.yaml"), ElementsAre(HasSubstr("no such file")));
}

}  // namespace
}  // namespace aisle::sim
