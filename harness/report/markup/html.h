#pragma once

#include <string>

namespace aisle {

/// Text made harmless inside an element or a quoted attribute: markup escaped, control bytes shown,
/// invalid UTF-8 replaced. Every name that reaches a page goes through here.
std::string Escape(const std::string& text);

/// A relative path as a link: everything but plain characters and '/' percent-encoded.
std::string EscapeUrl(const std::string& path);

}  // namespace aisle
