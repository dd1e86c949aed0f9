// What people get wrong, and what the program says: the whole message each time, exit code 4, and
// nothing left behind.
#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "harness/io/file.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

struct Case {
  std::vector<std::string> arguments;  ///< {d} is the folder of the files
  Files files;
  std::string message;
};

const std::string kSystemsEnd = "systems: [oracle]\n";
const std::string kGood = "suite: s\nquestion: q\nscenes: [short]\n" + kSystemsEnd;
const std::string kPoses = "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n";

/// The good suite with another line of systems.
Files WithSystem(const std::string& system) {
  return {{"s.yaml",
           kGood.substr(0, kGood.size() - kSystemsEnd.size()) + "systems: [" + system + "]\n"}};
}

Files WithEstimate(const std::string& estimate) { return {{"t.txt", kPoses}, {"e.txt", estimate}}; }

class BrokenInputTest : public ProgramTest {
 protected:
  std::string Fill(std::string text) const {
    const std::string folder = folder_.string();
    for (std::size_t at = 0; (at = text.find("{d}", at)) != std::string::npos;) {
      text.replace(at, 3, folder);
    }
    return text;
  }

  void Expect(const std::vector<Case>& cases) const {
    for (const Case& one : cases) {
      fs::remove_all(folder_);
      fs::create_directories(folder_);
      WriteFileAtomically(folder_ / "short.yaml", ReadFile(scene_));
      for (const auto& [name, text] : one.files) WriteFileAtomically(folder_ / name, text);
      std::vector<std::string> arguments;
      for (const std::string& argument : one.arguments) arguments.push_back(Fill(argument));
      if (arguments.front() == "run") {
        arguments.insert(arguments.end(), {"--out", (folder_ / "out").string()});
      }
      const Said said = Run(arguments, 30);
      EXPECT_EQ(said.code, 4) << said.text;
      EXPECT_EQ(said.text, Fill(one.message) + "\n");
      EXPECT_FALSE(fs::exists(folder_ / "out"));
    }
  }
};

