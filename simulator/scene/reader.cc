#include "simulator/scene/reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <set>

#include "simulator/common/printable.h"

namespace aisle::sim {
namespace {

/// A plain decimal number, all of the text. No octal, hexadecimal, '_', inf or nan, all of which
/// yaml-cpp reads in surprising ways.
std::optional<double> DecimalNumber(const YamlValue& value) {
  if (!value.is_text() || value.quoted) return std::nullopt;
  const std::string& text = value.text;
  const std::size_t first_digit = text.starts_with('-') ? 1 : 0;
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && text[i] >= '0' && text[i] <= '9';
  };
  if (text.size() > 32 || !is_digit(first_digit)) return std::nullopt;
  if (text[first_digit] == '0' && is_digit(first_digit + 1)) return std::nullopt;
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stopped != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// What stands there, short enough for a message.
std::string Shown(const YamlValue& value) {
  if (value.is_null()) return "nothing";
  if (value.is_map()) return "a map";
  if (value.is_list()) return fmt::format("a list of {}", value.items.size());
  return fmt::format("'{}'", Printable(value.text, 40));
}

std::string ToText(Range range) {
  if (range.low <= -1e9 && range.high >= 1e9) return "";
  return fmt::format(" from {:g} to {:g}", range.low, range.high);
}

}  // namespace

YamlReader::YamlReader(const YamlValue& map, std::string path, Issues* issues)
    : map_(map), path_(std::move(path)), issues_(issues) {}

Mark YamlReader::mark() const { return map_.mark; }

Mark YamlReader::MarkOf(const char* key) const {
  const YamlEntry* entry = map_.Find(key);
  return entry ? entry->mark : mark();
}

bool YamlReader::Has(const char* key) const { return map_.Find(key) != nullptr; }

void YamlReader::OnlyWith(const char* other, std::initializer_list<const char*> keys) {
  if (Has(other)) return;
  for (const GivenKey& key : Given(keys)) alone_.emplace_back(key, other);
}

std::string YamlReader::PathOf(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

const YamlValue* YamlReader::Find(const Key& key) {
  known_.emplace_back(key.name);
  if (const YamlEntry* entry = map_.Find(key.name)) return &entry->value;
  if (key.required && (key.unless == nullptr || !Has(key.unless))) missing_.push_back(key);
  return nullptr;
}

void YamlReader::Expected(const YamlValue& value, const Key& key, const std::string& what) {
  issues_->Add(value.mark, PathOf(key.name),
               fmt::format("expected {}, got {} ({}); example: {}: {}", what, Shown(value),
                           key.help, key.name, key.example));
}

void YamlReader::Number(const Key& key, double* value, Range range) {
  const auto node = Find(key);
  if (!node) return;
  const auto number = DecimalNumber(*node);
  if (number && range.Holds(*number)) {
    *value = *number;
  } else {
    Expected(*node, key, "a number" + ToText(range));
  }
}

void YamlReader::Integer(const Key& key, int* value, Range range) {
  const auto node = Find(key);
  if (!node) return;
  const auto number = DecimalNumber(*node);
  if (number && range.Holds(*number) && *number == std::floor(*number)) {
    *value = static_cast<int>(*number);
  } else {
    Expected(*node, key, "an integer" + ToText(range));
  }
}

void YamlReader::Flag(const Key& key, bool* value) {
  const auto node = Find(key);
  if (!node) return;
  const bool plain = node->is_text() && !node->quoted;
  if (plain && (node->text == "true" || node->text == "false")) {
    *value = node->text == "true";
  } else {
    Expected(*node, key, "true or false");
  }
}

void YamlReader::Name(const Key& key, std::string* value) {
  const auto node = Find(key);
  if (!node) return;
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  const std::string& text = node->text;
  if (!text.empty() && text.size() <= 80 && std::ranges::all_of(text, allowed)) {
    *value = text;
  } else {
    Expected(*node, key, "a name of letters, digits, '_' and '-', at most 80");
  }
}

void YamlReader::Sentence(const Key& key, std::string* value) {
  const auto node = Find(key);
  if (!node) return;
  if (node->is_text() && !node->text.empty()) {
    *value = node->text;
  } else {
    Expected(*node, key, "a text");
  }
}

void YamlReader::Sentences(const Key& key, std::vector<std::string>* values) {
  const auto node = Find(key);
  if (!node) return;
  const auto is_text = [](const YamlValue& item) { return item.is_text() && !item.text.empty(); };
  if (!node->is_list() || node->items.empty() || !std::ranges::all_of(node->items, is_text)) {
    Expected(*node, key, "a list of texts");
    return;
  }
  values->clear();
  for (const YamlValue& item : node->items) values->push_back(item.text);
}

bool YamlReader::ReadPair(const YamlValue& list, double* values, std::size_t count,
                          Range range) const {
  if (!list.is_list() || list.items.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = DecimalNumber(list.items[i]);
    if (!number || !range.Holds(*number)) return false;
    values[i] = *number;
  }
  return true;
}

void YamlReader::Numbers(const Key& key, double* values, std::size_t count, Range range) {
  const auto node = Find(key);
  if (!node) return;
  std::vector<double> read(count);
  if (ReadPair(*node, read.data(), count, range)) {
    std::ranges::copy(read, values);
  } else {
    Expected(*node, key, fmt::format("a list of {} numbers{}", count, ToText(range)));
  }
}

void YamlReader::Integers(const Key& key, int* values, std::size_t count, Range range) {
  const auto node = Find(key);
  if (!node) return;
  std::vector<double> read(count);
  const auto is_whole = [](double number) { return number == std::floor(number); };
  if (ReadPair(*node, read.data(), count, range) && std::ranges::all_of(read, is_whole)) {
    std::ranges::transform(read, values, [](double number) { return static_cast<int>(number); });
  } else {
    Expected(*node, key, fmt::format("a list of {} integers{}", count, ToText(range)));
  }
}

void YamlReader::Points(const Key& key, std::vector<Eigen::Vector2d>* values,
                        std::vector<Mark>* marks) {
  const auto node = Find(key);
  if (!node) return;
  if (!node->is_list() || node->items.empty()) {
    Expected(*node, key, "a list of points [x, y]");
    return;
  }
  values->clear();
  marks->clear();
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    const YamlValue& item = node->items[i];
    if (!ReadPair(item, point.data(), 2, {-1000, 1000})) {
      Expected(item, key, fmt::format("a point [x, y] in metres as number {} of the list", i + 1));
    }
    values->push_back(point);
    marks->push_back(item.mark);
  }
}

void YamlReader::Group(const Key& key, const Part& part) {
  const auto node = Find(key);
  if (!node) return;
  if (!node->is_map()) {
    Expected(*node, key, "a map");
    return;
  }
  YamlReader reader(*node, PathOf(key.name), issues_);
  part(reader);
  reader.ReportKeys();
}

void YamlReader::List(const Key& key, const std::function<void(std::size_t)>& resize,
                      const Element& element) {
  const auto node = Find(key);
  if (!node) return;
  if (!node->is_list()) {
    Expected(*node, key, "a list");
    return;
  }
  if (key.required && node->items.empty()) Expected(*node, key, "at least one");
  resize(node->items.size());
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    const YamlValue& item = node->items[i];
    if (!item.is_map()) {
      Expected(item, key, fmt::format("a map as number {} of the list", i + 1));
      continue;
    }
    YamlReader reader(item, fmt::format("{}[{}]", PathOf(key.name), i), issues_);
    element(reader, i);
    reader.ReportKeys();
  }
}

