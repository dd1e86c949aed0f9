#pragma once

#include <string>

namespace aisle {

/// One word to a shell, whatever it holds: names and folders come from others.
std::string ShellWord(const std::string& text);

}  // namespace aisle