TEST_F(BrokenInputTest, SuitesAndScenes) {
  const std::vector<std::string> run{"run", "{d}/s.yaml"};
  const std::string example = "example: command: my_slam {dataset} {output}";
  Expect({
      {{"run", "{d}/none.yaml"}, {}, "aisle: {d}/none.yaml: no such file"},
      {{"run", "smok"}, {}, "aisle: smok: no such file, scene or suite (did you mean smoke?)"},
      {{"render", "paper/scen2", "--out", "{d}/out"},
       {},
       "aisle: paper/scen2: no such file, scene or suite (did you mean "
       "paper/scene2?)"},
      {{"preview", "smok"}, {}, "aisle: smok: no such file, scene or suite (did you mean smoke?)"},
      {{"gallery", "smok"}, {}, "aisle: smok: no such file, scene or suite (did you mean smoke?)"},
      {{"vocabulary", "train", "smok", "--out", "{d}/out"},
       {},
       "aisle: smok: no such file, scene or suite (did you mean smoke?)"},
      {{"run", "{d}"}, {}, "aisle: {d}: is a folder; expected a file"},
      {run,
       {{"s.yaml", ""}},
       "aisle: {d}/s.yaml:1:1: expected a map of scene keys; example: about: \"A person "
       "crosses.\""},
      {run,
       {{"s.yaml", kGood + "seeds: [1, two]\n"}},
       "aisle: {d}/s.yaml:5:12: seeds: expected a number of seeds (1 to 1000), or a list of "
       "integers, got 'two' (number of seeds, from 1 on, or a list; each seed changes who walks, "
       "when, how fast and along which path); example: seeds: 3"},
      {run, WithSystem("{name: mine}"),
       "aisle: {d}/s.yaml:4:18: systems[0].name: it needs 'command', or 'like' with a built-in "
       "system"},
      {run, WithSystem("{name: mine, command: slam}"),
       "aisle: {d}/s.yaml:4:33: systems[0].command: the command must contain {output}; " + example},
      {run, WithSystem("{name: oracle, command: \"x {output}\"}"),
       "aisle: {d}/s.yaml:4:18: systems[0].name: 'oracle' is a built-in system; give the variant "
       "another name; example: {name: oracle_2, like: oracle, options: {feature.features: 800}}"},
      {run, WithSystem("{name: m, command: \"x {output}\", dataset: bag}"),
       "aisle: {d}/s.yaml:4:53: systems[0].dataset: expected one of euroc, kitti, got 'bag' "
       "(layout of the dataset that is exported for the command); example: dataset: euroc"},
      {run, WithSystem("{name: m, command: \"x {output}\", timeout_s: 0}"),
       "aisle: {d}/s.yaml:4:55: systems[0].timeout_s: expected a number of 0.001 or more, got '0' "
       "(seconds after which the command is stopped); example: timeout_s: 600"},
      {run, WithSystem("{name: m, contract: ros, command: x}"),
       "aisle: {d}/s.yaml:4:31: systems[0].contract: expected one of vslam-lab, vslam-lab-python, "
       "stream, got 'ros' (how the command is called; vslam-lab: as a system wrapped for "
       "VSLAM-LAB, unchanged; vslam-lab-python: the same, with arguments as --key value; stream: "
       "it receives frames on its stdin and answers each on its stdout, so that it can steer); "
       "example: contract: vslam-lab"},
      {run, WithSystem("{name: n, like: paper, mask_errors: {boundary_px: 1}}"),
       "aisle: {d}/s.yaml:4:18: systems[0].name: 'mask_errors' are for a system like oracle or "
       "semantic, which are told their masks"},
      {run, WithSystem("{name: n, like: paper, options: {keyframe.least_inliers: 20}}"),
       "aisle: {d}/s.yaml:4:18: systems[0].name: keyframe.least_inliers has no effect with base "
       "orbslam2; only base plain uses it"},
      {run, WithSystem("{name: n, like: oracle, mask_errors: {miss_share: 2}}"),
       "aisle: {d}/s.yaml:4:61: systems[0].mask_errors.miss_share: expected a number from 0 to 1, "
       "got '2' (share of the other objects that is missed, each for a while); example: "
       "miss_share: 0.05"},
      {run,
       {{"s.yaml", kGood + "limits: [{score: ate_rmse_m, system: paper, max: 1}]\n"}},
       "aisle: {d}/s.yaml:5:38: limits[0].system: expected one of oracle, got 'paper' (only for "
       "this system); example: system: oracle"},
      {{"run", "{d}/s.yaml", "--systems", "best"},
       {{"s.yaml", kGood}},
       "aisle: --systems: unknown name 'best': expected one of orbslam2, plain, semantic, paper, "
       "robust, oracle"},
      {{"run", "{d}/s.yaml", "--twins", "undead"},
       {{"s.yaml", kGood}},
       "aisle: --twins: unknown name 'undead': expected one of live, empty, frozen, "
       "none, low, mid, high"},
      {{"run", "{d}/s.yaml", "--shard", "3/2"},
       {{"s.yaml", kGood}},
       "aisle: --shard: expected I/N with 1 <= I <= N, for example 2/3, got '3/2'"},
      {{"check", "{d}/s.yaml"},
       {{"s.yaml", "suite: &a [*a]\n"}},
       "{d}/s.yaml:1:8: anchors (&name) are not allowed; write the value out"},
      {{"preview", "{d}/none.yaml", "-o", "{d}/x.png"}, {}, "aisle: {d}/none.yaml: no such file"},
      {{"bench", "light", "--foreign", "{d}/box.json"},
       {{"box.json", "{\"camera\": {\"type\": \"fisheye\"}, \"film\": {}}"}},
       "aisle: {d}/box.json: camera.type: 'fisheye' is not read, only 'perspective'"},
      {{"bench", "light", "--foreign", "{d}/box.json", "--reference", "{d}/box.png"},
       {{"box.json", "{}"}, {"box.png", ""}},
       "aisle: {d}/box.png: expected a .pfm or .exr file"},
      {{"bench", "dynamic", "paper/scene2:9-3"},
       {},
       "aisle: paper/scene2:9-3: expected SOURCE:FROM-TO, for example paper/scene2:90-130"},
      {{"bench", "accuracy", "paper/scene2", "paper/scene22"},
       {},
       "aisle: paper/scene22: not found: expected a scene (a file, or a name like paper/scene2) or "
       "a recording's folder"},
      {{"bench", "accuracy", "paper/scene2:90-95", "--starts", "9"},
       {},
       "aisle: paper/scene2:90-95: its last start would be frame 98, and it ends before frame 95: "
       "fewer --starts or a smaller --step"},
  });
}

