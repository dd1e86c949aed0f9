#pragma once

namespace aisle {

/// The one style sheet of every report: light and dark, no other resource.
extern const char* const kStyleSheet;

}  // namespace aisle
