#include "harness/cli/bag_notes.h"

#include "harness/campaign/source.h"
#include "harness/io/input_error.h"

namespace aisle {

void TellNotes(const std::string& file, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    fmt::print(stderr, "aisle: {}: {}\n", Printable(file, 4096), note);
  }
}

void TellNotesOfScenes(const std::vector<Suite>& suites) {
  std::set<std::string> told;
  for (const Suite& suite : suites) {
    for (const SuiteScene& scene : suite.scenes) {
      if (told.insert(scene.file).second) TellNotes(scene.file, NotesOfSource(scene.file));
    }
  }
}

}  // namespace aisle
