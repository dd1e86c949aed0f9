#include "harness/campaign/job.h"

#include <gtest/gtest.h>

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
  job.frames_key = "the key of the frames";
  job.inputs_hash = "the hash of the inputs";
  job.threads = 3;
  job.video = false;
  job.debug_dynamic = true;
  return job;
}

TEST(JobTest, ComesBackAsItWasWritten) {
  const std::string text = ToJson(Example());
  const Job back = JobFromJson(text, "job.json");
  EXPECT_EQ(back.spec, Example().spec);
  EXPECT_EQ(ToJson(back), text);
  EXPECT_EQ(back.out, Example().out);
  EXPECT_EQ(back.led_frames, Example().led_frames);
  EXPECT_FALSE(back.video);
  EXPECT_TRUE(back.debug_dynamic);
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

TEST(SystemSpecTest, OnlyPartsThatFitTogetherAreGood) {
  EXPECT_EQ(Validate(BuiltIn("robust")), "");
  EXPECT_NE(Validate(SystemSpec{}), "");
  SystemSpec masks = BuiltIn("robust");
  masks.mask_errors.boundary_px = 1;
  EXPECT_NE(Validate(masks), "");
  masks.like = "semantic";
  EXPECT_EQ(Validate(masks), "");
}

}  // namespace
}  // namespace aisle
