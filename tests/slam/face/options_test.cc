#include <gmock/gmock.h>

#include <cctype>
#include <cstring>
#include <set>
#include <type_traits>

#include "slam/stereo_slam.h"

namespace aisle::slam {
namespace {

using Kind = OptionDescription::Kind;
using testing::HasSubstr;

const OptionDescription& Find(const std::vector<OptionDescription>& all, const std::string& path) {
  for (const OptionDescription& one : all) {
    if (one.path == path) return one;
  }
  throw std::out_of_range(path);
}

TEST(DescribeOptions, TellsEverythingOfAnOption) {
  SlamOptions options;
  options.dynamic.robust.field.memory = 0.8;
  options.dynamic.method = DynamicMethod::kPaper;
  const std::vector<OptionDescription> all = DescribeOptions(options);
  EXPECT_EQ(all.front().path, "base");  // it is set first
  const OptionDescription& method = Find(all, "dynamic.method");
  EXPECT_EQ(method.kind, Kind::kChoice);
  EXPECT_EQ(method.value, "paper");
  EXPECT_THAT(method.choices, testing::ElementsAre("none", "paper", "robust"));
  const OptionDescription& memory = Find(all, "dynamic.robust.field.memory");
  EXPECT_EQ(memory.kind, Kind::kNumber);
  EXPECT_EQ(memory.value, "0.8");
  EXPECT_EQ(memory.low, 0);
  EXPECT_EQ(memory.high, 1);
  const OptionDescription& cell = Find(all, "feature.cell_px");
  EXPECT_EQ(cell.kind, Kind::kInteger);
  EXPECT_EQ(cell.unit, "px");
  EXPECT_EQ(Find(all, "dynamic.robust.evidence.least").value, "-1");
}

TEST(DescribeOptions, HasASentenceAndARangeThatHoldsTheDefaultForEach) {
  std::set<std::string> paths;
  for (const OptionDescription& one : DescribeOptions({})) {
    EXPECT_TRUE(paths.insert(one.path).second) << one.path << " twice";
    ASSERT_FALSE(one.help.empty()) << one.path;
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(one.help.front()))) << one.path;
    EXPECT_EQ(one.help.back(), '.') << one.path;
    if (one.kind != Kind::kNumber && one.kind != Kind::kInteger) continue;
    EXPECT_LT(one.low, one.high) << one.path;
    EXPECT_GE(std::stod(one.value), one.low) << one.path;
    EXPECT_LE(std::stod(one.value), one.high) << one.path;
  }
}

/// A valid text for the option that is not its value.
std::string AnotherValue(const OptionDescription& one) {
  if (one.kind == Kind::kFlag) return one.value == "true" ? "false" : "true";
  if (one.kind == Kind::kChoice) return one.choices[one.value == one.choices[0] ? 1 : 0];
  const double bound = std::stod(one.value) == one.low ? one.high : one.low;
  if (one.kind == Kind::kInteger) return fmt::format("{:.0f}", bound);
  // Not round, so that a digit lost on the way shows.
  return fmt::format("{}", std::stod(one.value) + (bound - std::stod(one.value)) / 3);
}

TEST(SetOption, SetsWhatItNamesAndNothingElse) {
  const std::vector<OptionDescription> before = DescribeOptions({});
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].path == "base") continue;  // it sets all, see OfTheBaseStartsFromItsOptions
    SlamOptions options;
    const std::string text = AnotherValue(before[i]);
    ASSERT_EQ(SetOption(before[i].path, text, &options), "");
    const std::vector<OptionDescription> after = DescribeOptions(options);
    for (std::size_t j = 0; j < before.size(); ++j) {
      EXPECT_EQ(after[j].value, i == j ? text : before[j].value) << before[j].path;
    }
  }
}

