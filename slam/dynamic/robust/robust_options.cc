#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {
namespace {

constexpr const char* kMustBeOdd = "be odd";

}  // namespace

void Describe(OptionFields& fields, SurfaceOptions& options) {
  fields.Number("grey_noise", &options.grey_noise, {0.1, 100}, "grey levels",
                "Deviation of one pixel in the dark.");
  fields.Number("brightness_noise", &options.brightness_noise, {0, 1}, "",
                "Deviation of a pixel that grows with brightness, as a share of the brightness.");
  fields.Number(
      "shading_noise", &options.shading_noise, {0, 10}, "",
      "Deviation of the mean of 5x5 pixels by glare and shadow, as a share of the brightness.");
  fields.Integer("window_px", &options.window_px, {3, 31}, "half-size px",
                 "Side of the window in which texture is gathered; odd.");
  fields.Require(options.window_px % 2 == 1, "window_px", options.window_px, kMustBeOdd);
}

void Describe(OptionFields& fields, ToleranceOptions& options) {
  fields.Number("sigmas", &options.sigmas, {0.1, 100}, "deviations",
                "Noise within one surface: deviations of a disparity, as learned while running.");
  fields.Number("share", &options.share, {0, 1}, "",
                "Step of disparity within one surface: share of the disparity.");
  fields.Number(
      "learning_rate", &options.learning_rate, {0, 1}, "",
      "Share by which a frame moves the noise that is learned, of disparity and of flow.");
}

void Describe(OptionFields& fields, EgoMotionOptions& options) {
  fields.Integer("cell_px", &options.cell_px, {2, 1000}, "half-size px",
                 "Side of the squares that each give one point, that with the best texture.");
  fields.Number("acceleration_mps2", &options.acceleration_mps2, {1e-3, 1e3}, "m/s^2",
                "Deviation of the vehicle's acceleration.");
  fields.Number("angular_acceleration_radps2", &options.angular_acceleration_radps2, {1e-3, 1e3},
                "rad/s^2", "Deviation of the vehicle's angular acceleration.");
  fields.Number("jolt_mps2", &options.jolt_mps2, {0, 1e4}, "m/s^2",
                "Deviation of the vertical acceleration where wheels cross something; 0: never.");
  fields.Number("jolt_radps2", &options.jolt_radps2, {0, 1e4}, "rad/s^2",
                "Deviation of the angular acceleration of pitch and roll where wheels cross "
                "something; 0: never.");
  fields.Number("trust_in_region", &options.trust_in_region, {0, 1}, "",
                "Largest trust in a point of a region that moves.");
  fields.Seed("seed", &options.seed, "Seed of the samples drawn.");
}

void Describe(OptionFields& fields, FieldOptions& options) {
  constexpr OptionRange kBias{-10, 0};
  fields.Number("memory", &options.memory, {0, 1}, "",
                "Share of the log-odds of moving that survives from frame to frame.");
  fields.Number(
      "longer", &options.longer, {0, 1}, "",
      "Share of the longer gaps' evidence that survives in frames without a new comparison.");
  fields.Number("limit", &options.limit, {1, 100}, "log-odds",
                "Bound of the log-odds, either way.");
  fields.Number("bias", &options.bias, kBias, "log-odds", "Prior of every pixel towards static.");
  fields.Number("unlikely_bias", &options.unlikely_bias, kBias, "log-odds",
                "Further prior towards static where the disparity is unknown, and on the floor.");
  fields.Number("coupling", &options.coupling, {0, 100}, "log-odds",
                "Strength by which neighbours on one surface agree.");
  fields.Number("contrast", &options.contrast, {0.1, 1e3}, "grey levels",
                "Step of grey between neighbours that halves their agreement.");
  fields.Number(
      "moving", &options.moving, {0, 100}, "log-odds",
      "Log-odds above which something moves: for a gap, a pixel and the mean of a region.");
  fields.Number("grow_to", &options.grow_to, {-100, 0}, "log-odds",
                "Log-odds of pixels down to which moving ones grow.");
  fields.Number("grow_link", &options.grow_link, {0, 1}, "",
                "Share of the coupling that links need for growth.");
  fields.Number("grow_m", &options.grow_m, {0, 10}, "m", "Reach of that growth.");
  fields.RequireNotAbove("moving", options.moving, "limit", options.limit);
  fields.Require(options.grow_to >= -options.limit, "grow_to", options.grow_to,
                 fmt::format("not be below -limit, which is {}", -options.limit));
}

void Describe(OptionFields& fields, RegionOptions& options) {
  constexpr OptionRange kPixels{0, 1e6};
  fields.Number("link", &options.link, {0, 1}, "",
                "Weaker links, as a share of the coupling, part regions.");
  fields.Number("core_log_odds", &options.core_log_odds, {0, 100}, "log-odds",
                "Log-odds above which a pixel surely moves, and no static look-alike is searched.");
  fields.Integer("birth_core_px", &options.birth_core_px, kPixels, "pixels",
                 "Number of sure pixels that a new region needs.");
  fields.Integer("keep_core_px", &options.keep_core_px, kPixels, "pixels",
                 "Number of sure pixels that a known region needs.");
  fields.Number("overlap", &options.overlap, {0, 1}, "",
                "Overlap of a region with its predecessor, or of its box with the region that it "
                "is a part of, as a share.");
  fields.RequireNotAbove("keep_core_px", options.keep_core_px, "birth_core_px",
                         options.birth_core_px);
}

void Describe(OptionFields& fields, RobustOptions& options) {
  fields.Group("disparity", &options.disparity);
  fields.Group("surface", &options.surface);
  fields.Group("tolerance", &options.tolerance);
  fields.Group("flow", &options.flow);
  fields.Group("ego", &options.ego);
  fields.Group("evidence", &options.evidence);
  fields.Group("field", &options.field);
  fields.Group("region", &options.region);
}

}  // namespace aisle::slam::dynamic
