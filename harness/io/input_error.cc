#include "harness/io/input_error.h"

#include <fmt/format.h>

namespace aisle {
namespace {

std::string Located(const std::string& file, std::size_t line, const std::string& message) {
  return line == 0 ? fmt::format("{}: {}", file, message)
                   : fmt::format("{}:{}: {}", file, line, message);
}

}  // namespace

InputError::InputError(const std::string& file, std::size_t line, const std::string& message)
    : std::runtime_error(Located(Printable(file, 4096), line, message)) {}

std::string Printable(const std::string& text, std::size_t max_length) {
  std::string printable;
  for (const char c : text.substr(0, max_length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      printable += fmt::format("\\x{:02x}", byte);
    } else {
      printable += c;
    }
  }
  return text.size() > max_length ? printable + "…" : printable;
}

}  // namespace aisle
