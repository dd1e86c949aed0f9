#include "slam/optimize/optimize_options.h"

namespace aisle::slam {
namespace {

void DescribePasses(OptionFields& fields, int* robust_iterations, int* final_iterations) {
  fields.Integer("robust_iterations", robust_iterations, {0, 1000}, "",
                 "Most iterations of the first pass, with Huber's cost.");
  fields.Integer("final_iterations", final_iterations, {0, 1000}, "",
                 "Most iterations of the second pass, without outliers; 0: there is none.");
}

}  // namespace

void Describe(OptionFields& fields, AlignPointsOptions& options) {
  fields.Integer("hypotheses", &options.hypotheses, {1, 10000}, "",
                 "Most three-point hypotheses of RANSAC.");
  fields.Number("confidence", &options.confidence, {0, 1}, "",
                "RANSAC ends once a clean sample has been drawn with this probability.");
  fields.Number("chi2_slack", &options.chi2_slack, {0.1, 100}, "",
                "A hypothesis' inliers may exceed their 95 % chi-square bound by this factor.");
  fields.Integer("least_inliers", &options.least_inliers, {3, 10000}, "",
                 "Least number of inliers of a refined pose.");
  fields.Seed("seed", &options.seed, "Seed of the samples drawn.");
}

void Describe(OptionFields& fields, LocalAdjustmentOptions& options) {
  fields.Integer("free_keyframes", &options.free_keyframes, {1, 1e6}, "keyframes",
                 "Keyframes that are adjusted: the new one and its most covisible ones.");
  fields.Integer(
      "fixed_keyframes", &options.fixed_keyframes, {0, 1e6}, "keyframes",
      "Other keyframes that see the same landmarks and hold them in place, most shared first.");
  fields.Integer("least_shared", &options.least_shared, {1, 10000}, "landmarks",
                 "Keyframes that share fewer landmarks with the new one are not adjusted.");
  DescribePasses(fields, &options.robust_iterations, &options.final_iterations);
  fields.Flag("second_chance", &options.second_chance,
              "Whether an observation that the first pass drops may come back after the second.");
}

void Describe(OptionFields& fields, LoopSpreadOptions& options) {
  fields.Number("sigma_m", &options.sigma_m, {1e-4, 100}, "m",
                "Deviation of the translation between two keyframes, neighbours or a loop's.");
  fields.Number("sigma_rad", &options.sigma_rad, {1e-5, 3}, "rad",
                "Deviation of the rotation between two keyframes, neighbours or a loop's.");
  fields.Integer(
      "strong_shared", &options.strong_shared, {1, 100000}, "landmarks",
      "Number of shared landmarks from which two keyframes are linked besides the spanning tree.");
  fields.Integer("iterations", &options.iterations, {1, 1000}, "",
                 "Most iterations of the pose graph.");
}

void Describe(OptionFields& fields, GlobalAdjustmentOptions& options) {
  DescribePasses(fields, &options.robust_iterations, &options.final_iterations);
}

}  // namespace aisle::slam
