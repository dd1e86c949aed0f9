#include "harness/campaign/job.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

Job Example() {
  Job job;
  job.spec = {.scene = "paper/one",
              .scene_file = "scenes/paper/one.yaml",
              .twin = "empty",
              .system = {.name = "v",
                         .like = "oracle",
                         .options = {{"a.b", "0.1"}, {"c", "\"><script>"}},
                         .mask_errors = {.boundary_px = 0.1},
                         .external = {}},
              .seed = 18446744073709551615u};
  job.out = "out/x y";
  job.frames = "/frames";
  job.led_frames = "/frames/led";
  job.teaching = "/taught/a";
  job.frames_key = "the key of the frames";
  job.inputs_hash = "the hash of the inputs";
  job.threads = 3;
  job.video = false;
  job.debug_dynamic = true;
  job.memory_mib = 32000;
  job.hidden = {"/report of all", "/scratch"};
  return job;
}

TEST(JobTest, ComesBackAsItWasWritten) {
  const std::string text = ToJson(Example());
  const Job back = JobFromJson(text, "job.json");
  EXPECT_EQ(back.spec, Example().spec);
  EXPECT_EQ(ToJson(back), text);
  EXPECT_EQ(back.out, Example().out);
  EXPECT_EQ(back.led_frames, Example().led_frames);
  EXPECT_EQ(back.teaching, Example().teaching);
  EXPECT_FALSE(back.video);
  EXPECT_TRUE(back.debug_dynamic);
  EXPECT_EQ(back.memory_mib, 32000);
  EXPECT_EQ(back.hidden, Example().hidden);
}

/// Topics hold neither '-' nor '.': systems that are two to a report are one to a bag.
TEST(JobTest, SystemsThatWouldShareABagsTopicsLeaveNone) {
  RunSpec one{.scene = "smoke/short",
              .scene_file = AISLE_SOURCE_DIR "/scenes/smoke/short.yaml",
              .twin = "live",
              .system = {.name = "a-b", .like = "plain"},
              .seed = 1};
  RunSpec other = one;
  other.system.name = "a_b";
  const Fingerprints fingerprints;
  EXPECT_EQ(MakeJobs({one, other}, fingerprints, {.out = "out"}).size(), 2u);
  EXPECT_EQ(MakeJobs({one}, fingerprints, {.out = "out", .mcap = true}).size(), 1u);
  EXPECT_THROW(MakeJobs({one, other}, fingerprints, {.out = "out", .mcap = true}), InputError);
}

TEST(JobTest, FramesAreKeptWhereOthersAreShownTheSame) {
  const Fingerprints fingerprints;
  const auto job_of = [&](const std::string& scene, const SystemSpec& system) {
    const RunSpec spec{.scene = scene,
                       .scene_file = AISLE_SOURCE_DIR "/scenes/" + scene + ".yaml",
                       .twin = "live",
                       .system = system,
                       .seed = 1};
    return MakeJobs({spec}, fingerprints, {.out = "out"}).at(0);
  };
  SystemSpec steers = BuiltIn("plain"), taught = steers;
  taught.options["drive.taught"] = "true";
  EXPECT_NE(job_of("smoke/short", steers).frames, "");
  EXPECT_EQ(job_of("drive/aisle_dock", steers).frames, "");
  EXPECT_EQ(job_of("drive/aisle_dock", taught).frames, "");
  EXPECT_NE(job_of("drive/aisle_dock", taught).led_frames, "");
}

