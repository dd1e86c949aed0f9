#include "harness/bench/detector.h"

#include "harness/io/input_error.h"
#include "harness/plugs/detector.h"

namespace aisle {
namespace {

ObjectCount& operator+=(ObjectCount& sum, const ObjectCount& more) {
  sum.asked += more.asked;
  sum.counted += more.counted;
  return sum;
}

void AddLarge(const MaskFacts& facts, const FrameTruth& truth,
              const std::map<int, std::string>& losses, DetectorOutcome* outcome) {
  for (const ObjectOutcome& object : facts.objects) {
    if (!IsLargeMover(object)) continue;
    const ObjectCount one{1, object.found ? 1 : 0};
    const bool across = GoesAcross(truth, object.instance);
    outcome->large += one;
    if (across) outcome->large_across += one;
    const auto step = losses.find(object.instance);
    if (step == losses.end()) continue;
    auto& by_step = across ? outcome->losses_across : outcome->losses_along;
    ++by_step[object.found ? "found" : step->second];
  }
}

}  // namespace

Clip LoadClip(const BenchView& view, const BenchSource& source, const BenchProgress& progress) {
  const auto sequence = OpenSource(view, source);
  Clip clip{view.text, sequence->name(), sequence->calibration(), {}};
  int index = 0;
  for (const FrameRequest& request : sequence->Schedule()) {
    const int now = index++;
    if (now < view.from - 1) continue;
    if (now >= view.to) break;
    if (progress) progress(fmt::format("{}: frame {}", view.text, now));
    SequenceFrame frame = sequence->At(request);
    if (!frame.truth || frame.truth->dynamic.empty()) {
      throw InputError(view.text + ": its truth does not say what moves; take a scene");
    }
    frame.images.left = frame.images.left.clone();  // a sequence may use its images again
    frame.images.right = frame.images.right.clone();
    clip.frames.push_back(std::move(frame));
  }
  if (clip.frames.size() < 2) throw InputError(view.text + ": fewer than two frames");
  return clip;
}

DetectorOutcome& DetectorOutcome::operator+=(const DetectorOutcome& more) {
  frames += more.frames;
  pixels += more.pixels;
  masks += more.masks;
  large += more.large;
  large_across += more.large_across;
  for (const auto& [stage, ms] : more.stage_ms) stage_ms[stage] += ms;
  for (const auto& [step, movers] : more.losses_along) losses_along[step] += movers;
  for (const auto& [step, movers] : more.losses_across) losses_across[step] += movers;
  return *this;
}

double DetectorOutcome::object_f1() const {
  const double found = masks.objects_found;
  const double sum = 2 * found + masks.objects_missed + masks.objects_invented;
  return sum > 0 ? 2 * found / sum : 0;
}

double DetectorOutcome::pixel_iou() const {
  const auto both = static_cast<double>(masks.true_positives);
  const double any = both + static_cast<double>(masks.false_positives + masks.false_negatives);
  return any > 0 ? both / any : 0;
}

double DetectorOutcome::static_wrong() const {
  const auto moving = static_cast<double>(masks.true_positives + masks.false_negatives);
  return static_cast<double>(masks.false_positives) / std::max(pixels - moving, 1.0);
}

double DetectorOutcome::mean_ms() const {
  const auto whole = stage_ms.find("dynamic");
  return whole == stage_ms.end() ? 0 : whole->second / std::max(frames, 1);
}

bool GoesAcross(const FrameTruth& truth, int instance) {
  for (const ObjectTruth& object : truth.objects) {
    if (object.instance != instance) continue;
    const Eigen::Vector3d in_rig = truth.T_world_rig.linear().transpose() * object.velocity_mps;
    return 2 * in_rig.head<2>().norm() >= in_rig.norm();
  }
  return false;
}

DetectorOutcome MeasureDetector(const Clip& clip, const SystemSpec& system, bool find_losses) {
  const auto detector = MakeDetector(system, clip.calibration, find_losses);
  DetectorOutcome outcome;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    const SequenceFrame& frame = clip.frames[i];
    const Detector::Found found = detector->Detect(frame.images);
    if (i == 0) continue;
    const MaskFacts facts = CompareMasks(frame.images.left, *frame.truth, found.regions);
    const std::map<int, std::string> losses =
        find_losses ? detector->FindLosses(*clip.frames[i - 1].truth, *frame.truth)
                    : std::map<int, std::string>{};
    AddLarge(facts, *frame.truth, losses, &outcome);
    ++outcome.frames;
    outcome.pixels += static_cast<double>(frame.images.left.total());
    outcome.masks += facts;
    for (const auto& [stage, ms] : found.stage_ms) outcome.stage_ms[stage] += ms;
  }
  return outcome;
}

}  // namespace aisle
