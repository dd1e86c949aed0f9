#pragma once

#include <string>
#include <vector>

#include "harness/contract/sequence.h"

namespace aisle {

/// Another sequence, which must outlive it: what a decorator does not change. What wheels measured
/// is not handed on: it counts the other's frames.
class ForwardingSequence : public Sequence {
 public:
  explicit ForwardingSequence(const Sequence& to) : to_(to) {}

  std::string name() const override { return to_.name(); }
  StereoCalibration calibration() const override { return to_.calibration(); }
  double rate_hz() const override { return to_.rate_hz(); }
  std::vector<FrameRequest> Schedule() const override { return to_.Schedule(); }
  SequenceFrame At(const FrameRequest& request) const override { return to_.At(request); }

 private:
  const Sequence& to_;
};

}  // namespace aisle
