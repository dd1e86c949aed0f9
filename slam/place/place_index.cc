#include "slam/place/place_index.h"

#include <algorithm>

namespace aisle::slam {

void PlaceIndex::Add(KeyframeId id, const WordVector& words) {
  Remove(id);
  images_[id] = words;
  for (const auto& [word, weight] : words) by_word_[word][id] = weight;
}

void PlaceIndex::Remove(KeyframeId id) {
  const auto image = images_.find(id);
  if (image == images_.end()) return;
  for (const auto& [word, weight] : image->second) {
    const auto entries = by_word_.find(word);
    entries->second.erase(id);
    if (entries->second.empty()) by_word_.erase(entries);
  }
  images_.erase(image);
}

const WordVector* PlaceIndex::Find(KeyframeId id) const {
  const auto image = images_.find(id);
  return image == images_.end() ? nullptr : &image->second;
}

std::vector<PlaceMatch> PlaceIndex::Query(const WordVector& words) const {
  std::map<KeyframeId, double> similarity;
  for (const auto& [word, weight] : words) {
    const auto entries = by_word_.find(word);
    if (entries == by_word_.end()) continue;
    for (const auto& [id, other] : entries->second) similarity[id] += std::min(weight, other);
  }
  std::vector<PlaceMatch> found;
  for (const auto& [id, value] : similarity) found.push_back({id, value});
  std::stable_sort(found.begin(), found.end(), [](const PlaceMatch& a, const PlaceMatch& b) {
    return a.similarity > b.similarity;
  });
  return found;
}

}  // namespace aisle::slam
