#include "simulator/world/recorded_ways.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "simulator/scene/load.h"
#include "simulator/world/captured_person.h"

namespace aisle::sim {
namespace {

/// Why somebody cannot be read; none: he can.
std::optional<std::string> Trouble(const Scene& scene, const Mark& mark, const std::string& key,
                                   const auto& read) {
  try {
    read();
    return std::nullopt;
  } catch (const std::system_error&) {
    throw;  // the machine's, not the file's
  } catch (const std::runtime_error& error) {
    return fmt::format("{}: {}: {}", PlaceText(scene.files, mark), key, error.what());
  }
}

struct Reading {
  FloorWays ways;
  std::vector<std::string> troubles;
};

Reading ReadCaptured(const Scene& scene, AssetLibrary* assets, bool bodies) {
  Reading reading;
  for (const PersonSpec& person : scene.people) {
    const CaptureSpec& capture = person.capture;
    const bool moves = !capture.bvh.name.empty();
    if (!moves && (!bodies || capture.mesh.name.empty())) continue;
    const std::optional<std::string> trouble =
        Trouble(scene, moves ? capture.bvh.mark : capture.mesh.mark,
                fmt::format("people[{}].{}", person.place, moves ? "bvh" : "mesh"), [&] {
                  if (moves) {
                    reading.ways[person.name] = RecordedWay(person, assets);
                  } else {
                    CheckClip(person, assets);
                  }
                });
    if (trouble) reading.troubles.push_back(*trouble);
  }
  return reading;
}

}  // namespace

FloorWays RecordedWays(const Scene& scene, AssetLibrary* assets) {
  Reading reading = ReadCaptured(scene, assets, false);
  if (!reading.troubles.empty()) throw std::runtime_error(reading.troubles.front());
  return std::move(reading.ways);
}

std::vector<std::string> CheckCaptured(const Scene& scene, AssetLibrary* assets) {
  const Reading reading = ReadCaptured(scene, assets, true);
  if (!reading.troubles.empty() || reading.ways.empty()) return reading.troubles;
  return CheckWays(scene, reading.ways);
}

}  // namespace aisle::sim
