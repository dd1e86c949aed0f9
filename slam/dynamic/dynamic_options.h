#pragma once

#include "slam/common/option_fields.h"
#include "slam/dynamic/paper/paper_options.h"
#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam {

/// How moving objects are kept out of the features.
enum class DynamicMethod {
  kNone,    ///< they are not
  kPaper,   ///< epipolar test, superpixels, rectangles: two frames, no memory
  kRobust,  ///< stereo scene flow against the static world, labelled pixels, memory
};

struct DynamicOptions {
  DynamicMethod method = DynamicMethod::kNone;
  dynamic::PaperOptions paper;    ///< read by kPaper alone
  dynamic::RobustOptions robust;  ///< read by kRobust alone
  bool keep_stages = false;       ///< hand out what every stage found; changes no result
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, DynamicOptions& options);

}  // namespace aisle::slam
