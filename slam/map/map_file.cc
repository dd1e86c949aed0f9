#include "slam/map/map_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "slam/common/checksum.h"
#include "slam/common/write_aside.h"

namespace aisle::slam {
namespace {

static_assert(std::endian::native == std::endian::little, "map files are little-endian");

constexpr char kMagic[8] = {'a', 'i', 's', 'l', 'e', 'm', 'a', 'p'};
constexpr std::uint32_t kVersion = 4;
constexpr std::uint32_t kWithoutLoops = 3;  // the same, but for closed loops: read as having none

struct Header {
  char magic[8];
  std::uint32_t version, unused;
  std::uint64_t size, checksum;  // of the bytes that follow
};

class Writer {
 public:
  template <typename T>
  requires std::is_arithmetic_v<T>
  void Value(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
  }
  void Count(const auto& list) { Value(static_cast<std::uint64_t>(list.size())); }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}

  template <typename T>
  requires std::is_arithmetic_v<T>
  void Value(T& value) {
    if (bytes_.size() - at_ < sizeof(value)) throw std::invalid_argument("a list ends too early");
    std::memcpy(&value, bytes_.data() + at_, sizeof(value));
    at_ += sizeof(value);
  }
  void Count(auto& list) {
    std::uint64_t count = 0;
    Value(count);
    // Nothing that is counted takes less than four bytes.
    if (count > (bytes_.size() - at_) / 4) throw std::invalid_argument("a list is too long");
    list.resize(static_cast<std::size_t>(count));
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// One description of the format serves both directions: `file` is a Writer or a Reader, and what is
// carried is const or not.

void CarryAll(auto& file, auto&& list, const auto& carry_one) {
  file.Count(list);
  for (auto& one : list) carry_one(file, one);
}

constexpr auto kValue = [](auto& file, auto& value) { file.Value(value); };
constexpr auto kKeyframeId = [](auto& file, auto& id) { file.Value(id.value); };
constexpr auto kLandmarkId = [](auto& file, auto& id) {
  file.Value(id.slot);
  file.Value(id.generation);
};
constexpr auto kVector = [](auto& file, auto& vector) {
  for (int i = 0; i < 3; ++i) file.Value(vector[i]);
};
constexpr auto kPose = [](auto& file, auto& pose) {
  for (int i = 0; i < 12; ++i) file.Value(pose.matrix()(i / 4, i % 4));
};
constexpr auto kDescriptor = [](auto& file, auto& descriptor) {
  for (auto& word : descriptor) file.Value(word);
};
constexpr auto kKeypoint = [](auto& file, auto& keypoint) {
  file.Value(keypoint.pixel.x);
  file.Value(keypoint.pixel.y);
  file.Value(keypoint.level);
  file.Value(keypoint.angle_deg);
  file.Value(keypoint.response);
};
constexpr auto kMeasurement = [](auto& file, auto& measurement) {
  kVector(file, measurement.uvd);
  file.Value(measurement.sigma_px);
  file.Value(measurement.sigma_d);
  file.Value(measurement.u_in_d);
};
constexpr auto kPatch = [](auto& file, auto& patch) {
  for (auto& grey : patch.grey) file.Value(grey);
};
constexpr auto kObservation = [](auto& file, auto& observation) {
  kKeyframeId(file, observation.keyframe);
  file.Value(observation.feature);
};

constexpr auto kFrame = [](auto& file, auto& frame) {
  file.Value(frame.id);
  file.Value(frame.stamp_ns);
  file.Value(frame.scale);
  CarryAll(file, frame.features.keypoints, kKeypoint);
  CarryAll(file, frame.features.descriptors, kDescriptor);
  CarryAll(file, frame.measurements, kMeasurement);
  CarryAll(file, frame.patches, kPatch);
};

constexpr auto kKeyframe = [](auto& file, auto& keyframe) {
  kKeyframeId(file, keyframe.id);
  kKeyframeId(file, keyframe.parent);
  kPose(file, keyframe.T_world_rig);
  CarryAll(file, keyframe.landmarks, kLandmarkId);
  if constexpr (std::is_same_v<std::remove_reference_t<decltype(file)>, Reader>) {
    const auto frame = std::make_shared<Frame>();
    kFrame(file, *frame);
    keyframe.frame = frame;
  } else {
    kFrame(file, *keyframe.frame);
  }
};

constexpr auto kLandmark = [](auto& file, auto& landmark) {
  kLandmarkId(file, landmark.id);
  kVector(file, landmark.position);
  CarryAll(file, landmark.observations, kObservation);
  kKeyframeId(file, landmark.created_by);
  file.Value(landmark.predicted);
  file.Value(landmark.found);
  kDescriptor(file, landmark.descriptor);
  kVector(file, landmark.normal);
  file.Value(landmark.reference_distance_m);
  file.Value(landmark.reference_level);
};

constexpr auto kRetired = [](auto& file, auto& retired) {
  kKeyframeId(file, retired.id);
  kKeyframeId(file, retired.heir);
  kPose(file, retired.T_heir_rig);
};

constexpr auto kCamera = [](auto& file, auto& camera) {
  file.Value(camera.width);
  file.Value(camera.height);
  for (auto* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy, &camera.baseline_m}) {
    file.Value(*value);
  }
};

constexpr auto kContents = [](auto& file, auto& contents) {
  CarryAll(file, contents.keyframes, kKeyframe);
  CarryAll(file, contents.landmarks, kLandmark);
  CarryAll(file, contents.generations, kValue);
  CarryAll(file, contents.vacant, kValue);
  CarryAll(file, contents.retired, kRetired);
  file.Value(contents.next_keyframe);
};

constexpr auto kClosedLoop = [](auto& file, auto& loop) {
  kKeyframeId(file, loop.current);
  kKeyframeId(file, loop.matched);
};

void Demand(bool holds, const char* rule) {
  if (!holds) throw std::invalid_argument(rule);
}

bool IsPose(const Eigen::Isometry3d& pose) {
  constexpr double kRounding = 1e-3;  // of many motions, one after the other
  return pose.matrix().allFinite() &&
         (pose.linear() * pose.linear().transpose()).isIdentity(kRounding) &&
         pose.linear().determinant() > 0;
}

bool IsLevel(int level) {
  constexpr int kMostLevels = 32;
  return level >= 0 && level < kMostLevels;
}

/// The checksum tells accidents; these, what somebody has written on purpose or by another program.
void CheckFrame(const Frame& frame, const StereoCamera& camera) {
  Demand(std::isfinite(frame.scale) && frame.scale > 1, "a scale between levels is not above 1");
  const std::size_t count = frame.features.keypoints.size();
  Demand(frame.features.descriptors.size() == count && frame.measurements.size() == count &&
             (frame.patches.empty() || frame.patches.size() == count),
         "a keyframe's lists differ in length");
  for (const Keypoint& keypoint : frame.features.keypoints) {
    Demand(std::abs(keypoint.pixel.x) <= 2 * static_cast<float>(camera.width) &&
               std::abs(keypoint.pixel.y) <= 2 * static_cast<float>(camera.height),
           "a feature lies far outside the image");
    Demand(IsLevel(keypoint.level), "a feature is of a level that does not exist");
    Demand(std::isfinite(keypoint.angle_deg) && std::isfinite(keypoint.response),
           "a feature is not finite");
  }
  for (const Measurement& measurement : frame.measurements) {
    Demand(measurement.uvd.allFinite() && std::isfinite(measurement.u_in_d) &&
               std::isfinite(measurement.sigma_px) && measurement.sigma_px > 0 &&
               std::isfinite(measurement.sigma_d) && measurement.sigma_d >= 0,
           "a measurement is not finite");
  }
}

void CheckNumbers(const MapContents& contents, const StereoCamera& camera) {
  for (const Keyframe& keyframe : contents.keyframes) {
    Demand(IsPose(keyframe.T_world_rig), "a keyframe's pose is none");
    CheckFrame(*keyframe.frame, camera);
  }
  for (const RetiredKeyframe& one : contents.retired) {
    Demand(IsPose(one.T_heir_rig), "a keyframe's pose is none");
  }
  for (const Landmark& landmark : contents.landmarks) {
    Demand(landmark.position.allFinite() && landmark.normal.allFinite() &&
               std::isfinite(landmark.reference_distance_m),
           "a landmark is not finite");
    Demand(landmark.predicted >= 0 && landmark.found >= 0, "a landmark was seen less than never");
    Demand(IsLevel(landmark.reference_level), "a landmark is of a level that does not exist");
  }
}

/// What is not in the file but follows from it.
void RebuildFrame(Keyframe& keyframe, const StereoCamera& camera) {
  auto frame = std::make_shared<Frame>(*keyframe.frame);
  frame->grid = FeatureGrid(frame->features.keypoints, {camera.width, camera.height});
  keyframe.frame = frame;
}

SavedMap Decode(Reader file, std::uint32_t version) {
  SavedMap saved;
  MapContents contents;
  kCamera(file, saved.camera);
  if (const std::string error = Validate(saved.camera); !error.empty()) {
    throw std::invalid_argument(error);
  }
  constexpr int kLargestSide = 16384;
  Demand(saved.camera.width <= kLargestSide && saved.camera.height <= kLargestSide,
         "its camera has too many pixels");
  kKeyframeId(file, saved.reference);
  kContents(file, contents);
  if (version != kWithoutLoops) CarryAll(file, contents.closed_loops, kClosedLoop);
  if (!file.at_end()) throw std::invalid_argument("something follows its end");
  CheckNumbers(contents, saved.camera);
  for (Keyframe& keyframe : contents.keyframes) RebuildFrame(keyframe, saved.camera);
  saved.map = Map(contents);
  if (!saved.map.Find(saved.reference)) throw std::invalid_argument("it has no reference keyframe");
  return saved;
}

}  // namespace

void SaveMap(const SavedMap& saved, const std::filesystem::path& file) {
  Writer body;
  kCamera(body, saved.camera);
  kKeyframeId(body, saved.reference);
  const MapContents contents = saved.map.Contents();
  kContents(body, contents);
  CarryAll(body, contents.closed_loops, kClosedLoop);
  Header header{{}, kVersion, 0, body.bytes().size(), ChecksumOfWords(body.bytes())};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  WriteAside(file, {{reinterpret_cast<const char*>(&header), sizeof(header)}, body.bytes()});
}

SavedMap LoadMap(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) -> std::runtime_error {
    return std::runtime_error(fmt::format("{}: {}", file.string(), what));
  };
  std::error_code error;
  const std::uintmax_t whole = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (error || !in) throw fail("cannot open it");
  Header header{};
  in.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!in || std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) {
    throw fail("not a map; save one with `aisle slam --save-map`");
  }
  if (header.version != kVersion && header.version != kWithoutLoops) {
    throw fail(fmt::format("has version {}, but this program reads version {}; map the place again",
                           header.version, kVersion));
  }
  if (header.size != whole - sizeof(header))
    throw fail("damaged: its length differs from the one it states");
  std::string bytes(static_cast<std::size_t>(header.size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw fail("not readable");
  if (ChecksumOfWords(bytes) != header.checksum) throw fail("damaged: checksum");
  try {
    return Decode(Reader(std::move(bytes)), header.version);
  } catch (const std::invalid_argument& broken) {
    throw fail(fmt::format("damaged: {}", broken.what()));
  }
}

}  // namespace aisle::slam
