// What arguments lead to, without starting the program.
#include "harness/cli/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "harness/io/file.h"
#include "harness/io/trajectory.h"
#include "harness/record/results.h"
#include "tests/harness/cli/exit.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The commands that `words` choose, outermost first; empty where they are refused.
std::vector<std::string> Chosen(const std::string& words, Action* action) {
  CLI::App app;
  app.require_subcommand(1);
  AddCommands(&app, action);
  try {
    app.parse(words);
  } catch (const CLI::ParseError&) {
    return {};
  }
  std::vector<std::string> names;
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    names.push_back(at->get_name());
  }
  return names;
}

TEST(CommandLineTest, AMisspeltCommandIsToldFromAMissingOne) {
  std::string said;
  EXPECT_EQ(Exit({"rnu"}, &said), kBadInput);
  EXPECT_THAT(said, testing::StartsWith("unknown command 'rnu' (did you mean run?)"));
  EXPECT_EQ(Exit({}, &said), kBadInput);
  EXPECT_THAT(said, testing::StartsWith("A subcommand is required"));
  EXPECT_EQ(Exit({"run", "--no-such-option"}, &said), kBadInput);
  EXPECT_THAT(said, testing::Not(HasSubstr("unknown command")));
}

TEST(CommandLineTest, AMisspeltOptionIsToldWithTheOneThatIsNear) {
  std::string said;
  EXPECT_EQ(Exit({"run", "smoke", "--sytems", "robust"}, &said), kBadInput);
  EXPECT_THAT(said,
              testing::StartsWith("unknown option '--sytems' for 'run' (did you mean --systems?)"));
  EXPECT_EQ(Exit({"bench", "slam", "--tiwn=live"}, &said), kBadInput);
  EXPECT_THAT(
      said, testing::StartsWith("unknown option '--tiwn' for 'bench slam' (did you mean --twin?)"));
  EXPECT_EQ(Exit({"check", "a.yaml", "--", "--more"}, &said), kBadInput);
  EXPECT_EQ(Exit({"run", "smoke", "--qqqqqqqqqqqq"}, &said), kBadInput);
  EXPECT_THAT(said, testing::StartsWith("unknown option '--qqqqqqqqqqqq' for 'run'\n"));
}

TEST(CommandLineTest, ACommandThatIsChosenLeavesSomethingToDo) {
  for (const std::string words :
       {"report out", "compare a b", "check a.yaml", "bench slam", "rerun a/b/c/1 --in out"}) {
    Action action;
    EXPECT_EQ(Chosen(words, &action).front(), words.substr(0, words.find(' ')));
    EXPECT_TRUE(action) << words;
  }
}

/// "bench light: " of a command that a user is shown, and has no example; of those below it too.
std::string WithoutExample(const CLI::App& command, const std::string& above) {
  std::string names;
  for (const CLI::App* below : command.get_subcommands({})) {
    if (below->get_group().empty()) continue;  // not for people
    const std::string name = above + below->get_name();
    if (below->get_footer().find("Example: ") == std::string::npos &&
        below->get_subcommands({}).empty()) {
      names += name + ": ";
    }
    names += WithoutExample(*below, name + " ");
  }
  return names;
}

TEST(CommandLineTest, EveryCommandHasAnExampleOfItself) {
  Action action;
  CLI::App app;
  AddCommands(&app, &action);
  EXPECT_EQ(WithoutExample(app, ""), "");
}

TEST(CommandLineTest, AssetsThatAreNowhereAreOneErrorWhereverTheyAreAskedFor) {
  const char* before = std::getenv("AISLE_ASSETS");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("AISLE_ASSETS", "/no/such/folder", 1);
  std::string said;
  EXPECT_EQ(Exit({"run", "quickstart"}, &said), kBadInput);  // looked up while arguments are read
  EXPECT_THAT(said, HasSubstr("set AISLE_ASSETS"));
  before == nullptr ? ::unsetenv("AISLE_ASSETS") : ::setenv("AISLE_ASSETS", kept.c_str(), 1);
}

TEST(CommandLineTest, ABenchIsACommandOfItsOwn) {
  Action action;
  EXPECT_THAT(Chosen("bench dynamic paper/scene2:90-130 --warm-up 3", &action),
              testing::ElementsAre("bench", "dynamic"));
}

TEST(CommandLineTest, WhatIsRefusedLeavesNothingToDo) {
  for (const char* words : {"", "nonsense", "bench", "bench dynamic --every 0", "compare a",
                            "bench dynamic --debug-dynamic", "report"}) {
    Action action;
    EXPECT_TRUE(Chosen(words, &action).empty()) << words;
    EXPECT_FALSE(action) << words;
  }
}

