#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// A folder of its own that goes away with the test.
class Scratch {
 public:
  Scratch()
      : path_(std::filesystem::path(testing::TempDir()) / fmt::format("aisle-mesh-{}", getpid())) {
    std::filesystem::create_directories(path_);
  }
  ~Scratch() { std::filesystem::remove_all(path_); }
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string TextOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What ImportModel complains of; empty when it loads.
inline std::string ErrorOf(const std::filesystem::path& file, const ImportOptions& options = {}) {
  try {
    ImportModel(file, options);
  } catch (const ImportError& error) {
    return error.what();
  }
  return "";
}

}  // namespace aisle::sim
