#include "harness/io/dataset.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "tests/fuzz/fuzz.h"

/// The calibration files of a recording: EuRoC's sensor.yaml for both cameras, KITTI's calib.txt.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  namespace fs = std::filesystem;
  const fs::path root = fuzz::AsFile("", "root").parent_path();
  const std::string bytes(fuzz::Text(data, size));
  const fs::path euroc = root / "euroc", kitti = root / "kitti";
  for (const char* camera : {"cam0", "cam1"}) {
    const fs::path folder = euroc / "mav0" / camera;
    fs::create_directories(folder / "data");
    std::ofstream(folder / "sensor.yaml", std::ios::binary) << bytes;
    std::ofstream(folder / "data.csv") << "#timestamp,filename\n1,1.png\n2,2.png\n";
    std::ofstream(folder / "data" / "1.png") << "";
    std::ofstream(folder / "data" / "2.png") << "";
  }
  for (const char* images : {"image_0", "image_1"}) {
    fs::create_directories(kitti / images);
    std::ofstream(kitti / images / "000000.png") << "";
  }
  std::ofstream(kitti / "times.txt") << "0\n";
  std::ofstream(kitti / "calib.txt", std::ios::binary) << bytes;
  for (const auto& [folder, format] :
       {std::pair(euroc, DatasetFormat::kEuroc), std::pair(kitti, DatasetFormat::kKitti)}) {
    try {
      const StereoRecording recording = ReadRecording(folder, format);
      fuzz::Hold(
          std::isfinite(recording.cameras.left.fx) && std::isfinite(recording.cameras.right.fx),
          "a focal length that is read is finite");
      ++fuzz::taken;
    } catch (const InputError&) {
    }
  }
  return 0;
}
