#include "slam/flow/dense_flow_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, DenseFlowOptions& options) {
  fields.Integer("finest_scale", &options.finest_scale, {0, 3}, "",
                 "Halvings of the half-size image on which the finest patches of the flow lie.");
  fields.Integer("descents", &options.descents, {1, 256}, "",
                 "Gradient-descent iterations of a patch on each scale.");
  fields.Number(
      "inertia", &options.inertia, {1e-3, 1e6}, "(grey levels/px)^2",
      "Squared gradient of a patch that counts as much as the flow of the coarser scale.");
  fields.Integer("refinements", &options.refinements, {0, 100}, "",
                 "Variational iterations on each scale.");
}

}  // namespace aisle::slam
