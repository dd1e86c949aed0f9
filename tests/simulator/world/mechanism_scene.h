#pragma once

#include <string>

namespace aisle::sim {

/// A small hall in which nothing stands.
inline const std::string kHall = R"(about: Things move.
frames: 200
rig: {start: [0, 0], steps: []}
hall: {from: [-5, -8], to: [20, 8], height_m: 6}
lights: [{rows: 1, per_row: 2, height_m: 5}]
)";

/// A mechanism with every kind of joint, and a part that rests.
inline const std::string kJoints = R"(mechanisms:
  - name: all
    at: [5, 1]
    heading_deg: 20
    parts:
      - {name: arm, size_m: [1, 0.1, 0.1], at_m: [0, 0, 2], joint: {kind: hinge, axis: [0, 0, 1], moves: [{at_s: 1, to_deg: 70, over_s: 1.5}]}}
      - {on: arm, size_m: [0.2, 0.2, 0.2], at_m: [0.5, 0, 0], joint: {kind: spin, axis: [1, 0, 0], rate_hz: 0.7, from_s: 2}}
      - {size_m: [0.1, 1, 1], at_m: [2, 0, 0.5], joint: {kind: slider, axis: [0, 1, 0], moves: [{at_s: 2, to_m: 1, over_s: 2}]}}
      - {shape: link, size_m: [0.1, 0.03, 0.14], at_m: [3, 0, 4], count: 10, joint: {kind: chain, axis: [1, 0, 0], length_m: 1, swing_m: 0.2, at_s: 0.5}}
      - {shape: cylinder, size_m: [0.1, 0.1, 0.5], at_m: [4, 0, 1], roll_deg: 90, count: 3, step_m: [0.2, 0, 0], delay_s: 0.3, joint: {kind: pendulum, axis: [0, 1, 0], swing_deg: 20, length_m: 0.7, decay_s: 2, at_s: 0.2}}
      - {size_m: [5, 0.2, 0.2], at_m: [2, 2, 0.1]}
)";

}  // namespace aisle::sim