/// Smaller than the SLAM takes: the recording's fault, not ours.
TEST_F(BrokenInputTest, ARecordingOfTinyImages) {
  const auto camera = [](const char* T) {
    return fmt::format(
        "camera_model: pinhole\nintrinsics: [30, 30, 16, 10]\nresolution: [33, 20]\n"
        "distortion_coefficients: [0, 0, 0, 0]\nT_BS:\n  data: [{}]\n",
        T);
  };
  const cv::Mat1b grey(20, 33, std::uint8_t{90});
  for (const char* name : {"cam0", "cam1"}) {
    const fs::path folder = fs::path(folder_) / "d/mav0" / name;
    fs::create_directories(folder / "data");
    cv::imwrite((folder / "data/1000000000.png").string(), grey);
    std::ofstream(folder / "data.csv") << "#timestamp [ns],filename\n1000000000,1000000000.png\n";
    std::ofstream(folder / "sensor.yaml")
        << camera(name == std::string("cam0") ? "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1"
                                              : "1,0,0,0.12,0,1,0,0,0,0,1,0,0,0,0,1");
  }
  const Said said = Run({"slam", Fill("{d}/d"), "-o", Fill("{d}/o")}, 30);
  EXPECT_EQ(said.code, 4) << said.text;
  EXPECT_THAT(said.text, testing::HasSubstr(Fill(
                             "aisle: {d}/d: StereoSlam: camera is 33x20 pixels; at least 64x64 are "
                             "needed")));
}

TEST_F(BrokenInputTest, ReportsPartsAndRuns) {
  Expect({
      {{"report", "{d}"}, {}, "aisle: {d}/results.json: no such file"},
      {{"report", "{d}"},
       {{"results.json", "{\"schema\": 99}"}},
       "aisle: {d}/results.json: not a results file: schema is not 1"},
      {{"merge", "{d}/o", "{d}"},
       {{"plan.json", "[]"}},
       "aisle: {d}/plan.json: not a plan: [json.exception.type_error.304] cannot use at() with "
       "array"},
      {{"rerun", "a/b/c/1", "--in", "{d}/gone"}, {}, "aisle: {d}/gone/plan.json: no such file"},
      {{"compare", "{d}/a.json", "{d}/b.json"},
       {{"b.json", "{}"}},
       "aisle: {d}/a.json: no such file"},
  });
}

TEST_F(BrokenInputTest, TrajectoriesMasksAndRecordings) {
  const std::vector<std::string> score{"score", "--truth", "{d}/t.txt", "--estimate", "{d}/e.txt"};
  Expect({
      {{"score", "--truth", "{d}/t.txt"},
       {{"t.txt", kPoses}},
       "aisle: expected --truth and --estimate, or --masks-truth and --masks"},
      {score, {{"t.txt", kPoses}}, "aisle: {d}/e.txt: no such file"},
      {score, WithEstimate(""), "aisle: {d}/e.txt: no poses in this file"},
      {score, WithEstimate("0 0 0 0 0 0 0 1\n1 nan 0 0 0 0 0 1\n"),
       "aisle: {d}/e.txt:2: field 2 is nan: poses must be finite"},
      {score, WithEstimate("0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 0\n"),
       "aisle: {d}/e.txt:2: the quaternion has norm 0, not 1: check the order of the columns"},
      {score, WithEstimate("1 0 0 0 0 0 0 1\n0 1 0 0 0 0 0 1\n"),
       "aisle: {d}/e.txt:2: stamp 0 is earlier than on the previous line (1): sort the file"},
      {{"score", "--truth", "{d}/t.txt", "--estimate", "{d}/e.txt", "--format", "tum"},
       WithEstimate("0 0 0 0\n"),
       "aisle: {d}/e.txt:1: 4 fields; a TUM line has 8: timestamp tx ty tz qx qy qz qw"},
      {{"score", "--truth", "{d}/t.txt", "--estimate", "{d}/e.txt", "--delta", "1.5"},
       WithEstimate(kPoses),
       "aisle: delta = 1.5: frames are whole"},
      {score, WithEstimate("0 1e300 0 0 0 0 0 1\n"),
       "aisle: {d}/e.txt:1: field 2 is 1e300: positions must be in metres and within 1e+08 of the "
       "origin"},
      {{"score", "--masks-truth", "{d}/none", "--masks", "{d}/none"},
       {},
       "aisle: {d}/none: no PNG images in this folder"},
      {{"slam", "{d}", "-o", "{d}/o.txt"},
       {},
       "aisle: {d}: not a dataset: EuRoC's has cam0 and cam1 (sensor.yaml, data.csv, data), here "
       "or in mav0, KITTI's has calib.txt, times.txt, image_0 and image_1, a ROS 2 bag has "
       "metadata.yaml; this folder has short.yaml"},
      {{"slam", "{d}", "-o", "{d}/o.txt", "--system", "oracle"},
       {},
       "aisle: system 'oracle' needs the truth about moving objects, which a recording does not "
       "have"},
      {{"slam", "{d}", "-o", "{d}/o.txt", "--system", "best"},
       {},
       "aisle: unknown system 'best': expected one of orbslam2, plain, semantic, paper, "
       "robust, oracle"},
  });
}

