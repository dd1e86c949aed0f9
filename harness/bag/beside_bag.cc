#include "harness/bag/beside_bag.h"

#include <nlohmann/json.hpp>

#include "harness/bag/drive_bag.h"
#include "harness/io/file.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

/// A text in YAML's double quotes, on one line.
std::string Quoted(const std::string& text) { return Json(text).dump(); }

const char* ColourOf(std::size_t i) {
  constexpr const char* kColours[] = {"#e69f00ff", "#56b4e9ff", "#009e73ff",
                                      "#f0e442ff", "#d55e00ff", "#cc79a7ff"};
  return kColours[i % std::size(kColours)];
}

Json PathIn(const char* colour) {
  return {{"visible", true}, {"type", "line"}, {"lineWidth", 0.08}, {"gradient", {colour, colour}}};
}

Json PlanPanel(const std::vector<std::string>& systems) {
  Json topics = {{"/truth/path", PathIn("#ffffffff")}, {"/truth/boxes", {{"visible", true}}}};
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const std::string topic = fmt::format("/{}", RosName(systems[i]));
    topics[topic + "/path"] = PathIn(ColourOf(i));
    topics[topic + "/pose"] = {{"visible", true}};
  }
  return {{"followMode", "follow-none"},
          {"followTf", kMapFrame},
          {"cameraState",
           {{"perspective", false},
            {"distance", 45},
            {"phi", 0},
            {"thetaOffset", 0},
            {"targetOffset", {0, 0, 0}}}},
          {"topics", topics},
          {"layers",
           {{"grid",
             {{"layerId", "foxglove.Grid"}, {"visible", true}, {"size", 60}, {"divisions", 60}}}}}};
}

Json ImagePanel(const std::string& topic) {
  return {{"imageMode",
           {{"imageTopic", topic},
            {"calibrationTopic", "/left/camera_info"},
            {"annotations", {{"/left/boxes", {{"visible", true}}}}}}}};
}

Json Split(const Json& first, const Json& second, const char* direction) {
  return {{"first", first}, {"second", second}, {"direction", direction}};
}

/// The plan with a column of stills to its right.
Json BesidePlan(const Json& plan, const std::vector<std::string>& stills, Json* panels) {
  Json column;
  for (std::size_t i = stills.size(); i-- > 0;) {
    const std::string panel = fmt::format("Image!worst_{}", i + 1);
    (*panels)[panel] = {{"imageMode", {{"imageTopic", stills[i]}}}};
    column = column.is_null() ? Json(panel) : Split(panel, column, "column");
  }
  return column.is_null() ? plan : Split(plan, column, "row");
}

}  // namespace

std::string RosbagMetadata(const McapWriter& bag, const std::string& file_name) {
  const auto span_ns = bag.last_ns() - bag.first_ns();
  std::string text = "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n";
  text += fmt::format(
      "  duration:\n    nanoseconds: {}\n  starting_time:\n    nanoseconds_since_epoch: {}\n"
      "  message_count: {}\n  topics_with_message_count:\n",
      span_ns, bag.first_ns(), bag.messages());
  for (const BagChannel& channel : bag.channels()) {
    text += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n"
        "        serialization_format: cdr\n        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        channel.topic, channel.type, Quoted(channel.qos), channel.messages);
  }
  text += "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n";
  text += fmt::format("    - {}\n  files:\n    - path: {}\n", Quoted(file_name), Quoted(file_name));
  text += fmt::format(
      "      starting_time:\n        nanoseconds_since_epoch: {}\n"
      "      duration:\n        nanoseconds: {}\n      message_count: {}\n",
      bag.first_ns(), span_ns, bag.messages());
  return text;
}

std::string FoxgloveLayout(const std::vector<std::string>& systems,
                           const std::vector<std::string>& stills) {
  Json panels = {{"3D!plan", PlanPanel(systems)},
                 {"Image!left", ImagePanel("/left/image_rect")},
                 {"Image!moving", ImagePanel("/left/moving")}};
  Json second = "Image!moving", below = "3D!plan";
  if (!systems.empty()) {
    const std::string first = RosName(systems.front());
    panels["Image!rejected"] = ImagePanel(fmt::format("/left/rejected_{}", first));
    panels["RosOut!events"] = {{"topicToRender", fmt::format("/{}/events", first)}};
    Json paths = Json::array();
    for (const std::string& system : systems) {
      paths.push_back(
          {{"value", fmt::format("/{}/state.data", RosName(system))}, {"label", system}});
    }
    panels["StateTransitions!states"] = {{"paths", paths}, {"isSynced", true}};
    second = Split("Image!moving", "Image!rejected", "row");
    below = Split("3D!plan", Split("StateTransitions!states", "RosOut!events", "column"), "row");
  }
  below = BesidePlan(below, stills, &panels);
  const Json layout = {{"configById", panels},
                       {"globalVariables", Json::object()},
                       {"userNodes", Json::object()},
                       {"playbackConfig", {{"speed", 1}}},
                       {"layout", Split(Split("Image!left", second, "column"), below, "row")}};
  return layout.dump(1) + "\n";
}

bool IsAttached(const std::filesystem::path& file) {
  constexpr std::array<const char*, 6> kLarge = {".aislemesh", ".glb", ".gltf",
                                                 ".mcap",      ".db3", ".bvh"};
  return std::ranges::find(kLarge, file.extension()) == kLarge.end();
}

void WriteBesideBag(const std::filesystem::path& bag_file, const McapWriter& bag,
                    const std::vector<std::string>& systems,
                    const std::vector<std::string>& stills) {
  const std::filesystem::path folder = bag_file.parent_path();
  WriteFileAtomically(folder / "foxglove_layout.json", FoxgloveLayout(systems, stills));
  WriteFileAtomically(folder / "metadata.yaml", RosbagMetadata(bag, bag_file.filename().string()));
}

}  // namespace aisle
