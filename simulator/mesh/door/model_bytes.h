#pragma once

#include <string>
#include <string_view>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// A model as this project's own bytes: versioned, with their length and a checksum, little-endian,
/// and nothing in them that has to be interpreted.
std::string EncodeModel(const Model& model);

/// Gives the model back to the last bit. Takes nothing on trust: lists are no longer than their
/// bytes, and the model is held to CheckModel. Throws ImportError.
Model DecodeModel(std::string_view bytes, const ImportOptions& options);

}  // namespace aisle::sim
