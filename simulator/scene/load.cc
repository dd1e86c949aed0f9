#include "simulator/scene/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulator/scene/check.h"
#include "simulator/scene/check_routes.h"
#include "simulator/scene/extend.h"
#include "simulator/scene/mesh_files.h"
#include "simulator/scene/reader.h"
#include "simulator/scene/rig_files.h"
#include "simulator/scene/within_reach.h"

namespace aisle::sim {
namespace {

struct Parsed {
  Scene scene;
  std::vector<std::string> messages;
};

void NumberPlaces(Scene* scene) {
  for (std::size_t i = 0; i < scene->people.size(); ++i) scene->people[i].place = i;
  for (std::size_t i = 0; i < scene->vehicles.size(); ++i) scene->vehicles[i].place = i;
  for (std::size_t i = 0; i < scene->mechanisms.size(); ++i) scene->mechanisms[i].place = i;
}

/// The rig of a hall's own scene is at one view after the other, a frame each.
void StandAtViews(Scene* scene) {
  scene->frames = std::max(1, static_cast<int>(scene->views.size()));
  for (std::size_t i = 0; i < scene->views.size(); ++i) {
    const ViewSpec& view = scene->views[i];
    TimedPose pose{std::llround(1e9 * static_cast<double>(i) / scene->rate_hz),
                   Eigen::Isometry3d::Identity()};
    pose.T_world_body =
        RigPose({.position = view.at, .heading_rad = view.heading_rad},
                {.height_m = view.height_m, .forward_m = 0, .pitch_rad = view.pitch_rad}, {}, 0);
    scene->rig.poses.push_back(pose);
  }
  if (scene->views.empty()) return;
  scene->rig.mark = scene->rig.route.mark = scene->views.front().mark;
  scene->rig.route.plan.start = scene->views.front().at;
}

/// What the text and the files it names say, as far as it is no mistake.
Scene ReadScene(const std::string& text, const std::string& file, const BagPoseReader& bags,
                Issues* issues) {
  Scene scene;
  scene.file = file;
  if (const auto trees = ReadExtended(text, issues)) {
    YamlReader reader(trees->top, "", issues);
    Describe(reader, scene);
    reader.ReportKeys();
    NumberPlaces(&scene);
    for (const YamlValue& tree : trees->dealt) {
      YamlReader hall(tree, "", issues);
      DescribePremises(hall, scene.dealt.emplace_back());
    }
    if (trees->top.Find("rig") == nullptr) StandAtViews(&scene);
    if (scene.drive.there) scene.rig.route = WithinReach(scene.rig.route, scene.drive);
  }
  scene.files = issues->files();
  if (issues->empty()) ReadRigFiles(&scene, bags, issues);
  if (issues->empty()) FindMeshFiles(&scene, issues);
  return scene;
}

/// The stages of reading; each needs the one before to have found nothing.
Parsed Parse(const std::string& text, const std::string& file, const BagPoseReader& bags) {
  Issues issues(file);
  Scene scene = ReadScene(text, file, bags, &issues);
  if (issues.empty()) CheckScene(scene, &issues);
  for (const Premises& premises : scene.dealt) {  // any of them may be there
    Scene dealt = scene;
    static_cast<Premises&>(dealt) = premises;
    dealt.dealt.clear();
    if (issues.empty()) CheckScene(dealt, &issues);
  }
  return {std::move(scene), issues.Messages()};
}

Parsed ParseFile(const std::filesystem::path& file, const BagPoseReader& bags) {
  std::string problem;
  const auto text = ReadSceneText(file, &problem);
  if (!text) return {{}, {problem}};
  return Parse(*text, file.string(), bags);
}

Scene SceneOrThrow(Parsed parsed) {
  if (!parsed.messages.empty()) throw SceneError(std::move(parsed.messages));
  return std::move(parsed.scene);
}

}  // namespace

SceneError::SceneError(std::vector<std::string> messages)
    : std::runtime_error(fmt::format("{}", fmt::join(messages, "\n"))),
      messages_(std::move(messages)) {}

Scene LoadScene(const std::filesystem::path& file, const BagPoseReader& bags) {
  return SceneOrThrow(ParseFile(file, bags));
}

Scene ParseScene(const std::string& text, const std::string& file, const BagPoseReader& bags) {
  return SceneOrThrow(Parse(text, file, bags));
}

std::vector<std::string> CheckSeed(const Scene& scene, std::uint64_t seed, const FloorWays& ways) {
  Issues issues(scene.files);
  CheckRoutesOfSeed(scene, seed, &issues, ways);
  return issues.Messages();
}

std::vector<std::string> CheckWays(const Scene& scene, const FloorWays& ways) {
  Issues issues(scene.files);
  CheckRoutes(scene, &issues, ways);
  return issues.Messages();
}

std::vector<std::string> CheckScene(const std::filesystem::path& file, const BagPoseReader& bags) {
  return ParseFile(file, bags).messages;
}

Scene ReadSceneLoosely(const std::filesystem::path& file, const BagPoseReader& bags) {
  Issues issues(file.string());
  std::string problem;
  if (const auto text = ReadSceneText(file, &problem)) {
    return ReadScene(*text, file.string(), bags, &issues);
  }
  Scene scene;
  scene.file = file.string();
  scene.files = issues.files();
  return scene;
}

std::vector<std::string> SceneFiles(const std::filesystem::path& file, const BagPoseReader& bags) {
  return ReadSceneLoosely(file, bags).files;
}

}  // namespace aisle::sim
