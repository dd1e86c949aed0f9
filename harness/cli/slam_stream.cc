#include "harness/cli/slam_stream.h"

#include <unistd.h>

#include "harness/contract/map_id.h"
#include "harness/io/input_error.h"
#include "harness/io/stream_protocol.h"

namespace aisle {
namespace {

using Kind = StreamError::Kind;

/// The stream as long as there is one: the next message is the frame's or the end's.
std::size_t Answer(StreamPipe* pipe, const std::string& name, const MakeEstimatorFor& make,
                   const FinishEstimator& finish) {
  const auto next = [&] {
    std::optional<StreamMessage> message = pipe->Receive();
    if (!message) throw StreamError(Kind::kClosed, "the stream ended without an end message");
    return *std::move(message);
  };
  const StreamMessage greeting = next();
  if (greeting.type != StreamType::kHello) {
    throw StreamError(Kind::kNonsense, "expected a hello message first");
  }
  const StreamHello hello = ReadHello(greeting.payload);
  const std::unique_ptr<Estimator> estimator = make(hello.calibration);
  pipe->Send(StreamType::kHello, FormatName(kStreamVersion, name));
  std::optional<std::int64_t> last_ns;
  for (std::size_t frames = 0;; ++frames) {
    StreamMessage message = next();
    std::int64_t moved_to = 0;  // the frame that the wheels' message is about
    std::optional<MotionMeasurement> motion;
    if (message.type == StreamType::kMotion) {
      motion = ReadMotion(message.payload, &moved_to);
      message = next();
    }
    if (message.type == StreamType::kEnd) {
      pipe->Send(StreamType::kTrack, FormatTrack(estimator->Finish()));
      finish(estimator.get());
      return frames;
    }
    if (message.type != StreamType::kFrame) {
      throw StreamError(Kind::kNonsense, "expected a frame or the end");
    }
    StereoFrame frame = ReadFrame(message.payload, hello.calibration);
    if (motion && moved_to != frame.id) {
      throw StreamError(Kind::kNonsense, fmt::format("motion to frame {} arrived before frame {}",
                                                     moved_to, frame.id));
    }
    frame.motion = motion;
    if (last_ns && frame.stamp_ns <= *last_ns) {
      throw StreamError(
          Kind::kNonsense,
          fmt::format("frame {}: its timestamp is not later than the previous one", frame.id));
    }
    last_ns = frame.stamp_ns;
    const FrameEstimate said = estimator->Process(frame, {});
    pipe->Send(said.T_world_rig ? StreamType::kPose : StreamType::kLost,
               FormatAnswer(frame.id, said.T_world_rig, MapIdOf(said)));
  }
}

}  // namespace

std::size_t AnswerStream(const std::string& name, const MakeEstimatorFor& make,
                         const FinishEstimator& finish) {
  const int talk = ::dup(STDOUT_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  StreamPipe pipe(STDIN_FILENO, talk);
  try {
    const std::size_t frames = Answer(&pipe, name, make, finish);
    ::close(talk);
    return frames;
  } catch (const StreamError& error) {
    ::close(talk);
    throw InputError(fmt::format(
        "stdin: {}; --stream expects a harness, see reports/docs/stream.md", error.what()));
  }
}

}  // namespace aisle
