#pragma once

#include <string>
#include <vector>

namespace aisle::slam {

/// The known name nearest to a misspelt one by edit distance, two swapped letters being one
/// mistake: at most a third of its letters may be wrong. One that begins alike is near whatever its
/// length. A name of parts with dots between ("field.memory") is compared with as many last parts
/// of the others too. The first of equals; empty if none is near.
std::string NearestName(const std::string& name, const std::vector<std::string>& names);

/// "; did you mean xyz?", or nothing.
std::string DidYouMean(const std::string& name, const std::vector<std::string>& names);

}  // namespace aisle::slam
