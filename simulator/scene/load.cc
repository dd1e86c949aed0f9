#include "simulator/scene/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulator/scene/check.h"
#include "simulator/scene/check_routes.h"
#include "simulator/scene/extend.h"
#include "simulator/scene/reader.h"
#include "simulator/scene/rig_files.h"

namespace aisle::sim {
namespace {

struct Parsed {
  Scene scene;
  std::vector<std::string> messages;
};

void NumberPlaces(Scene* scene) {
  for (std::size_t i = 0; i < scene->people.size(); ++i) scene->people[i].place = i;
  for (std::size_t i = 0; i < scene->vehicles.size(); ++i) scene->vehicles[i].place = i;
}

/// What the text and the files it names say, as far as it is no mistake.
Scene ReadScene(const std::string& text, const std::string& file, Issues* issues) {
  Scene scene;
  scene.file = file;
  if (const auto top = ReadExtended(text, issues)) {
    YamlReader reader(*top, "", issues);
    Describe(reader, scene);
    reader.ReportKeys();
    NumberPlaces(&scene);
  }
  scene.files = issues->files();
  if (issues->empty()) ReadRigFiles(&scene, issues);
  return scene;
}

/// The stages of reading; each needs the one before to have found nothing.
Parsed Parse(const std::string& text, const std::string& file) {
  Issues issues(file);
  Scene scene = ReadScene(text, file, &issues);
  if (issues.empty()) CheckScene(scene, &issues);
  return {std::move(scene), issues.Messages()};
}

Parsed ParseFile(const std::filesystem::path& file) {
  std::string problem;
  const auto text = ReadSceneText(file, &problem);
  if (!text) return {{}, {problem}};
  return Parse(*text, file.string());
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
  Issues issues(scene.files);
  CheckRoutesOfSeed(scene, seed, &issues);
  return issues.Messages();
}

std::vector<std::string> CheckScene(const std::filesystem::path& file) {
  return ParseFile(file).messages;
}

std::vector<std::string> SceneFiles(const std::filesystem::path& file) {
  Issues issues(file.string());
  std::string problem;
  const auto text = ReadSceneText(file, &problem);
  return text ? ReadScene(*text, file.string(), &issues).files : issues.files();
}

}  // namespace aisle::sim