/// Calls `look` for each command below `app`, with the words that choose it.
void ForEachCommand(
    const CLI::App& app, const std::vector<std::string>& words,
    const std::function<void(const std::vector<std::string>&, const CLI::App&)>& look) {
  for (const CLI::App* command : app.get_subcommands({})) {
    std::vector<std::string> longer = words;
    longer.push_back(command->get_name());
    look(longer, *command);
    ForEachCommand(*command, longer, look);
  }
}

/// Gives each of the texts to every option of that type, of all commands; each is refused by `why`.
/// Returns how many were asked.
std::size_t AskEveryOption(const std::string& type, const std::vector<std::string>& texts,
                           const std::string& why) {
  CLI::App app;
  Action action;
  AddCommands(&app, &action);
  std::size_t asked = 0;
  ForEachCommand(app, {}, [&](const std::vector<std::string>& words, const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
      if (!option->get_type_name().starts_with(type)) continue;
      for (const std::string& text : texts) {
        std::vector<std::string> all = words;
        all.push_back(option->get_name() + "=" + text);
        std::string said;
        EXPECT_EQ(Exit(all, &said), kBadInput) << testing::PrintToString(all);
        EXPECT_THAT(said, HasSubstr(option->get_name() + ": " + why + ", got '" + text + "'"));
        ++asked;
      }
    }
  });
  return asked;
}

TEST(CommandLineTest, EveryTextOfHelpStandsAlone) {
  CLI::App app;
  Action action;
  AddCommands(&app, &action);
  const auto stands_alone = [](const std::string& text) {
    return !text.empty() && std::isupper(static_cast<unsigned char>(text.front())) != 0 &&
           text.back() != '.';
  };
  ForEachCommand(app, {}, [&](const std::vector<std::string>& words, const CLI::App& command) {
    const std::string name = testing::PrintToString(words);
    EXPECT_TRUE(stands_alone(command.get_description())) << name << command.get_description();
    for (const CLI::Option* option : command.get_options()) {
      EXPECT_TRUE(stands_alone(option->get_description()))
          << name << option->get_name() << ": " << option->get_description();
    }
  });
}

TEST(CommandLineTest, NoSeedIsReadAsAnother) {
  const std::vector<std::string> texts = {"-1", "18446744073709551616", "1.5", "0x10", "+5", " 5",
                                          "5 "};
  EXPECT_GE(AskEveryOption("UINT", texts, "expected an integer in [0, 18446744073709551615]"),
            5u * 7u);  // run, render, preview, gallery and bisect have some
}

TEST(CommandLineTest, NoIntegerIsReadAsC) {
  EXPECT_GE(AskEveryOption("INT", {"0x10", "+5", " 5", "5 ", "1.5"}, "expected an integer"),
            5u * 5u);  // run, rerun, slam, vocabulary and gallery have some
  AskEveryOption("INT", {"9223372036854775808"},
                 "expected an integer in [-9223372036854775808, 9223372036854775807]");
}

/// C would read 010 as 8, and 09 not at all.
TEST(CommandLineTest, ZerosInFrontOfANumberChangeNothing) {
  CLI::App app;
  Action action;
  AddCommands(&app, &action);
  for (const std::string text : {"010", "10"}) {
    app.parse("run smoke --threads " + text + " --seed 09," + text);
    const CLI::App& run = *app.get_subcommand("run");
    EXPECT_EQ(run.get_option("--threads")->as<int>(), 10) << text;
    EXPECT_THAT(run.get_option("--seed")->as<std::vector<std::uint64_t>>(),
                testing::ElementsAre(9, 10))
        << text;
  }
}

TEST(CommandLineTest, NoOptionTakesWhatIsNoFiniteNumber) {
  EXPECT_GE(AskEveryOption("FLOAT", {"nan", "inf", "-inf", "1e999", "0x10", " 5"},
                           "expected a finite number"),
            6u * 8u);  // run, rerun, bisect, preview and score have some
  EXPECT_EQ(Exit({"preview", "smoke/bits", "--time", "1e300"}), kBadInput);
}

TEST(CommandLineTest, AViewWithoutFramesHasNoTable) {
  std::string said;
  EXPECT_EQ(Exit({"bench", "sensitivity", "smoke/bits:5000-5001", "--only",
                  "dynamic.robust.field.memory"},
                 &said),
            kBadInput);
  EXPECT_THAT(said,
              HasSubstr("smoke/bits:5000-5001: it ends before frame 5001; its frames are 0 to 7"));
}

