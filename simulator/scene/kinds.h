#pragma once

namespace aisle::sim {

/// How busy a scene is. An actor takes part when the scene's level is at least its own.
enum class Dynamics { kNone, kLow, kMid, kHigh };

enum class GoodsKind { kMixed, kCartons, kDrums, kTotes, kWrapped, kIdentical, kNothing };

}  // namespace aisle::sim
