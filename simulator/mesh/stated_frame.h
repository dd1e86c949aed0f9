#pragma once

#include <optional>
#include <string_view>

#include "simulator/mesh/import.h"
#include "simulator/mesh/model_format.h"

namespace aisle::sim {

/// What a file, or its format, says of its coordinates.
struct StatedFrame {
  ModelFormat format = ModelFormat::kObj;
  std::optional<float> unit_m;  ///< metres of its unit
  std::optional<UpAxis> up;
};

/// glTF is in metres with y up (glTF 2.0, 3.4), COLLADA says both in its <asset> (1.4.1, 5-18) or
/// one or neither, OBJ nothing. A unit that is no positive number is as good as none.
StatedFrame FrameStatedIn(ModelFormat format, std::string_view text);

/// Throws ImportError that names what neither the file nor the options state.
void RequireStated(const StatedFrame& stated, const ImportOptions& options);

}  // namespace aisle::sim
