#include "simulator/mesh/kept/kept_model.h"

#include <xxhash.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "simulator/mesh/door/model_bytes.h"
#include "simulator/mesh/door/read_model.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kRecordVersion = 1;
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30;

fs::path RecordOf(const fs::path& file) { return file.string() + ".json"; }

std::string HashOf(std::string_view bytes) {
  return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

std::string BytesOf(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) {
    throw ImportError(fmt::format("{}: there is no such file", file.string()));
  }
  if (fs::file_size(file, failed) > kMostBytes) {
    throw ImportError(fmt::format("{}: it is larger than {} bytes", file.string(), kMostBytes));
  }
  std::ifstream stream(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  if (!stream) throw ImportError(fmt::format("{}: it cannot be read", file.string()));
  return bytes;
}

/// A file that is written aside and goes again unless it is put in its place.
class Aside {
 public:
  Aside(const fs::path& file, std::string_view bytes)
      : file_(file), part_(file.string() + ".part") {
    std::ofstream stream(part_, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    std::error_code unknown;
    if (stream && !fs::is_directory(file_, unknown)) return;
    Remove();
    Fail();
  }
  ~Aside() { Remove(); }
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

  void Place() {
    std::error_code failed;
    fs::rename(part_, file_, failed);
    if (failed) Fail();
  }

 private:
  void Remove() const {
    std::error_code gone;
    if (!fs::is_directory(part_, gone)) fs::remove(part_, gone);
  }
  [[noreturn]] void Fail() const {
    throw ImportError(fmt::format("{}: it cannot be written", file_.string()));
  }

  fs::path file_, part_;
};

Json JsonOf(const ModelRecord& record) {
  return {{"aisle_mesh_record", kRecordVersion},
          {"source", record.source},
          {"source_hash", record.source_hash},
          {"licence", record.licence},
          {"hash", record.hash},
          {"unit_m", record.unit_m},
          {"up", record.up},
          {"bounds_m", {record.low_m, record.high_m}},
          {"triangles", record.triangles},
          {"left_out", record.left_out}};
}

ModelRecord RecordIn(const Json& json) {
  ModelRecord record;
  if (json.at("aisle_mesh_record").get<int>() != kRecordVersion) {
    throw ImportError("it is of another version; import the mesh again");
  }
  record.source = json.at("source");
  record.source_hash = json.at("source_hash");
  record.licence = json.at("licence");
  record.hash = json.at("hash");
  record.unit_m = json.at("unit_m");
  record.up = json.at("up");
  record.low_m = json.at("bounds_m").at(0);
  record.high_m = json.at("bounds_m").at(1);
  record.triangles = json.at("triangles");
  record.left_out = json.at("left_out");
  return record;
}

ModelRecord RecordFor(const fs::path& file, const std::string& bytes) {
  const fs::path beside = RecordOf(file);
  std::error_code failed;
  if (!fs::is_regular_file(beside, failed)) {
    throw ImportError(
        fmt::format("{}: its record {} is missing, which says where it comes from and under which "
                    "licence; import the mesh again, or copy both files",
                    file.string(), beside.filename().string()));
  }
  ModelRecord record;
  try {
    record = RecordIn(Json::parse(BytesOf(beside)));
  } catch (const std::exception& error) {
    throw ImportError(fmt::format("{}: {}", beside.string(), error.what()));
  }
  if (record.hash != HashOf(bytes)) {
    throw ImportError(
        fmt::format("{}: its bytes are not those its record speaks of (hash {}, there {}); import "
                    "the mesh again",
                    file.string(), HashOf(bytes), record.hash));
  }
  return record;
}

bool IsKept(const fs::path& file) { return file.extension() == kKeptExtension; }

void RequireKnown(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (IsKept(file) || extension == ".glb" || extension == ".gltf") return;
  throw ImportError(
      fmt::format("{}: import it first, since its format does not always say its unit and which "
                  "way is up: aisle import-mesh {}",
                  file.string(), file.filename().string()));
}

}  // namespace

std::string HashOfModelFile(const fs::path& file) { return HashOf(BytesOf(file)); }

ModelRecord KeepModel(const Model& model, ModelRecord record, const fs::path& file) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& position : model.mesh.positions) box.extend(position);
  for (int i = 0; i < 3; ++i) {
    record.low_m[static_cast<std::size_t>(i)] = box.min()[i];
    record.high_m[static_cast<std::size_t>(i)] = box.max()[i];
  }
  record.triangles = model.mesh.triangles.size();
  record.left_out = model.left_out;
  const std::string bytes = EncodeModel(model);
  record.hash = HashOf(bytes);
  Aside mesh(file, bytes), beside(RecordOf(file), JsonOf(record).dump(2) + "\n");
  mesh.Place();
  beside.Place();
  return record;
}

ModelRecord ReadModelRecord(const fs::path& file) { return RecordFor(file, BytesOf(file)); }

Model OpenUserModel(const fs::path& file, const ImportOptions& options) {
  RequireKnown(file);
  if (!IsKept(file)) {
    ImportOptions alone = options;
    alone.one_file = true;  // a scene's essence has the bytes of this file, not of others
    return ReadModel(file, alone);
  }
  const std::string bytes = BytesOf(file);
  RecordFor(file, bytes);
  try {
    return DecodeModel(bytes, options);
  } catch (const ImportError& error) {
    throw ImportError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

void CheckUserModel(const fs::path& file) {
  RequireKnown(file);
  if (IsKept(file)) {
    ReadModelRecord(file);
  } else {
    HashOfModelFile(file);
  }
}

}  // namespace aisle::sim
