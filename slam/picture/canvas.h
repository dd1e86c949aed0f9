#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

namespace aisle::slam::picture {

using Colour = cv::Vec3b;  ///< BGR

// Readable on grey, apart for colour-blind eyes, and meaning the same in every picture.
inline constexpr int kTitleHeight = 26, kLegendHeight = 46;  ///< pixels
inline const Colour kStatic(110, 220, 90), kDynamic(60, 70, 255), kUnsure(170, 170, 170),
    kFound(240, 220, 40), kTruth(60, 70, 255), kNote(240, 240, 240);

inline cv::Scalar ToScalar(const Colour& c) { return {double(c[0]), double(c[1]), double(c[2])}; }

/// A colour that tells things of small numbers apart; repeats after eight.
Colour ColourOf(int number);

/// The grey image in colours; `brightness` in (0, 1] dims it so that what is drawn stands out.
cv::Mat3b OnGrey(const cv::Mat1b& image, double brightness = 1);

/// Mixes `colour` into the pixels of the mask.
void Tint(const cv::Mat1b& mask, const Colour& colour, double strength, cv::Mat3b& picture);

/// Values as blue (low end) over grey (middle) to red (high end), |value| >= limit being full
/// colour, mixed into the picture by their size. Sizes must agree.
void TintByLogOdds(const cv::Mat1f& log_odds, double limit, cv::Mat3b& picture);
Colour LogOddsColour(double log_odds, double limit);

/// Values from 0 to `most` from dark to bright; negative ones black.
cv::Mat3b HeatOf(const cv::Mat1f& values, double most);
Colour HeatColour(double value, double most);

/// Directions as hue, lengths up to `most` as strength.
cv::Mat3b WheelOf(const cv::Mat2f& vectors, double most);

/// Text on a plate of `colour`, kept inside the picture.
void Plate(const std::string& text, cv::Point at, const Colour& colour, cv::Mat3b& picture);

struct LegendEntry {
  Colour colour;
  std::string text;
};

/// The picture between its title and, below, the legend in a first line and the caption in a
/// second. The title must be short enough for the width.
cv::Mat3b Framed(const cv::Mat3b& picture, const std::string& title,
                 const std::vector<LegendEntry>& legend, const std::string& caption);

}  // namespace aisle::slam::picture
