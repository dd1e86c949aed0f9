#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "harness/campaign/inputs.h"
#include "harness/campaign/source.h"
#include "harness/cli/bag_notes.h"
#include "harness/cli/by_name.h"
#include "harness/cli/command.h"
#include "harness/io/input_error.h"
#include "harness/plugs/user_model.h"
#include "harness/record/record_json.h"
#include "harness/suite/recording.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> Complaints(const std::string& file) {
  try {
    if (!IsSuiteFile(file)) return CheckSource(file);
    std::vector<std::string> complaints;
    for (const SuiteScene& scene : LoadSuite(file, KnownNames()).scenes) {
      for (const std::string& complaint : CheckSource(scene.file)) complaints.push_back(complaint);
    }
    return complaints;
  } catch (const InputError& error) {
    return Lines(error.what());
  }
}

/// Folders stand for the YAML files below them, in the order of their names.
std::vector<std::string> FilesOf(const std::vector<std::string>& places) {
  std::vector<std::string> files;
  for (const std::string& place : places) {
    if (!std::filesystem::is_directory(place)) {
      files.push_back(place);
      continue;
    }
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
      if (entry.path().extension() == ".yaml") found.insert(entry.path().string());
    }
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

void PrintText(const std::string& file, const std::vector<std::string>& complaints) {
  for (const std::string& complaint : complaints) fmt::print(stderr, "{}\n", complaint);
  if (!complaints.empty()) return;
  fmt::print("{}: good\n", file);
  if (IsRecording(file)) TellNotes(file, NotesOfSource(file));
  if (IsSuiteFile(file) || IsRecording(file)) return;
  for (const std::string& line : DescribeMeshes(file)) fmt::print("  {}\n", line);
}

int Check(const std::vector<std::string>& places, bool json) {
  const std::vector<std::string> files = FilesOf(places);
  if (files.empty()) {
    fmt::print(stderr, "no .yaml file to check: name scene or suite files, or folders of them\n");
    return kNothingToDo;
  }
  std::size_t bad = 0;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& file : files) {
    const std::vector<std::string> complaints = Complaints(file);
    if (json) {
      list.push_back({{"file", file}, {"good", complaints.empty()}, {"complaints", complaints}});
    } else {
      PrintText(file, complaints);
    }
    bad += complaints.empty() ? 0 : 1;
  }
  if (json) fmt::print("{}", Dump({{"files", list}}));
  return bad == 0 ? kAllPassed : kBadInput;
}

}  // namespace

void AddCheckCommand(CLI::App* app, Action* action) {
  const auto files = std::make_shared<std::vector<std::string>>();
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app->add_subcommand("check", "validate scene and suite files");
  command->add_option("FILE", *files, "scene or suite files, or folders of them")
      ->required()
      ->transform(ByName());
  command->add_flag("--json", *json, "for programs");
  command->footer("Example: ./aisle check scenes");
  command->callback([=] { *action = [=] { return Check(*files, *json); }; });
}

}  // namespace aisle
