#include "harness/cli/bench_source.h"

#include "harness/cli/places.h"
#include "harness/io/dataset.h"
#include "harness/io/input_error.h"
#include "harness/plugs/cached_sequence.h"
#include "harness/plugs/recorded_sequence.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/suite/suite.h"

namespace aisle {

namespace fs = std::filesystem;

void AddSourceOptions(CLI::App* command, BenchSource* source) {
  command
      ->add_option("--format", source->format,
                   fmt::format("of a folder: euroc or kitti; default {}", source->format))
      ->check(CLI::IsMember({"euroc", "kitti"}));
  command->add_option("--twin", source->twin,
                      fmt::format("of a scene: live, empty or frozen; default {}", source->twin));
  command->add_option("--seed", source->seed, "of a scene; default 1");
  command->add_option(
      "--frames-dir", source->frames_dir,
      "keep rendered frames there and use what is there, whichever program made it");
  command->add_option("--threads", source->threads, "0: all");
}

BenchView ParseView(const std::string& text) {
  BenchView view{.source = text};
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    view.source = text.substr(0, colon);
    char rest = 0;
    if (std::sscanf(text.c_str() + colon + 1, "%d-%d%c", &view.from, &view.to, &rest) != 2 ||
        view.from < 0 || view.to <= view.from) {
      throw InputError(Printable(text) +
                       ": expected SOURCE:FROM-TO, for example paper/scene2:90-130");
    }
  }
  if (!fs::exists(SceneFile(view.source))) {
    throw InputError(Printable(view.source) +
                     ": neither a scene (a file, or a name like paper/scene2) nor the folder of a "
                     "recording");
  }
  return view;
}

std::unique_ptr<Sequence> OpenSource(const std::string& name, const BenchSource& source) {
  if (fs::is_directory(name)) return OpenRecording(name, DatasetFormatFromName(source.format));
  const std::string file = SceneFile(name);
  const SimulatedSequenceOptions simulation{.scene_file = file,
                                            .scene_name = SceneName(file),
                                            .assets_dir = AssetsDir().string(),
                                            .twin = source.twin,
                                            .seed = source.seed,
                                            .threads = source.threads};
  if (source.frames_dir.empty()) return OpenSimulation(simulation);
  const fs::path kept = fs::path(source.frames_dir) /
                        fmt::format("{}_{}_{}", SceneName(file), source.twin, source.seed);
  return OpenCached(FrameStore(kept),
                    [simulation](std::uint64_t* hash) { return OpenSimulation(simulation, hash); });
}

}  // namespace aisle
