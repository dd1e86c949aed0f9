#include "simulator/calibration/calibration_text.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "simulator/common/byte_order_mark.h"
#include "simulator/common/input_file.h"

namespace aisle::sim {

std::string CalibrationText(const std::string& file) {
  constexpr std::uintmax_t kMostBytes = 1 << 20;
  if (const std::string wrong = InputFileError(file, kMostBytes); !wrong.empty()) {
    throw std::runtime_error(wrong);
  }
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return std::string(WithoutByteOrderMark(bytes.view()));
}

}  // namespace aisle::sim
