#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {
namespace {

/// What one frame's pixels say, and how sure each of it is.
void DescribeMeasurements(OptionFields& fields, EvidenceOptions& options) {
  fields.Number("mover_mps", &options.mover_mps, {0.01, 100}, "m/s",
                "Deviation of a mover's speed along each axis of the image.");
  fields.Number("disparity_noise", &options.disparity_noise, {0.01, 10}, "half-size px",
                "Deviation of a disparity.");
  fields.Number("noise_per_displacement", &options.noise_per_displacement, {0, 1}, "px/px",
                "Deviation of the flow per pixel of displacement.");
  fields.Number("independent_pixels", &options.independent_pixels, {0.1, 1000}, "",
                "Pixels of a window whose grey values count as independent.");
  fields.Number("difference_weight", &options.difference_weight, {0, 100}, "",
                "Weight of an ill fit of the moved window against that count.");
  fields.Number("hidden_difference", &options.hidden_difference, {0, 100}, "",
                "Limit of that difference where the static surface was hidden.");
}

/// Which surfaces may be one and the same.
void DescribeSurfaces(OptionFields& fields, EvidenceOptions& options) {
  fields.Number("other_disparity", &options.other_disparity, {0.1, 100}, "half-size px",
                "Disparities so far apart are two matches, not one measured ill.");
  fields.Number("sure", &options.sure, {0, 100}, "log-odds",
                "Log-odds of earlier frames from which on no static look-alike is searched.");
  fields.Integer("alias_disparities", &options.alias_disparities, {1, 128}, "half-size px",
                 "Disparities among which a static look-alike is searched.");
  fields.Number("same_surface", &options.same_surface, {0.01, 100}, "half-size px",
                "Step of disparity within one surface: constant part.");
  fields.Number("same_surface_share", &options.same_surface_share, {0, 1}, "",
                "Step of disparity within one surface: share of the disparity.");
  fields.Number("same_surface_speeds", &options.same_surface_speeds, {0, 100}, "",
                "Step of disparity within one surface: deviations of a mover's speed.");
  fields.Integer("blind_px", &options.blind_px, {0, 64}, "half-size px",
                 "Band at the right image's edge where the earlier frame may not have known a "
                 "mover's disparity.");
  fields.Number("edge_step", &options.edge_step, {0.01, 100}, "half-size px",
                "Step of disparity to something nearer whose flow covers a pixel: constant part.");
  fields.Number("edge_share", &options.edge_share, {0, 1}, "",
                "Step of disparity to something nearer whose flow covers a pixel: share.");
  fields.Integer("edge_window_px", &options.edge_window_px, {1, 101}, "half-size px",
                 "Side of the window in which that is looked for; odd.");
}

}  // namespace

void Describe(OptionFields& fields, EvidenceOptions& options) {
  DescribeMeasurements(fields, options);
  DescribeSurfaces(fields, options);
  fields.Numbers("least", &options.least, {-20, 0}, "log-odds",
                 "Least that one frame may say over a gap of 1, 5, 15 frames.");
  fields.Numbers("most", &options.most, {0, 20}, "log-odds",
                 "Most that one frame may say over a gap of 1, 5, 15 frames.");
  fields.Number("least_speed_share", &options.least_speed_share, {0, 1}, "",
                "A mover has not stopped while it goes at this share of its mean speed.");
  fields.Number("mover_noise", &options.mover_noise, {1, 100}, "",
                "Times by which a mover's flow errs more than a static pixel's.");
  fields.Number("motion_found", &options.motion_found, {0, 20}, "log-odds",
                "Evidence of one gap from which on the others count less.");
  fields.Number("others_weight", &options.others_weight, {0, 1}, "",
                "Weight of what those others say for static.");
  fields.Require(options.edge_window_px % 2 == 1, "edge_window_px", options.edge_window_px,
                 "be odd");
}

}  // namespace aisle::slam::dynamic
