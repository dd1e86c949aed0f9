#include "simulator/scene/fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "simulator/scene/load.h"
#include "simulator/scene/reader.h"

namespace aisle::sim {
namespace {

/// Reads the example of every key as if it stood in a file.
class ExampleReader : public Fields {
 public:
  void Number(const Key& key, double* value, Range range) override {
    Read(key, [&](Fields& f) { f.Number(key, value, range); });
  }
  void Integer(const Key& key, int* value, Range range) override {
    Read(key, [&](Fields& f) { f.Integer(key, value, range); });
  }
  void Flag(const Key& key, bool* value) override {
    Read(key, [&](Fields& f) { f.Flag(key, value); });
  }
  void Name(const Key& key, std::string* value) override {
    Read(key, [&](Fields& f) { f.Name(key, value); });
  }
  void Sentence(const Key& key, std::string* value) override {
    Read(key, [&](Fields& f) { f.Sentence(key, value); });
  }
  void Sentences(const Key& key, std::vector<std::string>* values) override {
    Read(key, [&](Fields& f) { f.Sentences(key, values); });
  }
  void Numbers(const Key& key, double* values, std::size_t count, Range range) override {
    Read(key, [&](Fields& f) { f.Numbers(key, values, count, range); });
  }
  void Integers(const Key& key, int* values, std::size_t count, Range range) override {
    Read(key, [&](Fields& f) { f.Integers(key, values, count, range); });
  }
  void Points(const Key& key, std::vector<Eigen::Vector2d>* values,
              std::vector<Mark>* marks) override {
    Read(key, [&](Fields& f) { f.Points(key, values, marks); });
  }
  void Group(const Key& key, const Part& part) override {
    Read(key, [&](Fields& f) { f.Group(key, part); });
    ++depth_;
    part(*this);
    --depth_;
  }
  void List(const Key& key, const std::function<void(std::size_t)>& resize,
            const Element& element) override {
    Read(key, [&](Fields& f) { f.List(key, resize, element); });
    ++depth_;
    resize(1);
    element(*this, 0);
    resize(0);
    --depth_;
  }
  Mark mark() const override { return {}; }
  Mark MarkOf(const char* /*key*/) const override { return {}; }
  bool Has(const char* /*key*/) const override { return false; }

  int count() const { return count_; }
  /// Of a scene's own keys, the maps and lists whole.
  const std::map<std::string, std::string>& top() const { return top_; }

 protected:
  void ChoiceIndex(const Key& key, int* index, std::initializer_list<const char*> names) override {
    Read(key, [&](Fields& f) {
      auto choice = static_cast<Any>(*index);
      f.Choice(key, &choice, names);
      *index = static_cast<int>(choice);
    });
  }

 private:
  enum class Any {};

  void Read(const Key& key, const std::function<void(Fields&)>& read) {
    ++count_;
    if (depth_ == 0) top_[key.name] = key.example;
    const YamlValue map = BuildYamlTree(fmt::format("{}: {}\n", key.name, key.example), 0);
    Issues issues("example");
    YamlReader reader(map, "", &issues);
    read(reader);
    reader.ReportKeys();
    EXPECT_THAT(issues.Messages(), testing::IsEmpty());
  }

  int count_ = 0, depth_ = 0;
  std::map<std::string, std::string> top_;
};

TEST(Fields, EveryKeysExampleMayStandInAFile) {
  ExampleReader reader;
  Scene scene;
  Describe(reader, scene);
  EXPECT_GT(reader.count(), 200);
}

/// What can be read may still be refused: a door that slides nowhere, a crowd without room.
TEST(Fields, ASceneMayHaveTheExampleOfEachOfItsKeys) {
  ExampleReader reader;
  Scene scene;
  Describe(reader, scene);
  const std::map<std::string, std::string> needed = {
      {"about", reader.top().at("about")},
      {"rig", "{start: [0, -5], steps: [{go: [[8, -5]], speed_mps: 0.9}]}"},
      {"hall", reader.top().at("hall")},
      {"lights", reader.top().at("lights")}};
  int checked = 0;
  for (const auto& [name, example] : reader.top()) {
    if (name == "extend" || name == "vary") continue;  // they name files
    std::map<std::string, std::string> keys = needed;
    keys[name] = example;
    std::string text;
    for (const auto& [key, value] : keys) text += fmt::format("{}: {}\n", key, value);
    EXPECT_NO_THROW(ParseScene(text, "s.yaml")) << text;
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

}  // namespace
}  // namespace aisle::sim
