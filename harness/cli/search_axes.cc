#include "harness/cli/search_axes.h"

#include <sstream>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"

namespace aisle {
namespace {

const SystemOption& OptionOf(const std::vector<SystemOption>& options, const std::string& path,
                             const std::string& system) {
  for (const SystemOption& option : options) {
    if (option.path == path) return option;
  }
  throw InputError(fmt::format("unknown option '{}' of {}; `aisle systems {}` lists its options",
                               Printable(path), system, system));
}

SearchAxis ParseAxis(const std::string& line, const std::vector<SystemOption>& options,
                     const std::string& system) {
  std::istringstream words(line);
  SearchAxis axis;
  std::string ratio, rest;
  if (!(words >> axis.path >> axis.low >> axis.high)) {
    throw InputError("expected PATH LOW HIGH, for example dynamic.paper.spread.points 300 1500");
  }
  words >> ratio >> rest;
  axis.even_ratios = ratio == "ratio";
  if ((!ratio.empty() && !axis.even_ratios) || !rest.empty()) {
    throw InputError("expected nothing or the word ratio after HIGH");
  }
  if (axis.low >= axis.high) throw InputError("LOW must be less than HIGH");
  if (axis.even_ratios && axis.low <= 0) throw InputError("with ratio, LOW must be greater than 0");
  const SystemOption& option = OptionOf(options, axis.path, system);
  axis.integer = option.kind == SystemOption::Kind::kInteger;
  if (!axis.integer && option.kind != SystemOption::Kind::kNumber) {
    throw InputError(axis.path + " is not a number");
  }
  for (const double end : {axis.low, axis.high}) {
    if (end >= option.low && end <= option.high) continue;
    throw InputError(fmt::format("expected {} in [{:g}, {:g}], got {:g}", axis.path, option.low,
                                 option.high, end));
  }
  return axis;
}

}  // namespace

std::vector<SearchAxis> ReadAxes(const std::string& file, const std::string& system) {
  const std::vector<SystemOption> options = OptionsOf(FindSystem(system));
  std::istringstream text(ReadFile(file));
  std::vector<SearchAxis> axes;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with('#')) continue;
    try {
      axes.push_back(ParseAxis(line, options, system));
      for (std::size_t i = 0; i + 1 < axes.size(); ++i) {
        if (axes[i].path == axes.back().path) throw InputError(axes[i].path + " is given twice");
      }
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}:{}: {}", Printable(file), number, error.what()));
    }
  }
  if (axes.empty())
    throw InputError(Printable(file) + ": no options in this file; expected one per line");
  return axes;
}

NamedSet ParseNamedSet(const std::string& text, const std::string& system) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon == 0) {
    throw InputError(Printable(text) + ": expected NAME:PATH=VALUE,PATH=VALUE");
  }
  std::vector<std::string> assignments;
  std::istringstream list(text.substr(colon + 1));
  for (std::string one; std::getline(list, one, ',');) assignments.push_back(one);
  return {text.substr(0, colon), OptionsFromText(assignments, FindSystem(system))};
}

}  // namespace aisle
