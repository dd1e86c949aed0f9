#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace aisle {

/// What is at work while the light of a scene is solved.
struct LightWork {
  std::string phase;             ///< "direct light"
  double share = 0;              ///< of the whole that is done, 0 to 1
  std::optional<double> left_s;  ///< none where nothing can be said yet
};

/// "direct light, 43 %, 12 s left".
std::string Describe(const LightWork& work);

/// Told while the light is solved; from any thread, one call at a time. What it throws ends it.
using TellLightWork = std::function<void(const LightWork&)>;

/// Says how far the light of a scene is: to who asked for it and, as a bar, to a terminal; where
/// neither is there, as a line on stderr now and then.
class LightTeller {
 public:
  using Clock = std::chrono::steady_clock;

  LightTeller(std::string scene, TellLightWork told);
  /// `phase` and `share` as LightWork has them.
  void Tell(const std::string& phase, double share, Clock::time_point now = Clock::now());

 private:
  void Draw(const LightWork& work) const;

  std::string scene_;
  TellLightWork told_;
  bool is_terminal_;
  std::optional<Clock::time_point> began_, said_;
  double share_at_beginning_ = 0;
};

}  // namespace aisle
