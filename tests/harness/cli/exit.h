#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/cli/command_line.h"

namespace aisle {

/// The exit code of `aisle WORDS...`; what it says goes to `said`.
inline int Exit(std::vector<std::string> words, std::string* said = nullptr) {
  words.insert(words.begin(), "aisle");
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = RunCommandLine(static_cast<int>(argv.size()), argv.data());
  const std::string text =
      testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  if (said != nullptr) *said = text;
  return code;
}

}  // namespace aisle
