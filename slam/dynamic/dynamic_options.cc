#include "slam/dynamic/dynamic_options.h"

namespace aisle::slam {

void Describe(OptionFields& fields, DynamicOptions& options) {
  fields.Choice("method", &options.method, {"none", "paper", "robust"},
                "Method that finds moving objects; each method has its own options.");
  fields.Group("paper", &options.paper);
  fields.Group("robust", &options.robust);
}

}  // namespace aisle::slam
