#include "harness/io/stream_protocol.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <limits>

#include "harness/contract/rigid.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

using Kind = StreamError::Kind;

[[noreturn]] void Nonsense(const std::string& what) { throw StreamError(Kind::kNonsense, what); }

template <class Value>
void Put(std::string* bytes, const Value& value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes values from a payload, in order.
class Taker {
 public:
  Taker(const std::string& payload, const char* what) : payload_(payload), what_(what) {}

  template <class Value>
  Value Take() {
    Value value;
    std::memcpy(&value, Bytes(sizeof value), sizeof value);
    return value;
  }
  const char* Bytes(std::size_t count) {
    if (payload_.size() - at_ < count) {
      Nonsense(fmt::format("{} of {} bytes ends too early", what_, payload_.size()));
    }
    at_ += count;
    return payload_.data() + at_ - count;
  }
  std::size_t left() const { return payload_.size() - at_; }
  void Done() const {
    if (left() > 0) Nonsense(fmt::format("{} has {} bytes too many", what_, left()));
  }

 private:
  const std::string& payload_;
  const char* what_;
  std::size_t at_ = 0;
};

void PutPose(std::string* bytes, const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Eigen::Vector3d& t = pose.translation();
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) Put(bytes, value);
}

Eigen::Isometry3d TakePose(Taker* taker, const std::string& whose) {
  std::array<double, 7> v;
  for (double& value : v) value = taker->Take<double>();
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  constexpr double kUnit = 1e-3;
  for (const double value : v) {
    if (!std::isfinite(value)) Nonsense(whose + " has a number that is not finite");
  }
  if (std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}) > kFarthest_m) {
    Nonsense(
        fmt::format("{} is at {:g}, {:g}, {:g}: positions are metres, at most {:g} from the origin",
                    whose, v[0], v[1], v[2], kFarthest_m));
  }
  if (std::abs(q.norm() - 1) > kUnit) {
    Nonsense(fmt::format("{} has a quaternion of length {:g}, expected 1", whose, q.norm()));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() << v[0], v[1], v[2];
  return pose;
}

constexpr const char* kEndsWithin = "the stream ends within a message";
constexpr const char* kStdoutIsTaken = ": stdout belongs to the stream, print to stderr";

/// What a program prints for people, where bytes of a message were due.
bool IsText(const std::string& bytes) {
  return std::ranges::all_of(
      bytes, [](unsigned char c) { return std::isprint(c) != 0 || std::isspace(c) != 0; });
}

double NowS() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::string FormatHello(const StreamHello& hello) {
  const StereoCalibration& c = hello.calibration;
  std::string bytes;
  Put(&bytes, hello.version);
  Put(&bytes, static_cast<std::uint32_t>(c.width));
  Put(&bytes, static_cast<std::uint32_t>(c.height));
  Put(&bytes, std::uint32_t{0});
  for (const double value : {c.fx, c.fy, c.cx, c.cy, c.baseline_m, hello.rate_hz}) {
    Put(&bytes, value);
  }
  return bytes;
}

StreamHello ReadHello(const std::string& payload) {
  Taker taker(payload, "hello");
  StreamHello hello;
  hello.version = taker.Take<std::uint32_t>();
  if (hello.version != kStreamVersion) {
    Nonsense(
        fmt::format("it speaks version {}, this is version {}", hello.version, kStreamVersion));
  }
  constexpr std::uint32_t kLargestSide = 16384;
  const auto side = [&] {
    const auto pixels = taker.Take<std::uint32_t>();
    if (pixels == 0 || pixels > kLargestSide) Nonsense(fmt::format("{} pixels wide", pixels));
    return static_cast<int>(pixels);
  };
  StereoCalibration& c = hello.calibration;
  c.width = side();
  c.height = side();
  taker.Take<std::uint32_t>();
  for (double* value : {&c.fx, &c.fy, &c.cx, &c.cy, &c.baseline_m, &hello.rate_hz}) {
    *value = taker.Take<double>();
    if (!std::isfinite(*value) || *value <= 0) Nonsense("its calibration is not positive");
  }
  taker.Done();
  return hello;
}

