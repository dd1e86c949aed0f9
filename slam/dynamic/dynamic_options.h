#pragma once

#include <string>

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

/// The first broken rule with its value, or an empty string.
inline std::string Validate(const DynamicOptions& options) {
  const std::string paper = options.paper.Validate();
  return paper.empty() ? options.robust.Validate() : paper;
}

}  // namespace aisle::slam
