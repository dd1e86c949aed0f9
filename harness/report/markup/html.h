#pragma once

#include <string>

namespace aisle {

/// Text made harmless inside an element or a quoted attribute: markup escaped, control bytes shown,
/// invalid UTF-8 replaced. Every name that reaches a page goes through here.
std::string Escape(const std::string& text);

/// Length of the well-formed UTF-8 character at `at`, which is inside the text; 0 if there is none.
std::size_t CharacterLength(const std::string& text, std::size_t at);

/// A relative path as a link: everything but plain characters and '/' percent-encoded.
std::string EscapeUrl(const std::string& path);

}  // namespace aisle
