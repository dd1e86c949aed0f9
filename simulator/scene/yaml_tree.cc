#include "simulator/scene/yaml_tree.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace aisle::sim {
namespace {

using Kind = YamlValue::Kind;

class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(int file) : file_(file) {}

  YamlValue TakeRoot() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { Put(New(Kind::kNull, mark)); }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { Put(New(Kind::kNull, mark)); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    YamlValue text = New(Kind::kText, mark);
    text.text = value;
    text.quoted = tag == "!";
    Put(std::move(text));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open_.push_back({New(Kind::kList, mark), std::nullopt});
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open_.push_back({New(Kind::kMap, mark), std::nullopt});
  }
  void OnMapEnd() override { Close(); }

 private:
  struct Open {
    YamlValue value;
    std::optional<YamlEntry> entry;  ///< of a map, whose value is to come
  };

  YamlValue New(Kind kind, const YAML::Mark& mark) const {
    YamlValue value;
    value.kind = kind;
    value.mark = {mark.line + 1, mark.column + 1, file_};
    return value;
  }

  void Put(YamlValue value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    auto& [outer, entry] = open_.back();
    if (outer.is_list()) {
      outer.items.push_back(std::move(value));
    } else if (!entry) {
      entry = YamlEntry{value.text, value.mark, {}};
    } else {
      entry->value = std::move(value);
      outer.entries.push_back(std::move(*entry));
      entry.reset();
    }
  }

  void Close() {
    YamlValue done = std::move(open_.back().value);
    open_.pop_back();
    Put(std::move(done));
  }

  const int file_;
  std::vector<Open> open_;
  YamlValue root_;
};

}  // namespace

const YamlEntry* YamlValue::Find(const std::string& key) const {
  const auto found = std::ranges::find(entries, key, &YamlEntry::key);
  return found == entries.end() ? nullptr : &*found;
}

YamlValue BuildYamlTree(const std::string& text, int file) {
  std::istringstream stream(text);
  TreeBuilder builder(file);
  YAML::Parser parser(stream);
  parser.HandleNextDocument(builder);
  return builder.TakeRoot();
}

YamlValue Overridden(YamlValue base, const YamlValue& over) {
  if (!base.is_map() || !over.is_map()) return over;
  base.mark = over.mark;
  for (const YamlEntry& entry : over.entries) {
    const auto there = std::ranges::find(base.entries, entry.key, &YamlEntry::key);
    if (there == base.entries.end()) {
      base.entries.push_back(entry);
    } else {
      there->mark = entry.mark;
      there->value = Overridden(std::move(there->value), entry.value);
    }
  }
  return base;
}

}  // namespace aisle::sim
