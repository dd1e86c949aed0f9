#pragma once

#include <string>

namespace aisle {

/// Text that stands in a cell of a Markdown table as it is.
std::string MarkdownText(const std::string& text);

}  // namespace aisle
