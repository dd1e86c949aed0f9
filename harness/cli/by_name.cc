#include "harness/cli/by_name.h"

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

}  // namespace aisle
