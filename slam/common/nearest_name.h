#pragma once

#include <string>
#include <vector>

namespace aisle::slam {

/// Letters to insert, drop or replace until `a` is `b` (Levenshtein 1966).
int EditDistance(const std::string& a, const std::string& b);

/// "; did you mean xyz?" with the name most like `name`, the first of equals; empty where none is:
/// more than a third of the letters differ. A name of parts with dots between ("field.memory") is
/// compared with as many last parts of the others too.
std::string DidYouMean(const std::string& name, const std::vector<std::string>& names);

}  // namespace aisle::slam
