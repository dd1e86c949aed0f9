#pragma once

#include <string_view>

namespace aisle::sim {

/// A file's text, or its first line, less the mark that Windows' editors set before UTF-8.
inline std::string_view WithoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

}  // namespace aisle::sim
