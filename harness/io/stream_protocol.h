#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"

namespace aisle {

/// The stream between a harness and a system, over the system's stdin and stdout; told in full in
/// reports/docs/stream.md. A message is a payload's length and a type, both 32 bits, and the
/// payload; everything little-endian, floating point is IEEE 754.
///
///   harness                     system
///   kHello calibration, rate -> kHello version, name
///   kMotion id, motion                                             where it asked for wheels
///   kFrame id, stamp, images -> kPose id, pose  or  kLost id       for every frame
///   kEnd                     -> kTrack stamped poses               and the system ends
inline constexpr std::uint32_t kStreamVersion = 1;
inline constexpr std::size_t kLargestStreamMessage = std::size_t{64} << 20;

enum class StreamType : std::uint32_t {
  kHello = 1,
  kFrame = 2,
  kPose = 3,
  kLost = 4,
  kEnd = 5,
  kTrack = 6,
  kMotion = 7,
};
struct StreamMessage {
  StreamType type = StreamType::kEnd;
  std::string payload;
};

/// Who is on the other side went away, took too long, or said what cannot be.
struct StreamError : std::runtime_error {
  enum class Kind { kClosed, kTimeout, kNonsense };
  StreamError(Kind which, const std::string& what) : std::runtime_error(what), kind(which) {}
  Kind kind;
};

struct StreamHello {
  std::uint32_t version = kStreamVersion;
  StereoCalibration calibration;
  double rate_hz = 0;
};

// Payloads. Each reader throws StreamError (kNonsense) naming what is wrong.
std::string FormatHello(const StreamHello& hello);
StreamHello ReadHello(const std::string& payload);
std::string FormatName(std::uint32_t version, const std::string& name);
/// The name in a system's kHello, made harmless. Another version than ours is nonsense.
std::string ReadName(const std::string& payload);
std::string FormatFrame(const StereoFrame& frame);
StereoFrame ReadFrame(const std::string& payload, const StereoCalibration& calibration);
/// What wheels say of the rig's way to frame `id`, which comes next.
std::string FormatMotion(std::int64_t id, const MotionMeasurement& motion);
MotionMeasurement ReadMotion(const std::string& payload, std::int64_t* id);
/// Of kPose where there is one, of kLost else.
/// `map_id` (MapIdOf) is written unless it is 0.
std::string FormatAnswer(std::int64_t id, const std::optional<Eigen::Isometry3d>& pose,
                         int map_id = 0);
/// What an answer says.
struct StreamAnswer {
  std::optional<Eigen::Isometry3d> pose;
  int map_id = 0;
};
/// The answer to frame `id`.
StreamAnswer ReadAnswer(const StreamMessage& message, std::int64_t id);
std::string FormatTrack(const Trajectory& track);
Trajectory ReadTrack(const std::string& payload);

/// Messages over a pair of descriptors, which are the caller's. Neither side can block it for
/// longer than it is given.
class StreamPipe {
 public:
  /// `timeout_s` of one message, 0: for ever. `while_waiting` is called some twenty times a second.
  StreamPipe(int read_fd, int write_fd, double timeout_s = 0,
             std::function<void()> while_waiting = {});

  void Send(StreamType type, const std::string& payload);
  /// The next message; nothing where the other side has closed between two of them.
  std::optional<StreamMessage> Receive();
  /// Whether the other side has written what nobody has read yet.
  bool HasUnread() const;

 private:
  bool Wait(int fd, short events, double until_s) const;
  std::size_t ReadAll(char* data, std::size_t size, double until_s);
  double Deadline() const;

  const int read_fd_, write_fd_;
  const double timeout_s_;
  const std::function<void()> while_waiting_;
};

}  // namespace aisle
