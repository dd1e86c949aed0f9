#include "harness/bench/source.h"

#include <filesystem>

#include "harness/io/dataset.h"
#include "harness/io/input_error.h"
#include "harness/plugs/cached_sequence.h"
#include "harness/plugs/recorded_sequence.h"
#include "harness/plugs/simulated_sequence.h"

namespace aisle {

namespace fs = std::filesystem;

void RefuseEmptyView(const BenchView& view, std::size_t frames) {
  if (frames == 0) throw InputError(Printable(view.text) + ": no frame lies in this view");
}

std::unique_ptr<Sequence> OpenSource(const BenchView& view, const BenchSource& source) {
  if (fs::is_directory(view.path)) {
    return OpenRecording(view.path, DatasetFormatFromName(source.format));
  }
  const std::uint64_t seed = view.seed.value_or(source.seed);
  const SimulatedSequenceOptions simulation{.scene_file = view.path,
                                            .scene_name = view.scene,
                                            .assets_dir = view.assets_dir,
                                            .twin = source.twin,
                                            .seed = seed,
                                            .threads = source.threads};
  if (source.frames_dir.empty()) return OpenSimulation(simulation);
  const fs::path kept =
      fs::path(source.frames_dir) / fmt::format("{}_{}_{}", view.scene, source.twin, seed);
  return OpenCached(FrameStore(kept), view.scene,
                    [simulation](std::uint64_t* hash) { return OpenSimulation(simulation, hash); });
}

}  // namespace aisle
