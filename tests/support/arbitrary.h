#pragma once

#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace aisle {

// Values of every kind, for properties (rc::check): to be called from within one.

template <class Whole>
Whole AnyWhole() {
  return *rc::gen::arbitrary<Whole>();
}
inline bool AnyFlag() { return *rc::gen::arbitrary<bool>(); }
/// From `low` on, below `high`.
inline int AnyOf(int low, int high) { return *rc::gen::inRange(low, high); }

/// A finite number of any size, down to the smallest.
inline double AnyNumber() {
  const double value = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
  return std::isfinite(value) ? value : 0.1;
}
/// Within bounds, with all the digits that a double has.
inline double AnyNumberIn(double low, double high) {
  const auto whole = *rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53);
  return low + (high - low) * std::ldexp(static_cast<double>(whole), -53);
}

/// Bytes of any kind, zeros too.
inline std::string AnyBytes() { return *rc::gen::arbitrary<std::string>(); }

/// Text as a file may hold it: UTF-8, with quotes, backslashes, line ends and what HTML minds.
inline std::string AnyText() {
  static const std::vector<std::string> kPieces = {"a",  "B", "7",   " ",    "/",  "\\",
                                                   "\"", "'", "<b>", "&",    ",",  "\n",
                                                   "\t", "ä", "…",   "\x01", "%s", "{}"};
  std::string text;
  for (int left = AnyOf(0, 9); left > 0; --left) {
    text += kPieces[static_cast<std::size_t>(AnyOf(0, static_cast<int>(kPieces.size())))];
  }
  return text;
}
/// Text with something in it.
inline std::string AnyName() {
  std::string name = AnyText();
  name += 'n';
  return name;
}

template <class Make>
auto AnyList(int most, const Make& make) {
  std::vector<decltype(make())> list;
  for (int left = AnyOf(0, most + 1); left > 0; --left) list.push_back(make());
  return list;
}
template <class Make>
auto AnyMap(int most, const Make& make) {
  std::map<std::string, decltype(make())> map;
  for (int left = AnyOf(0, most + 1); left > 0; --left) map.insert_or_assign(AnyName(), make());
  return map;
}
template <class Make>
auto Perhaps(const Make& make) {
  return AnyFlag() ? std::optional(make()) : std::nullopt;
}

inline Eigen::Isometry3d AnyPose(double reach_m = 1e4) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto part = [] { return AnyNumberIn(-1, 1); };
  const Eigen::Quaterniond turn(1.5 + part(), part(), part(), part());
  pose.linear() = turn.normalized().toRotationMatrix();
  for (double& metres : pose.translation()) metres = AnyNumberIn(-reach_m, reach_m);
  return pose;
}

}  // namespace aisle
