#pragma once

#include <string>
#include <vector>

namespace aisle {

/// The known word nearest to a misspelt one by edit distance; empty if none is near. One that
/// begins alike is near whatever its length.
std::string NearestWord(const std::string& word, const std::vector<std::string>& known);

/// " (did you mean X?)", or nothing.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& known);

}  // namespace aisle
