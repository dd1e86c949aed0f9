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

std::string BytesOf(const std::string& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return std::move(bytes).str();
}

/// FNV-1a, 64 bits: for what is too large to be kept as it is.
std::uint64_t DigestOf(std::string_view bytes) {
  std::uint64_t digest = 0xcbf29ce484222325;
  for (const char byte : bytes) {
    digest = (digest ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  }
  return digest;
}

/// The poses of a bag, of which all else does not matter.
std::string TextOf(const std::vector<TimedPose>& poses) {
  std::string text;
  for (const TimedPose& pose : poses) {
    text += fmt::format("{}", pose.time_ns);
    for (int i = 0; i < 12; ++i) text += fmt::format(" {}", pose.T_world_body(i / 4, i % 4));
  }
  return text;
}

/// What the files hold that a scene names, whose names say nothing.
void AppendNamedFiles(const std::filesystem::path& scene_file, std::size_t scene_files,
                      const BagPoseReader& bags, std::string* text) {
  const Scene scene = ReadSceneLoosely(scene_file, bags);
  for (std::size_t i = scene_files; i < scene.files.size(); ++i) {
    const std::string& file = scene.files[i];
    const bool is_mesh = std::ranges::find(scene.mesh_files, file) != scene.mesh_files.end();
    const bool is_bag = file.ends_with(".mcap") || file.ends_with(".db3");
    const std::string bytes = is_bag ? TextOf(scene.rig.poses) : BytesOf(file);
    if (is_mesh || is_bag) {
      *text += fmt::format("h{}:{:016x}", bytes.size(), DigestOf(bytes));
    } else {
      *text += fmt::format("f{}:{}", bytes.size(), bytes);
    }
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

std::string EssenceOf(const std::filesystem::path& file, bool with_actors,
                      const BagPoseReader& bags) {
  std::string problem;
  const auto text = ReadSceneText(file, &problem);
  if (!text) throw SceneError({problem});
  Issues issues(file.string());
  std::optional<SceneTrees> trees = ReadExtended(*text, &issues);
  if (!trees) throw SceneError(issues.Messages());
  std::string essence;
  Append(Seen(std::move(trees->top), with_actors), &essence);
  for (YamlValue& tree : trees->dealt) Append(Seen(std::move(tree), with_actors), &essence);
  AppendNamedFiles(file, issues.files().size(), bags, &essence);
  return essence;
}

}  // namespace aisle::sim
