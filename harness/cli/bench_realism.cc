#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "harness/cli/command.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/picture/realism.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> folders;
  std::string data, json;
  int pictures = 24;
};

/// One column of the table.
struct PictureSet {
  std::string name;
  std::size_t pictures = 0;
  std::vector<double> values;
};

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
  if (!left.empty()) files = std::move(left);  // of both eyes in one folder, the left ones
  std::sort(files.begin(), files.end());
  return files;
}

/// The left pictures of a dataset in EuRoC's, KITTI's or TUM's layout, or a folder's own.
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

PictureSet Measure(const std::string& name, const fs::path& folder, int most) {
  const std::vector<fs::path> files = FindPictures(folder);
  const std::size_t count = std::min(files.size(), static_cast<std::size_t>(most));
  std::vector<std::vector<double>> pictures;
  ProgressLine line;
  for (std::size_t i = 0; i < count; ++i) {
    line.Show(fmt::format("{}: picture {} of {}", name, i + 1, count));
    const std::size_t at = i * files.size() / count;
    const cv::Mat1b image = ReadGreyPng(files[at]);
    const cv::Mat1b next = at + 1 < files.size() ? ReadGreyPng(files[at + 1]) : cv::Mat1b();
    pictures.push_back(DescribePicture(image, next));
  }
  return {name, count, MedianOfEach(pictures)};
}

std::vector<PictureSet> MeasureRealSets(const Options& options) {
  std::vector<PictureSet> sets;
  for (const auto& [name, folder] : kRealSets) {
    const fs::path at = fs::path(options.data) / folder;
    if (fs::is_directory(at)) sets.push_back(Measure(name, at, options.pictures));
  }
  if (sets.empty()) {
    fmt::print(
        "no real pictures at {}: --data FOLDER with euroc-v101-still, euroc-loop-pairs or "
        "kitti/sequences/06\n",
        Printable(options.data));
  }
  return sets;
}

std::string Cell(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits);
}

/// A row a statistic, real sets first; then how many of the given sets lie within the real ones.
std::string Table(const std::vector<PictureSet>& real, const std::vector<PictureSet>& given) {
  std::string table = "| medians over pictures |";
  std::string rule = "|---|";
  for (const auto* sets : {&real, &given}) {
    for (const PictureSet& set : *sets) {
      table += fmt::format(" {} ({}) |", set.name, set.pictures);
      rule += "---|";
    }
  }
  table += real.empty() ? "\n" : " within |\n";
  rule += real.empty() ? "\n" : "---|\n";
  table += rule;
  const auto statistics = PictureStatistics();
  for (std::size_t i = 0; i < statistics.size(); ++i) {
    table += fmt::format("| {} |", statistics[i].name);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const PictureSet& set : real) {
      table += fmt::format(" {} |", Cell(set.values[i], statistics[i].digits));
      low = std::fmin(low, set.values[i]);
      high = std::fmax(high, set.values[i]);
    }
    int within = 0, known = 0;
    for (const PictureSet& set : given) {
      table += fmt::format(" {} |", Cell(set.values[i], statistics[i].digits));
      if (std::isnan(set.values[i])) continue;
      ++known;
      within += set.values[i] >= low && set.values[i] <= high;
    }
    table += real.empty() ? "\n" : fmt::format(" {} of {} |\n", within, known);
  }
  return table;
}

nlohmann::json ToJson(const std::vector<PictureSet>& sets, bool real) {
  nlohmann::json rows = nlohmann::json::array();
  for (const PictureSet& set : sets) {
    nlohmann::json row = {{"name", set.name}, {"real", real}, {"pictures", set.pictures}};
    const auto statistics = PictureStatistics();
    for (std::size_t i = 0; i < statistics.size(); ++i) {
      if (!std::isnan(set.values[i])) row[statistics[i].key] = set.values[i];
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

int BenchRealism(const Options& options) {
  std::vector<PictureSet> given;
  for (const std::string& folder : options.folders) FindPictures(folder);  // all, before the first
  for (const std::string& folder : options.folders) {
    fs::path path = fs::path(folder).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    given.push_back(Measure(Printable(path.filename().string()), folder, options.pictures));
  }
  const std::vector<PictureSet> real = MeasureRealSets(options);
  fmt::print("{}", Table(real, given));
  if (!options.json.empty()) {
    nlohmann::json rows = ToJson(real, true);
    for (nlohmann::json& row : ToJson(given, false)) rows.push_back(std::move(row));
    WriteFileAtomically(options.json, rows.dump(2) + "\n");
  }
  return kAllPassed;
}

std::string Definitions() {
  std::string text = "Medians over the pictures of:\n";
  for (const PictureStatistic& statistic : PictureStatistics()) {
    text += fmt::format("  {}: {}\n", statistic.name, statistic.definition);
  }
  return text + "Example: ./aisle bench realism my_dataset --json realism.json";
}

}  // namespace

void AddBenchRealism(CLI::App* bench, Action* action) {
  const auto options = std::make_shared<Options>();
  options->data = (fs::path(AISLE_SOURCE_DIR) / "../shared/data").lexically_normal().string();
  CLI::App* command = bench->add_subcommand(
      "realism", "contrast, corners, spectrum, tones and noise of pictures beside real cameras'");
  command
      ->add_option("DIRS", options->folders,
                   "folders of grey PNG pictures, or datasets in EuRoC's, KITTI's or TUM's layout")
      ->required();
  command->add_option("--data", options->data,
                      fmt::format("folder of the real sets (default {})", options->data));
  command->add_option("--pictures", options->pictures, "of a folder, at most, evenly (default 24)")
      ->check(CLI::Range(1, 100000));
  command->add_option("--json", options->json, "write every value there too");
  command->footer(Definitions());
  command->callback([=] { *action = [=] { return BenchRealism(*options); }; });
}

}  // namespace aisle
