#include "simulator/mesh/capture/bvh.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>

namespace aisle::sim {
namespace {

constexpr std::size_t kMostJoints = 1000, kMostFrames = 100'000;
constexpr double kFarthest = 1e6;  ///< of any number in the file
constexpr std::uintmax_t kMostBytes = 256u << 20;

/// The words of a text, one after the other.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  [[noreturn]] void Fail(const std::string& what) const {
    throw ImportError(fmt::format("line {}: {}", line_, what));
  }
  bool AtEnd() {
    Skip();
    return at_ >= text_.size();
  }
  std::string_view Next() {
    if (AtEnd()) Fail("the file ends too early");
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n", at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }
  void Expect(std::string_view word) {
    const std::string_view found = Next();
    if (found != word) Fail(fmt::format("expected {}, found '{}'", word, Short(found)));
  }
  double Number() {
    const std::string_view word = Next();
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    double number = 0;
    const auto [end, failed] = std::from_chars(begin, word.data() + word.size(), number);
    if (failed != std::errc() || end != word.data() + word.size() ||
        !(std::abs(number) <= kFarthest)) {
      Fail(fmt::format("expected a number within {:g}, found '{}'", kFarthest, Short(word)));
    }
    return number;
  }
  std::size_t Count(std::size_t most, const char* what) {
    const double number = Number();
    if (number < 0 || number != std::floor(number) || number > static_cast<double>(most)) {
      Fail(fmt::format("expected {} to {}, 0 to {}", "a number of", what, most));
    }
    return static_cast<std::size_t>(number);
  }
  /// The rest of the line: names may have spaces.
  std::string Line() {
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
    while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\t')) rest.remove_suffix(1);
    return std::string(rest.substr(0, 200));
  }
  static std::string Short(std::string_view word) {
    std::string text(word.substr(0, 40));
    for (char& c : text) c = std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
    return text;
  }

 private:
  void Skip() {
    for (; at_ < text_.size() && (std::isspace(static_cast<unsigned char>(text_[at_])) != 0);
         ++at_) {
      line_ += text_[at_] == '\n' ? 1 : 0;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

char ChannelOf(std::string_view name, const Words& words) {
  constexpr std::array<std::pair<std::string_view, char>, 6> kChannels = {{{"Xposition", 'x'},
                                                                           {"Yposition", 'y'},
                                                                           {"Zposition", 'z'},
                                                                           {"Xrotation", 'X'},
                                                                           {"Yrotation", 'Y'},
                                                                           {"Zrotation", 'Z'}}};
  for (const auto& [channel, letter] : kChannels) {
    if (name == channel) return letter;
  }
  words.Fail(fmt::format("there is no channel '{}'", Words::Short(name)));
}

void ReadChannels(Words* words, BvhJoint* joint, std::size_t* values) {
  const std::size_t count = words->Count(6, "channels");
  for (std::size_t i = 0; i < count; ++i) {
    joint->channels += ChannelOf(words->Next(), *words);
  }
  joint->first_value = *values;
  *values += count;
}

/// The braces of the root, without recursion: who opens what comes from outside.
void ReadHierarchy(Words* words, Bvh* bvh) {
  words->Expect("HIERARCHY");
  words->Expect("ROOT");
  std::vector<int> open;
  const auto add = [&](std::string name) {
    if (bvh->joints.size() >= kMostJoints) words->Fail("it has more than 1000 joints");
    BvhJoint joint;
    joint.name = std::move(name);
    joint.parent = open.empty() ? -1 : open.back();
    words->Expect("{");
    words->Expect("OFFSET");
    for (int i = 0; i < 3; ++i) joint.offset[i] = words->Number();
    open.push_back(static_cast<int>(bvh->joints.size()));
    bvh->joints.push_back(std::move(joint));
  };
  add(words->Line());
  while (!open.empty()) {
    const std::string_view word = words->Next();
    BvhJoint& joint = bvh->joints[static_cast<std::size_t>(open.back())];
    if (word == "CHANNELS") {
      if (!joint.channels.empty()) words->Fail("the joint has channels already");
      ReadChannels(words, &joint, &bvh->values);
    } else if (word == "JOINT") {
      add(words->Line());
    } else if (word == "End") {
      words->Expect("Site");
      add(joint.name + "/end");
    } else if (word == "}") {
      open.pop_back();
    } else {
      words->Fail(
          fmt::format("expected CHANNELS, JOINT, End Site or }}, found '{}'", Words::Short(word)));
    }
  }
}

void ReadMotion(Words* words, Bvh* bvh) {
  words->Expect("MOTION");
  words->Expect("Frames:");
  const std::size_t frames = words->Count(kMostFrames, "frames");
  if (frames < 2) words->Fail("a motion has two frames at least");
  words->Expect("Frame");
  words->Expect("Time:");
  bvh->frame_s = words->Number();
  if (!(bvh->frame_s >= 1e-4 && bvh->frame_s <= 10)) {
    words->Fail("a frame lasts 0.0001 to 10 s");
  }
  for (std::size_t i = 0; i < frames; ++i) {
    std::vector<double>& frame = bvh->frames.emplace_back();
    for (std::size_t k = 0; k < bvh->values; ++k) frame.push_back(words->Number());
  }
  if (!words->AtEnd()) words->Fail("numbers follow after the last frame");
}

Eigen::Isometry3d LocalOf(const BvhJoint& joint, const double* values) {
  Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
  local.translation() = joint.offset;
  for (std::size_t i = 0; i < joint.channels.size(); ++i) {
    const char channel = joint.channels[i];
    if (channel >= 'x') {
      local.translation()[channel - 'x'] = values[i];
    } else {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(channel - 'X');
      local.linear() =
          (local.linear() * Eigen::AngleAxisd(values[i] * std::numbers::pi / 180, axis)).eval();
    }
  }
  return local;
}

BvhPose Chained(const Bvh& bvh, const double* values) {
  BvhPose pose;
  for (const BvhJoint& joint : bvh.joints) {
    Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
    local.translation() = joint.offset;
    if (values != nullptr) local = LocalOf(joint, values + joint.first_value);
    const auto parent = static_cast<std::size_t>(joint.parent);
    pose.push_back(joint.parent < 0 ? local : pose[parent] * local);
  }
  return pose;
}

}  // namespace

Bvh ParseBvh(std::string_view text) {
  Words words(text);
  Bvh bvh;
  ReadHierarchy(&words, &bvh);
  ReadMotion(&words, &bvh);
  return bvh;
}

Bvh ReadBvh(const std::filesystem::path& file) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) {
    throw ImportError(fmt::format("{}: there is no such file", file.string()));
  }
  if (std::filesystem::file_size(file, failed) > kMostBytes) {
    throw ImportError(fmt::format("{}: it is larger than {} bytes", file.string(), kMostBytes));
  }
  std::ifstream stream(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  try {
    return ParseBvh(text);
  } catch (const ImportError& error) {
    throw ImportError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

BvhPose PoseOf(const Bvh& bvh, std::size_t frame) { return Chained(bvh, bvh.frames[frame].data()); }

BvhPose ZeroPose(const Bvh& bvh) { return Chained(bvh, nullptr); }

}  // namespace aisle::sim
