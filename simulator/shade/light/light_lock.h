#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

namespace aisle::sim {

/// Held by the one process that solves what several need at once. The system takes it from a
/// process that dies; a process that is frozen, or whose machine is gone while the folder is
/// shared, is found out by its silence.
class LightLock {
 public:
  /// None where another holds it. Where there can be no lock (a folder that cannot be written),
  /// one that binds nobody.
  static std::optional<LightLock> Try(const std::filesystem::path& file);

  LightLock(LightLock&& other) noexcept;
  LightLock& operator=(LightLock&&) = delete;
  ~LightLock();  ///< takes the file away

  /// Shows those who wait that the work goes on, and how far it is. Thread-safe.
  void Beat(double share) const;

 private:
  LightLock() = default;
  std::filesystem::path file_;
  int fd_ = -1;
};

/// One who waits for the holder of a lock.
class LightWait {
 public:
  using Clock = std::chrono::steady_clock;
  explicit LightWait(std::filesystem::path file) : file_(std::move(file)) {}

  /// Looks at the holder's last beat. False once there was none for `patience`: who waits then
  /// does the work himself.
  bool Look(Clock::time_point now = Clock::now(),
            Clock::duration patience = std::chrono::minutes(1));
  /// What the holder has done of the work, 0 to 1.
  double share() const { return beat_.share; }

 private:
  friend class LightLock;
  struct Beat {
    double share = 0;
    std::uint64_t count = 0;
    bool operator==(const Beat&) const = default;
  };

  std::filesystem::path file_;
  Beat beat_;
  std::optional<Clock::time_point> heard_;
};

}  // namespace aisle::sim
