#include "simulator/calibration/calibration_text.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "simulator/common/input_file.h"

namespace aisle::sim {

std::string CalibrationText(const std::string& file) {
  constexpr std::uintmax_t kMostBytes = 1 << 20;
  if (const std::string wrong = InputFileError(file, kMostBytes); !wrong.empty()) {
    throw std::runtime_error(wrong);
  }
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  std::string text = bytes.str();
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

}  // namespace aisle::sim
