#pragma once

#include <stdexcept>
#include <string>

namespace aisle {

/// The user's file or argument is wrong. what() is the whole message for the user: where, what, and
/// how to mend it.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// "file:line: message"; line 0 leaves the line out.
  InputError(const std::string& file, std::size_t line, const std::string& message);
};

/// The machine is in the way: a full disk, a folder that cannot be written.
class MachineError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The text with control characters shown as \xNN and cut at a length: fit for a message.
std::string Printable(const std::string& text, std::size_t max_length = 60);

}  // namespace aisle
