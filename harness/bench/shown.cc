#include "harness/bench/shown.h"

#include <algorithm>

#include "harness/io/input_error.h"
#include "harness/plugs/simulated_drive.h"
#include "harness/plugs/systems.h"
#include "harness/plugs/wheel_odometry.h"

namespace aisle {
namespace {

bool Tells(const std::optional<FrameTruth>& truth, MaskSource asked) {
  if (asked == MaskSource::kNone) return true;
  return truth && !(asked == MaskSource::kDynamic ? truth->dynamic : truth->actor).empty();
}

}  // namespace

std::unique_ptr<Sequence> OpenSourceFor(const SystemSpec& system, const BenchView& view,
                                        const BenchSource& source) {
  std::unique_ptr<Sequence> sequence = OpenSource(view, source);
  if (!WantsOdometry(system)) return sequence;
  const Wheels wheels = view.scene.empty() ? Wheels{} : WheelsOfScene(view.path);
  return WithOdometry(std::move(sequence), SeedOf(view, source), wheels);
}

MaskMaker MasksFor(const SystemSpec& system, const BenchView& view, const BenchSource& source) {
  const MaskSource asked = FindSystem(system.like).mask_source;
  return [asked, make = MasksWithErrors(asked, system.mask_errors, SeedOf(view, source)),
          view = view.text, name = system.name](const SequenceFrame& frame) {
    if (Tells(frame.truth, asked)) return make(frame);
    throw InputError(fmt::format(
        "{}: system '{}' needs to be told what moves, which is unknown here: use a scene",
        Printable(view), Printable(name)));
  };
}

FrameEstimate Show(const SequenceFrame& frame, const MaskMaker& masks, Estimator* estimator) {
  const ExternalMask mask = masks(frame);
  FrameEstimate estimate = estimator->Process(frame.images, mask);
  AdoptMask(mask, &estimate);
  return estimate;
}

std::vector<FrameRequest> Excerpt::Schedule() const {
  const std::vector<FrameRequest> all = ForwardingSequence::Schedule();
  const auto at = [&](int i) {
    return all.begin() + std::clamp<std::ptrdiff_t>(i, 0, std::ssize(all));
  };
  return {at(std::min(from_, to_)), at(to_)};
}

SequenceFrame Excerpt::At(const FrameRequest& request) const {
  SequenceFrame frame = ForwardingSequence::At(request);
  if (request.id <= from_) frame.images.motion.reset();
  return frame;
}

}  // namespace aisle
