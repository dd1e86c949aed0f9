#include "harness/plugs/light_teller.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "harness/io/duration.h"

namespace aisle {
namespace {

constexpr std::chrono::seconds kBetweenLines(10);

double Seconds(LightTeller::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

std::string Describe(const LightWork& work) {
  std::string text = work.phase;
  if (work.share > 0) text += fmt::format(", {:.0f} %", 100 * work.share);
  if (work.left_s) text += ", " + Duration(*work.left_s) + " left";
  return text;
}

LightTeller::LightTeller(std::string scene, TellLightWork told)
    : scene_(std::move(scene)), told_(std::move(told)), is_terminal_(isatty(STDERR_FILENO) != 0) {}

void LightTeller::Tell(const std::string& phase, double share, Clock::time_point now) {
  // A second solution, as of lamps that are dimmed, begins anew; one that is waited for is met
  // half-done.
  if (!began_ || share < share_at_beginning_) {
    began_ = said_ = now;
    share_at_beginning_ = share;
  }
  LightWork work{phase, share, std::nullopt};
  const double elapsed_s = Seconds(now - *began_), done = share - share_at_beginning_;
  constexpr double kLeastShare = 0.01, kLeastSeconds = 0.5;  // to say anything by
  if (done > kLeastShare && elapsed_s > kLeastSeconds) {
    work.left_s = elapsed_s * (1 - share) / done;
  }
  if (told_) told_(work);
  if (is_terminal_) {
    Draw(work);
  } else if (!told_ && now - *said_ >= kBetweenLines) {
    fmt::print(stderr, "{}: solving its light: {}\n", scene_, Describe(work));
    said_ = now;
  }
  if (share >= 1) began_.reset();
}

void LightTeller::Draw(const LightWork& work) const {
  constexpr int kWidth = 20;
  const int filled = static_cast<int>(work.share * kWidth);
  fmt::print(stderr, "\r\033[K{}: solving its light [{:#<{}}{:.<{}}] {}", scene_, "", filled, "",
             kWidth - filled, Describe(work));
  if (work.share >= 1) fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace aisle
