#include "harness/bench/source.h"

#include <filesystem>

#include "harness/io/dataset.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/plugs/cached_sequence.h"
#include "harness/plugs/recorded_sequence.h"
#include "harness/plugs/simulated_sequence.h"

namespace aisle {

namespace fs = std::filesystem;

void RefuseEmptyView(const BenchView& view, std::size_t frames) {
  if (frames == 0) throw InputError(Printable(view.text) + ": no frames in this view");
}

std::uint64_t SeedOf(const BenchView& view, const BenchSource& source) {
  return view.seed.value_or(source.seed);
}

namespace {

std::unique_ptr<Sequence> OpenWhole(const BenchView& view, const BenchSource& source) {
  if (fs::is_directory(view.path)) {
    return OpenRecording(view.path, DatasetFormatFromName(source.format));
  }
  const std::uint64_t seed = SeedOf(view, source);
  const SimulatedSequenceOptions simulation{.scene_file = view.path,
                                            .scene_name = view.scene,
                                            .assets_dir = view.assets_dir,
                                            .twin = source.twin,
                                            .seed = seed,
                                            .threads = source.threads};
  if (source.frames_dir.empty()) return OpenSimulation(simulation);
  // Another scene of that name, or this one edited, has frames of its own.
  const std::uint64_t essence = Hash(EssenceOfScene(view.path, source.twin));
  const fs::path kept = fs::path(source.frames_dir) /
                        fmt::format("{}_{}_{}_{:016x}", view.scene, source.twin, seed, essence);
  return OpenCached(FrameStore(kept), view.scene,
                    [simulation](std::uint64_t* hash) { return OpenSimulation(simulation, hash); });
}

}  // namespace

void RefuseOutside(const BenchView& view, std::size_t frames) {
  RefuseEmptyView(view, frames);
  const bool whole = view.to == std::numeric_limits<int>::max();
  if (whole || static_cast<std::size_t>(view.to) <= frames) return;
  throw InputError(
      fmt::format("{}: it ends before frame {}; its frames are 0 to {}, all of them 0-{}",
                  Printable(view.text), view.to, frames - 1, frames));
}

std::unique_ptr<Sequence> OpenSource(const BenchView& view, const BenchSource& source) {
  std::unique_ptr<Sequence> sequence = OpenWhole(view, source);
  RefuseOutside(view, sequence->Schedule().size());
  return sequence;
}

}  // namespace aisle
