#include "harness/io/frame_store.h"

#include "harness/io/byte_stream.h"
#include "harness/io/file.h"
#include "harness/io/hash.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMagic = 0x4D465341;  // "ASFM"
constexpr std::uint32_t kVersion = 4;
constexpr const char* kFrameEnding = ".frame";

// --- Envelope: magic, version, checksum, payload -------------------------------------------------

void WriteChecked(const fs::path& path, const std::string& payload) {
  ByteWriter writer;
  writer.Put(kMagic);
  writer.Put(kVersion);
  writer.Put(Hash(payload));
  WriteFileAtomically(path, writer.bytes() + payload, Durability::kSurvivesProcessLoss);
}

/// The payload, or nothing where the file is absent, damaged or of another version.
std::optional<std::string> ReadChecked(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  try {
    std::string bytes = ReadFile(path);
    ByteReader reader(bytes);
    const bool ours = reader.Get<std::uint32_t>() == kMagic;
    const bool known = reader.Get<std::uint32_t>() == kVersion;
    const auto checksum = reader.Get<std::uint64_t>();
    bytes.erase(0, 2 * sizeof(std::uint32_t) + sizeof(std::uint64_t));
    if (ours && known && checksum == Hash(bytes)) return bytes;
  } catch (const std::exception&) {  // unreadable or deleted under our hands: absent all the same
  }
  return std::nullopt;
}

// --- Payloads ------------------------------------------------------------------------------------

void PutPose(const Eigen::Isometry3d& pose, ByteWriter* writer) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) writer->Put(pose.matrix()(row, column));
  }
}

Eigen::Isometry3d GetPose(ByteReader* reader) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) pose.matrix()(row, column) = reader->Get<double>();
  }
  return pose;
}

void PutVector(const Eigen::Vector3d& v, ByteWriter* writer) {
  for (int i = 0; i < 3; ++i) writer->Put(v[i]);
}

Eigen::Vector3d GetVector(ByteReader* reader) {
  Eigen::Vector3d v;
  for (int i = 0; i < 3; ++i) v[i] = reader->Get<double>();
  return v;
}

void PutObject(const ObjectTruth& object, ByteWriter* writer) {
  writer->Put(object.instance);
  writer->PutText(object.object_class);
  writer->Put(object.box_visible);
  writer->Put(object.box_full);
  PutVector(object.center_m, writer);
  PutVector(object.extent_m, writer);
  PutPose(object.T_world_object, writer);
  PutVector(object.velocity_mps, writer);
  writer->Put(object.visible_fraction);
  writer->Put(object.visible_pixels);
  writer->Put(object.dynamic_pixels);
}

ObjectTruth GetObject(ByteReader* reader) {
  ObjectTruth object;
  object.instance = reader->Get<int>();
  object.object_class = reader->GetText();
  object.box_visible = reader->Get<cv::Rect2d>();
  object.box_full = reader->Get<cv::Rect2d>();
  object.center_m = GetVector(reader);
  object.extent_m = GetVector(reader);
  object.T_world_object = GetPose(reader);
  object.velocity_mps = GetVector(reader);
  object.visible_fraction = reader->Get<double>();
  object.visible_pixels = reader->Get<int>();
  object.dynamic_pixels = reader->Get<int>();
  return object;
}

void PutTruth(const FrameTruth& truth, ByteWriter* writer) {
  PutPose(truth.T_world_rig, writer);
  writer->Put(truth.smear_ms);
  writer->PutRuns(truth.instance);
  writer->PutRuns(truth.depth_grid);
  for (const cv::Mat1b& mask :
       {truth.dynamic, truth.dynamic_right, truth.actor, truth.actor_right}) {
    writer->PutRuns(mask);
  }
  writer->Put(static_cast<std::uint32_t>(truth.objects.size()));
  for (const ObjectTruth& object : truth.objects) PutObject(object, writer);
}

FrameTruth GetTruth(ByteReader* reader) {
  FrameTruth truth;
  truth.T_world_rig = GetPose(reader);
  truth.smear_ms = reader->Get<double>();
  truth.instance = reader->GetRuns<std::uint16_t>();
  truth.depth_grid = reader->GetRuns<float>();
  for (cv::Mat1b* mask : {&truth.dynamic, &truth.dynamic_right, &truth.actor, &truth.actor_right}) {
    *mask = reader->GetRuns<unsigned char>();
  }
  truth.objects.resize(reader->Get<std::uint32_t>());
  for (ObjectTruth& object : truth.objects) object = GetObject(reader);
  return truth;
}