std::string FormatName(std::uint32_t version, const std::string& name) {
  std::string bytes;
  Put(&bytes, version);
  return bytes + name;
}

std::string ReadName(const std::string& payload) {
  Taker taker(payload, "hello");
  const auto version = taker.Take<std::uint32_t>();
  if (version != kStreamVersion) {
    Nonsense(
        fmt::format("it speaks version {} of the stream, expected {}", version, kStreamVersion));
  }
  constexpr std::size_t kLongest = 120;
  return Printable(payload.substr(sizeof version), kLongest);
}

std::string FormatFrame(const StereoFrame& frame) {
  std::string bytes;
  bytes.reserve(16 + 2 * frame.left.total());
  Put(&bytes, frame.id);
  Put(&bytes, frame.stamp_ns);
  for (const cv::Mat1b& image : {frame.left, frame.right}) {
    for (int y = 0; y < image.rows; ++y) {
      bytes.append(reinterpret_cast<const char*>(image.ptr(y)),
                   static_cast<std::size_t>(image.cols));
    }
  }
  return bytes;
}

StereoFrame ReadFrame(const std::string& payload, const StereoCalibration& calibration) {
  Taker taker(payload, "frame");
  StereoFrame frame;
  frame.id = taker.Take<std::int64_t>();
  frame.stamp_ns = taker.Take<std::int64_t>();
  for (cv::Mat1b* image : {&frame.left, &frame.right}) {
    image->create(calibration.height, calibration.width);
    std::memcpy(image->data, taker.Bytes(image->total()), image->total());
  }
  taker.Done();
  return frame;
}

std::string FormatMotion(std::int64_t id, const MotionMeasurement& motion) {
  std::string bytes;
  Put(&bytes, id);
  PutPose(&bytes, motion.T_now_before);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) Put(&bytes, motion.covariance(row, column));
  }
  return bytes;
}

MotionMeasurement ReadMotion(const std::string& payload, std::int64_t* id) {
  Taker taker(payload, "motion");
  *id = taker.Take<std::int64_t>();
  MotionMeasurement motion;
  motion.T_now_before = TakePose(&taker, "its motion");
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      motion.covariance(row, column) = taker.Take<double>();
    }
  }
  taker.Done();
  if (!motion.covariance.allFinite() ||
      !motion.covariance.isApprox(motion.covariance.transpose()) ||
      motion.covariance.llt().info() != Eigen::Success) {
    Nonsense("the covariance of its motion is invalid");
  }
  return motion;
}

std::string FormatAnswer(std::int64_t id, const std::optional<Eigen::Isometry3d>& pose,
                         int map_id) {
  std::string bytes;
  Put(&bytes, id);
  if (pose) PutPose(&bytes, *pose);
  if (map_id != 0) Put(&bytes, static_cast<std::int32_t>(map_id));
  return bytes;
}

StreamAnswer ReadAnswer(const StreamMessage& message, std::int64_t id) {
  if (message.type != StreamType::kPose && message.type != StreamType::kLost) {
    Nonsense(fmt::format("expected an answer, got a message of type {}",
                         static_cast<std::uint32_t>(message.type)));
  }
  Taker taker(message.payload, "answer");
  const auto of = taker.Take<std::int64_t>();
  if (of != id)
    Nonsense(fmt::format("expected the answer to frame {1}, got that to frame {0}", of, id));
  StreamAnswer answer;
  if (message.type == StreamType::kPose) answer.pose = TakePose(&taker, "its pose");
  if (taker.left() > 0) answer.map_id = taker.Take<std::int32_t>();
  taker.Done();
  return answer;
}

std::string FormatTrack(const Trajectory& track) {
  std::string bytes;
  for (const StampedPose& pose : track) {
    Put(&bytes, pose.stamp_ns);
    PutPose(&bytes, pose.T_world_rig);
  }
  return bytes;
}

Trajectory ReadTrack(const std::string& payload) {
  Taker taker(payload, "track");
  Trajectory track;
  while (taker.left() > 0) {
    const auto stamp_ns = taker.Take<std::int64_t>();
    track.push_back(
        {stamp_ns, TakePose(&taker, fmt::format("pose {} of its track", track.size()))});
  }
  return track;
}

