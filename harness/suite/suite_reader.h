#pragma once

#include <yaml-cpp/yaml.h>

#include "harness/suite/fields.h"
#include "harness/suite/issues.h"

namespace aisle {

/// Fills a struct from a YAML map. Mistakes go to `issues` and leave the value as it was. Call
/// ReportKeys() when the description has been through.
class YamlReader : public Fields {
 public:
  /// `path` is the dotted path of the map, empty for the top.
  YamlReader(YAML::Node map, std::string path, Issues* issues);

  void Name(const Key& key, std::string* value, const Words& words) override;
  void Text(const Key& key, std::string* value) override;
  void Number(const Key& key, double* value, Range range) override;
  void OptionalNumber(const Key& key, std::optional<double>* value, Range range) override;
  void Integer(const Key& key, int* value, Range range) override;
  void Names(const Key& key, std::vector<std::string>* values, const Words& words) override;
  void Texts(const Key& key, std::vector<std::string>* values, const Check& check) override;
  void CountOrList(const Key& key, std::vector<std::uint64_t>* values, int most) override;
  void Numbers(const Key& key, std::vector<double>* values, Range range) override;
  void Values(const Key& key, std::map<std::string, std::string>* values,
              const CheckValue& check) override;
  void Group(const Key& key, const Part& part) override;
  void List(const Key& key, const std::function<void(std::size_t)>& resize, const Element& element,
            const char* plain) override;
  bool Has(const char* key) const override;
  bool IsPlain() const override { return plain_; }
  void Fail(const char* key, const std::string& what) override;

  /// Reports keys that are missing or unknown; a misspelt one is reported once.
  void ReportKeys();

 private:
  /// The value of a key; remembers a required one that is missing.
  std::optional<YAML::Node> Find(const Key& key);
  std::string PathOf(const std::string& key) const;
  void Expected(const YAML::Node& node, const Key& key, const std::string& what);
  /// The words of a list or of a single value; reports what is none.
  std::vector<YAML::Node> Items(const YAML::Node& node, const Key& key);
  void ReadItem(const YAML::Node& item, std::size_t index, const Key& key, const Element& element,
                const char* plain);

  YAML::Node map_;
  std::string path_;
  Issues* issues_;
  bool plain_ = false;
  std::vector<std::string> known_;
  std::vector<Key> missing_;  ///< required keys that are not there
};

}  // namespace aisle
