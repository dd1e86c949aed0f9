#include "harness/io/stream_protocol.h"
#include "tests/fuzz/fuzz.h"

/// The first byte is the message's type, the rest its payload.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  if (size == 0) return 0;
  const std::string payload(reinterpret_cast<const char*>(data) + 1, size - 1);
  const StereoCalibration rig{
      .width = 8, .height = 4, .fx = 9, .fy = 9, .cx = 4, .cy = 2, .baseline_m = 0.1};
  try {
    std::int64_t id = 0;
    switch (data[0] % 7) {
      case 0:
        ReadHello(payload);
        break;
      case 1:
        ReadName(payload);
        break;
      case 2:
        ReadFrame(payload, rig);
        break;
      case 3:
        ReadAnswer({StreamType::kPose, payload}, 0);
        break;
      case 4:
        ReadAnswer({StreamType::kLost, payload}, 0);
        break;
      case 5:
        ReadTrack(payload);
        break;
      default:
        ReadMotion(payload, &id);
    }
    ++fuzz::taken;
  } catch (const StreamError&) {
  }
  return 0;
}