TEST(SetOption, TakesEveryDescribedValueBackToTheSameBits) {
  SlamOptions changed, copy;
  for (const OptionDescription& one : DescribeOptions({})) {
    ASSERT_EQ(SetOption(one.path, AnotherValue(one), &changed), "");
  }
  for (const OptionDescription& one : DescribeOptions(changed)) {
    ASSERT_EQ(SetOption(one.path, one.value, &copy), "");
  }
  EXPECT_EQ(std::memcmp(&copy.feature.scale, &changed.feature.scale, sizeof(double)), 0);
  const auto a = DescribeOptions(changed), b = DescribeOptions(copy);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].value, b[i].value) << a[i].path;
}

TEST(SetOption, OfTheBaseStartsFromItsOptions) {
  SlamOptions options;
  options.threads = 3;
  options.vocabulary_file = "words";
  options.map_file = "map";
  options.localise_only = options.schedule.free_running = options.dynamic.keep_stages = true;
  ASSERT_EQ(SetOption("feature.features", "800", &options), "");
  ASSERT_EQ(SetOption("base", "orbslam2", &options), "");
  EXPECT_EQ(options.base, Base::kOrbSlam2);
  EXPECT_TRUE(options.equal_columns);
  const auto expect_is = [](const SlamOptions& is, const SlamOptions& expected) {
    const auto a = DescribeOptions(is), b = DescribeOptions(expected);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].value, b[i].value) << a[i].path;
  };
  expect_is(options, OptionsOf(Base::kOrbSlam2));
  // The driver's own stay.
  EXPECT_EQ(options.threads, 3);
  EXPECT_EQ(options.vocabulary_file, "words");
  EXPECT_EQ(options.map_file, "map");
  EXPECT_TRUE(options.localise_only && options.schedule.free_running);
  EXPECT_TRUE(options.dynamic.keep_stages);

  ASSERT_EQ(SetOption("keypoint_noise_px", "0.5", &options), "");
  EXPECT_EQ(options.keypoint_noise_px, 0.5);
  EXPECT_TRUE(options.equal_columns);
  EXPECT_THAT(SetOption("base", "orbslam3", &options), HasSubstr("did you mean orbslam2?"));
  EXPECT_EQ(options.keypoint_noise_px, 0.5);
  ASSERT_EQ(SetOption("base", "plain", &options), "");
  expect_is(options, SlamOptions());
}

TEST(SetOption, SaysWhatIsWrong) {
  SlamOptions options;
  EXPECT_EQ(SetOption("dynamic.robust.feild.memory", "0.8", &options),
            "unknown option dynamic.robust.feild.memory; did you mean "
            "dynamic.robust.field.memory?");
  EXPECT_EQ(SetOption("field.memory", "0.8", &options),
            "unknown option field.memory; did you mean dynamic.robust.field.memory?");
  EXPECT_EQ(SetOption("feature", "800", &options),
            "feature is a group of options, such as feature.features");
  EXPECT_EQ(SetOption("zebra crossing", "1", &options), "unknown option zebra crossing");
  EXPECT_EQ(SetOption("feature.features", "0", &options),
            "feature.features is 0; it must be in [1, 20000]");
  EXPECT_EQ(SetOption("feature.features", "8e2", &options),
            "feature.features is \"8e2\"; it must be a whole number in [1, 20000]");
  EXPECT_EQ(SetOption("dynamic.method", "robst", &options),
            "dynamic.method is \"robst\"; it must be one of none, paper, robust; did you mean "
            "robust?");
}

TEST(SetOption, KnowsNothingOfWhatTheDriverOwns) {
  SlamOptions options;
  for (const char* path : {"vocabulary_file", "map_file", "localise_only", "threads",
                           "dynamic.keep_stages", "schedule.free_running", "schedule.background"}) {
    EXPECT_THAT(SetOption(path, "1", &options), HasSubstr("unknown option")) << path;
  }
}

