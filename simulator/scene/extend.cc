#include "simulator/scene/extend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include "simulator/common/own_files.h"
#include "simulator/scene/hall_files.h"
#include "simulator/scene/yaml_guard.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxFileBytes = 1 << 20;
constexpr const char* kExtendExample = "; example: extend: paper/scene2";

/// The file that the entry of a scene names, or nothing with the reason in `issues`.
std::optional<fs::path> BaseOf(const YamlEntry& entry, Issues* issues) {
  const YamlValue& value = entry.value;
  if (!value.is_text() || value.text.empty()) {
    issues->Add(value.mark, kExtendKey,
                std::string("expected a scene file, as a path from this file's folder or by its "
                            "name among the scenes that come with the program") +
                    kExtendExample);
    return std::nullopt;
  }
  const std::vector<std::string>& files = issues->files();
  const fs::path base = NamedSceneFile(files.back(), value.text);
  const auto same = [&](const std::string& file) {
    return fs::weakly_canonical(file) == fs::weakly_canonical(base);
  };
  if (std::ranges::any_of(files, same)) {
    issues->Add(value.mark, kExtendKey,
                fmt::format("scenes extend each other in a cycle: {}, {}", fmt::join(files, ", "),
                            base.string()));
    return std::nullopt;
  }
  return base;
}

/// A scene's tree and those of all that it extends, nearest first.
std::optional<std::vector<YamlValue>> ReadLayers(const std::string& text, Issues* issues) {
  std::optional<YamlValue> tree = ReadTree(text, issues);
  if (!tree) return std::nullopt;
  std::vector<YamlValue> layers = {std::move(*tree)};
  while (const YamlEntry* entry = layers.back().Find(kExtendKey)) {
    const auto base = BaseOf(*entry, issues);
    if (!base) return std::nullopt;
    std::string problem;
    const auto base_text = ReadSceneText(*base, &problem);
    if (!base_text) {
      issues->Add(entry->value.mark, kExtendKey, problem + kExtendExample);
      return std::nullopt;
    }
    issues->AddFile(base->string());
    auto layer = ReadTree(*base_text, issues);
    if (!layer) return std::nullopt;
    layers.push_back(std::move(*layer));
  }
  return layers;
}

YamlValue Merged(const std::vector<YamlValue>& layers) {
  YamlValue merged = layers.back();
  for (auto over = layers.rbegin() + 1; over != layers.rend(); ++over) {
    merged = Overridden(std::move(merged), *over);
  }
  return merged;
}

}  // namespace

fs::path NamedSceneFile(const std::string& by, fs::path name) {
  if (name.extension() != ".yaml") name += ".yaml";
  const fs::path beside = (fs::path(by).parent_path() / name).lexically_normal();
  std::error_code failed;
  if (fs::exists(beside, failed)) return beside;
  const fs::path own = FindOwnFolder(OwnFile());
  const fs::path known = (own / "scenes" / name).lexically_normal();
  return !own.empty() && fs::exists(known, failed) ? known : beside;
}

std::optional<std::string> ReadSceneText(const fs::path& file, std::string* problem) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) {
    *problem = fmt::format("{}: no such file", file.string());
    return std::nullopt;
  }
  if (fs::file_size(file, failed) > kMaxFileBytes) {
    *problem = fmt::format("{}: larger than 1 MiB, too large for a scene", file.string());
    return std::nullopt;
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream) return text.str();
  for (const int of_the_machine : {EMFILE, ENFILE, ENOMEM, EIO}) {
    if (errno != of_the_machine) continue;
    throw std::system_error(errno, std::generic_category(), file.string() + ": not readable");
  }
  *problem = fmt::format("{}: not readable", file.string());
  return std::nullopt;
}

std::optional<YamlValue> ReadTree(const std::string& text, Issues* issues) {
  const int file = static_cast<int>(issues->files().size()) - 1;
  GuardYaml(text, file, issues);
  if (!issues->empty()) return std::nullopt;
  YamlValue tree = BuildYamlTree(text, file);
  if (tree.is_map()) return tree;
  issues->Add({1, 1, file}, "",
              "expected a map of scene keys; example: about: \"A person crosses.\"");
  return std::nullopt;
}

std::optional<SceneTrees> ReadExtended(const std::string& text, Issues* issues) {
  std::optional<std::vector<YamlValue>> layers = ReadLayers(text, issues);
  if (!layers) return std::nullopt;
  const auto names = std::ranges::find_if(*layers, NamesHalls);
  if (names == layers->end()) return SceneTrees{Merged(*layers), {}};
  const std::vector<NamedHall> halls = HallsOf(*names, issues);
  std::vector<YamlValue> below;
  for (const NamedHall& hall : halls) {
    if (auto tree = ReadHall(hall, issues)) below.push_back(std::move(*tree));
  }
  if (!issues->empty()) return std::nullopt;
  std::for_each(names + 1, layers->end(), RemoveHall);
  const auto place = layers->insert(names + 1, YamlValue{});
  SceneTrees trees;
  for (YamlValue& hall : below) {
    *place = std::move(hall);
    trees.dealt.push_back(Merged(*layers));
  }
  trees.top = trees.dealt.front();
  if (halls.front().key == kUseKey) trees.dealt.clear();
  return trees;
}

}  // namespace aisle::sim
