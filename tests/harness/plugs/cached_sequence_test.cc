#include "harness/plugs/cached_sequence.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <random>
#include <thread>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// What was asked of the original.
struct Asked {
  std::atomic<int> opened = 0, made = 0;
};

/// Frames of noise with everything that truth can say, by number and time alone.
class Noise : public Sequence {
 public:
  explicit Noise(Asked* asked) : asked_(asked) { ++asked_->opened; }

  std::string name() const override { return "made/up"; }
  StereoCalibration calibration() const override { return {48, 32, 40, 41, 23, 15, 0.12}; }
  double rate_hz() const override { return 20; }
  std::vector<FrameRequest> Schedule() const override {
    std::vector<FrameRequest> schedule;
    for (int i = 0; i < 6; ++i) {
      FrameRequest request{i, 50'000'000LL * i, Eigen::Isometry3d::Identity()};
      request.T_world_rig.translation().x() = 0.1 * i;
      schedule.push_back(request);
    }
    return schedule;
  }
  SequenceFrame At(const FrameRequest& request) const override {
    ++asked_->made;
    return Make(request);
  }

  static SequenceFrame Make(const FrameRequest& request) {
    cv::RNG random(static_cast<std::uint64_t>(1000 + request.id) +
                   static_cast<std::uint64_t>(1e6 * request.T_world_rig.translation().x()));
    const auto bytes = [&] {
      cv::Mat1b image(32, 48);
      random.fill(image, cv::RNG::UNIFORM, 0, 256);
      return image;
    };
    SequenceFrame frame;
    frame.images = {request.id, request.stamp_ns, bytes(), bytes()};
    FrameTruth& truth = frame.truth.emplace();
    truth.T_world_rig = request.T_world_rig;
    truth.smear_ms = 3;
    truth.dynamic = bytes() > 200;
    truth.dynamic_right = bytes() > 200;
    truth.actor = bytes() > 180;
    truth.actor_right = bytes() > 180;
    truth.instance = cv::Mat1w(32, 48);
    random.fill(truth.instance, cv::RNG::UNIFORM, 0, 500);
    truth.depth = cv::Mat1f(32, 48);
    random.fill(truth.depth, cv::RNG::UNIFORM, 1, 30);
    truth.depth(3, 4) = std::numeric_limits<float>::infinity();
    ObjectTruth object;
    object.instance = 7;
    object.object_class = "person";
    object.box_visible = {1.5, 2, 10, 20};
    object.box_full = {1, 2, 12, 22};
    object.center_m = {1, 2, 3};
    object.extent_m = {0.5, 0.6, 1.8};
    object.velocity_mps = {0.1, -1, 0};
    object.visible_fraction = 0.75;
    object.visible_pixels = 150;
    object.dynamic_pixels = 70;
    truth.objects = {object};
    return frame;
  }

 private:
  Asked* asked_;
};

bool Same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         (a.empty() ||
          std::equal(a.begin<std::uint8_t>(), a.end<std::uint8_t>(), b.begin<std::uint8_t>()));
}

void ExpectSame(const SequenceFrame& got, const SequenceFrame& made) {
  EXPECT_EQ(got.images.id, made.images.id);
  EXPECT_EQ(got.images.stamp_ns, made.images.stamp_ns);
  EXPECT_TRUE(Same(got.images.left, made.images.left));
  EXPECT_TRUE(Same(got.images.right, made.images.right));
  ASSERT_TRUE(got.truth.has_value());
  const FrameTruth &a = *got.truth, &b = *made.truth;
  EXPECT_EQ(a.T_world_rig.matrix(), b.T_world_rig.matrix());
  EXPECT_EQ(a.smear_ms, b.smear_ms);
  EXPECT_TRUE(Same(a.dynamic, b.dynamic));
  EXPECT_TRUE(Same(a.dynamic_right, b.dynamic_right));
  EXPECT_TRUE(Same(a.actor, b.actor));
  EXPECT_TRUE(Same(a.actor_right, b.actor_right));
  EXPECT_EQ(cv::norm(a.instance, b.instance, cv::NORM_INF), 0);
  ASSERT_FALSE(a.depth_grid.empty());
  for (int y = 0; y < a.depth_grid.rows; ++y) {
    for (int x = 0; x < a.depth_grid.cols; ++x) {
      EXPECT_EQ(a.depth_grid(y, x), b.depth(16 * y, 16 * x)) << "every 16th pixel";
    }
  }
  ASSERT_EQ(a.objects.size(), 1u);
  EXPECT_EQ(a.objects[0].object_class, "person");
  EXPECT_EQ(a.objects[0].box_visible, b.objects[0].box_visible);
  EXPECT_EQ(a.objects[0].box_full, b.objects[0].box_full);
  EXPECT_EQ(a.objects[0].velocity_mps, b.objects[0].velocity_mps);
  EXPECT_EQ(a.objects[0].dynamic_pixels, 70);
}

class CachedSequenceTest : public testing::Test {
 protected:
  CachedSequenceTest() { fs::remove_all(folder_); }
  ~CachedSequenceTest() override { fs::remove_all(folder_); }

  std::unique_ptr<Sequence> Open(std::uint64_t* hash = nullptr,
                                 const std::string& name = "made/up") {
    return OpenCached(
        FrameStore(folder_), name,
        [this](std::uint64_t* content_hash) {
          if (content_hash != nullptr) *content_hash = 77;
          return std::make_unique<Noise>(&asked_);
        },
        hash);
  }
  std::vector<fs::path> Files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
  }

  Asked asked_;
  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_cached_{}", ::getpid());
};

