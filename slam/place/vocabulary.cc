#include "slam/place/vocabulary.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "slam/common/checksum.h"
#include "slam/common/mix.h"
#include "slam/common/write_aside.h"

namespace aisle::slam {
namespace {

constexpr char kMagic[8] = {'a', 'i', 's', 'l', 'e', 'v', 'o', 'c'};
constexpr std::uint32_t kVersion = 1;

struct Header {
  char magic[8];
  std::uint32_t version, nodes;
  std::uint64_t checksum;
};

using Members = std::vector<const Descriptor*>;

std::size_t Nearest(const Descriptor& descriptor, const std::vector<Descriptor>& centres) {
  std::size_t nearest = 0;
  int least = 257;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const int distance = HammingDistance(descriptor, centres[i]);
    if (distance < least) least = distance, nearest = i;
  }
  return nearest;
}

/// The descriptor whose every bit is that of the majority.
Descriptor MajorityOf(const Members& members) {
  std::array<std::size_t, 256> set{};
  for (const Descriptor* member : members) {
    for (std::size_t bit = 0; bit < 256; ++bit) set[bit] += ((*member)[bit / 64] >> (bit % 64)) & 1;
  }
  Descriptor majority{};
  for (std::size_t bit = 0; bit < 256; ++bit) {
    if (2 * set[bit] > members.size()) majority[bit / 64] |= std::uint64_t{1} << (bit % 64);
  }
  return majority;
}

struct Cluster {
  Descriptor centre;
  Members members;
};

std::vector<Cluster> Divide(const Members& members, const Vocabulary::Options& options,
                            std::uint64_t seed) {
  std::set<Descriptor> first;
  for (int draw = 0; draw < 4 * options.branching && std::ssize(first) < options.branching;
       ++draw) {
    first.insert(*members[Mix(kGolden + seed + static_cast<std::uint64_t>(draw)) % members.size()]);
  }
  std::vector<Descriptor> centres(first.begin(), first.end());
  std::vector<Cluster> clusters;
  for (int i = 0; i < options.iterations; ++i) {
    clusters.assign(centres.size(), {});
    for (const Descriptor* member : members) {
      clusters[Nearest(*member, centres)].members.push_back(member);
    }
    std::erase_if(clusters, [](const Cluster& cluster) { return cluster.members.empty(); });
    std::vector<Descriptor> moved;
    for (Cluster& cluster : clusters) {
      cluster.centre = MajorityOf(cluster.members);
      moved.push_back(cluster.centre);
    }
    if (moved == centres) break;
    centres = std::move(moved);
  }
  return clusters;
}

}  // namespace

double Likeness(const WordVector& a, const WordVector& b) {
  double shared = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (i->first == j->first) {
      shared += std::min(i->second, j->second);
      ++i, ++j;
    } else {
      i->first < j->first ? ++i : ++j;
    }
  }
  return shared;
}

Vocabulary Vocabulary::Train(const std::vector<std::vector<Descriptor>>& images,
                             const Options& options) {
  struct Open {
    std::size_t node;
    int depth;
    Members members;
  };
  Members all;
  for (const auto& image : images) {
    for (const Descriptor& descriptor : image) all.push_back(&descriptor);
  }
  if (all.empty()) throw std::invalid_argument("Vocabulary::Train: no descriptors to train on");
  Vocabulary vocabulary;
  vocabulary.nodes_.emplace_back();
  std::deque<Open> open;
  open.push_back({0, 0, std::move(all)});
  while (!open.empty()) {
    const Open here = std::move(open.front());
    open.pop_front();
    std::vector<Cluster> clusters;
    if (here.depth < options.depth && std::ssize(here.members) > options.branching) {
      clusters = Divide(here.members, options, Mix(kGolden + options.seed) + 1000003 * here.node);
    }
    if (clusters.size() < 2) {
      vocabulary.nodes_[here.node].word = vocabulary.words_++;
      continue;
    }
    vocabulary.nodes_[here.node].first_child = static_cast<std::int32_t>(vocabulary.nodes_.size());
    vocabulary.nodes_[here.node].children = static_cast<std::int32_t>(clusters.size());
    for (Cluster& cluster : clusters) {
      open.push_back({vocabulary.nodes_.size(), here.depth + 1, std::move(cluster.members)});
      vocabulary.nodes_.push_back({cluster.centre, -1, 0, -1, 0});
    }
  }
  vocabulary.WeighWords(images);
  return vocabulary;
}

