#include "harness/campaign/job_sequence.h"

#include "harness/campaign/progress.h"
#include "harness/campaign/source.h"
#include "harness/io/hash.h"
#include "harness/io/places.h"
#include "harness/plugs/cached_sequence.h"
#include "harness/suite/recording.h"

namespace aisle {

SimulatedSequenceOptions SimulationOf(const Job& job) {
  return {.scene_file = job.spec.scene_file,
          .scene_name = job.spec.scene,
          .assets_dir = AssetsDir().string(),
          .twin = job.spec.twin,
          .seed = job.spec.seed,
          .threads = job.threads,
          .light_progress = [](const LightWork& work) {
            TellStage("solving its light: " + Describe(work));
          }};
}

std::unique_ptr<Sequence> OpenSequence(const Job& job, std::uint64_t* content_hash) {
  if (IsRecording(job.spec.scene_file)) {
    if (content_hash != nullptr) *content_hash = HashSource(job.spec.scene_file, job.spec.twin, 0);
    return OpenRecordingSource(job.spec.scene_file);
  }
  const auto open = [simulation = SimulationOf(job)](std::uint64_t* hash) {
    TellStage("opening the scene");
    return OpenSimulation(simulation, hash);
  };
  if (job.frames.empty()) return open(content_hash);
  return OpenCached(FrameStore(job.frames), job.spec.scene, open, content_hash);
}

}  // namespace aisle
