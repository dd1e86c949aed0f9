#pragma once

#include <map>
#include <vector>

#include "slam/map/ids.h"
#include "slam/place/vocabulary.h"

namespace aisle::slam {

/// A keyframe and how much it looks like what was asked for.
struct PlaceMatch {
  KeyframeId keyframe;
  double similarity = 0;  ///< 0 to 1
};

/// Which keyframes contain which words (an inverted file, Sivic and Zisserman 2003): a query
/// touches only those that share some.
class PlaceIndex {
 public:
  void Add(KeyframeId id, const WordVector& words);
  void Remove(KeyframeId id);

  /// Null where the keyframe is not in the index.
  const WordVector* Find(KeyframeId id) const;

  /// Keyframes that share a word with the query, most alike first, then older first.
  std::vector<PlaceMatch> Query(const WordVector& words) const;

 private:
  std::map<KeyframeId, WordVector> images_;
  std::map<int, std::map<KeyframeId, float>> by_word_;
};

}  // namespace aisle::slam
