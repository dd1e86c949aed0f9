#include "harness/plugs/cached_sequence.h"

#include <mutex>

#include "harness/io/keep.h"
#include "harness/plugs/cached_frame.h"

namespace aisle {
namespace {

using OpenOriginal = std::function<std::unique_ptr<Sequence>(std::uint64_t*)>;

class CachedSequence : public Sequence {
 public:
  CachedSequence(FrameStore store, std::string name, SequenceHeader header,
                 std::unique_ptr<Sequence> original, OpenOriginal open_original)
      : store_(std::move(store)),
        name_(std::move(name)),
        header_(std::move(header)),
        open_original_(std::move(open_original)),
        original_(std::move(original)) {}

  std::string name() const override { return name_; }
  StereoCalibration calibration() const override { return header_.calibration; }
  double rate_hz() const override { return header_.rate_hz; }
  std::vector<FrameRequest> Schedule() const override { return header_.schedule; }

  SequenceFrame At(const FrameRequest& request) const override {
    if (!IsPlanned(request)) return Original().At(request);
    if (std::optional<SequenceFrame> kept = store_.Read(request.id)) return *std::move(kept);
    return MakeAndKeep(store_, [&] { return Original().At(request); });
  }

 private:
  /// Only frames of the planned poses are kept: their number alone names them.
  bool IsPlanned(const FrameRequest& request) const {
    const auto index = static_cast<std::size_t>(request.id);
    return index < header_.schedule.size() && header_.schedule[index].id == request.id &&
           header_.schedule[index].stamp_ns == request.stamp_ns &&
           header_.schedule[index].T_world_rig.matrix() == request.T_world_rig.matrix();
  }

  const Sequence& Original() const {
    const std::lock_guard lock(mutex_);
    if (!original_) original_ = open_original_(nullptr);
    return *original_;
  }

  const FrameStore store_;
  const std::string name_;
  const SequenceHeader header_;
  const OpenOriginal open_original_;
  mutable std::mutex mutex_;  ///< guards the opening of the original
  mutable std::unique_ptr<Sequence> original_;
};

}  // namespace

std::unique_ptr<Sequence> OpenCached(const FrameStore& store, const std::string& name,
                                     OpenOriginal open_original, std::uint64_t* content_hash) {
  std::optional<SequenceHeader> header = store.ReadHeader();
  std::unique_ptr<Sequence> original;
  if (!header) {
    header.emplace();
    original = open_original(&header->content_hash);
    header->calibration = original->calibration();
    header->rate_hz = original->rate_hz();
    header->schedule = original->Schedule();
    KeepWherePossible([&] { store.WriteHeader(*header); });
  }
  if (content_hash != nullptr) *content_hash = header->content_hash;
  return std::make_unique<CachedSequence>(store, name, *std::move(header), std::move(original),
                                          std::move(open_original));
}

}  // namespace aisle
