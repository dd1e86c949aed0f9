#include "slam/feature/feature_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, FeatureOptions& options) {
  fields.Integer("features", &options.features, {1, 20000}, "",
                 "Most features per image, over all pyramid levels.");
  fields.Integer("levels", &options.levels, {1, 16}, "", "Levels of the image pyramid.");
  // A landmark's level is predicted by dividing by the logarithm of this.
  fields.Number("scale", &options.scale, {1.01, 2}, "",
                "Scale from one pyramid level to the next.");
  fields.Integer("fast_threshold", &options.fast_threshold, {1, 254}, "grey levels",
                 "Contrast that FAST asks of a corner at first.");
  fields.Integer("fast_threshold_low", &options.fast_threshold_low, {1, 254}, "grey levels",
                 "Contrast asked of a corner in cells where the first finds nothing.");
  fields.Number("least_corner_ratio", &options.least_corner_ratio, {0, 1}, "",
                "Least ratio of the eigenvalues of the structure tensor around a corner; below, it "
                "lies on a straight edge and is not taken. 0 takes all.");
  fields.Integer("cell_px", &options.cell_px, {8, 4096}, "px",
                 "Side of the cells in which corners are searched, in pixels of the level.");
  fields.Integer("border_px", &options.border_px, {16, 1024}, "px",
                 "Least distance of a corner from the image's edge, in pixels of the level; "
                 "orientation reaches 16.");
  fields.Number("mask_margin_px", &options.mask_margin_px, {0, 100}, "px",
                "Least distance of a corner from a masked pixel, in pixels of the level.");
  fields.RequireNotAbove("fast_threshold_low", options.fast_threshold_low, "fast_threshold",
                         options.fast_threshold);
}

}  // namespace aisle::slam