TEST(WhyWithoutEffect, NamesTheBaseThatLooksAtTheOption) {
  const SlamOptions plain = OptionsOf(Base::kPlain), orbslam2 = OptionsOf(Base::kOrbSlam2);
  EXPECT_EQ(WhyWithoutEffect("track.local_keyframes", plain), "");
  EXPECT_EQ(WhyWithoutEffect("track.local_keyframes", orbslam2),
            "track.local_keyframes has no effect with base orbslam2; only base plain uses it");
  EXPECT_EQ(WhyWithoutEffect("orbslam2.map_ratio", plain),
            "orbslam2.map_ratio has no effect with base plain; only base orbslam2 uses it");
  EXPECT_EQ(WhyWithoutEffect("orbslam2.map_ratio", orbslam2), "");
  // The rejection of movers, which both bases have, predicts the motion across a gap.
  EXPECT_EQ(WhyWithoutEffect("track.longest_gap_s", orbslam2), "");
  EXPECT_EQ(WhyWithoutEffect("feature.features", orbslam2), "");
}

TEST(WhyWithoutEffect, NamesTheMethodThatLooksAtTheOption) {
  SlamOptions options;
  options.dynamic.method = DynamicMethod::kRobust;
  EXPECT_EQ(WhyWithoutEffect("dynamic.robust.field.memory", options), "");
  EXPECT_EQ(WhyWithoutEffect("dynamic.paper.flow.window_px", options),
            "dynamic.paper.flow.window_px has no effect: dynamic.method is not paper");
  options.dynamic.method = DynamicMethod::kNone;
  EXPECT_EQ(WhyWithoutEffect("dynamic.robust.field.memory", options),
            "dynamic.robust.field.memory has no effect: dynamic.method is not robust");
  EXPECT_EQ(WhyWithoutEffect("track.prior_map_share", options),
            "track.prior_map_share has no effect: dynamic.method is not robust");
}

TEST(Validate, CoversEveryPartWithItsPath) {
  EXPECT_EQ(Validate(SlamOptions{}), "");
  EXPECT_EQ(Validate(OptionsOf(Base::kOrbSlam2)), "");
  const auto broken = [](const auto& change) {
    SlamOptions options;
    change(options);
    return Validate(options);
  };
  EXPECT_EQ(broken([](auto& o) { o.track.dead_reckoning.match.radius_px = -1; }),
            "track.dead_reckoning.match.radius_px is -1; it must be in [0, 500] px");
  EXPECT_THAT(broken([](auto& o) { o.keyframe.close_baselines = 0; }),
              HasSubstr("keyframe.close_baselines is 0"));
  EXPECT_THAT(broken([](auto& o) { o.mapping.adjust.free_keyframes = 0; }),
              HasSubstr("mapping.adjust.free_keyframes is 0"));
  EXPECT_THAT(broken([](auto& o) { o.loop.align.confidence = NAN; }),
              HasSubstr("loop.align.confidence is nan"));
  EXPECT_THAT(broken([](auto& o) { o.global.final_iterations = -1; }),
              HasSubstr("global.final_iterations is -1"));
  EXPECT_EQ(broken([](auto& o) { o.feature.fast_threshold_low = 30; }),
            "feature.fast_threshold_low is 30; it must not exceed feature.fast_threshold, which is "
            "20");
  EXPECT_THAT(broken([](auto& o) { o.dynamic.robust.disparity.max_disparity_px = 48; }),
              HasSubstr("must be a multiple of 32"));
  EXPECT_THAT(broken([](auto& o) { o.threads = -1; }), HasSubstr("threads is -1"));
  EXPECT_THAT(broken([](auto& o) { o.localise_only = true; }), HasSubstr("without a map_file"));
  EXPECT_THAT(
      broken([](auto& o) { o.schedule.free_running = true, o.schedule.background = false; }),
      HasSubstr("schedule.free_running is true"));
}

