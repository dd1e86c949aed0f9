#pragma once

#include <string>
#include <vector>

#include "simulator/scene/mark.h"

namespace aisle::sim {

struct YamlEntry;

/// What stands at one place of a YAML file.
struct YamlValue {
  enum class Kind { kNull, kText, kMap, kList } kind = Kind::kNull;
  Mark mark;
  std::string text;                ///< of kText
  bool quoted = false;             ///< so that "1" is a text and 1 a number
  std::vector<YamlEntry> entries;  ///< of kMap, in the file's order
  std::vector<YamlValue> items;    ///< of kList

  bool is_null() const { return kind == Kind::kNull; }
  bool is_text() const { return kind == Kind::kText; }
  bool is_map() const { return kind == Kind::kMap; }
  bool is_list() const { return kind == Kind::kList; }
  /// The entry of a map; null where there is none.
  const YamlEntry* Find(const std::string& key) const;
};

struct YamlEntry {
  std::string key;  ///< empty where the key is no text
  Mark mark;        ///< of the key
  YamlValue value;
};

/// The tree of a text that GuardYaml has let pass; `file` goes into its marks.
YamlValue BuildYamlTree(const std::string& text, int file);

/// `base` where `over` says nothing else: maps key by key, anything else as a whole. Each value
/// keeps the mark of the file it comes from.
YamlValue Overridden(YamlValue base, const YamlValue& over);

}  // namespace aisle::sim