TEST_F(CachedSequenceTest, FramesAreThoseOfTheOriginalWhicheverWayTheyCame) {
  EXPECT_EQ(FrameStore(folder_).Count(), 0);
  for (int drive = 0; drive < 3; ++drive) {
    std::uint64_t hash = 0;
    const auto sequence = Open(&hash);
    EXPECT_EQ(hash, 77u);
    EXPECT_EQ(sequence->name(), "made/up");
    EXPECT_EQ(sequence->rate_hz(), 20);
    EXPECT_EQ(sequence->calibration().fy, 41);
    const std::vector<FrameRequest> schedule = sequence->Schedule();
    ASSERT_EQ(schedule.size(), 6u);
    for (const FrameRequest& request : schedule) {
      const SequenceFrame frame = sequence->At(request);
      ExpectSame(frame, Noise::Make(request));
      EXPECT_TRUE(frame.truth->depth.empty()) << "whichever way they came";
      EXPECT_TRUE(frame.truth->instance_right.empty());
    }
    EXPECT_EQ(asked_.opened, 1) << "what is there needs no original";
    EXPECT_EQ(asked_.made, 6) << "each frame is made once";
    EXPECT_EQ(FrameStore(folder_).Count(), 6);
  }
}

TEST_F(CachedSequenceTest, TheNameIsTheAskersWhoeverFilledTheStore) {
  for (const std::string name : {"paper/scene2", "paper/scene3", "paper/scene2"}) {
    std::uint64_t hash = 0;
    EXPECT_EQ(Open(&hash, name)->name(), name);
    EXPECT_EQ(hash, 77u);
  }
  EXPECT_EQ(asked_.opened, 1);
}

TEST_F(CachedSequenceTest, AFrameThatIsDamagedOrGoneIsMadeAnew) {
  const std::vector<FrameRequest> schedule = Noise(&asked_).Schedule();
  for (const FrameRequest& request : schedule) Open()->At(request);
  const std::vector<fs::path> files = Files();
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    const fs::path& file = files[random() % files.size()];
    const std::string whole = ReadFile(file);
    std::string bytes = whole;
    if (round % 5 == 0) {
      bytes.resize(random() % bytes.size());
    } else {
      bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
    }
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    const int made = asked_.made, opened = asked_.opened;
    const auto sequence = Open();
    ASSERT_EQ(sequence->Schedule().size(), schedule.size());
    for (const FrameRequest& request : schedule) {
      ExpectSame(sequence->At(request), Noise::Make(request));
    }
    EXPECT_GT(asked_.made + asked_.opened, made + opened) << "it was noticed: " << file;
    EXPECT_EQ(ReadFile(file), whole) << "and is whole again";
  }
}

/// Lets no file grow, as a full disk does.
class FullDisk {
 public:
  FullDisk() : signal_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit full{512, before_.rlim_max};  // what is said on stderr has room
    ::setrlimit(RLIMIT_FSIZE, &full);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, signal_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*signal_)(int);
  rlimit before_{};
};

TEST_F(CachedSequenceTest, AStoreThatCannotBeWrittenCostsNoFrame) {
  const auto expect_frames = [&] {
    std::uint64_t hash = 0;
    const auto sequence = Open(&hash);
    EXPECT_EQ(hash, 77u);
    for (const FrameRequest& request : sequence->Schedule()) {
      ExpectSame(sequence->At(request), Noise::Make(request));
    }
  };
  testing::internal::CaptureStderr();
  {
    const FullDisk full;
    expect_frames();
    EXPECT_EQ(FrameStore(folder_).Count(), 0);
  }
  fs::remove_all(folder_);
  WriteFileAtomically(folder_, "in the way");
  expect_frames();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
  EXPECT_EQ(asked_.made, 12);
}

/// A vehicle that is steered asks from elsewhere: such frames are the original's and nobody's else.
TEST_F(CachedSequenceTest, FramesFromOtherPosesAreNeverKeptNorAnsweredFromTheStore) {
  const auto sequence = Open();
  const std::vector<FrameRequest> schedule = sequence->Schedule();
  for (const FrameRequest& request : schedule) sequence->At(request);
  const std::vector<fs::path> files = Files();
  FrameRequest elsewhere = schedule[2];
  elsewhere.T_world_rig.translation().x() += 1e-6;
  FrameRequest later = schedule[2];
  later.stamp_ns += 1;
  FrameRequest beyond = schedule[2];
  beyond.id = 6;
  for (const FrameRequest& request : {elsewhere, later, beyond}) {
    const int made = asked_.made;
    const SequenceFrame frame = sequence->At(request);
    EXPECT_EQ(asked_.made, made + 1);
    EXPECT_TRUE(Same(frame.images.left, Noise::Make(request).images.left));
    EXPECT_EQ(Files(), files);
  }
  ExpectSame(sequence->At(schedule[2]), Noise::Make(schedule[2]));
}

TEST_F(CachedSequenceTest, ManyThreadsSeeTheSameFramesAndOpenOneOriginal) {
  Open();  // the header
  asked_.opened = 0;
  const auto sequence = Open();
  const std::vector<FrameRequest> schedule = sequence->Schedule();
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < 18; ++i) {
        const FrameRequest& request = schedule[(i + t) % schedule.size()];
        const SequenceFrame frame = sequence->At(request);
        wrong += !Same(frame.images.left, Noise::Make(request).images.left);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(asked_.opened, 1);
}

}  // namespace
}  // namespace aisle
