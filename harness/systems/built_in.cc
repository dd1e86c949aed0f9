#include "harness/systems/built_in.h"

#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"

namespace aisle {

const std::vector<System>& Systems() {
  static const std::vector<System> systems = {
      {"orbslam2",
       "the published ORB-SLAM2's tracking, keyframes and mapping, nothing rejected",
       MaskSource::kNone,
       {{"base", "orbslam2"}}},
      {"plain", "our stereo SLAM, nothing rejected", MaskSource::kNone},
      {"semantic",
       "orbslam2 without features on any person or vehicle, moving or not: the DynaSLAM row",
       MaskSource::kActors,
       {{"base", "orbslam2"}}},
      {"paper",
       "orbslam2 with the paper's rejection of dynamic regions, as written",
       MaskSource::kNone,
       {{"base", "orbslam2"}, {"dynamic.method", "paper"}}},
      {"robust",
       "our SLAM with our best rejection of dynamic regions",
       MaskSource::kNone,
       {{"dynamic.method", "robust"}}},
      {"oracle", "our SLAM without features on what truth says moves now: the best rejection",
       MaskSource::kDynamic},
  };
  return systems;
}

const System& FindSystem(const std::string& name) {
  std::vector<std::string> known;
  for (const System& system : Systems()) {
    if (system.name == name) return system;
    known.push_back(system.name);
  }
  throw InputError(fmt::format("unknown system '{}': expected one of {}{}", Printable(name),
                               fmt::join(known, ", "), DidYouMean(name, known)));
}

System Varied(System system, const std::map<std::string, std::string>& options) {
  for (const auto& [path, value] : options) system.options[path] = value;
  return system;
}

}  // namespace aisle
