#include "harness/cli/by_name.h"

#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"
#include "harness/io/places.h"

namespace aisle {

CLI::Validator ByName() {
  return {[](std::string& word) {
            word = SceneFile(word);
            return std::string();
          },
          ""};
}

CLI::Validator SuiteByName() {
  return {[](std::string& word) {
            const std::string suite = SceneFile("suites/" + word);
            const std::string found = SceneFile(word);
            std::error_code error;
            const bool folder = std::filesystem::is_directory(found, error);
            word = folder && std::filesystem::exists(suite, error) ? suite : found;
            return std::string();
          },
          ""};
}

void CheckAreThere(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    std::error_code error;  // names that no file can have among them
    if (file.empty() || std::filesystem::exists(file, error) || error) continue;
    const std::filesystem::path path = file;
    if (path.is_absolute()) throw InputError(file, 0, "no such file");
    const std::string name = std::filesystem::path(path).replace_extension().string();
    std::vector<std::string> known = NamesOfScenes();
    if (name.find('/') != std::string::npos) {  // a scene's: no suite is nearer for its beginning
      std::erase_if(known, [](const std::string& one) { return one.find('/') == one.npos; });
    }
    throw InputError(file, 0, "no such file, scene or suite" + DidYouMean(name, known));
  }
}

}  // namespace aisle
