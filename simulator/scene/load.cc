#include "simulator/scene/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <sstream>

#include "simulator/scene/check.h"
#include "simulator/scene/check_routes.h"
#include "simulator/scene/reader.h"
#include "simulator/scene/yaml_guard.h"

namespace aisle::sim {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 1 << 20;

struct Parsed {
  Scene scene;
  std::vector<std::string> messages;
};

void NumberPlaces(Scene* scene) {
  for (std::size_t i = 0; i < scene->people.size(); ++i) scene->people[i].place = i;
  for (std::size_t i = 0; i < scene->vehicles.size(); ++i) scene->vehicles[i].place = i;
}

/// The stages of reading; each needs the one before to have found nothing.
Parsed Parse(const std::string& text, const std::string& file) {
  Issues issues(file);
  Scene scene;
  scene.file = file;
  GuardYaml(text, &issues);
  if (issues.empty()) {
    const YAML::Node top = YAML::Load(text);
    if (top.IsMap()) {
      YamlReader reader(top, "", &issues);
      Describe(reader, scene);
      reader.ReportKeys();
      NumberPlaces(&scene);
    } else {
      issues.Add({1, 1}, "", "expected a map of scene keys; example: about: \"A person crosses.\"");
    }
  }
  if (issues.empty()) CheckScene(scene, &issues);
  return {std::move(scene), issues.Messages()};
}

/// The file's text, or why there is none.
std::string ReadText(const std::filesystem::path& file, std::string* problem) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) {
    *problem = fmt::format("{}: there is no such file", file.string());
    return "";
  }
  if (std::filesystem::file_size(file, failed) > kMaxFileBytes) {
    *problem =
        fmt::format("{}: the file is larger than 1 MiB, too large for a scene", file.string());
    return "";
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) *problem = fmt::format("{}: it cannot be read", file.string());
  return text.str();
}

Parsed ParseFile(const std::filesystem::path& file) {
  std::string problem;
  const std::string text = ReadText(file, &problem);
  if (!problem.empty()) return {{}, {problem}};
  return Parse(text, file.string());
}

Scene SceneOrThrow(Parsed parsed) {
  if (!parsed.messages.empty()) throw SceneError(std::move(parsed.messages));
  return std::move(parsed.scene);
}

}  // namespace

SceneError::SceneError(std::vector<std::string> messages)
    : std::runtime_error(fmt::format("{}", fmt::join(messages, "\n"))),
      messages_(std::move(messages)) {}

Scene LoadScene(const std::filesystem::path& file) { return SceneOrThrow(ParseFile(file)); }

Scene ParseScene(const std::string& text, const std::string& file) {
  return SceneOrThrow(Parse(text, file));
}

std::vector<std::string> CheckSeed(const Scene& scene, std::uint64_t seed) {
  Issues issues(scene.file);
  CheckRoutesOfSeed(scene, seed, &issues);
  return issues.Messages();
}

std::vector<std::string> CheckScene(const std::filesystem::path& file) {
  return ParseFile(file).messages;
}

}  // namespace aisle::sim
