#pragma once

#include <utility>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// Has `add`, which appends to the model's materials and textures the band that its options name,
/// fill these, and `model->colour` too where the options ask for it.
template <class Add>
void ForEachBand(const ImportOptions& options, Model* model, const Add& add) {
  if (options.colour) {
    for (const Band band : {Band::kRed, Band::kGreen, Band::kBlue}) {
      ImportOptions one = options;
      one.band = band;
      add(one);
      model->colour.push_back({std::move(model->materials), std::move(model->textures)});
      model->materials.clear();
      model->textures.clear();
    }
  }
  add(options);
}

}  // namespace aisle::sim
