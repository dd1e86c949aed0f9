#include "harness/report/page/resources.h"

#include "harness/io/file.h"

namespace aisle {

void WriteResources(const std::filesystem::path& folder) {
  WriteFileAtomically(folder / "style.css", std::string(kStyleSheet));
  WriteFileAtomically(folder / "report.js", std::string(kScript));
}

}  // namespace aisle
