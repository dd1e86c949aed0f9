#include "slam/place/vocabulary.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "slam/place/place_index.h"

namespace aisle::slam {
namespace {

Descriptor RandomDescriptor(std::mt19937_64& random) {
  return {random(), random(), random(), random()};
}

/// Images of a few hundred kinds of features each; a feature differs in a few bits each time.
struct World {
  explicit World(int kinds) {
    for (int i = 0; i < kinds; ++i) kinds_.push_back(RandomDescriptor(random_));
  }
  std::vector<Descriptor> Image(int first_kind, int features) {
    std::vector<Descriptor> image;
    for (int i = 0; i < features; ++i) {
      Descriptor seen = kinds_[static_cast<std::size_t>(first_kind + i) % kinds_.size()];
      for (int flip = 0; flip < 12; ++flip) {
        const std::uint64_t bit = random_() % 256;
        seen[bit / 64] ^= std::uint64_t{1} << (bit % 64);
      }
      image.push_back(seen);
    }
    return image;
  }
  std::mt19937_64 random_{7};
  std::vector<Descriptor> kinds_;
};

std::vector<std::vector<Descriptor>> TrainingImages(World& world) {
  std::vector<std::vector<Descriptor>> images;
  for (int i = 0; i < 40; ++i) images.push_back(world.Image(50 * i, 200));
  return images;
}

TEST(Vocabulary, RecognisesAPlaceSeenAgain) {
  World world(2000);
  const Vocabulary vocabulary = Vocabulary::Train(TrainingImages(world), {});
  EXPECT_GT(vocabulary.words(), 500);
  PlaceIndex index;
  for (int place = 0; place < 20; ++place) {
    index.Add({place}, vocabulary.Describe(world.Image(100 * place, 100)));
  }
  for (int place = 0; place < 20; ++place) {
    const auto found = index.Query(vocabulary.Describe(world.Image(100 * place, 100)));
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front().keyframe, KeyframeId{place});
    EXPECT_GT(found.front().similarity, 2 * found[1].similarity);
  }
}

TEST(Vocabulary, AnImageIsWhollyLikeItself) {
  World world(500);
  const Vocabulary vocabulary = Vocabulary::Train(TrainingImages(world), {});
  const WordVector words = vocabulary.Describe(world.Image(0, 300));
  EXPECT_NEAR(Likeness(words, words), 1.0, 1e-5);
  EXPECT_EQ(Likeness(words, {}), 0.0);
  EXPECT_TRUE(vocabulary.Describe({}).empty());
}

std::string Bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Vocabulary, TrainsToTheSameBytesAndComesBackFromDisk) {
  World world(500), again(500);
  const std::filesystem::path a = testing::TempDir() + "a.voc", b = testing::TempDir() + "b.voc";
  const Vocabulary vocabulary = Vocabulary::Train(TrainingImages(world), {});
  vocabulary.Save(a);
  Vocabulary::Train(TrainingImages(again), {}).Save(b);
  EXPECT_EQ(Bytes(a), Bytes(b));
  const Vocabulary loaded = Vocabulary::Load(a);
  EXPECT_EQ(loaded.words(), vocabulary.words());
  const auto image = world.Image(0, 300);
  EXPECT_EQ(loaded.Describe(image), vocabulary.Describe(image));
}

TEST(Vocabulary, RefusesDamagedFiles) {
  World world(500);
  const std::filesystem::path file = testing::TempDir() + "damaged.voc";
  Vocabulary::Train(TrainingImages(world), {}).Save(file);
  const std::string whole = Bytes(file);
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 4;
  for (const std::string& bytes :
       {std::string(), std::string("something else entirely, long enough to be a header"),
        whole.substr(0, whole.size() / 2), flipped}) {
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_THROW(Vocabulary::Load(file), std::runtime_error);
  }
  EXPECT_THROW(Vocabulary::Load("/no/such/file"), std::runtime_error);
}

TEST(PlaceIndex, ForgetsWhatIsRemoved) {
  PlaceIndex index;
  index.Add({1}, {{3, 0.5f}, {4, 0.5f}});
  index.Add({2}, {{3, 1.0f}});
  EXPECT_EQ(index.Query({{3, 1.0f}}).front().keyframe, KeyframeId{2});
  index.Remove({2});
  index.Remove({2});
  EXPECT_EQ(index.Query({{3, 1.0f}}).front().keyframe, KeyframeId{1});
  EXPECT_EQ(index.Find({2}), nullptr);
  index.Remove({1});
  EXPECT_TRUE(index.Query({{3, 1.0f}}).empty());
}

}  // namespace
}  // namespace aisle::slam
