#include "harness/campaign/cache_bounds.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class CacheBoundsTest : public testing::Test {
 protected:
  void SetUp() override {
    cache_ = fs::temp_directory_path() / fmt::format("aisle_cache_bounds_{}", ::getpid());
  }
  void TearDown() override { RemoveFolder(cache_); }

  /// A sequence of so many bytes, last opened so long ago.
  void Keep(const std::string& sequence, std::size_t bytes, std::chrono::hours ago = {}) const {
    WriteFileAtomically(cache_ / sequence / "file", std::string(bytes, 'x'));
    fs::last_write_time(cache_ / sequence, fs::file_time_type::clock::now() - ago);
  }
  bool Has(const std::string& sequence) const { return fs::exists(cache_ / sequence); }

  fs::path cache_;
};

using std::chrono::hours;

TEST_F(CacheBoundsTest, EachCacheHasItsOwn) {
  for (const std::string cache : {"frames/", "datasets/"}) {
    Keep(cache + "of_the_day_before", 3000, hours(26));
    Keep(cache + "of_last_night", 3000, hours(12));
    Keep(cache + "of_now", 3000);
  }
  Keep("taught/old", 800, hours(1));
  Keep("taught/new", 800);
  ShrinkCaches(cache_, 4000);
  EXPECT_FALSE(Has("frames/of_the_day_before"));
  EXPECT_FALSE(Has("frames/of_last_night"));
  EXPECT_TRUE(Has("frames/of_now"));
  EXPECT_FALSE(Has("datasets/of_the_day_before"));
  EXPECT_TRUE(Has("datasets/of_last_night")) << "a guest may be amid it";
  EXPECT_TRUE(Has("datasets/of_now"));
  EXPECT_FALSE(Has("taught/old")) << "a quarter of the frames' bound";
  EXPECT_TRUE(Has("taught/new"));
}

TEST_F(CacheBoundsTest, WhatIsWithinThemStays) {
  Keep("frames/old", 1500, hours(100));
  Keep("frames/new", 1500);
  Keep("taught/old", 900, hours(100));
  Keep("datasets/old", 3900, hours(100));
  ShrinkCaches(cache_, 4000);
  for (const char* kept : {"frames/old", "frames/new", "taught/old", "datasets/old"}) {
    EXPECT_TRUE(Has(kept)) << kept;
  }
  ShrinkCaches(cache_ / "none", 4000);
}

TEST_F(CacheBoundsTest, AreEnforcedOnceAMinute) {
  double now_ms = 5000;
  CacheBounds bounds(
      cache_, [&] { return now_ms; }, 1000);
  const auto stays = [&](double at_ms) {
    Keep("frames/large", 2000);
    now_ms = at_ms;
    bounds.Tick();
    return Has("frames/large");
  };
  EXPECT_TRUE(stays(5000));
  EXPECT_TRUE(stays(65'000));
  EXPECT_FALSE(stays(65'001));
  EXPECT_TRUE(stays(65'002));
  EXPECT_TRUE(stays(125'001));
  EXPECT_FALSE(stays(125'002));
}

TEST_F(CacheBoundsTest, ALongLookIsNotFollowedByAnother) {
  double now_ms = 0;
  CacheBounds bounds(
      cache_, [&] { return now_ms += 50e3; }, 1000);  // 50 s at the start
  const auto stays = [&] {
    Keep("frames/large", 2000);
    bounds.Tick();
    return Has("frames/large");
  };
  EXPECT_TRUE(stays());   // 100 s: fifty since the start
  EXPECT_FALSE(stays());  // 150 s at its begin, 200 s at its end
  EXPECT_TRUE(stays());   // 250 s: a hundred since its begin, but fifty since its end
}

}  // namespace
}  // namespace aisle
