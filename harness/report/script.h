#pragma once

namespace aisle {

/// The one script of every report: sorting, filtering, values under the pointer, a view of the
/// tracks that turns. Pages are whole without it, and most policies of CI servers forbid it.
extern const char* const kScript;

}  // namespace aisle
