#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {
void Describe(OptionFields& fields, EvidenceOptions& options) {
  fields.Number("mover_mps", &options.mover_mps, {0.01, 100}, "m/s",
                "Deviation of a moving object's speed along each axis of the image.");
  fields.Number(
      "mover_m", &options.mover_m, {0.01, 100}, "m",
      "Deviation of a moving object's path over a longer gap, along each axis of the image.");
  fields.Number("noise_per_displacement", &options.noise_per_displacement, {0, 1}, "px/px",
                "Deviation of the flow per pixel of displacement.");
  fields.Number("independent_pixels", &options.independent_pixels, {0.1, 1000}, "",
                "Pixels of a window whose grey values count as independent.");
  fields.Number("difference_weight", &options.difference_weight, {0, 100}, "",
                "Weight of a poor fit of the moved window against the independent pixels.");
  fields.Number("hidden_difference", &options.hidden_difference, {0, 100}, "",
                "Limit of the difference where the static surface was hidden.");
  fields.Integer("edge_window_px", &options.edge_window_px, {1, 101}, "half-size px",
                 "Side of the window in which a nearer surface takes over the flow; odd.");
  fields.Number("least", &options.least, {-20, 0}, "log-odds",
                "Lowest evidence of one frame over a gap.");
  fields.Number("most", &options.most, {0, 20}, "log-odds",
                "Highest evidence of one frame over a gap.");
  fields.Number("least_speed_share", &options.least_speed_share, {0, 1}, "",
                "A moving object has not stopped while it moves at this share of its mean speed.");
  fields.Number("mover_noise", &options.mover_noise, {1, 100}, "",
                "Factor by which a moving object's flow errs more than a static pixel's.");
  fields.Number("others_weight", &options.others_weight, {0, 1}, "",
                "Weight of gaps that indicate static where another has found motion.");
  fields.Require(options.edge_window_px % 2 == 1, "edge_window_px", options.edge_window_px,
                 "be odd");
}

}  // namespace aisle::slam::dynamic
