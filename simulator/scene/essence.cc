#include "simulator/scene/essence.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "simulator/scene/extend.h"
#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

/// Each part behind its kind and size, so that no two trees have one text.
void Append(const YamlValue& value, std::string* text) {
  switch (value.kind) {
    case YamlValue::Kind::kNull:
      *text += "~";
      return;
    case YamlValue::Kind::kText:
      *text += fmt::format("{}{}:{}", value.quoted ? "q" : "t", value.text.size(), value.text);
      return;
    case YamlValue::Kind::kList:
      *text += fmt::format("l{}:", value.items.size());
      for (const YamlValue& item : value.items) Append(item, text);
      return;
    case YamlValue::Kind::kMap:
      break;
  }
  std::vector<const YamlEntry*> entries;
  for (const YamlEntry& entry : value.entries) entries.push_back(&entry);
  std::sort(entries.begin(), entries.end(),
            [](const YamlEntry* a, const YamlEntry* b) { return a->key < b->key; });
  *text += fmt::format("m{}:", entries.size());
  for (const YamlEntry* entry : entries) {
    *text += fmt::format("{}:{}", entry->key.size(), entry->key);
    Append(entry->value, text);
  }
}

/// The bytes of the files that a real rig brings, whose names say nothing.
void AppendRigFiles(const std::filesystem::path& scene_file, std::size_t scene_files,
                    std::string* text) {
  const std::vector<std::string> files = SceneFiles(scene_file);
  for (std::size_t i = scene_files; i < files.size(); ++i) {
    std::ostringstream bytes;
    bytes << std::ifstream(files[i], std::ios::binary).rdbuf();
    *text += fmt::format("f{}:{}", bytes.view().size(), bytes.view());
  }
}

bool IsSeen(const std::string& key, bool with_actors) {
  if (key == "about" || key == kExtendKey || key == kVaryKey) return false;
  return with_actors || (key != "people" && key != "vehicles" && key != "crowd");
}

/// Without what cannot be seen: a hall is what its file holds, whatever that is called.
YamlValue Seen(YamlValue tree, bool with_actors) {
  std::erase_if(tree.entries,
                [&](const YamlEntry& entry) { return !IsSeen(entry.key, with_actors); });
  const auto hall = std::ranges::find(tree.entries, kHallKey, &YamlEntry::key);
  if (hall != tree.entries.end()) {
    std::erase_if(hall->value.entries, [](const YamlEntry& entry) { return entry.key == kUseKey; });
  }
  return tree;
}

}  // namespace

std::string EssenceOf(const std::filesystem::path& file, bool with_actors) {
  std::string problem;
  const auto text = ReadSceneText(file, &problem);
  if (!text) throw SceneError({problem});
  Issues issues(file.string());
  std::optional<SceneTrees> trees = ReadExtended(*text, &issues);
  if (!trees) throw SceneError(issues.Messages());
  std::string essence;
  Append(Seen(std::move(trees->top), with_actors), &essence);
  for (YamlValue& tree : trees->dealt) Append(Seen(std::move(tree), with_actors), &essence);
  AppendRigFiles(file, issues.files().size(), &essence);
  return essence;
}

}  // namespace aisle::sim