/// Of all files below that are there; others may be taking them away.
std::uintmax_t BytesBelow(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    std::error_code gone;
    if (at->is_regular_file(gone)) bytes += at->file_size(gone);
  }
  return bytes;
}

struct StoredSequence {
  fs::path folder;
  fs::file_time_type used;
  std::uintmax_t bytes = 0;
};

std::vector<StoredSequence> StoredSequences(const fs::path& root) {
  std::vector<StoredSequence> sequences;
  std::error_code error;
  for (fs::directory_iterator at(root, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;
    if (!at->is_directory(gone)) continue;
    sequences.push_back(
        {at->path(), fs::last_write_time(at->path(), gone), BytesBelow(at->path())});
  }
  return sequences;
}

}  // namespace

fs::path FrameStore::FramePath(std::int64_t frame_id) const {
  return folder_ / fmt::format("{:06}{}", frame_id, kFrameEnding);
}

std::int64_t FrameStore::Count() const {
  std::int64_t count = 0;
  std::error_code error;  // nothing is there yet
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    count += entry.path().extension() == kFrameEnding ? 1 : 0;
  }
  return count;
}

std::optional<SequenceHeader> FrameStore::ReadHeader() const {
  const std::optional<std::string> payload = ReadChecked(folder_ / "header");
  if (!payload) return std::nullopt;
  std::error_code error;
  fs::last_write_time(folder_, fs::file_time_type::clock::now(), error);  // used: not to be deleted
  ByteReader reader(*payload);
  SequenceHeader header;
  header.name = reader.GetText();
  header.calibration = reader.Get<StereoCalibration>();
  header.rate_hz = reader.Get<double>();
  header.content_hash = reader.Get<std::uint64_t>();
  header.schedule.resize(reader.Get<std::uint32_t>());
  for (FrameRequest& request : header.schedule) {
    request.id = reader.Get<std::int64_t>();
    request.stamp_ns = reader.Get<std::int64_t>();
    request.T_world_rig = GetPose(&reader);
  }
  return header;
}

void FrameStore::WriteHeader(const SequenceHeader& header) const {
  ByteWriter writer;
  writer.PutText(header.name);
  writer.Put(header.calibration);
  writer.Put(header.rate_hz);
  writer.Put(header.content_hash);
  writer.Put(static_cast<std::uint32_t>(header.schedule.size()));
  for (const FrameRequest& request : header.schedule) {
    writer.Put(request.id);
    writer.Put(request.stamp_ns);
    PutPose(request.T_world_rig, &writer);
  }
  WriteChecked(folder_ / "header", writer.bytes());
}

std::optional<SequenceFrame> FrameStore::Read(std::int64_t frame_id) const {
  const std::optional<std::string> payload = ReadChecked(FramePath(frame_id));
  if (!payload) return std::nullopt;
  ByteReader reader(*payload);
  SequenceFrame frame;
  frame.images.id = reader.Get<std::int64_t>();
  frame.images.stamp_ns = reader.Get<std::int64_t>();
  frame.images.left = reader.GetRaw();
  frame.images.right = reader.GetRaw();
  if (reader.Get<char>() != 0) frame.truth = GetTruth(&reader);
  return frame;
}

void FrameStore::Write(const SequenceFrame& frame) const {
  ByteWriter writer;
  writer.Put(frame.images.id);
  writer.Put(frame.images.stamp_ns);
  writer.PutRaw(frame.images.left);
  writer.PutRaw(frame.images.right);
  writer.Put(static_cast<char>(frame.truth.has_value()));
  if (frame.truth) PutTruth(*frame.truth, &writer);
  WriteChecked(FramePath(frame.images.id), writer.bytes());
}

void ShrinkStore(const fs::path& root, std::uintmax_t max_bytes, std::chrono::hours grace) {
  const fs::file_time_type now = fs::file_time_type::clock::now();
  std::vector<StoredSequence> sequences = StoredSequences(root);
  std::sort(sequences.begin(), sequences.end(),
            [](const StoredSequence& a, const StoredSequence& b) { return a.used < b.used; });
  std::uintmax_t total = 0;
  for (const StoredSequence& sequence : sequences) total += sequence.bytes;
  for (const StoredSequence& sequence : sequences) {
    if (total <= max_bytes || (grace.count() > 0 && now - sequence.used < grace)) return;
    std::error_code error;
    fs::remove_all(sequence.folder, error);  // another process may be at it: no matter
    total -= sequence.bytes;
  }
}

}  // namespace aisle
