#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {
namespace {

constexpr const char* kMustBeOdd = "be odd";

}  // namespace

void Describe(OptionFields& fields, SurfaceOptions& options) {
  fields.Number("grey_noise", &options.grey_noise, {0.1, 100}, "grey levels",
                "Deviation of one pixel in the dark.");
  fields.Number("brightness_noise", &options.brightness_noise, {0, 1}, "",
                "Deviation that grows with brightness, as a share of it.");
  fields.Integer("window_px", &options.window_px, {3, 31}, "half-size px",
                 "Side of the window in which texture is gathered; odd.");
  fields.Integer("border_px", &options.border_px, {0, 64}, "half-size px",
                 "Matches this close to the right image's edge are forgotten.");
  fields.Require(options.window_px % 2 == 1, "window_px", options.window_px, kMustBeOdd);
}

void Describe(OptionFields& fields, EgoMotionOptions& options) {
  fields.Integer("cell_px", &options.cell_px, {2, 1000}, "half-size px",
                 "Side of the squares that each give one point, that of the best texture.");
  fields.Integer("hypotheses", &options.hypotheses, {0, 100000}, "",
                 "Three-point hypotheses beside the prediction and standing still.");
  fields.Number("gate_chi2", &options.gate_chi2, {1, 100}, "",
                "Chi-square bound of an inlier, with three degrees of freedom.");
  fields.Number("acceleration_mps2", &options.acceleration_mps2, {1e-3, 1e3}, "m/s^2",
                "Deviation of the vehicle's acceleration.");
  fields.Number("angular_acceleration_radps2", &options.angular_acceleration_radps2, {1e-3, 1e3},
                "rad/s^2", "Deviation of the vehicle's angular acceleration.");
  fields.Integer("rounds", &options.rounds, {1, 100}, "", "Rounds of re-weighting.");
  fields.Integer("iterations", &options.iterations, {1, 100}, "", "Gauss-Newton steps a round.");
  fields.Seed("seed", &options.seed, "Seed of the samples drawn.");
}

void Describe(OptionFields& fields, FloorOptions& options) {
  fields.Integer("hypotheses", &options.hypotheses, {0, 100000}, "",
                 "Three-point hypotheses of the floor's plane; 0: no floor.");
  fields.Number("disparity", &options.disparity, {0.01, 10}, "half-size px",
                "Distance of an inlier from the plane: constant part.");
  fields.Number("disparity_share", &options.disparity_share, {0, 1}, "",
                "Distance of an inlier from the plane: share of its disparity.");
  fields.Number("most_roll", &options.most_roll, {0, 10}, "",
                "Tangent of the floor's slope across the image.");
  fields.Number("below_weight", &options.below_weight, {0, 100}, "",
                "A point below a floor speaks so many times against it.");
  fields.Number("least_support", &options.least_support, {0, 1}, "",
                "Least share of the lower half's points that a floor must explain.");
  fields.Seed("seed", &options.seed, "Seed of the samples drawn.");
}

