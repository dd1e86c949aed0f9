#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/bench/realism.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/page_block.h"
#include "harness/cli/terminal.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/picture/realism.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> folders;
  std::string data, json;
  PageBlock into{"sets"};
  int pictures = 24;
};

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
    for (const auto* sets : {&real, &given}) {
      for (const PictureSet& set : *sets) {
        table += fmt::format(" {} |", Cell(set.values[i], statistics[i].digits));
      }
    }
    const WithinReal count = CountWithin(real, given, i);
    table += real.empty() ? "\n" : fmt::format(" {} of {} |\n", count.within, count.known);
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
  options.into.Check();
  CheckCanBeWritten(options.json);
  ProgressLine line;
  const auto show = [&](const std::string& at) { line.Show(at); };
  std::vector<PictureSet> given;
  for (const std::string& folder : options.folders) FindPictures(folder);  // all, before the first
  for (const std::string& folder : options.folders) {
    fs::path path = fs::path(folder).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    given.push_back(
        MeasurePictures(Printable(path.filename().string()), folder, options.pictures, show));
  }
  std::vector<PictureSet> real;
  if (!options.data.empty()) real = MeasureRealPictures(options.data, options.pictures, show);
  line.Clear();
  if (real.empty()) {
    fmt::print(
        "no real pictures{}: name a folder that has euroc-v101-still, euroc-loop-pairs or "
        "kitti/sequences/06 with --data\n",
        options.data.empty() ? "" : " in " + Printable(options.data));
  }
  fmt::print("{}", Table(real, given));
  options.into.Write(Table(real, given));
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
  CLI::App* command = bench->add_subcommand("realism",
                                            "Compare contrast, corners, spectrum, tones and noise "
                                            "of pictures with those of real cameras");
  command
      ->add_option("DIRS", options->folders,
                   "Folders of grey PNG pictures, or datasets in EuRoC's, KITTI's or TUM's layout")
      ->required();
  command
      ->add_option("--data", options->data,
                   "Folder of the real pictures; without it, nothing is compared")
      ->envname("AISLE_TEST_DATA");
  command
      ->add_option("--pictures", options->pictures,
                   "Most pictures to take of a folder, evenly spread; default: 24")
      ->check(CLI::Range(1, 100000));
  AddJsonFile(command, &options->json, "every value");
  options->into.AddTo(command);
  command->footer(Definitions());
  command->callback([=] { *action = [=] { return BenchRealism(*options); }; });
}

}  // namespace aisle