TEST(CommandLineTest, HelpIsNoErrorAndWrongUsageIs) {
  std::string said;
  EXPECT_EQ(Exit({"--help"}, &said), kAllPassed);
  EXPECT_THAT(said, HasSubstr("Exit codes: 0 all passed"));
  EXPECT_EQ(Exit({"--version"}), kAllPassed);
  EXPECT_EQ(Exit({"bench", "slam", "--help"}), kAllPassed);
  EXPECT_EQ(Exit({}), kBadInput);
  EXPECT_EQ(Exit({"nonsense"}), kBadInput);
  EXPECT_EQ(Exit({"bench", "slam", "--laps", "0"}), kBadInput);
}

TEST(CommandLineTest, BadFilesAreBadInputAndAreNamed) {
  std::string said;
  EXPECT_EQ(Exit({"report", "/nowhere/at/all"}, &said), kBadInput);
  EXPECT_EQ(said, "aisle: /nowhere/at/all/results.json: no such file\n");
  EXPECT_EQ(Exit({"check", "/nowhere/at/all.yaml"}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("/nowhere/at/all.yaml"));
  EXPECT_EQ(Exit({"bench", "dynamic", "paper/scene2:9-3"}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("paper/scene2:9-3: expected SOURCE:FROM-TO"));
}

TEST(CommandLineTest, ABrokenVerdictIsTheExitCodeOfAReport) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_cli_{}", ::getpid());
  const auto code_of = [&](bool passed) {
    Results results;
    results.suite = "nightly";
    results.verdicts = {{.name = "a limit", .passed = passed, .why = "so"}};
    WriteFileAtomically(folder / "results.json", ToJson(results));
    return Exit({"report", folder.string()});
  };
  EXPECT_EQ(code_of(true), kAllPassed);
  EXPECT_EQ(code_of(false), kVerdictFailed);
  fs::remove_all(folder);
}

TEST(CommandLineTest, NothingToCompareIsSaid) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_cli_none_{}", ::getpid());
  WriteFileAtomically(folder / "results.json", ToJson(Results{}));
  EXPECT_EQ(Exit({"compare", folder.string(), folder.string()}), kNothingToDo);
  fs::remove_all(folder);
}

TEST(CommandLineTest, MetresAreNotComparedWithMillimetres) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_cli_mm_{}", ::getpid());
  const auto write = [&](const std::string& name, const std::string& unit) {
    Results results;
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      RunRecord& run = results.runs.emplace_back();
      run.spec = {.scene = "s",
                  .scene_file = "",
                  .twin = "live",
                  .system = BuiltIn("oracle"),
                  .seed = seed};
      run.scores["ate_rmse_m"] = {
          .value = 0.02, .unit = unit, .alignment = "se3", .n = 9, .absent = ""};
    }
    WriteFileAtomically(folder / name, ToJson(results));
    return (folder / name).string();
  };
  const std::string metres = write("m.json", "m"), millimetres = write("mm.json", "mm");
  std::string said;
  EXPECT_EQ(Exit({"compare", metres, metres}), kAllPassed);
  EXPECT_EQ(Exit({"compare", metres, millimetres}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("mm.json: ate_rmse_m of the run s/live/oracle/1 has the unit 'mm'"));
  EXPECT_EQ(Exit({"compare", millimetres, metres}), kBadInput);
  fs::remove_all(folder);
}

/// A folder of its own, and what `score` says of files in it.
class ScoreTest : public testing::Test {
 protected:
  ScoreTest() { fs::create_directories(folder_); }
  ~ScoreTest() override { fs::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text);
    return (folder_ / name).string();
  }
  /// A bent drive, seen at 20 Hz.
  static Trajectory Drive() {
    Trajectory drive;
    for (int k = 0; k < 200; ++k) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() << 0.05 * k, std::sin(0.05 * k), 0;
      drive.push_back({k * 50'000'000LL, pose});
    }
    return drive;
  }
  static std::string Times() {
    std::string times;
    for (const StampedPose& pose : Drive()) times += FormatSeconds(pose.stamp_ns) + "\n";
    return times;
  }
  std::string Kitti(const std::string& name) const {
    return Write(name, FormatTrajectory(Drive(), TrajectoryFormat::kKitti));
  }
  std::string Tum(const std::string& name) const {
    return Write(name, FormatTrajectory(Drive(), TrajectoryFormat::kTum));
  }
  /// The error of equal poses is none.
  static void ExpectNoError(std::vector<std::string> more) {
    more.insert(more.begin(), "score");
    more.emplace_back("--json");
    std::string said;
    ASSERT_EQ(Exit(more, &said), kAllPassed) << said;
    const std::size_t end = said.rfind('}') + 1;  // what is said on stderr comes behind
    const auto scores = nlohmann::json::parse(said.substr(0, end)).at("scores");
    EXPECT_LT(scores.at("ate_rmse_m").at("value").get<double>(), 1e-9);
    EXPECT_EQ(scores.at("coverage").at("value").get<double>(), 1);
  }

  const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("aisle_cli_score_{}", ::getpid());
};

