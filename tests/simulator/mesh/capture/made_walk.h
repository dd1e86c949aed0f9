#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

namespace aisle::sim::test {

/// How a made-up recording is written: the same walk in other words.
struct WalkStyle {
  double unit_m = 0.01;       ///< of the file
  bool z_up = false;          ///< else y is up; the walker faces z, or -y
  bool hanging_arms = false;  ///< the offsets draw hanging arms, which every frame lifts to a T
  double thigh_m = 0.4;       ///< of a leg of 0.8 m: others have other shares
};

/// A walk in closed form, in metres: straight on at a constant speed, the hips at a constant
/// height, feet flat on the floor and at rest for three fifths of each cycle.
struct MadeWalk {
  static constexpr double kSpeed = 0.7, kCycle_s = 1.2, kStance = 0.6, kLeg = 0.4, kHip = 0.82;
  static constexpr double kAnkle = 0.08, kLift = 0.12, kRate_hz = 60;
  static constexpr int kFrames = 240;

  /// Share of its cycle that a foot has behind it; it stands below kStance.
  static double Phase(double time_s, int side) {
    const double phase = time_s / kCycle_s + (side == 0 ? 0 : 0.5);
    return phase - std::floor(phase);
  }
  static bool Stands(double time_s, int side) { return Phase(time_s, side) < kStance; }

  /// The ankle ahead of the hip, and above the floor.
  static std::array<double, 2> Ankle(double time_s, int side) {
    const double phase = Phase(time_s, side), half = kSpeed * kCycle_s * kStance / 2;
    if (phase < kStance) return {half - kSpeed * kCycle_s * phase, kAnkle};
    const double swing = (phase - kStance) / (1 - kStance);
    const double smooth = swing * swing * (3 - 2 * swing);
    const double lift = std::sin(std::numbers::pi * swing);
    return {-half + 2 * half * smooth, kAnkle + kLift * lift * lift};
  }
  /// How far thigh and shin lean forward from hanging down, in degrees.
  static std::array<double, 2> Leg(double time_s, int side, double thigh_m) {
    const auto [ahead, high] = Ankle(time_s, side);
    const double down = kHip - high, reach = std::hypot(ahead, down), shin_m = 2 * kLeg - thigh_m;
    const double bend =
        std::acos((thigh_m * thigh_m + reach * reach - shin_m * shin_m) / (2 * thigh_m * reach));
    const double thigh = std::atan2(ahead, down) + bend;
    const double shin =
        std::atan2(ahead - thigh_m * std::sin(thigh), down - thigh_m * std::cos(thigh));
    constexpr double kDegree = 180 / std::numbers::pi;
    return {kDegree * thigh, kDegree * shin};
  }
};

/// Writes the walk as a BVH file.
class WalkWriter {
 public:
  explicit WalkWriter(const WalkStyle& style) : style_(style) {}

  std::string Write() {
    text_ = "HIERARCHY\nROOT Hips\n{\n";
    Offset(0, 0, 0);
    text_ += "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
    Joint("Spine", 0, 0.12, 0);
    Joint("Chest", 0, 0.2, 0);
    for (const double side : {1.0, -1.0}) Arm(side);
    Joint("Neck", 0, 0.25, 0);
    Joint("Head", 0, 0.1, 0);
    End(0, 0.2, 0);
    text_ += "}\n}\n}\n}\n";
    for (const double side : {1.0, -1.0}) LegOf(side);
    text_ += fmt::format("}}\nMOTION\nFrames: {}\nFrame Time: {:.9f}\n", MadeWalk::kFrames,
                         1 / MadeWalk::kRate_hz);
    for (int frame = 0; frame < MadeWalk::kFrames; ++frame) Frame(frame / MadeWalk::kRate_hz);
    return text_;
  }

 private:
  /// x to the walker's left, y up, z ahead.
  void Offset(double left, double up, double ahead) {
    const double u = 1 / style_.unit_m;
    text_ += style_.z_up
                 ? fmt::format("OFFSET {:.9f} {:.9f} {:.9f}\n", u * left, -u * ahead, u * up)
                 : fmt::format("OFFSET {:.9f} {:.9f} {:.9f}\n", u * left, u * up, u * ahead);
  }
  void Joint(const std::string& name, double left, double up, double ahead) {
    text_ += "JOINT " + name + "\n{\n";
    Offset(left, up, ahead);
    text_ += "CHANNELS 3 Zrotation Xrotation Yrotation\n";
  }
  void End(double left, double up, double ahead) {
    text_ += "End Site\n{\n";
    Offset(left, up, ahead);
    text_ += "}\n";
  }
  void Arm(double side) {
    const std::string name = side > 0 ? "Left" : "Right";
    const auto along = [&](double m) {
      return style_.hanging_arms ? std::array{0.0, -m} : std::array{side * m, 0.0};
    };
    Joint(name + "Shoulder", 0.03 * side, 0.2, 0);
    Joint(name + "Arm", 0.15 * side, 0, 0);
    Joint(name + "ForeArm", along(0.28)[0], along(0.28)[1], 0);
    Joint(name + "Hand", along(0.26)[0], along(0.26)[1], 0);
    End(along(0.1)[0], along(0.1)[1], 0);
    text_ += "}\n}\n}\n}\n";
  }
  void LegOf(double side) {
    const std::string name = side > 0 ? "Left" : "Right";
    Joint(name + "UpLeg", 0.1 * side, 0, 0);
    Joint(name + "Leg", 0, -style_.thigh_m, 0);
    Joint(name + "Foot", 0, style_.thigh_m - 2 * MadeWalk::kLeg, 0);
    Joint(name + "ToeBase", 0, -0.06, 0.14);
    End(0, 0, 0.06);
    text_ += "}\n}\n}\n}\n";
  }

  /// Turns about the axis to the walker's left: about x in both kinds of file.
  void Turns(std::initializer_list<double> about_left) {
    for (const double angle : about_left) text_ += fmt::format(" 0 {:.9f} 0", angle);
  }
  /// About the axis ahead: lifts a hanging arm of the left, lowers one of the right.
  void Lift(double side) {
    const double angle = style_.hanging_arms ? 90 * side : 0;
    text_ += style_.z_up ? fmt::format(" 0 0 {}", -angle) : fmt::format(" {} 0 0", angle);
  }
  void Frame(double time_s) {
    const double u = 1 / style_.unit_m, way = u * MadeWalk::kSpeed * time_s,
                 hip = u * MadeWalk::kHip;
    text_ += style_.z_up ? fmt::format("0 {:.9f} {:.9f}", -way, hip)
                         : fmt::format("0 {:.9f} {:.9f}", hip, way);
    Turns({0, 0, 0});  // hips, spine, chest
    for (const double side : {1.0, -1.0}) {
      Turns({0});
      Lift(side);
      Turns({0, 0});
    }
    Turns({0, 0});  // neck, head
    for (const int side : {0, 1}) {
      const auto [thigh, shin] = MadeWalk::Leg(time_s, side, style_.thigh_m);
      Turns({-thigh, thigh - shin, shin, 0});
    }
    text_ += "\n";
  }

  WalkStyle style_;
  std::string text_;
};

}  // namespace aisle::sim::test
