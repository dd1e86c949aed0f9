#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/campaign/guest_program.h"
#include "harness/campaign/inputs.h"
#include "harness/campaign/source.h"
#include "harness/cli/bag_notes.h"
#include "harness/cli/by_name.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/files_below.h"
#include "harness/io/input_error.h"
#include "harness/plugs/user_model.h"
#include "harness/record/record_json.h"
#include "harness/suite/recording.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> Complaints(const std::string& file) {
  const fs::path path(file);
  const bool of_a_bag = path.filename() == "metadata.yaml";
  if (of_a_bag || fs::is_directory(path)) {
    const fs::path folder = of_a_bag ? path.parent_path() : path;
    if (const std::string what = WhatRecording(folder); !what.empty()) {
      return {InputError(folder.string(), 0, what).what()};
    }
  }
  try {
    RefuseForeignYaml(file);
    if (!IsSuiteFile(file)) return CheckSource(file);
    std::vector<std::string> complaints;
    const Suite suite = LoadSuite(file, KnownNames());
    for (const SuiteScene& scene : suite.scenes) {
      for (const std::string& complaint : CheckSource(scene.file)) complaints.push_back(complaint);
    }
    for (const std::string& complaint : Lines(ComplaintsOf(suite))) complaints.push_back(complaint);
    return complaints;
  } catch (const InputError& error) {
    return Lines(error.what());
  }
}

/// Folders stand for the files below them.
std::vector<std::string> FilesOf(const std::vector<std::string>& places) {
  std::vector<std::string> files;
  for (const std::string& place : places) {
    const bool whole = fs::is_directory(place) && WhatRecording(place).empty();
    const std::vector<std::string> more = whole ? FilesBelow(place) : std::vector{place};
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

/// What is worth knowing of a file that is good.
std::vector<std::string> NotesOf(const std::string& file) {
  if (IsRecording(file)) return NotesOfSource(file);
  if (IsSuiteFile(file)) return NotesOfSystems(LoadSuite(file, KnownNames()));
  return {};
}

void PrintText(const std::string& file, const std::vector<std::string>& complaints,
               const std::vector<std::string>& notes) {
  for (const std::string& complaint : complaints) fmt::print(stderr, "{}\n", complaint);
  if (!complaints.empty()) return;
  fmt::print("{}: good\n", file);
  TellNotes(file, notes);
  if (IsRecording(file) || IsSuiteFile(file)) return;
  for (const std::string& line : DescribeMeshes(file)) fmt::print("  {}\n", line);
}

int Check(const std::vector<std::string>& places, bool json) {
  const std::vector<std::string> files = FilesOf(places);
  if (files.empty()) {
    fmt::print(stderr, "no .yaml files to check: name scene or suite files, or folders of them\n");
    return kNothingToDo;
  }
  std::size_t bad = 0;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::string& file : files) {
    const std::vector<std::string> complaints = Complaints(file);
    const bool good = complaints.empty();
    const std::vector<std::string> notes = good ? NotesOf(file) : std::vector<std::string>();
    if (json) {
      list.push_back(
          {{"file", file}, {"good", good}, {"complaints", complaints}, {"notes", notes}});
    } else {
      PrintText(file, complaints, notes);
    }
    bad += good ? 0 : 1;
  }
  if (json) fmt::print("{}", Dump({{"files", list}}));
  return bad == 0 ? kAllPassed : kBadInput;
}

}  // namespace

void AddCheckCommand(CLI::App* app, Action* action) {
  const auto files = std::make_shared<std::vector<std::string>>();
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app->add_subcommand("check", "Validate scene and suite files");
  command->add_option("FILE", *files, "Scene or suite files, or folders of them")
      ->required()
      ->transform(ByName());
  AddJson(command, json.get());
  command->footer("Example: ./aisle check scenes");
  command->callback([=] { *action = [=] { return Check(*files, *json); }; });
}

}  // namespace aisle