TEST(FingerprintsTest, ATeachingIsSharedHoweverItIsDrivenBy) {
  const Fingerprints fingerprints;
  RunSpec spec{.scene = "drive/aisle_dock",
               .scene_file = AISLE_SOURCE_DIR "/scenes/drive/aisle_dock.yaml",
               .twin = "live",
               .system = {.name = "a", .like = "plain", .options = {{"drive.taught", "true"}}},
               .seed = 1};
  const std::string teaching = fingerprints.Teaching(spec);
  RunSpec other = spec;
  other.twin = "empty";
  other.system.name = "b";
  other.system.options["drive.latency_ms"] = "50";
  EXPECT_EQ(fingerprints.Teaching(other), teaching);
  EXPECT_NE(fingerprints.Run(other), fingerprints.Run(spec));
  other.system.options["feature.features"] = "800";
  EXPECT_NE(fingerprints.Teaching(other), teaching);
  other = spec;
  other.system.like = "robust";
  EXPECT_NE(fingerprints.Teaching(other), teaching);
  other = spec;
  other.seed = 2;
  EXPECT_NE(fingerprints.Teaching(other), teaching);
}

TEST(FingerprintsTest, WhatACommandNamesInItsSourcesCounts) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_in_source_{}", ::getpid());
  const fs::path source = folder / "my slam";  // a folder's name may hold a space
  const auto fingerprint = [&] {
    ExternalSystem external{.command = "{source}/build/slam --settings={source}/set.yaml {output}"};
    external.repository = source.string();
    return Fingerprints().Run(
        {.scene = "smoke/short",
         .scene_file = AISLE_SOURCE_DIR "/scenes/smoke/short.yaml",
         .twin = "live",
         .system =
             {.name = "mine", .like = "", .options = {}, .mask_errors = {}, .external = external},
         .seed = 1});
  };
  for (const char* file : {"build/slam", "set.yaml"}) {
    const std::string before = fingerprint();
    WriteFileAtomically(source / file, "made yesterday");
    const std::string made = fingerprint();
    EXPECT_NE(made, before) << file;
    WriteFileAtomically(source / file, "made today");
    EXPECT_NE(fingerprint(), made) << file;
  }
  fs::remove_all(folder);
}

TEST(FingerprintsTest, TheValueOfAVariableThatASystemIsGivenCounts) {
  const auto fingerprint = [](const std::vector<std::string>& environment) {
    ExternalSystem external{.command = "slam {output}"};
    external.environment = environment;
    return Fingerprints().Run({.scene = "smoke/short",
                               .scene_file = AISLE_SOURCE_DIR "/scenes/smoke/short.yaml",
                               .twin = "live",
                               .system = {.name = "mine", .like = "", .external = external},
                               .seed = 1});
  };
  const char* const kName = "AISLE_TEST_MODEL";
  std::set<std::string> fingerprints;
  ::unsetenv(kName);
  const std::string without = fingerprint({});
  fingerprints.insert(fingerprint({kName}));
  for (const char* value : {"", "small", "large"}) {
    ::setenv(kName, value, 1);
    fingerprints.insert(fingerprint({kName}));
    EXPECT_EQ(fingerprint({}), without) << "it is not told of it";
  }
  ::unsetenv(kName);
  EXPECT_EQ(fingerprints.size(), 4u);
}

TEST(JobTest, AForeignSystemComesBackToo) {
  Job job = Example();
  job.spec.system = {.name = "mine",
                     .like = "",
                     .options = {},
                     .mask_errors = {},
                     .external = ExternalSystem{.command = "slam {output}",
                                                .dataset = "kitti",
                                                .trajectory = "euroc",
                                                .vslam_lab = VslamLabStyle::kPython,
                                                .timeout_s = 0.25,
                                                .may_write = {"/srv/cache"},
                                                .environment = {"LICENCE"},
                                                .depends_on = {"net.pt", "words"}}};
  EXPECT_EQ(JobFromJson(ToJson(job), "job.json").spec, job.spec);
}

TEST(JobTest, WhatIsNoJobIsSaidSo) {
  for (const char* bad : {"", "{}", "[]", "{\"schema\": 99}"}) {
    EXPECT_THROW(JobFromJson(bad, "job.json"), InputError) << bad;
  }
}

TEST(JobTest, NestingBeyondAnyJobIsNamedWithTheFile) {
  try {
    JobFromJson(std::string(100, '[') + std::string(100, ']'), "job.json");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "job.json: not a job file: nested deeper than 64 levels");
  }
}

}  // namespace
}  // namespace aisle
