#pragma once

#include <functional>
#include <string>
#include <vector>

namespace aisle {

/// What the seeds of a cell say beside their median: "0.31–0.52", the least and the most; from five
/// seeds on "0.31 [0.35–0.50] 0.52", between them the bootstrap's 95 % interval of the median.
/// `text` writes one value.
std::string SpreadText(const std::vector<double>& values,
                       const std::function<std::string(double)>& text);

/// The same in few words, for the median's own cell: "[0.35, 0.50]", the bootstrap's 95 % interval
/// of the median; of less than five seeds "(0.31 to 0.52)", the least and the most; empty of one.
std::string IntervalText(const std::vector<double>& values,
                         const std::function<std::string(double)>& text);

/// So many seeds have an interval of their median.
bool HasInterval(std::size_t seeds);

/// Says what such a row holds.
std::string SpreadRowName(std::size_t seeds, const std::string& scene);

}  // namespace aisle
