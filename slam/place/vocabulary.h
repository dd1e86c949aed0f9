#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "slam/feature/descriptor.h"

namespace aisle::slam {

/// How an image looks as a whole: the visual words it contains, by rising word, with weights that
/// sum to 1.
using WordVector = std::vector<std::pair<int, float>>;

/// Likeness of two images, 0 to 1: the weight they share (Nister & Stewenius 2006, L1 norm).
double Likeness(const WordVector& a, const WordVector& b);

/// A tree of visual words over binary descriptors: each node is a descriptor, and a descriptor's
/// word is the leaf reached by going to the nearest child at every level.
class Vocabulary {
 public:
  struct Options {
    int branching = 10;
    int depth = 4;
    int iterations = 8;      ///< of the clustering in each node
    std::uint64_t seed = 1;  ///< of the first centres
  };

  /// Clusters the descriptors of many images, as Galvez-Lopez and Tardos (2012) do: k-medians, of
  /// majority bits. Same images in the same order, same words. At least one descriptor is needed.
  static Vocabulary Train(const std::vector<std::vector<Descriptor>>& images,
                          const Options& options);

  /// Throws std::runtime_error that names the file and what is wrong with it.
  static Vocabulary Load(const std::filesystem::path& file);
  /// Whole or not at all. Throws std::runtime_error that names the file.
  void Save(const std::filesystem::path& file) const;

  int words() const { return words_; }
  WordVector Describe(const std::vector<Descriptor>& descriptors) const;

 private:
  struct Node {
    Descriptor centre{};
    std::int32_t first_child = -1;
    std::int32_t children = 0;
    std::int32_t word = -1;  // of a leaf
    float weight = 0;        // of a leaf: log(images / images that contain it)
  };
  int WordNode(const Descriptor& descriptor) const;
  void WeighWords(const std::vector<std::vector<Descriptor>>& images);

  std::vector<Node> nodes_;
  int words_ = 0;
};

}  // namespace aisle::slam
