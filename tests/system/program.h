#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "harness/campaign/process.h"
#include "harness/record/results.h"

namespace aisle {

/// How the program ended and the last of what it said (stdout and stderr).
struct Said {
  int code = -1;
  std::string text;
};

/// The real program in a folder of its own: a short scene, its own cache of frames.
class ProgramTest : public testing::Test {
 protected:
  /// Shared by the tests of one program: frames are rendered once.
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  void SetUp() override;
  void TearDown() override;

  static Said Run(const std::vector<std::string>& arguments, double timeout_s = 300);
  /// Starts the program and kills it, and all that it started, after so many seconds. False when it
  /// had ended before.
  static bool Kill(const std::vector<std::string>& arguments, double after_s);

  /// Writes a suite of the short scene below the test's folder and returns its path.
  std::string Suite(const std::string& name, const std::string& systems,
                    const std::string& more = "seeds: 1\n") const;
  std::string Out(const std::string& name) const { return (folder_ / name).string(); }
  static Results ResultsOf(const std::string& out) { return ReadResults(out); }
  /// The bits of every run by its id: hash of the trajectories and all scores but the machine's.
  static std::map<std::string, std::string> Bits(const std::string& out);

  std::filesystem::path folder_;
  std::string scene_;  ///< the short scene

 private:
  static std::filesystem::path root_;
};

}  // namespace aisle