TEST_F(BrokenInputTest, NumbersThatAreNoneOrTooLarge) {
  WriteFileAtomically(folder_ / "t.txt", kPoses);
  const std::string poses = (folder_ / "t.txt").string();
  const std::vector<std::string> score{"score", "--truth", poses, "--estimate", poses};
  const std::pair<const char*, const char*> wrong[] = {
      {"--delta", "nan"},          {"--delta", "1e30"},        {"--delta", "-1"},
      {"--max-difference", "nan"}, {"--max-difference", "-1"}, {"--max-difference", "1e30"},
      {"--rate", "nan"},           {"--rate", "inf"}};
  for (const auto& [option, value] : wrong) {
    std::vector<std::string> arguments = score;
    arguments.insert(arguments.end(), {option, value});
    const Said said = Run(arguments, 30);
    EXPECT_EQ(said.code, 4) << option << " " << value << ": " << said.text;
    EXPECT_THAT(said.text, testing::HasSubstr(option));
  }
  std::vector<std::string> far = score;
  far.insert(far.end(), {"--delta", "1e9"});  // whole, and beyond every file
  EXPECT_EQ(Run(far, 30).code, 0);
  const Said file = Run({"run", scene_, "--out", poses}, 30);
  EXPECT_EQ(file.code, 4);
  EXPECT_THAT(file.text, testing::HasSubstr("t.txt: is a file; expected a folder for the report"));
  const Said below = Run({"run", scene_, "--out", poses + "/night"}, 30);
  EXPECT_EQ(below.code, 4);
  EXPECT_THAT(below.text, testing::HasSubstr("t.txt/night: is a file or lies below one"));
}

/// Before the scene is looked at, whose light takes half a minute: it is broken, too.
TEST_F(BrokenInputTest, FramesToRenderAreReadFirst) {
  const Files files = {{"broken.yaml", "rate_hz: quick\n"}};
  const auto render = [](const std::string& frames) {
    return std::vector<std::string>{"render",  "{d}/broken.yaml", "--out",
                                    "{d}/out", "--frames",        frames};
  };
  Expect({{render("1"), files, "aisle: --frames 1: expected A:B, for example 100:200"},
          {render("a:b"), files, "aisle: --frames a:b: expected A:B, for example 100:200"},
          {render("5:2"), files, "aisle: --frames 5:2: selects nothing"}});
  const Said beyond =
      Run({"render", scene_, "--out", (folder_ / "out").string(), "--frames", "99:"});
  EXPECT_EQ(beyond.code, 4);
  EXPECT_THAT(beyond.text,
              testing::HasSubstr("--frames: no frames from 99 on; the scene has 0 to 11"));
  const Said longer =
      Run({"render", scene_, "--out", (folder_ / "out").string(), "--frames", "5:300"});
  EXPECT_EQ(longer.code, 4);
  EXPECT_THAT(longer.text,
              testing::HasSubstr("the scene ends before frame 300; it has 12 frames: use 5:12"));
}

TEST_F(BrokenInputTest, HostileNamesDoNoHarm) {
  for (const std::string& name : {std::string("\"><script>alert(1)</script>"), std::string("a\nb"),
                                  std::string("'; rm -rf x"), std::string("$(touch pwned)")}) {
    const fs::path scene = folder_ / "scenes" / name / "x.yaml";
    WriteFileAtomically(scene, ReadFile(scene_));
    const std::string out = Out("hostile");
    const Said said = Run({"run", scene.string(), "--systems", "plain", "--out", out});
    EXPECT_EQ(said.code, 0) << said.text;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
      if (entry.path().extension() != ".html") continue;
      EXPECT_THAT(ReadFile(entry.path()), testing::Not(testing::HasSubstr("<script>")));
    }
    EXPECT_FALSE(fs::exists("pwned"));
    fs::remove_all(folder_);
  }
  for (const char* command : {"run", "check", "preview", "report"}) {
    const Said endless = Run({command, std::string(5000, 'n')});
    EXPECT_EQ(endless.code, 4) << command << ": " << endless.text;
  }
  WriteFileAtomically(folder_ / "s.yaml", "suite: s\nquestion: q\nscenes: [" +
                                              std::string(5000, 'n') + "]\nsystems: [plain]\n");
  EXPECT_EQ(Run({"run", (folder_ / "s.yaml").string(), "--dry-run"}).code, 4);
  const Said above = Run({"rerun", "../../../etc/passwd", "--in", Out("none")});
  EXPECT_EQ(above.code, 4) << above.text;
}

}  // namespace
}  // namespace aisle
