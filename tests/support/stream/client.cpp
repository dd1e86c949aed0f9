// A system behind aisle's stream that says it never moved: where your own begins. Without any
// library: g++ -std=c++17 -O2 client.cpp -o client
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

enum Type : std::uint32_t { kHello = 1, kFrame, kPose, kLost, kEnd, kTrack };
constexpr std::uint32_t kVersion = 1;
std::FILE* const kHarness = fdopen(dup(1), "wb");
struct Message {
  std::uint32_t type = 0;
  std::string payload;
};

Message Receive() {
  std::uint32_t head[2];  // length, type
  if (std::fread(head, sizeof head, 1, stdin) != 1) std::exit(1);
  Message message{head[1], std::string(head[0], '\0')};
  if (head[0] > 0 && std::fread(message.payload.data(), head[0], 1, stdin) != 1) std::exit(1);
  return message;
}

void Send(Type type, const std::string& payload) {
  const std::uint32_t head[2] = {static_cast<std::uint32_t>(payload.size()), type};
  std::fwrite(head, sizeof head, 1, kHarness);
  std::fwrite(payload.data(), payload.size(), 1, kHarness);
  std::fflush(kHarness);
}

template <class Value>
std::string Bytes(const Value& value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

int main() {
  dup2(2, 1);                       // prints go to stderr from here on: stdout is the stream's
  const Message hello = Receive();  // version, width, height, 0; fx, fy, cx, cy, baseline, rate
  if (hello.type != kHello || hello.payload.compare(0, 4, Bytes(kVersion)) != 0) return 1;
  Send(kHello, Bytes(kVersion) + "stands still");
  std::string track;
  for (Message frame = Receive(); frame.type != kEnd; frame = Receive()) {
    if (frame.type != kFrame) continue;  // the wheels' motion to it, say, which is not answered
    const std::string id = frame.payload.substr(0, 8), stamp_ns = frame.payload.substr(8, 8);
    // The images follow, left and then right, row by row: your SLAM. Lost is Send(kLost, id).
    const double pose[7] = {0, 0, 0, 0, 0, 0, 1};  // tx ty tz qx qy qz qw of the left camera
    Send(kPose, id + Bytes(pose));
    track += stamp_ns + Bytes(pose);
  }
  Send(kTrack, track);
}
