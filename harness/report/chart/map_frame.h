#pragma once

namespace aisle {

/// Of the maps on a page, seen from above: their width and where between the ground is drawn. In
/// units of the map: it grows and shrinks with the page, its letters by steps of the style sheet.
inline constexpr double kMapWidth = 860, kMapLeft = 84, kMapRight = 846;

}  // namespace aisle
