#include "harness/campaign/bags.h"

#include "harness/bag/bag.h"
#include "harness/bag/beside_bag.h"
#include "harness/bag/drive_bag.h"
#include "harness/campaign/job_sequence.h"
#include "harness/campaign/run_bag.h"
#include "harness/campaign/source.h"
#include "harness/campaign/worst_frames.h"
#include "harness/io/file.h"
#include "harness/record/frames_csv.h"
#include "harness/record/record.h"
#include "harness/run/frames_ahead.h"
#include "harness/suite/recording.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// The messages of a run's bag, in the order of their time.
class RunMessages {
 public:
  explicit RunMessages(const fs::path& file) : bag_(OpenBag(file)), entries_(bag_->entries()) {
    std::ranges::stable_sort(entries_, {}, &BagEntry::log_ns);
  }
  /// Those up to a time, once.
  void CopyUntil(std::int64_t log_ns, DriveBag* to) {
    for (; next_ < entries_.size() && entries_[next_].log_ns <= log_ns; ++next_) {
      const BagEntry& entry = entries_[next_];
      to->Copy(bag_->channels()[entry.channel], entry.log_ns, bag_->Read(entry));
    }
  }
  const Bag& bag() const { return *bag_; }

 private:
  std::unique_ptr<Bag> bag_;
  std::vector<BagEntry> entries_;
  std::size_t next_ = 0;
};

constexpr std::size_t kWorstFrames = 3;
constexpr double kApart_s = 1;

/// The picture of a frame in which a system was far off.
struct Still {
  std::string topic, system;
  WorstFrame frame;
  cv::Mat1b picture = {};
};

void AddStillsOf(const Job& job, std::vector<Still>* stills) {
  const std::optional<RunRecord> record = ReadRun(job.spec, job.out);
  if (!record) return;
  const std::string system = job.spec.system.name;
  const FrameFile frames = ReadFrameFile(*record, job.out);
  std::size_t number = 0;
  for (const WorstFrame& frame : FindWorstFrames(frames.rows, kWorstFrames, kApart_s)) {
    stills->push_back({fmt::format("/{}/worst_{}", RosName(system), ++number), system, frame});
  }
}

/// Of a scene the depth that its stored frames are without; of a recording nothing is known.
std::function<cv::Mat1f(const FrameRequest&)> DepthOf(const Job& job) {
  if (IsRecording(job.spec.scene_file)) return {};
  return OpenDepth(SimulationOf(job));
}

void WriteBag(const std::vector<const Job*>& jobs, const fs::path& file) {
  const Job& first = *jobs.front();
  const std::unique_ptr<Sequence> sequence = OpenSequence(first);
  // A recording's stamps are those of the day; a scene's begin at 0.
  DriveBagOptions options;
  if (IsRecording(first.spec.scene_file)) options.epoch_ns = 0;
  DriveBag bag(file, sequence->calibration(), options);
  std::vector<RunMessages> runs;
  std::vector<std::string> systems;
  std::vector<Still> stills;
  for (const Job* job : jobs) {
    AddStillsOf(*job, &stills);
    runs.emplace_back(job->out / "runs" / RunId(job->spec) / RunBagName(false));
    systems.push_back(job->spec.system.name);
  }
  const std::vector<FrameRequest> schedule = sequence->Schedule();
  const auto depth = DepthOf(first);
  FramesAhead frames(*sequence, schedule, 3);
  for (const FrameRequest& request : schedule) {
    SequenceFrame frame = frames.Next().frame;
    if (depth && frame.truth && frame.truth->depth.empty()) frame.truth->depth = depth(request);
    bag.AddFrame(frame);
    for (Still& still : stills) {
      if (still.frame.id == request.id) still.picture = frame.images.left.clone();
    }
    for (RunMessages& run : runs) run.CopyUntil(request.stamp_ns + options.epoch_ns, &bag);
  }
  for (RunMessages& run : runs) {
    run.CopyUntil(std::numeric_limits<std::int64_t>::max(), &bag);
    for (const auto& [name, values] : run.bag().metadata()) bag.AddMetadata(name, values);
  }
  std::vector<std::string> still_topics;
  for (const Still& still : stills) {
    if (still.picture.empty()) continue;
    bag.AddStill(still.topic, still.picture,
                 fmt::format("{}, frame {}: {:.1f} cm off", still.system, still.frame.id,
                             100 * still.frame.error_m));
    still_topics.push_back(still.topic);
  }
  bag.AddMetadata("aisle", {{"scene", first.spec.scene},
                            {"twin", first.spec.twin},
                            {"seed", std::to_string(first.spec.seed)},
                            {"systems", fmt::format("{}", fmt::join(systems, " "))}});
  if (!IsRecording(first.spec.scene_file)) {
    for (const std::string& text : FilesOfSource(first.spec.scene_file)) {
      if (!IsAttached(text)) continue;
      bag.Attach(fs::path(text).filename().string(), "application/yaml", ReadFile(text));
    }
  }
  WriteBesideBag(file, bag.Finish(), systems, still_topics);
}

}  // namespace

void WriteBags(const std::vector<Job>& jobs, const fs::path& out,
               const std::function<void(const std::string&)>& say) {
  std::map<fs::path, std::vector<const Job*>> groups;
  for (const Job& job : jobs) {
    if (IsDriveSource(job.spec.scene_file) || job.spec.repeat > 1) continue;
    if (!fs::exists(job.out / "runs" / RunId(job.spec) / RunBagName(false))) {
      say(fmt::format("{}: no bag", RunId(job.spec)));
      continue;
    }
    const fs::path folder = out / "bags" / SafeName(job.spec.scene) / SafeName(job.spec.twin) /
                            std::to_string(job.spec.seed);
    groups[folder / "drive.mcap"].push_back(&job);
  }
  for (const auto& [file, group] : groups) {
    WriteBag(group, file);
    say(fmt::format("bag -> {}", file.string()));
  }
}

}  // namespace aisle
