#include "harness/suite/suite_reader.h"

#include <charconv>
#include <limits>
#include <set>

#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"

namespace aisle {
namespace {

constexpr std::size_t kLongestName = 80;

Place PlaceOf(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return {mark.line + 1, mark.column + 1};
}

/// What stands there, short enough for a message.
std::string Shown(const YAML::Node& node) {
  if (node.IsNull()) return "nothing";
  if (node.IsMap()) return "a map";
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  return fmt::format("'{}'", Printable(node.Scalar(), 40));
}

std::string ToText(Range range) {
  if (range.low <= -1e9 && range.high >= 1e9) return "";
  if (range.high >= 1e9) return fmt::format(" of {:g} or more", range.low);
  return fmt::format(" from {:g} to {:g}", range.low, range.high);
}

/// A plain decimal number, all of the text: no octal, '_', inf or nan, which yaml-cpp would read.
template <class T>
std::optional<T> PlainNumber(const YAML::Node& node) {
  if (!node.IsScalar() || node.Tag() == "!") return std::nullopt;  // "!" marks a quoted text
  const std::string& text = node.Scalar();
  T value{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

bool IsName(const std::string& text) {
  return !text.empty() && text.size() <= kLongestName && text.find("..") == std::string::npos &&
         text.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-") ==
             std::string::npos;
}

/// What is wrong with a name, or an empty string.
std::string NameMistake(const std::string& text, const Words& words) {
  const auto& known = words.known;
  if (known.empty()) {
    return IsName(text) ? "" : "a name of 1 to 80 letters, digits, '_', '.' and '-'";
  }
  if (std::find(known.begin(), known.end(), text) != known.end()) return "";
  return fmt::format("one of {}{}", fmt::join(known, ", "), DidYouMean(text, known));
}

}  // namespace

YamlReader::YamlReader(YAML::Node map, std::string path, Issues* issues)
    : map_(std::move(map)), path_(std::move(path)), issues_(issues) {}

bool YamlReader::Has(const char* key) const { return static_cast<bool>(map_[key]); }

void YamlReader::Fail(const char* key, const std::string& what) {
  Place place = PlaceOf(map_);
  for (const auto& entry : map_) {
    if (entry.first.IsScalar() && entry.first.Scalar() == key) place = PlaceOf(entry.second);
  }
  issues_->Add(place, Has(key) ? PathOf(key) : path_, what);
}

std::string YamlReader::PathOf(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

std::optional<YAML::Node> YamlReader::Find(const Key& key) {
  known_.emplace_back(key.name);
  const YAML::Node& map = map_;  // the const subscript adds nothing
  const YAML::Node value = map[key.name];
  if (value) return value;
  if (key.required) missing_.push_back(key);
  return std::nullopt;
}

void YamlReader::Expected(const YAML::Node& node, const Key& key, const std::string& what) {
  issues_->Add(PlaceOf(node), PathOf(key.name),
               fmt::format("expected {}, got {} ({}); example: {}: {}", what, Shown(node), key.help,
                           key.name, key.example));
}

void YamlReader::Name(const Key& key, std::string* value, const Words& words) {
  const auto node = Find(key);
  if (!node) return;
  const std::string text = node->IsScalar() ? node->Scalar() : "";
  const std::string mistake = NameMistake(text, words);
  if (mistake.empty()) {
    *value = text;
  } else {
    Expected(*node, key, mistake);
  }
}

void YamlReader::Text(const Key& key, std::string* value) {
  const auto node = Find(key);
  if (!node) return;
  if (node->IsScalar() && !node->Scalar().empty()) {
    *value = node->Scalar();
  } else {
    Expected(*node, key, "a text");
  }
}

void YamlReader::Number(const Key& key, double* value, Range range) {
  const auto node = Find(key);
  if (!node) return;
  const auto number = PlainNumber<double>(*node);
  if (number && *number >= range.low && *number <= range.high) {
    *value = *number;
  } else {
    Expected(*node, key, "a number" + ToText(range));
  }
}

void YamlReader::OptionalNumber(const Key& key, std::optional<double>* value, Range range) {
  if (!Has(key.name)) {
    known_.emplace_back(key.name);
    return;
  }
  // What is no number in the range is told, and breaks no further rule.
  double number = std::numeric_limits<double>::quiet_NaN();
  Number(key, &number, range);
  *value = number;
}

void YamlReader::Integer(const Key& key, int* value, Range range) {
  const auto node = Find(key);
  if (!node) return;
  const auto number = PlainNumber<int>(*node);
  if (number && *number >= range.low && *number <= range.high) {
    *value = *number;
  } else {
    Expected(*node, key, "an integer" + ToText(range));
  }
}

std::vector<YAML::Node> YamlReader::Items(const YAML::Node& node, const Key& key) {
  if (node.IsScalar()) return {node};  // a list of one may drop its brackets
  if (node.IsSequence() && node.size() > 0) return {node.begin(), node.end()};
  Expected(node, key, "a list with at least one entry");
  return {};
}

void YamlReader::Names(const Key& key, std::vector<std::string>* values, const Words& words) {
  Texts(key, values, [&](const std::string& text) {
    const std::string mistake = NameMistake(text, words);
    return mistake.empty() ? std::string() : fmt::format("expected {}", mistake);
  });
}

void YamlReader::Texts(const Key& key, std::vector<std::string>* values, const Check& check) {
  const auto node = Find(key);
  if (!node) return;
  values->clear();
  std::set<std::string> seen;
  for (const YAML::Node& item : Items(*node, key)) {
    const std::string text = item.IsScalar() ? item.Scalar() : "";
    if (text.empty()) {
      Expected(item, key, "a text");
    } else if (seen.contains(text)) {
      issues_->Add(PlaceOf(item), PathOf(key.name),
                   fmt::format("duplicate '{}'; keep one of them", Printable(text)));
    } else if (const std::string mistake = check(text); !mistake.empty()) {
      issues_->Add(PlaceOf(item), PathOf(key.name),
                   fmt::format("'{}': {}", Printable(text), mistake));
    } else {
      seen.insert(text);
      values->push_back(text);
    }
  }
}

void YamlReader::CountOrList(const Key& key, std::vector<std::uint64_t>* values, int most) {
  const auto node = Find(key);
  if (!node) return;
  const std::string expected =
      fmt::format("a number of seeds (1 to {}), or a list of integers", most);
  std::vector<std::uint64_t> read;
  if (node->IsScalar()) {
    const auto count = PlainNumber<int>(*node);
    if (!count || *count < 1 || *count > most) return Expected(*node, key, expected);
    for (int i = 1; i <= *count; ++i) read.push_back(static_cast<std::uint64_t>(i));
  } else {
    std::set<std::uint64_t> seen;
    for (const YAML::Node& item : Items(*node, key)) {
      const auto number = PlainNumber<std::uint64_t>(item);
      if (!number) return Expected(item, key, expected);
      if (!seen.insert(*number).second) {
        return issues_->Add(PlaceOf(item), PathOf(key.name),
                            fmt::format("duplicate {}; keep one of them", *number));
      }
      read.push_back(*number);
    }
  }
  if (!read.empty()) *values = std::move(read);
}

void YamlReader::Numbers(const Key& key, std::vector<double>* values, Range range) {
  const auto node = Find(key);
  if (!node) return;
  std::vector<double> read;
  std::set<double> seen;
  for (const YAML::Node& item : Items(*node, key)) {
    const auto number = PlainNumber<double>(item);
    if (!number || !(*number >= range.low && *number <= range.high)) {
      return Expected(item, key, "a list of numbers" + ToText(range));
    }
    if (!seen.insert(*number).second) {
      return issues_->Add(PlaceOf(item), PathOf(key.name),
                          fmt::format("duplicate {:g}; keep one of them", *number));
    }
    read.push_back(*number);
  }
  *values = std::move(read);
}

void YamlReader::Values(const Key& key, std::map<std::string, std::string>* values,
                        const CheckValue& check) {
  const auto node = Find(key);
  if (!node) return;
  if (!node->IsMap()) return Expected(*node, key, "a map");
  for (const auto& entry : *node) {
    const std::string name = entry.first.Scalar();
    if (!entry.second.IsScalar()) {
      Expected(entry.second, key, "a plain value for " + Printable(name));
    } else if (const std::string wrong = check(name, entry.second.Scalar()); !wrong.empty()) {
      issues_->Add(PlaceOf(entry.first), PathOf(key.name), wrong);
    } else {
      (*values)[name] = entry.second.Scalar();
    }
  }
}

void YamlReader::Group(const Key& key, const Part& part) {
  const auto node = Find(key);
  if (!node) return;
  if (!node->IsMap()) return Expected(*node, key, "a map");
  YamlReader reader(*node, PathOf(key.name), issues_);
  part(reader);
  reader.ReportKeys();
}

void YamlReader::ReadItem(const YAML::Node& item, std::size_t index, const Key& key,
                          const Element& element, const char* plain) {
  const bool is_plain = item.IsScalar() && plain != nullptr;
  if (!item.IsMap() && !is_plain) {
    return Expected(item, key, fmt::format("a map as number {} of the list", index + 1));
  }
  YAML::Node map(YAML::NodeType::Map);  // assigned to another node it would change that one
  if (is_plain) map[plain] = item;
  YamlReader reader(is_plain ? map : item, fmt::format("{}[{}]", PathOf(key.name), index), issues_);
  reader.plain_ = is_plain;
  element(reader, index);
  reader.ReportKeys();
}

void YamlReader::List(const Key& key, const std::function<void(std::size_t)>& resize,
                      const Element& element, const char* plain) {
  const auto node = Find(key);
  if (!node) return;
  const std::vector<YAML::Node> items = Items(*node, key);
  resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) ReadItem(items[i], i, key, element, plain);
}

void YamlReader::ReportKeys() {
  std::set<std::string> misspelt;
  for (const auto& entry : map_) {
    const std::string name = entry.first.Scalar();
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    const std::string near = NearestWord(name, known_);
    misspelt.insert(near);
    issues_->Add(PlaceOf(entry.first), PathOf(Printable(name)),
                 near.empty() ? fmt::format("unknown key; known keys: {}", fmt::join(known_, ", "))
                              : fmt::format("unknown key; did you mean {}?", near));
  }
  for (const Key& key : missing_) {
    if (misspelt.contains(key.name)) continue;
    issues_->Add(PlaceOf(map_), PathOf(key.name),
                 fmt::format("missing key ({}); example: {}: {}", key.help, key.name, key.example));
  }
}

}  // namespace aisle
