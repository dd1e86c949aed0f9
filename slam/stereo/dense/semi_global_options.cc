#include "slam/stereo/dense/semi_global_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, SemiGlobalOptions& options) {
  constexpr OptionRange kPrice{0, 73};  // with the dearest cost it is half a byte
  fields.Integer("max_disparity_px", &options.max_disparity_px, {32, kMostDisparities},
                 "half-size px", "Disparities searched; a multiple of 32.");
  fields.Integer("p1", &options.p1, kPrice, "census bits",
                 "Price of a change of disparity by one (P1).");
  fields.Integer("p2", &options.p2, kPrice, "census bits",
                 "Price of any other change of disparity (P2).");
  fields.Integer("p2_contrast", &options.p2_contrast, {1, 10000}, "grey levels",
                 "Step of grey that halves P2.");
  fields.Integer("least_p2", &options.least_p2, kPrice, "census bits",
                 "Least that P2 falls to by contrast.");
  fields.Integer("uniqueness_percent", &options.uniqueness_percent, {0, 90}, "%",
                 "Margin by which the best cost must win.");
  fields.Integer("left_right_px", &options.left_right_px, {0, kMostDisparities}, "half-size px",
                 "Disagreement allowed between left-to-right and right-to-left.");
  fields.Integer("speckle_px", &options.speckle_px, {0, 10000}, "pixels",
                 "Smaller islands of disparity are dropped.");
  fields.Integer("speckle_step_px", &options.speckle_step_px, {0, kMostDisparities}, "half-size px",
                 "Change of disparity from pixel to pixel that parts islands.");
  fields.Require(options.max_disparity_px % 32 == 0, "max_disparity_px", options.max_disparity_px,
                 "be a multiple of 32");
  fields.RequireNotAbove("p1", options.p1, "p2", options.p2);
  fields.RequireNotAbove("p1", options.p1, "least_p2", options.least_p2);
  fields.RequireNotAbove("least_p2", options.least_p2, "p2", options.p2);
}

}  // namespace aisle::slam
