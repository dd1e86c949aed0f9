#include "simulator/shade/light/light_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "simulator/shade/light/light_cache.h"
#include "simulator/shade/light/static_light.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

class LightLockTest : public testing::Test {
 protected:
  LightLockTest() : folder_(fs::path(testing::TempDir()) / fmt::format("aisle-lock-{}", getpid())) {
    fs::remove_all(folder_);
  }
  ~LightLockTest() override { fs::remove_all(folder_); }

  fs::path folder_;
  fs::path file_ = folder_ / "light.lock";
};

/// A process that does some work with a pipe to say that it is ready, and then sleeps.
class Child {
 public:
  explicit Child(const std::function<void()>& work) {
    std::array<int, 2> ready{};
    if (pipe(ready.data()) != 0) throw std::runtime_error("no pipe");
    id_ = fork();
    if (id_ == 0) {
      work();
      [[maybe_unused]] const ssize_t sent = write(ready[1], "r", 1);
      for (;;) pause();
    }
    close(ready[1]);
    char byte = 0;
    [[maybe_unused]] const ssize_t got = read(ready[0], &byte, 1);
    close(ready[0]);
  }
  ~Child() { Kill(); }
  void Kill() {
    if (id_ < 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
    id_ = -1;
  }

 private:
  pid_t id_ = -1;
};

TEST_F(LightLockTest, OneHoldsItAndLeavesNothing) {
  {
    const std::optional<LightLock> lock = LightLock::Try(file_);
    ASSERT_TRUE(lock);
    EXPECT_TRUE(fs::exists(file_));
    EXPECT_FALSE(LightLock::Try(file_));
  }
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_TRUE(LightLock::Try(file_));
}

TEST_F(LightLockTest, AHolderThatIsKilledLosesIt) {
  Child holder([&] { [[maybe_unused]] static auto lock = LightLock::Try(file_); });
  EXPECT_FALSE(LightLock::Try(file_));
  holder.Kill();
  EXPECT_TRUE(fs::exists(file_)) << "he could not take it away";
  EXPECT_TRUE(LightLock::Try(file_));
}

TEST_F(LightLockTest, WhoWaitsHearsHowFarTheHolderIsAndLosesPatienceWithASilentOne) {
  const std::optional<LightLock> lock = LightLock::Try(file_);
  LightWait wait(file_);
  const LightWait::Clock::time_point start{};
  EXPECT_TRUE(wait.Look(start, seconds(60)));
  EXPECT_TRUE(wait.Look(start + seconds(59), seconds(60)));
  lock->Beat(0.25);
  EXPECT_TRUE(wait.Look(start + seconds(61), seconds(60)));
  EXPECT_EQ(wait.share(), 0.25);
  lock->Beat(0.25);  // no further, but alive
  EXPECT_TRUE(wait.Look(start + seconds(120), seconds(60)));
  EXPECT_TRUE(wait.Look(start + seconds(179), seconds(60)));
  EXPECT_FALSE(wait.Look(start + seconds(180), seconds(60)));
}

TEST_F(LightLockTest, WhereThereCanBeNoneNobodyIsBound) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  EXPECT_TRUE(LightLock::Try(file_));
  EXPECT_TRUE(LightLock::Try(file_));
}

struct Hall {
  World world{test::Hall({.boxes = 20, .lights = 2})};
  Tracer tracer{world, {}};
  TexturePool textures{world.textures()};
  std::vector<float> all_on = std::vector<float>(world.lights().size(), 1.0f);

  StaticLightOptions Draft(const fs::path& folder, TellLight progress = {}) const {
    return {.cache_folder = folder,
            .texel_m = 0.5f,
            .coarse_texel_m = 1,
            .volume_spacing_m = 2,
            .directions = 16,
            .progress = std::move(progress)};
  }
};

/// Whoever waits takes what the holder left, and solves nothing himself.
TEST_F(LightLockTest, TheLightThatAnotherSolvesIsWaitedFor) {
  const Hall hall;
  const LightState solved =
      *StaticLight(hall.world, hall.tracer, hall.textures, hall.Draft(folder_)).At(hall.all_on);
  const std::uint64_t key = LightKey(hall.world, hall.Draft(folder_), hall.all_on);
  fs::remove_all(folder_);

  std::optional<LightLock> other = LightLock::Try(LockFileOf(folder_, key));
  ASSERT_TRUE(other);
  std::set<std::string> phases;
  int waits = 0;
  const auto progress = [&](const LightProgress& at) {
    phases.insert(at.phase);
    if (at.phase != std::string("another run solves it") || ++waits < 3) return;
    SaveLight(folder_, key, solved);
    other.reset();
  };
  const StaticLight waited(hall.world, hall.tracer, hall.textures, hall.Draft(folder_, progress));
  EXPECT_EQ(waited.At(hall.all_on)->total, solved.total);
  EXPECT_GE(waits, 3);
  EXPECT_EQ(phases.count("direct light"), 0u);
  EXPECT_FALSE(fs::exists(LockFileOf(folder_, key)));
}

/// One who is killed in the midst of it leaves a lock that nobody holds: the next one solves.
TEST_F(LightLockTest, TheLightOfOneWhoDiedIsSolvedByWhoWaits) {
  const Hall hall;
  const std::uint64_t key = LightKey(hall.world, hall.Draft(folder_), hall.all_on);
  Child holder(
      [&] { [[maybe_unused]] static auto lock = LightLock::Try(LockFileOf(folder_, key)); });
  std::set<std::string> phases;
  const auto progress = [&](const LightProgress& at) {
    phases.insert(at.phase);
    if (at.phase == std::string("another run solves it")) holder.Kill();
  };
  StaticLight(hall.world, hall.tracer, hall.textures, hall.Draft(folder_, progress));
  EXPECT_EQ(phases.count("another run solves it"), 1u);
  EXPECT_EQ(phases.count("direct light"), 1u);
  EXPECT_TRUE(HasLight(folder_, key));
}

/// What ends the work half-way (Ctrl-C in Python) leaves what it has for who goes on, and nothing
/// that could be taken for light.
TEST_F(LightLockTest, ASolutionThatIsBrokenOffLeavesWhatItHas) {
  const Hall hall;
  const auto progress = [&](const LightProgress& at) {
    if (at.phase == std::string("reflected light")) throw std::runtime_error("enough");
  };
  EXPECT_THROW(StaticLight(hall.world, hall.tracer, hall.textures, hall.Draft(folder_, progress)),
               std::runtime_error);
  const std::uint64_t key = LightKey(hall.world, hall.Draft(folder_), hall.all_on);
  EXPECT_TRUE(fs::remove(UnfinishedFileOf(folder_, key)));
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace aisle::sim