TEST_F(ScoreTest, KittiFilesAreNeverStampedByAGuessBesideStamps) {
  const std::string truth = Kitti("truth.txt"), estimate = Tum("slam.txt");
  std::string said;
  EXPECT_EQ(Exit({"score", "--truth", truth, "--estimate", estimate}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("--times"));
  EXPECT_EQ(Exit({"score", "--truth", estimate, "--estimate", truth}), kBadInput);
  ExpectNoError({"--truth", truth, "--estimate", estimate, "--times", Write("t.txt", Times())});
  ExpectNoError({"--truth", truth, "--estimate", Kitti("other.txt")});  // by their rows
}

TEST_F(ScoreTest, TimesOfTheBenchmarksLayoutAreFound) {
  const std::string truth = Kitti("data/poses/07.txt");
  Write("data/sequences/07/times.txt", Times());
  ExpectNoError({"--truth", truth, "--estimate", Tum("slam.txt")});
}

TEST_F(ScoreTest, NanosecondsAsRealNumbersAreStamps) {
  std::string orb;
  Trajectory truth = Drive();
  for (StampedPose& pose : truth) {
    pose.stamp_ns += 1403636579763555584;
    const Eigen::Vector3d& p = pose.T_world_rig.translation();
    orb += fmt::format("{}.000000 {} {} {} 0.0 0.0 0.0 1.0\n", pose.stamp_ns, p.x(), p.y(), p.z());
  }
  ExpectNoError({"--truth", Write("gt.csv", FormatTrajectory(truth, TrajectoryFormat::kEuroc)),
                 "--estimate", Write("orb.txt", orb)});
}

TEST_F(ScoreTest, WhatWouldHaveNoEffectIsRefused) {
  const std::string file = Tum("slam.txt");
  const std::vector<std::string> good = {"score", "--truth", file, "--estimate", file};
  for (const std::vector<std::string>& idle :
       {std::vector<std::string>{"--times", Write("t.txt", Times())},
        {"--along-estimate"},
        {"--align", "none", "--align-first", "5"},
        {"--association", "index", "--rate", "20"}}) {
    std::vector<std::string> words = good;
    words.insert(words.end(), idle.begin(), idle.end());
    EXPECT_EQ(Exit(words), kBadInput) << idle.front();
  }
}

TEST(CommandLineTest, AnInstructionSetThatTheTracerHasNoCodeForIsRefused) {
  EXPECT_EQ(Exit({"render", "paper/scene2", "--out", "/no/where", "--isa", "sse4.2"}), kBadInput);
  EXPECT_EQ(Exit({"bench", "render", "--isa", "sse4.2"}), kBadInput);
  EXPECT_EQ(Exit({"bench", "growth", "--isa", "avx"}), kBadInput);
}

TEST(CommandLineTest, OptionsOfAClusterAreRefusedWhereTheyHaveNoEffect) {
  const std::vector<std::string> run = {"run", "quickstart", "--dry-run"};
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = run;
    words.insert(words.end(), more.begin(), more.end());
    return Exit(words) == kBadInput;
  };
  EXPECT_TRUE(refused({"--partition", "night"}));
  EXPECT_TRUE(refused({"--wait"}));
  EXPECT_TRUE(refused({"--nodes-at-most", "3"}));
  EXPECT_TRUE(refused({"--on", "k8s", "--partition", "night"}));
  EXPECT_TRUE(refused({"--on", "k8s", "--task-time", "1:00"}));
  EXPECT_TRUE(refused({"--on", "slurm", "--image", "aisle:1"}));
  EXPECT_TRUE(refused({"--on", "slurm", "--claim", "out"}));
}

