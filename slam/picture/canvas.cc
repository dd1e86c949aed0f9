#include "slam/picture/canvas.h"

#include <opencv2/imgproc.hpp>

namespace aisle::slam::picture {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kTitleScale = 0.5, kTextScale = 0.42;
const Colour kBar(38, 34, 30), kInk(20, 20, 20);

void Write(const std::string& text, cv::Point at, double scale, const Colour& colour,
           cv::Mat3b& picture) {
  cv::putText(picture, text, at, kFont, scale, ToScalar(colour), 1, cv::LINE_AA);
}

int WidthOf(const std::string& text, double scale) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, scale, 1, &baseline).width;
}

unsigned char Mix(unsigned char under, unsigned char over, double share) {
  return cv::saturate_cast<unsigned char>(under * (1 - share) + over * share);
}

Colour Mix(const Colour& under, const Colour& over, double share) {
  return {Mix(under[0], over[0], share), Mix(under[1], over[1], share),
          Mix(under[2], over[2], share)};
}

/// 256 colours of one of OpenCV's maps.
cv::Mat3b MapOf(int map) {
  cv::Mat1b ramp(1, 256);
  for (int i = 0; i < 256; ++i) ramp(0, i) = static_cast<unsigned char>(i);
  cv::Mat3b colours;
  cv::applyColorMap(ramp, colours, map);
  return colours;
}

}  // namespace

Colour ColourOf(int number) {
  static const std::array<Colour, 8> colours = {
      Colour(240, 180, 60), Colour(80, 200, 250),  Colour(200, 120, 250), Colour(120, 230, 120),
      Colour(250, 220, 90), Colour(120, 140, 255), Colour(220, 220, 220), Colour(90, 240, 220)};
  const int count = static_cast<int>(colours.size());
  return colours[static_cast<std::size_t>(((number % count) + count) % count)];
}

cv::Mat3b OnGrey(const cv::Mat1b& image, double brightness) {
  cv::Mat1b dimmed;
  image.convertTo(dimmed, CV_8U, brightness);
  cv::Mat3b picture;
  cv::cvtColor(dimmed, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

void Tint(const cv::Mat1b& mask, const Colour& colour, double strength, cv::Mat3b& picture) {
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask(y, x) != 0) picture(y, x) = Mix(picture(y, x), colour, strength);
    }
  }
}

Colour LogOddsColour(double log_odds, double limit) {
  const Colour still(255, 130, 40), moving(40, 50, 255), unknown(128, 128, 128);
  const double share = std::min(std::abs(log_odds) / limit, 1.0);
  return Mix(unknown, log_odds > 0 ? moving : still, share);
}

void TintByLogOdds(const cv::Mat1f& log_odds, double limit, cv::Mat3b& picture) {
  constexpr double kMoving = 0.75, kStill = 0.4;  // of the colour: the image stays to be seen
  for (int y = 0; y < log_odds.rows; ++y) {
    for (int x = 0; x < log_odds.cols; ++x) {
      const double value = log_odds(y, x);
      const double share = (value > 0 ? kMoving : kStill) * std::min(std::abs(value) / limit, 1.0);
      picture(y, x) = Mix(picture(y, x), LogOddsColour(value, limit), share);
    }
  }
}

Colour HeatColour(double value, double most) {
  static const cv::Mat3b map = MapOf(cv::COLORMAP_TURBO);
  if (value < 0) return {0, 0, 0};
  return map(0, static_cast<int>(255 * std::min(value / most, 1.0)));
}

cv::Mat3b HeatOf(const cv::Mat1f& values, double most) {
  cv::Mat3b picture(values.size());
  for (int y = 0; y < values.rows; ++y) {
    for (int x = 0; x < values.cols; ++x) picture(y, x) = HeatColour(values(y, x), most);
  }
  return picture;
}

cv::Mat3b WheelOf(const cv::Mat2f& vectors, double most) {
  cv::Mat3b hsv(vectors.size());
  for (int y = 0; y < vectors.rows; ++y) {
    for (int x = 0; x < vectors.cols; ++x) {
      const cv::Vec2f& v = vectors(y, x);
      const double length = std::min(std::hypot(v[0], v[1]) / most, 1.0);
      const double degrees = std::atan2(v[1], v[0]) * 180 / CV_PI + 180;
      hsv(y, x) = {cv::saturate_cast<unsigned char>(std::min(degrees / 2, 179.0)),
                   cv::saturate_cast<unsigned char>(255 * length),
                   cv::saturate_cast<unsigned char>(70 + 185 * length)};
    }
  }
  cv::Mat3b picture;
  cv::cvtColor(hsv, picture, cv::COLOR_HSV2BGR);
  return picture;
}

void Plate(const std::string& text, cv::Point at, const Colour& colour, cv::Mat3b& picture) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, kFont, kTextScale, 1, &baseline);
  at.x = std::clamp(at.x, 0, std::max(0, picture.cols - size.width - 6));
  at.y = std::clamp(at.y, size.height + 6, picture.rows - 2);
  const cv::Rect plate(at.x, at.y - size.height - 6, size.width + 6, size.height + 6);
  cv::rectangle(picture, plate & cv::Rect({}, picture.size()), ToScalar(colour), cv::FILLED);
  Write(text, {at.x + 3, at.y - 3}, kTextScale, kInk, picture);
}

cv::Mat3b Framed(const cv::Mat3b& picture, const std::string& title,
                 const std::vector<LegendEntry>& legend, const std::string& caption) {
  constexpr int kLeft = 8, kChip = 10;
  cv::Mat3b framed;
  cv::copyMakeBorder(picture, framed, kTitleHeight, kLegendHeight, 0, 0, cv::BORDER_CONSTANT,
                     ToScalar(kBar));
  Write(title, {kLeft, 18}, kTitleScale, kNote, framed);
  int x = kLeft;
  const int line = kTitleHeight + picture.rows + 17;
  for (const LegendEntry& entry : legend) {
    cv::rectangle(framed, cv::Rect(x, line - kChip, kChip, kChip), ToScalar(entry.colour),
                  cv::FILLED);
    x += kChip + 4;
    Write(entry.text, {x, line}, kTextScale, kNote, framed);
    x += WidthOf(entry.text, kTextScale) + 12;
  }
  Write(caption, {kLeft, line + 19}, kTextScale, kNote, framed);
  return framed;
}

}  // namespace aisle::slam::picture
