#include "harness/bench/realism.h"

#include <array>
#include <cmath>
#include <limits>

#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/picture/realism.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// The real sets of a folder laid out as tests have it, by where their left pictures are.
constexpr std::array<std::pair<const char*, const char*>, 3> kRealSets = {
    std::pair{"EuRoC still", "euroc-v101-still"}, std::pair{"EuRoC hall", "euroc-loop-pairs"},
    std::pair{"KITTI 06", "kitti/sequences/06"}};

std::vector<fs::path> PngsOf(const fs::path& folder) {
  std::vector<fs::path> files, left;
  if (!fs::is_directory(folder)) return {};
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".png") continue;
    files.push_back(entry.path());
    if (entry.path().filename().string().starts_with("left")) left.push_back(entry.path());
  }
  if (!left.empty()) files = std::move(left);  // of both cameras in one folder, the left ones
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<fs::path> FindPictures(const fs::path& folder) {
  for (const char* inside :
       {"", "mav0/cam0/data", "cam0/data", "image_0", "sequences/00/image_0", "rgb"}) {
    std::vector<fs::path> files = PngsOf(folder / inside);
    if (!files.empty()) return files;
  }
  throw InputError(Printable(folder.string()) +
                   ": no PNG pictures there, nor in mav0/cam0/data, image_0, "
                   "sequences/00/image_0 or rgb");
}

PictureSet MeasurePictures(const std::string& name, const fs::path& folder, int most,
                           const BenchProgress& progress) {
  const std::vector<fs::path> files = FindPictures(folder);
  const std::size_t count = std::min(files.size(), static_cast<std::size_t>(most));
  std::vector<std::vector<double>> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    if (progress) progress(fmt::format("{}: picture {} of {}", name, i + 1, count));
    const std::size_t at = i * files.size() / count;
    const cv::Mat1b image = ReadGreyPng(files[at]);
    const cv::Mat1b next = at + 1 < files.size() ? ReadGreyPng(files[at + 1]) : cv::Mat1b();
    pictures.push_back(DescribePicture(image, next));
  }
  return {name, count, MedianOfEach(pictures)};
}

std::vector<PictureSet> MeasureRealPictures(const fs::path& data, int most,
                                            const BenchProgress& progress) {
  std::vector<PictureSet> sets;
  for (const auto& [name, folder] : kRealSets) {
    const fs::path at = data / folder;
    if (fs::is_directory(at)) sets.push_back(MeasurePictures(name, at, most, progress));
  }
  return sets;
}

WithinReal CountWithin(const std::vector<PictureSet>& real, const std::vector<PictureSet>& given,
                       std::size_t statistic) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PictureSet& set : real) {
    low = std::fmin(low, set.values[statistic]);
    high = std::fmax(high, set.values[statistic]);
  }
  WithinReal count;
  for (const PictureSet& set : given) {
    const double value = set.values[statistic];
    if (std::isnan(value)) continue;
    ++count.known;
    count.within += value >= low && value <= high;
  }
  return count;
}

}  // namespace aisle