StreamPipe::StreamPipe(int read_fd, int write_fd, double timeout_s,
                       std::function<void()> while_waiting)
    : read_fd_(read_fd),
      write_fd_(write_fd),
      timeout_s_(timeout_s),
      while_waiting_(std::move(while_waiting)) {
  for (const int fd : {read_fd, write_fd}) {
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
  }
}

double StreamPipe::Deadline() const {
  return timeout_s_ > 0 ? NowS() + timeout_s_ : std::numeric_limits<double>::infinity();
}

/// True once the descriptor can be used; throws when it is too late.
bool StreamPipe::Wait(int fd, short events, double until_s) const {
  constexpr int kSlice_ms = 50;
  while (true) {
    // Also where bytes keep coming: one now and then does not buy more time.
    if (NowS() > until_s) {
      throw StreamError(Kind::kTimeout, fmt::format("no answer within {:g} s", timeout_s_));
    }
    pollfd watched{fd, events, 0};
    const int ready = ::poll(&watched, 1, kSlice_ms);
    if (while_waiting_) while_waiting_();
    if (ready > 0) return (watched.revents & (events | POLLHUP)) != 0;
    if (ready < 0 && errno != EINTR) return false;
  }
}

bool StreamPipe::HasUnread() const {
  pollfd watched{read_fd_, POLLIN, 0};
  return ::poll(&watched, 1, 0) > 0 && (watched.revents & POLLIN) != 0;
}

void StreamPipe::Send(StreamType type, const std::string& payload) {
  std::string bytes;
  Put(&bytes, static_cast<std::uint32_t>(payload.size()));
  Put(&bytes, static_cast<std::uint32_t>(type));
  bytes += payload;
  const double until_s = Deadline();
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = ::write(write_fd_, bytes.data() + sent, bytes.size() - sent);
    if (count > 0) {
      sent += static_cast<std::size_t>(count);
    } else if (errno != EAGAIN && errno != EINTR) {
      throw StreamError(Kind::kClosed, "the stream is closed");
    } else {
      Wait(write_fd_, POLLOUT, until_s);
    }
  }
}

/// How many bytes there were: fewer than `size` where the stream ends before them.
std::size_t StreamPipe::ReadAll(char* data, std::size_t size, double until_s) {
  std::size_t got = 0;
  while (got < size) {
    const ssize_t count = ::read(read_fd_, data + got, size - got);
    if (count > 0) {
      got += static_cast<std::size_t>(count);
    } else if (count == 0) {
      break;
    } else if (errno != EAGAIN && errno != EINTR) {
      throw StreamError(Kind::kClosed, "the stream is closed");
    } else {
      Wait(read_fd_, POLLIN, until_s);
    }
  }
  return got;
}

std::optional<StreamMessage> StreamPipe::Receive() {
  const double until_s = Deadline();
  std::array<std::uint32_t, 2> head;
  std::string text(sizeof head, '\0');
  text.resize(ReadAll(text.data(), sizeof head, until_s));
  if (text.empty()) return std::nullopt;
  if (text.size() < sizeof head) {
    if (IsText(text)) {
      Nonsense("it ended after the text '" + Printable(text) + "'" + kStdoutIsTaken);
    }
    throw StreamError(Kind::kClosed, kEndsWithin);
  }
  std::memcpy(head.data(), text.data(), sizeof head);
  const std::uint32_t last_type = static_cast<std::uint32_t>(StreamType::kMotion);
  if (head[1] < 1 || head[1] > last_type) {
    Nonsense(fmt::format(
        "a message of type {}, expected 1 to {}{}", head[1], last_type,
        IsText(text) ? ": it begins with the text '" + Printable(text) + "'" + kStdoutIsTaken
                     : ""));
  }
  if (head[0] > kLargestStreamMessage) {
    Nonsense(fmt::format("a message of {} bytes; at most {} are allowed", head[0],
                         kLargestStreamMessage));
  }
  StreamMessage message{static_cast<StreamType>(head[1]), std::string(head[0], '\0')};
  if (ReadAll(message.payload.data(), head[0], until_s) < head[0]) {
    throw StreamError(Kind::kClosed, kEndsWithin);
  }
  return message;
}

}  // namespace aisle