void Describe(OptionFields& fields, FieldOptions& options) {
  constexpr OptionRange kBias{-10, 0};
  fields.Number("memory", &options.memory, {0, 1}, "",
                "Share of the log-odds of moving that survives from frame to frame.");
  fields.Number("limit", &options.limit, {1, 100}, "log-odds",
                "Bound of the log-odds, either way.");
  fields.Number("bias", &options.bias, kBias, "log-odds", "Leaning of every pixel to static.");
  fields.Number("unknown_bias", &options.unknown_bias, kBias, "log-odds",
                "Further leaning where the disparity is unknown.");
  fields.Number("floor_bias", &options.floor_bias, kBias, "log-odds",
                "Further leaning on the floor.");
  fields.Number("coupling", &options.coupling, {0, 100}, "log-odds",
                "Strength by which neighbours on one surface agree.");
  fields.Number("disparity", &options.disparity, {0.01, 10}, "half-size px",
                "Step of disparity between neighbours that halves it: constant part.");
  fields.Number("disparity_share", &options.disparity_share, {0, 1}, "",
                "Step of disparity between neighbours that halves it: share of the disparity.");
  fields.Number("contrast", &options.contrast, {0.1, 1e3}, "grey levels",
                "Step of grey between neighbours that halves it further.");
  fields.Number("floor_link", &options.floor_link, {0, 1}, "",
                "Share of the coupling between the floor and what stands on it.");
  fields.Integer("sweeps", &options.sweeps, {1, 1000}, "", "Sweeps of the solver over the image.");
  fields.Number("moving", &options.moving, {0, 100}, "log-odds",
                "Log-odds from which on a pixel moves.");
  fields.Number("grow_from", &options.grow_from, {0, 100}, "log-odds",
                "Evidence of moving pixels from which regions grow.");
  fields.Number("grow_to", &options.grow_to, {-100, 0}, "log-odds",
                "Evidence of pixels down to which they grow.");
  fields.Number("grow_link", &options.grow_link, {0, 1}, "",
                "Share of the coupling that links must have for growth.");
  fields.Number("grow_m", &options.grow_m, {0, 10}, "m", "Reach of that growth.");
  fields.RequireNotAbove("moving", options.moving, "limit", options.limit);
  fields.RequireNotAbove("grow_from", options.grow_from, "limit", options.limit);
  fields.Require(options.grow_to >= -options.limit, "grow_to", options.grow_to,
                 fmt::format("not be below -limit, which is {}", -options.limit));
}

void Describe(OptionFields& fields, RegionOptions& options) {
  constexpr OptionRange kPixels{0, 1e6};
  fields.Number("link", &options.link, {0, 1}, "",
                "Weaker links, as a share of the coupling, part "
                "regions.");
  fields.Integer("least_px", &options.least_px, {1, 1e6}, "pixels", "Smaller regions are noise.");
  fields.Number("least_log_odds", &options.least_log_odds, {-100, 100}, "log-odds",
                "Least mean log-odds of a region's pixels.");
  fields.Number("core_log_odds", &options.core_log_odds, {0, 100}, "log-odds",
                "Log-odds from which on a pixel is sure to move.");
  fields.Integer("birth_core_px", &options.birth_core_px, kPixels, "pixels",
                 "Sure pixels that a new region needs.");
  fields.Integer("keep_core_px", &options.keep_core_px, kPixels, "pixels",
                 "Sure pixels that a known region needs.");
  fields.Integer("birth_inner_px", &options.birth_inner_px, kPixels, "pixels",
                 "Pixels with the region all around that a new one needs.");
  fields.Integer("keep_inner_px", &options.keep_inner_px, kPixels, "pixels",
                 "Pixels with the region all around that a known one needs.");
  fields.Integer("inner_window_px", &options.inner_window_px, {1, 31}, "half-size px",
                 "Side of the window that is all around; odd.");
  fields.Number("least_overlap", &options.least_overlap, {0, 1}, "",
                "Share of the smaller one that a region and its predecessor have in common.");
  fields.Number("join_overlap", &options.join_overlap, {0, 1}, "",
                "Share of a region's box inside another's from which on it is a part of that.");
  fields.Number("join_disparity", &options.join_disparity, {0, 100}, "half-size px",
                "Step between the mean disparities of joined regions: constant part.");
  fields.Number("join_disparity_share", &options.join_disparity_share, {0, 1}, "",
                "Step between the mean disparities of joined regions: share of the disparity.");
  fields.Require(options.inner_window_px % 2 == 1, "inner_window_px", options.inner_window_px,
                 kMustBeOdd);
  fields.RequireNotAbove("keep_core_px", options.keep_core_px, "birth_core_px",
                         options.birth_core_px);
  fields.RequireNotAbove("keep_inner_px", options.keep_inner_px, "birth_inner_px",
                         options.birth_inner_px);
}

void Describe(OptionFields& fields, RobustOptions& options) {
  fields.Group("disparity", &options.disparity);
  fields.Group("surface", &options.surface);
  fields.Group("flow", &options.flow);
  fields.Group("ego", &options.ego);
  fields.Group("evidence", &options.evidence);
  fields.Group("floor", &options.floor);
  fields.Group("field", &options.field);
  fields.Group("region", &options.region);
}

}  // namespace aisle::slam::dynamic
