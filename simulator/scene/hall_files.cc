#include "simulator/scene/hall_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "simulator/scene/extend.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 11> kHallKeys = {kHallKey,   "racks",  "stacks",     "columns",
                                                   "markings", "props",  "mezzanines", "doors",
                                                   "fixtures", "lights", kViewsKey};
constexpr const char* kHallExample = "; example: use: halls/cold_store.yaml";

/// The value at a path of two keys, or null.
const YamlValue* Inner(const YamlValue& tree, const char* key, const char* inner) {
  const YamlEntry* outer = tree.Find(key);
  const YamlEntry* entry = outer ? outer->value.Find(inner) : nullptr;
  return entry ? &entry->value : nullptr;
}

std::string PathOf(const NamedHall& hall) { return hall.key == kUseKey ? "hall.use" : "vary.hall"; }

/// A hall's file may not take its hall from another one.
void RefuseAllElse(const YamlValue& tree, Issues* issues) {
  if (const YamlValue* use = Inner(tree, kHallKey, kUseKey)) {
    issues->Add(use->mark, "hall.use",
                "not allowed in a hall's file, which describes the hall itself");
  }
  for (const YamlEntry& entry : tree.entries) {
    if (entry.key == "about" || IsHallKey(entry.key)) continue;
    issues->Add(entry.mark, entry.key.substr(0, 80),
                fmt::format("not allowed in a hall's file, which may have: about, {}",
                            fmt::join(kHallKeys, ", ")));
  }
}

/// Writes the name into the tree, where the scene's own `use` would stand.
void SetUse(const NamedHall& hall, YamlValue* tree) {
  auto there = std::ranges::find(tree->entries, kHallKey, &YamlEntry::key);
  if (there == tree->entries.end()) {
    YamlValue map;
    map.kind = YamlValue::Kind::kMap;
    map.mark = tree->mark;
    there = tree->entries.insert(there, YamlEntry{kHallKey, tree->mark, std::move(map)});
  }
  YamlValue name;
  name.kind = YamlValue::Kind::kText;
  name.mark = hall.mark;
  name.text = hall.name;
  if (there->value.is_map()) there->value.entries.push_back({kUseKey, hall.mark, std::move(name)});
}

}  // namespace

bool IsHallKey(const std::string& key) {
  return std::ranges::find(kHallKeys, key) != kHallKeys.end();
}

bool NamesHalls(const YamlValue& tree) {
  return Inner(tree, kHallKey, kUseKey) != nullptr || Inner(tree, kVaryKey, kHallKey) != nullptr;
}

std::vector<NamedHall> HallsOf(const YamlValue& tree, Issues* issues) {
  const YamlValue* use = Inner(tree, kHallKey, kUseKey);
  const YamlValue* varied = Inner(tree, kVaryKey, kHallKey);
  if (use && varied) {
    issues->Add(varied->mark, "vary.hall",
                "the hall is already chosen by hall.use; keep one of the two");
    return {};
  }
  const auto is_name = [](const YamlValue& item) { return item.is_text() && !item.text.empty(); };
  if (use) {
    if (is_name(*use)) return {{use->text, kUseKey, use->mark}};
    issues->Add(use->mark, "hall.use",
                std::string("expected the path of a hall's file") + kHallExample);
    return {};
  }
  std::vector<NamedHall> halls;
  for (const YamlValue& item : varied->items) {
    if (is_name(item)) halls.push_back({item.text, kHallKey, item.mark});
  }
  if (halls.empty() || halls.size() != varied->items.size()) {
    issues->Add(varied->mark, "vary.hall",
                "expected a list of paths of halls' files; example: vary: {hall: [halls/new.yaml, "
                "halls/cold_store.yaml]}");
  }
  return halls;
}

std::optional<YamlValue> ReadHall(const NamedHall& hall, Issues* issues) {
  const std::string& by = issues->files().at(static_cast<std::size_t>(hall.mark.file));
  const fs::path file = NamedSceneFile(by, hall.name);
  std::string problem;
  const auto text = ReadSceneText(file, &problem);
  if (!text) {
    issues->Add(hall.mark, PathOf(hall), problem + kHallExample);
    return std::nullopt;
  }
  issues->AddFile(file.string());
  std::optional<YamlValue> tree = ReadTree(*text, issues);
  if (!tree) return std::nullopt;
  RefuseAllElse(*tree, issues);
  std::erase_if(tree->entries, [](const YamlEntry& entry) { return entry.key == "about"; });
  SetUse(hall, &*tree);
  return tree;
}

void RemoveHall(YamlValue& tree) {
  std::erase_if(tree.entries, [](const YamlEntry& entry) { return IsHallKey(entry.key); });
  const auto vary = std::ranges::find(tree.entries, kVaryKey, &YamlEntry::key);
  if (vary == tree.entries.end()) return;
  std::erase_if(vary->value.entries, [](const YamlEntry& entry) { return entry.key == kHallKey; });
}

std::string HallName(const std::string& file) { return fs::path(file).stem().string(); }

}  // namespace aisle::sim