TEST(CommandLineTest, WhereAResultGoesIsAskedBeforeTheWorkIsDone) {
  std::string said;
  EXPECT_EQ(Exit({"slam", "/no/where", "-o", fs::temp_directory_path().string()}, &said),
            kBadInput);
  EXPECT_THAT(said, HasSubstr("is a folder; expected a file"));
  EXPECT_EQ(Exit({"slam", "/no/where", "-o", "/dev/null/slam.txt"}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("/dev/null"));
  EXPECT_EQ(Exit({"preview", "paper/scene2", "-o", "scene2.gif"}, &said), kBadInput);
  EXPECT_THAT(said, HasSubstr("scene2.gif: expected a file name that ends with"));
  EXPECT_EQ(Exit({"preview", "paper/scene2", "--plan", "plan.svg"}), kBadInput);
}

TEST(CommandLineTest, ComparedAsJsonStdoutIsJsonAlone) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_cli_json_{}", ::getpid());
  const std::string out = folder.string(), pages = (folder / "pages").string();
  WriteFileAtomically(folder / "results.json", ToJson(Results{}));
  const char* words[] = {"aisle",  "compare", out.c_str(),  out.c_str(),
                         "--json", "--out",   pages.c_str()};
  testing::internal::CaptureStdout();
  RunCommandLine(static_cast<int>(std::size(words)), words);
  EXPECT_TRUE(nlohmann::json::accept(testing::internal::GetCapturedStdout()));
  EXPECT_TRUE(fs::exists(folder / "pages/compare.html"));
  fs::remove_all(folder);
}

TEST(CommandLineTest, DoctorTellsProgramsOnStdoutOrInAFile) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_doctor_{}", ::getpid());
  const std::vector<std::vector<std::string>> kinds{{"doctor"}, {"doctor", "--bits", "--pictures"}};
  for (const std::vector<std::string>& words : kinds) {
    std::vector<std::string> to_stdout = words, to_file = words;
    to_stdout.emplace_back("--json");
    to_file.insert(to_file.end(), {"--json", folder / "said.json"});
    std::string said;
    Exit(to_stdout, &said);
    const auto alone = nlohmann::json::parse(said);
    Exit(to_file, &said);
    const auto in_file = nlohmann::json::parse(ReadFile(folder / "said.json"));
    for (const auto& [key, value] : alone.items()) EXPECT_TRUE(in_file.contains(key)) << key;
    EXPECT_EQ(in_file.size(), alone.size());
    EXPECT_THAT(said, HasSubstr("processor"));
    EXPECT_FALSE(nlohmann::json::accept(said)) << "the table goes on being printed";
  }
  fs::remove_all(folder);
}

TEST(CommandLineTest, AGallerySaysHowItIsMadeAgain) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_gallery_{}", ::getpid());
  const fs::path out = folder / "my gallery";
  EXPECT_EQ(Exit({"gallery", "smoke/bits", "--samples", "1", "-o", out.string()}), kAllPassed);
  EXPECT_THAT(ReadFile(out / "README.md"), HasSubstr(" --samples 1 -o '" + out.string() + "'`"));
  fs::remove_all(folder);
}

TEST(CommandLineTest, CheckSaysOfARecordingsFolderWhatItIs) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_check_{}", ::getpid());
  WriteFileAtomically(folder / "bag/metadata.yaml", "rosbag2_bagfile_information: {}\n");
  WriteFileAtomically(folder / "euroc/mav0/cam0/sensor.yaml", "sensor_type: camera\n");
  WriteFileAtomically(folder / "kitti/calib.txt", "P0: 1\n");
  fs::create_directories(folder / "kitti/image_0");
  for (const char* name : {"bag", "bag/metadata.yaml", "euroc", "kitti"}) {
    std::string said;
    EXPECT_EQ(Exit({"check", (folder / name).string()}, &said), kBadInput) << name;
    EXPECT_THAT(said, HasSubstr("not a folder of scenes"));
    EXPECT_THAT(said, HasSubstr("`recording: FOLDER`"));
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
  }
  WriteFileAtomically(folder / "good.yaml",
                      ReadFile(fs::path(AISLE_SOURCE_DIR) / "scenes/smoke/bits.yaml"));
  std::string said;
  EXPECT_EQ(Exit({"check", folder.string()}, &said), kAllPassed) << said;
  EXPECT_EQ(said, (folder / "good.yaml").string() + ": good\n");
  fs::remove_all(folder);
}

TEST(CommandLineTest, AProgramThatIsNotHereIsToldBeforeTheNight) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_guest_{}", ::getpid());
  const std::string file = (folder / "s.yaml").string();
  WriteFileAtomically(file,
                      "suite: s\nscenes: [smoke/bits]\nseeds: 1\nsystems:\n"
                      "  - {name: mine, command: 'no_such_slam {output}'}\n");
  const std::vector<std::vector<std::string>> commands{{"check", file}, {"run", file, "--dry-run"}};
  for (const std::vector<std::string>& words : commands) {
    std::string said;
    EXPECT_EQ(Exit(words, &said), kAllPassed) << said;  // another machine may have it
    EXPECT_THAT(said, HasSubstr("system 'mine': its command begins with no_such_slam, which was"));
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace aisle
