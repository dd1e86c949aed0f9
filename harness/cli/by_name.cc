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

}  // namespace aisle