/// The bytes of an object that somebody has spoken for.
class Bytes {
 public:
  template <class T>
  void Add(const T& part) {
    const auto* begin = reinterpret_cast<const unsigned char*>(&part);
    for (std::size_t i = 0; i < sizeof(T); ++i) spoken_for_.insert(begin + i);
  }
  /// Offsets in `part` of bytes that hold a value (padding does not) and that nobody has added.
  template <class T>
  std::vector<std::size_t> MissingIn(const T& part) const {
    static_assert(std::is_trivially_copyable_v<T>);
    T marked;
    std::memset(static_cast<void*>(&marked), 0xff, sizeof(T));
    __builtin_clear_padding(&marked);
    std::array<unsigned char, sizeof(T)> holds_value;
    std::memcpy(holds_value.data(), &marked, sizeof(T));
    std::vector<std::size_t> missing;
    const auto* begin = reinterpret_cast<const unsigned char*>(&part);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      if (holds_value[i] != 0 && !spoken_for_.contains(begin + i)) missing.push_back(i);
    }
    return missing;
  }

 private:
  std::set<const unsigned char*> spoken_for_;
};

TEST(DescribeOptions, LeavesOutNoField) {
  SlamOptions options;
  Bytes bytes;
  const OptionFields fields = FieldsOf(options);
  for (const OptionField& field : fields.fields()) {
    if (const auto* choice = std::get_if<OptionChoice>(&field.value)) {
      bytes.Add(*static_cast<const int*>(choice->value));  // as large as every enumeration is
    } else if (const auto* number = std::get_if<double*>(&field.value)) {
      bytes.Add(**number);
    } else if (const auto* integer = std::get_if<int*>(&field.value)) {
      bytes.Add(**integer);
    } else if (const auto* seed = std::get_if<std::uint64_t*>(&field.value)) {
      bytes.Add(**seed);
    } else {
      bytes.Add(*std::get<bool*>(field.value));
    }
  }
  // What the driver owns.
  bytes.Add(options.dynamic.keep_stages);
  bytes.Add(options.schedule.free_running);
  bytes.Add(options.schedule.background);
  // A field more makes this line a compile error: name it, and describe it or say why not.
  const auto& [base, threads, dynamic, feature, stereo, track, keyframe, orbslam2, orbslam2_mapping,
               mapping, loop, global, schedule, map_file, localise_only, new_part_after_s,
               least_keyframes, vocabulary_file, keypoint_noise_px, equal_columns,
               least_first_points] = options;
  const std::vector<std::size_t> none;
  EXPECT_EQ(bytes.MissingIn(base), none);
  EXPECT_EQ(bytes.MissingIn(dynamic), none);
  EXPECT_EQ(bytes.MissingIn(feature), none);
  EXPECT_EQ(bytes.MissingIn(stereo), none);
  EXPECT_EQ(bytes.MissingIn(track), none);
  EXPECT_EQ(bytes.MissingIn(keyframe), none);
  EXPECT_EQ(bytes.MissingIn(orbslam2), none);
  EXPECT_EQ(bytes.MissingIn(orbslam2_mapping), none);
  EXPECT_EQ(bytes.MissingIn(mapping), none);
  EXPECT_EQ(bytes.MissingIn(loop), none);
  EXPECT_EQ(bytes.MissingIn(global), none);
  EXPECT_EQ(bytes.MissingIn(schedule), none);
  EXPECT_EQ(bytes.MissingIn(new_part_after_s), none);
  EXPECT_EQ(bytes.MissingIn(least_keyframes), none);
  EXPECT_EQ(bytes.MissingIn(keypoint_noise_px), none);
  EXPECT_EQ(bytes.MissingIn(equal_columns), none);
  EXPECT_EQ(bytes.MissingIn(least_first_points), none);
  // The driver's own.
  EXPECT_EQ(bytes.MissingIn(threads).size(), sizeof(threads));
  EXPECT_EQ(bytes.MissingIn(localise_only).size(), sizeof(localise_only));
  EXPECT_TRUE(map_file.empty() && vocabulary_file.empty());
}

}  // namespace
}  // namespace aisle::slam
