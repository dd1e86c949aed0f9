#include "slam/common/option_fields.h"

#include <charconv>
#include <type_traits>

#include "slam/common/nearest_name.h"

namespace aisle::slam {
namespace {

bool IsWithin(double value, OptionRange range) {  // not a number: nowhere
  return value >= range.low && value <= range.high;
}

/// "[8, 4096] px"
std::string Text(const OptionField& field) {
  return fmt::format("[{}, {}]{}{}", field.range.low, field.range.high,
                     field.unit.empty() ? "" : " ", field.unit);
}

template <class Number>
bool Read(const std::string& text, Number* value) {
  const char* end = text.data() + text.size();
  const auto [read_to, error] = std::from_chars(text.data(), end, *value);
  return error == std::errc() && read_to == end;
}

template <class Number>
std::string SetNumber(const std::string& text, const OptionField& field, Number* value) {
  using Wide = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;
  Wide read = 0;
  if (!Read(text, &read)) {
    return fmt::format("{} is \"{}\"; it must be a {}number in {}", field.path, text,
                       std::is_integral_v<Number> ? "whole " : "", Text(field));
  }
  if (!IsWithin(static_cast<double>(read), field.range)) {
    return fmt::format("{} is {}; it must be in {}", field.path, text, Text(field));
  }
  *value = static_cast<Number>(read);
  return {};
}

std::string SetFlag(const std::string& text, const OptionField& field, bool* value) {
  if (text != "true" && text != "false") {
    return fmt::format("{} is \"{}\"; it must be true or false", field.path, text);
  }
  *value = text == "true";
  return {};
}

std::string SetChoice(const std::string& text, const OptionField& field,
                      const OptionChoice& choice) {
  for (std::size_t i = 0; i < choice.names.size(); ++i) {
    if (choice.names[i] != text) continue;
    choice.set(choice.value, static_cast<int>(i));
    return {};
  }
  return fmt::format("{} is \"{}\"; it must be one of {}{}", field.path, text,
                     fmt::join(choice.names, ", "), DidYouMean(text, choice.names));
}

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// What is wrong with the value as it stands, or an empty string.
std::string Broken(const OptionField& field) {
  const bool within = std::visit(
      Overloaded{
          [](const bool*) { return true; },
          [](const OptionChoice& choice) {
            const int index = choice.get(choice.value);
            return index >= 0 && index < std::ssize(choice.names);
          },
          [&](const auto* value) { return IsWithin(static_cast<double>(*value), field.range); }},
      field.value);
  if (within) return {};
  if (std::holds_alternative<OptionChoice>(field.value))
    return field.path + " is not among its choices";
  return fmt::format("{} is {}; it must be in {}", field.path, TextOf(field), Text(field));
}

}  // namespace

void OptionFields::Number(const char* name, double* value, OptionRange range, const char* unit,
                          const char* help) {
  Add(name, value, range, unit, help);
}

void OptionFields::Integer(const char* name, int* value, OptionRange range, const char* unit,
                           const char* help) {
  Add(name, value, range, unit, help);
}

void OptionFields::Seed(const char* name, std::uint64_t* value, const char* help) {
  constexpr double kMost = 4294967295.0;  // as a double too, it is exact
  Add(name, value, {0, kMost}, "", help);
}

void OptionFields::Flag(const char* name, bool* value, const char* help) {
  Add(name, value, {}, "", help);
}

void OptionFields::Add(const char* name, decltype(OptionField::value) value, OptionRange range,
                       const char* unit, const char* help) {
  fields_.push_back({prefix_ + name, std::move(value), range, unit, help});
}

std::string TextOf(const OptionField& field) {
  return std::visit(Overloaded{[](const OptionChoice& choice) {
                                 const int index = choice.get(choice.value);
                                 const bool known = index >= 0 && index < std::ssize(choice.names);
                                 return known ? choice.names[static_cast<std::size_t>(index)] : "";
                               },
                               [](const auto* value) { return fmt::format("{}", *value); }},
                    field.value);
}

std::string SetFrom(const std::string& text, const OptionField& field) {
  return std::visit(
      Overloaded{[&](bool* value) { return SetFlag(text, field, value); },
                 [&](const OptionChoice& choice) { return SetChoice(text, field, choice); },
                 [&](auto* value) { return SetNumber(text, field, value); }},
      field.value);
}

std::string FirstBrokenRule(const OptionFields& fields) {
  for (const OptionField& field : fields.fields()) {
    if (std::string broken = Broken(field); !broken.empty()) return broken;
  }
  return fields.broken_rule();
}

}  // namespace aisle::slam
