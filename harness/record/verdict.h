#pragma once

#include <optional>
#include <string>

namespace aisle {

/// What was decided of an evening's scores, as results.json keeps it.
struct Verdict {
  std::string name;  ///< "paper/scene2 live oracle: ate_rmse_m"
  bool passed = false;
  bool flaky = false;                ///< failed, and a second attempt did not: still no pass
  std::optional<double> value = {};  ///< the median over seeds
  std::optional<double> limit = {};
  std::string why;                                 ///< the sentence for the morning
  std::string scene = {}, twin = {}, system = {};  ///< whom it is about; empty: nobody alone
};

}  // namespace aisle
