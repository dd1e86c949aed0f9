#include "slam/dynamic/paper/paper_options.h"

namespace aisle::slam::dynamic {

void Describe(OptionFields& fields, DisparityOptions& options) {
  fields.Integer("max_disparity_px", &options.max_disparity_px, {16, 512}, "px",
                 "Disparities searched; a multiple of 16.");
  fields.Integer("block_px", &options.block_px, {1, 21}, "px", "Side of the matched block; odd.");
  fields.Integer("uniqueness_percent", &options.uniqueness_percent, {0, 100}, "%",
                 "Margin by which the best cost must win.");
  fields.Integer("speckle_px", &options.speckle_px, {0, 10000}, "pixels",
                 "Smaller islands of disparity are dropped.");
  fields.Integer("left_right_px", &options.left_right_px, {-1, 16}, "px",
                 "Largest disagreement between left-to-right and right-to-left; -1: any.");
  fields.Flag("half_size", &options.half_size,
              "Match images of half the size; the block then covers twice as much.");
  fields.Require(options.max_disparity_px % 16 == 0, "max_disparity_px", options.max_disparity_px,
                 "be a multiple of 16");
  fields.Require(options.block_px % 2 == 1, "block_px", options.block_px, "be odd");
}

void Describe(OptionFields& fields, SpreadOptions& options) {
  fields.Integer("points", &options.points, {9, 100000}, "", "Most points, N of the quadtree.");
  fields.Integer("cell_px", &options.cell_px, {8, 4096}, "px", "Side of the square regions.");
  fields.Integer("fast_threshold", &options.fast_threshold, {1, 254}, "grey levels",
                 "Contrast that FAST asks of a corner at first.");
  fields.Integer("fast_threshold_low", &options.fast_threshold_low, {1, 254}, "grey levels",
                 "Contrast asked of a corner in regions where the first finds nothing.");
  fields.Integer("border_px", &options.border_px, {4, 256}, "px",
                 "Least distance of a point from the image's edge.");
  fields.RequireNotAbove("fast_threshold_low", options.fast_threshold_low, "fast_threshold",
                         options.fast_threshold);
}

void Describe(OptionFields& fields, FlowOptions& options) {
  fields.Integer("window_px", &options.window_px, {5, 101}, "px",
                 "Side of the tracked window of Lucas-Kanade.");
  fields.Integer("pyramid_levels", &options.pyramid_levels, {1, 8}, "",
                 "Levels of the image pyramid; 1: full resolution only.");
  fields.Integer("iterations", &options.iterations, {1, 100}, "", "Most iterations per level.");
  fields.Number(
      "forward_backward_px", &options.forward_backward_px, {0, 100}, "px",
      "Largest distance of a point from itself when tracked there and back; 0: no such check.");
}

void Describe(OptionFields& fields, FundamentalOptions& options) {
  fields.Number("inlier_px", &options.inlier_px, {1e-3, 100}, "px",
                "Epipolar distance up to which a pair supports a hypothesis.");
  fields.Integer("max_iterations", &options.max_iterations, {1, 100000}, "",
                 "Most nine-point hypotheses of RANSAC.");
  fields.Number("confidence", &options.confidence, {0, 1 - 1e-12}, "",
                "RANSAC ends once a clean sample has been drawn with this probability.");
  fields.Seed("seed", &options.seed, "Seed of the samples drawn.");
  fields.Number("standing_flow_px", &options.standing_flow_px, {0, 100}, "px",
                "Median flow up to which the camera counts as standing still; 0: never.");
}

void Describe(OptionFields& fields, EpipolarOptions& options) {
  fields.Number("alpha_px", &options.alpha_px, {0, 1000}, "px",
                "Epipolar distance beyond which a point moves: constant part.");
  fields.Number("beta", &options.beta, {0, 1000}, "px/px",
                "Epipolar distance beyond which a point moves: part per pixel of disparity.");
}

void Describe(OptionFields& fields, GroupOptions& options) {
  fields.Number("alpha_px", &options.alpha_px, {0, 10000}, "px",
                "Distance up to which moving points are one group: constant part.");
  fields.Number("beta", &options.beta, {0, 1000}, "px/px",
                "Distance up to which moving points are one group: part per pixel of disparity.");
  fields.Number("disparity_px", &options.disparity_px, {0, 1000}, "px",
                "Difference of disparity up to which moving points are one group.");
  fields.Integer("min_points", &options.min_points, {1, 100000}, "",
                 "Least number of points of a group.");
  fields.Number(
      "roi_margin", &options.roi_margin, {0, 100}, "",
      "Growth of a group's box into its region of interest, in the distance of a group's points.");
}

void Describe(OptionFields& fields, SuperpixelOptions& options) {
  fields.Number("step_px", &options.step_px, {3, 500}, "px", "Grid step of SLIC.");
  fields.Integer("iterations", &options.iterations, {1, 1000}, "", "Most iterations of SLIC.");
  fields.Number(
      "colour_share", &options.colour_share, {1e-3, 10}, "",
      "Distance in grey that weighs as much as a grid step, as a share of the image's grey "
      "range.");
}

void Describe(OptionFields& fields, PlaneOptions& options) {
  fields.Integer("iterations", &options.iterations, {1, 10000}, "",
                 "Three-point hypotheses per superpixel.");
  fields.Number("inlier_px", &options.inlier_px, {1e-3, 100}, "px",
                "Disparity residual up to which a pixel supports a plane.");
  fields.Integer("min_pixels", &options.min_pixels, {3, 1e6}, "pixels",
                 "Superpixels with fewer known disparities have no plane.");
  fields.Seed("seed", &options.seed, "Seed of the samples drawn.");
}

void Describe(OptionFields& fields, BoundaryOptions& options) {
  fields.Number("lambda_occlusion", &options.lambda_occlusion, {1e-6, 1e9}, "px^2",
                "Price of an occlusion boundary.");
  fields.Number("lambda_hinge", &options.lambda_hinge, {1e-9, 1e8}, "px^2",
                "Price of a hinge boundary, below an occlusion's.");
  fields.Number("lambda_penalty", &options.lambda_penalty, {0, 1e9}, "px^2",
                "Price added when the surface named as the front lies behind.");
  fields.Require(options.lambda_hinge < options.lambda_occlusion, "lambda_hinge",
                 options.lambda_hinge,
                 fmt::format("lie below lambda_occlusion, which is {}: equation (11)",
                             options.lambda_occlusion));
}

void Describe(OptionFields& fields, MarkOptions& options) {
  fields.Integer("min_rays", &options.min_rays, {1, 4}, "",
                 "A point counts only where this many of its four rays found an occlusion.");
}

void Describe(OptionFields& fields, PaperOptions& options) {
  fields.Group("disparity", &options.disparity);
  fields.Group("spread", &options.spread);
  fields.Group("flow", &options.flow);
  fields.Group("fundamental", &options.fundamental);
  fields.Group("epipolar", &options.epipolar);
  fields.Group("group", &options.group);
  fields.Group("superpixel", &options.superpixel);
  fields.Group("plane", &options.plane);
  fields.Group("boundary", &options.boundary);
  fields.Group("mark", &options.mark);
}

}  // namespace aisle::slam::dynamic
