#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace aisle::sim {

/// Whether `file`, with links resolved, exists inside the folder `root`.
bool IsInside(const std::filesystem::path& file, const std::filesystem::path& root);

/// All of a file; empty when it cannot be read.
std::vector<std::uint8_t> ReadBytes(const std::filesystem::path& file);

/// Lets assimp read regular files inside one folder and nothing else: what a model names may come
/// from anyone.
class ConfinedFiles : public Assimp::DefaultIOSystem {
 public:
  ConfinedFiles(std::filesystem::path root, std::size_t max_bytes)
      : root_(std::move(root)), max_bytes_(max_bytes) {}

  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;

 private:
  bool Allows(const std::filesystem::path& file) const;

  std::filesystem::path root_;
  std::size_t max_bytes_;
};

}  // namespace aisle::sim