void YamlReader::ChoiceIndex(const Key& key, int* index, std::initializer_list<const char*> names) {
  const auto node = Find(key);
  if (!node) return;
  const std::string& text = node->text;
  const auto found = std::ranges::find(names, text);
  if (found != names.end()) {
    *index = static_cast<int>(found - names.begin());
    return;
  }
  const std::string near = NearestWord(text, {names.begin(), names.end()});
  Expected(*node, key,
           fmt::format("one of {}{}", fmt::join(names, ", "),
                       near.empty() || text.empty() ? "" : " (did you mean " + near + "?)"));
}

void YamlReader::ReportKeys() {
  std::set<std::string> misspelt;
  for (const auto& [name, place, value] : map_.entries) {
    if (std::ranges::find(known_, name) != known_.end()) continue;
    const std::string near = NearestWord(name, known_);
    misspelt.insert(near);
    issues_->Add(place, PathOf(Printable(name, 80)),
                 near.empty() ? fmt::format("unknown key; known keys: {}", fmt::join(known_, ", "))
                              : fmt::format("unknown key; did you mean {}?", near));
  }
  for (const auto& [key, other] : alone_) {
    if (misspelt.contains(other)) continue;
    issues_->Add(key.mark, PathOf(key.name),
                 fmt::format("it has no effect without `{}`; add that, or remove this", other));
  }
  for (const Key& key : missing_) {
    if (misspelt.contains(key.name)) continue;
    issues_->Add(mark(), PathOf(key.name),
                 fmt::format("missing key ({}); example: {}: {}", key.help, key.name, key.example));
  }
}

}  // namespace aisle::sim
