#include "slam/dynamic/dynamic_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, DynamicOptions& options) {
  fields.Choice("method", &options.method, {"none", "paper", "robust"},
                "How moving objects are found; each method has options of its own.");
  fields.Group("paper", &options.paper);
  fields.Group("robust", &options.robust);
}

}  // namespace aisle::slam
