#include "harness/campaign/guest_dataset.h"

#include <set>

#include "harness/campaign/progress.h"
#include "harness/io/file.h"
#include "harness/io/file_lock.h"
#include "harness/io/hash.h"
#include "harness/io/input_error.h"
#include "harness/io/vslam_lab.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Written last, with the checksum of all others: a dataset without it is not whole.
constexpr const char* kDoneMark = "complete";

/// Names of all files below, but for the mark, in order.
std::set<fs::path> FilesOf(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path name = entry.path().lexically_relative(folder);
    const fs::file_status status = entry.symlink_status();
    if (fs::is_directory(status) || name == kDoneMark) continue;
    if (!fs::is_regular_file(status)) throw InputError(entry.path().string(), 0, "is not ours");
    files.insert(name);
  }
  return files;
}

/// Checksum of all files; each is handed to `see` as well.
std::string ChecksumOf(const fs::path& folder,
                       const std::function<void(const fs::path&, const std::string&)>& see = {}) {
  std::uint64_t checksum = 0;
  for (const fs::path& name : FilesOf(folder)) {
    const std::string bytes = ReadFile(folder / name);
    checksum = Hash(bytes, Hash(name.string(), checksum));
    if (see) see(name, bytes);
  }
  return fmt::format("{:016x}\n", checksum);
}

void Export(const Sequence& sequence, const GuestDataset& dataset) {
  RemoveFolder(dataset.kept);
  const std::vector<FrameRequest> schedule = sequence.Schedule();
  const ExportOptions& options = dataset.options;
  DatasetWriter writer(dataset.kept, sequence.calibration(), sequence.rate_hz(), schedule, options);
  for (std::size_t i = 0; i < schedule.size(); ++i) {
    writer.Add(sequence.At(schedule[i]));
    TellProgress(i + 1, 2 * schedule.size());
  }
  const PathOfRig path = dataset.open_path();
  writer.Finish(path);
  if (options.format == DatasetFormat::kEuroc) {
    WriteVslamLabFiles(dataset.kept, sequence.calibration(), sequence.rate_hz(), schedule, path,
                       options);
  }
  WriteFileAtomically(dataset.kept / kDoneMark, ChecksumOf(dataset.kept));
}

/// Copies the dataset; false where it is not there whole or not as it was exported.
bool Copy(const fs::path& kept, const fs::path& into) {
  std::error_code error;
  if (!fs::exists(kept / kDoneMark, error)) return false;
  fs::last_write_time(kept, fs::file_time_type::clock::now(), error);  // in use
  RemoveFolder(into);
  try {
    const std::string checksum =
        ChecksumOf(kept, [&](const fs::path& name, const std::string& bytes) {
          WriteFileAtomically(into / name, bytes, Durability::kSurvivesProcessLoss);
        });
    return checksum == ReadFile(kept / kDoneMark);
  } catch (const InputError&) {  // made unreadable, or taken away under our hands
    return false;
  } catch (const fs::filesystem_error&) {
    return false;
  }
}

}  // namespace

void LayOutDataset(const Sequence& sequence, const GuestDataset& dataset, const fs::path& into) {
  const FileLock lock(dataset.kept.string() + ".lock");
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (Copy(dataset.kept, into)) return;
    Export(sequence, dataset);
  }
  throw MachineError(dataset.kept.string() +
                     ": changed while it was copied: does another program write to the cache?");
}

}  // namespace aisle
