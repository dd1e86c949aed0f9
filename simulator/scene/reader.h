#pragma once

#include "simulator/scene/fields.h"
#include "simulator/scene/issues.h"
#include "simulator/scene/yaml_tree.h"

namespace aisle::sim {

/// Fills a struct from a YAML map, which outlives it. Mistakes go to `issues` and leave the value
/// as it was. Call ReportKeys() when the description has been through.
class YamlReader : public Fields {
 public:
  /// `path` is the dotted path of the map, "" for the top.
  YamlReader(const YamlValue& map, std::string path, Issues* issues);

  void Number(const Key& key, double* value, Range range) override;
  void Integer(const Key& key, int* value, Range range) override;
  void Flag(const Key& key, bool* value) override;
  void Name(const Key& key, std::string* value) override;
  void Sentence(const Key& key, std::string* value) override;
  void Sentences(const Key& key, std::vector<std::string>* values) override;
  void Numbers(const Key& key, double* values, std::size_t count, Range range) override;
  void Integers(const Key& key, int* values, std::size_t count, Range range) override;
  void Points(const Key& key, std::vector<Eigen::Vector2d>* values,
              std::vector<Mark>* marks) override;
  void Group(const Key& key, const Part& part) override;
  void List(const Key& key, const std::function<void(std::size_t)>& resize,
            const Element& element) override;
  Mark mark() const override;
  Mark MarkOf(const char* key) const override;
  bool Has(const char* key) const override;
  void OnlyWith(const char* other, std::initializer_list<const char*> keys) override;
  /// Reports keys that are missing, unknown or without the one they need; a misspelt one is
  /// reported once.
  void ReportKeys();

 protected:
  void ChoiceIndex(const Key& key, int* index, std::initializer_list<const char*> names) override;

 private:
  /// The value of a key, or null; remembers a required key that is missing.
  const YamlValue* Find(const Key& key);
  std::string PathOf(const std::string& key) const;
  void Expected(const YamlValue& value, const Key& key, const std::string& what);
  bool ReadPair(const YamlValue& list, double* values, std::size_t count, Range range) const;

  const YamlValue& map_;
  std::string path_;
  Issues* issues_;
  std::vector<std::string> known_;
  std::vector<Key> missing_;                             ///< required keys that are not there
  std::vector<std::pair<GivenKey, std::string>> alone_;  ///< keys without the one they need
};

}  // namespace aisle::sim
