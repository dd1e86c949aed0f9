#pragma once

#include <map>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// Decodes the images of a model into its textures, each once for each use.
class TextureStore {
 public:
  TextureStore(const ImportOptions& options, Model* model) : options_(options), model_(model) {}

  /// Index of the texture of the image that `key` identifies; `bytes` is asked for its file's bytes
  /// the first time only. Normal maps keep their colours. Throws ImportError.
  int Add(const std::string& key, bool is_normal_map,
          const std::function<std::vector<std::uint8_t>()>& bytes);

 private:
  const ImportOptions& options_;
  Model* model_;
  std::map<std::pair<std::string, bool>, int> known_;
};

}  // namespace aisle::sim
