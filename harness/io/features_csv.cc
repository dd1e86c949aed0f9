#include "harness/io/features_csv.h"

#include <array>
#include <charconv>
#include <sstream>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr double kFarthestPx = 1e5;  ///< from the image: more is no pixel of any camera

/// The numbers of a line of three or four; nothing where it is none.
std::optional<std::array<double, 4>> NumbersOf(const std::string& line) {
  std::array<double, 4> numbers{0, 0, 0, 1};
  const char *at = line.data(), *const end = at + line.size();
  std::size_t count = 0;
  while (count < numbers.size()) {
    while (at != end && *at == ' ') ++at;
    const auto [stopped, error] = std::from_chars(at, end, numbers[count]);
    if (error != std::errc() || !std::isfinite(numbers[count])) return std::nullopt;
    ++count;
    at = stopped;
    while (at != end && (*at == ' ' || *at == '\r')) ++at;
    if (at == end) break;
    if (*at++ != ',') return std::nullopt;
  }
  if (at != end || count < 3) return std::nullopt;
  return numbers;
}

bool IsKeypoint(const std::array<double, 4>& numbers) {
  const auto [frame, u, v, used] = numbers;
  return frame >= 0 && frame < 1e9 && frame == std::floor(frame) && std::abs(u) < kFarthestPx &&
         std::abs(v) < kFarthestPx && (used == 0 || used == 1);
}

}  // namespace

std::map<std::int64_t, FrameFeatures> ReadFeatures(const std::filesystem::path& file) {
  std::map<std::int64_t, FrameFeatures> features;
  std::istringstream stream(ReadFile(file, kLargestFile));
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const bool names = number == 1 && line.starts_with("frame");
    if (names || line.empty() || line == "\r" || line.starts_with("#")) continue;
    const auto numbers = NumbersOf(line);
    if (!numbers || !IsKeypoint(*numbers)) {
      throw InputError(file.string(), number,
                       fmt::format("expected frame,u,v,used with frames from 0 on, pixels and 0 or "
                                   "1, got '{}'; example: 12,310.5,200.25,1",
                                   Printable(line, 60)));
    }
    FrameFeatures& frame = features[static_cast<std::int64_t>((*numbers)[0])];
    frame.points.emplace_back(static_cast<float>((*numbers)[1]), static_cast<float>((*numbers)[2]));
    frame.used.push_back((*numbers)[3] == 1);
  }
  return features;
}

}  // namespace aisle
