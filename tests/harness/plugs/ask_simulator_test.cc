#include "harness/plugs/ask_simulator.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {
namespace {

TEST(AskSimulator, TellsWhoseFaultItIs) {
  EXPECT_EQ(AskSimulator([] { return 3; }), 3);
  const auto machine = []() -> int {
    throw std::system_error(EMFILE, std::generic_category(), "x");
  };
  const auto file = []() -> int { throw std::runtime_error("x.yaml:1:1: no"); };
  EXPECT_THROW(AskSimulator(machine), MachineError);
  EXPECT_THROW(AskSimulator(file), InputError);
}

TEST(AskSimulator, ASceneThatCannotBeOpenedForTooManyFilesIsNoMistakeOfTheScene) {
  const std::string scene = AISLE_SOURCE_DIR "/scenes/smoke/short.yaml";
  EXPECT_GT(CountSceneFrames(scene), 0);
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{0, before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none);
  EXPECT_THROW(CountSceneFrames(scene), MachineError);
  ::setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_THROW(CountSceneFrames(scene + ".none"), InputError);
}

}  // namespace
}  // namespace aisle