void Vocabulary::WeighWords(const std::vector<std::vector<Descriptor>>& images) {
  std::map<int, int> images_with;
  for (const auto& image : images) {
    std::set<int> nodes;
    for (const Descriptor& descriptor : image) nodes.insert(WordNode(descriptor));
    for (const int node : nodes) ++images_with[node];
  }
  for (const auto& [node, count] : images_with) {
    // One image more than there are: a word seen in all of them still weighs something.
    nodes_[static_cast<std::size_t>(node)].weight =
        std::log(static_cast<float>(images.size() + 1) / static_cast<float>(count));
  }
}

int Vocabulary::WordNode(const Descriptor& descriptor) const {
  int node = 0;
  while (nodes_[static_cast<std::size_t>(node)].children > 0) {
    const Node& parent = nodes_[static_cast<std::size_t>(node)];
    int least = 257;
    for (int child = parent.first_child; child < parent.first_child + parent.children; ++child) {
      const int distance =
          HammingDistance(descriptor, nodes_[static_cast<std::size_t>(child)].centre);
      if (distance < least) least = distance, node = child;
    }
  }
  return node;
}

WordVector Vocabulary::Describe(const std::vector<Descriptor>& descriptors) const {
  std::map<int, float> weights;
  for (const Descriptor& descriptor : descriptors) {
    const Node& leaf = nodes_[static_cast<std::size_t>(WordNode(descriptor))];
    if (leaf.weight > 0) weights[leaf.word] += leaf.weight;
  }
  float sum = 0;
  for (const auto& [word, weight] : weights) sum += weight;
  WordVector words(weights.begin(), weights.end());
  for (auto& [word, weight] : words) weight /= sum;
  return words;
}

void Vocabulary::Save(const std::filesystem::path& file) const {
  const char* bytes = reinterpret_cast<const char*>(nodes_.data());
  const std::size_t size = nodes_.size() * sizeof(Node);
  Header header{
      {}, kVersion, static_cast<std::uint32_t>(nodes_.size()), ChecksumOfBytes({bytes, size})};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  WriteAside(file, {{reinterpret_cast<const char*>(&header), sizeof(header)}, {bytes, size}});
}

Vocabulary Vocabulary::Load(const std::filesystem::path& file) {
  const auto fail = [&](const char* what) -> std::runtime_error {
    return std::runtime_error(fmt::format("{}: {}", file.string(), what));
  };
  std::ifstream in(file, std::ios::binary);
  if (!in) throw fail("cannot open it");
  Header header{};
  in.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!in || std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) {
    throw fail("not a vocabulary; train one with `aisle vocabulary train`");
  }
  if (header.version != kVersion) throw fail("has another version; train it again");
  constexpr std::uint32_t kMostNodes = 1u << 22;
  if (header.nodes == 0 || header.nodes > kMostNodes) throw fail("damaged: number of nodes");
  Vocabulary vocabulary;
  vocabulary.nodes_.resize(header.nodes);
  const std::size_t size = vocabulary.nodes_.size() * sizeof(Node);
  in.read(reinterpret_cast<char*>(vocabulary.nodes_.data()), static_cast<std::streamsize>(size));
  if (!in) throw fail("ends too early");
  const std::string_view bytes(reinterpret_cast<const char*>(vocabulary.nodes_.data()), size);
  if (ChecksumOfBytes(bytes) != header.checksum) {
    throw fail("damaged: checksum");
  }
  for (std::size_t i = 0; i < vocabulary.nodes_.size(); ++i) {
    const Node& node = vocabulary.nodes_[i];
    const std::int64_t end = std::int64_t{node.first_child} + node.children;
    const bool leaf = node.children == 0 && node.word >= 0;
    const bool inner = node.children > 0 && node.first_child > static_cast<std::int64_t>(i) &&
                       end <= std::ssize(vocabulary.nodes_);
    if (!leaf && !inner) throw fail("damaged: not a tree");
    vocabulary.words_ += leaf;
  }
  return vocabulary;
}

}  // namespace aisle::slam
