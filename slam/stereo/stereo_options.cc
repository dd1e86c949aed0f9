#include "slam/stereo/stereo_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, StereoOptions& options) {
  fields.Integer("descriptor_distance", &options.descriptor_distance, {1, 256}, "bits",
                 "Features whose descriptors differ by this or more do not match.");
  fields.Number("row_band_px", &options.row_band_px, {0, 100}, "px",
                "Rows up and down in which a match is searched, in pixels of its level.");
  fields.Number("nearest_m", &options.nearest_m, {0, 1000}, "m",
                "Depth of the nearest match; 0: one baseline.");
  // The buffers of patches hold 21 x 42 pixels.
  fields.Integer("patch_radius_px", &options.patch_radius_px, {1, 10}, "px",
                 "Reach of the square that is compared, in pixels of the level.");
  fields.Integer("search_px", &options.search_px, {1, 10}, "px",
                 "Reach of the search for the compared square around the right feature, in pixels "
                 "of the level.");
  fields.Choice("refinement", &options.refinement, {"least_squares", "parabola"},
                "How a match's column is refined to less than a pixel: least squares over the "
                "patch, or a parabola as in the published ORB-SLAM2.");
  fields.Number("worst_to_median", &options.worst_to_median, {1, 1000}, "",
                "Matches whose patches differ by more than this many medians are dropped.");
  fields.Number("disparity_noise_px", &options.disparity_noise_px, {1e-3, 100}, "px",
                "Deviation of a disparity that no patch shows, such as that of the calibration, in "
                "pixels of the level.");
  fields.Number("usual_slant", &options.usual_slant, {1e-3, 1}, "px/px",
                "Deviation of a patch's slant: disparity per pixel.");
  fields.Number("image_noise", &options.image_noise, {0.01, 100}, "grey levels",
                "Deviation of one pixel's brightness.");
}

}  // namespace aisle::slam
