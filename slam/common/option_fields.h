#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

namespace aisle::slam {

/// Least and most, both allowed.
struct OptionRange {
  double low = 0, high = 0;
};

/// A value of an enumeration, whichever it is; the names are those of the values 0, 1, ...
struct OptionChoice {
  void* value;
  int (*get)(const void* value);
  void (*set)(void* value, int index);
  std::vector<std::string> names;
};

/// One option of a struct and where it lies.
struct OptionField {
  std::string path;  ///< from the struct that was described: "robust.field.memory"
  std::variant<double*, int*, std::uint64_t*, bool*, OptionChoice> value;
  OptionRange range;  ///< of numbers
  std::string unit, help;
};

/// What the description of an options struct fills. A description is written once, as a function
///   void Describe(OptionFields& fields, FooOptions& options);
/// beside the struct, that names every field with its range, unit and a sentence, then the rules
/// that tie fields together. Listing, setting and checking all follow from it.
class OptionFields {
 public:
  void Number(const char* name, double* value, OptionRange range, const char* unit,
              const char* help);
  void Integer(const char* name, int* value, OptionRange range, const char* unit, const char* help);
  /// Of random numbers: any whole number below 2^32.
  void Seed(const char* name, std::uint64_t* value, const char* help);
  void Flag(const char* name, bool* value, const char* help);
  /// `names` are those of the enumerators, which count from 0.
  template <class Enum>
  void Choice(const char* name, Enum* value, std::initializer_list<const char*> names,
              const char* help) {
    Add(name,
        OptionChoice{
            value,
            [](const void* from) { return static_cast<int>(*static_cast<const Enum*>(from)); },
            [](void* to, int index) { *static_cast<Enum*>(to) = static_cast<Enum>(index); },
            {names.begin(), names.end()}},
        {}, "", help);
  }
  /// Each with a path of its own: name.0, name.1, ...
  template <std::size_t Count>
  void Numbers(const char* name, std::array<double, Count>* values, OptionRange range,
               const char* unit, const char* help) {
    for (std::size_t i = 0; i < Count; ++i) {
      Number(fmt::format("{}.{}", name, i).c_str(), &(*values)[i], range, unit, help);
    }
  }
  /// A nested struct, which has its own description.
  template <class Options>
  void Group(const char* name, Options* options) {
    const std::string outside = prefix_;
    prefix_ += name;
    prefix_ += '.';
    Describe(*this, *options);
    prefix_ = outside;
  }

  /// A rule beyond ranges: where it does not hold, "`name` is `value`; it must `must`".
  template <class Value>
  void Require(bool holds, const char* name, const Value& value, const std::string& must) {
    if (holds || !broken_rule_.empty()) return;
    broken_rule_ = fmt::format("{}{} is {}; it must {}", prefix_, name, value, must);
  }
  template <class Value>
  void RequireNotAbove(const char* name, const Value& value, const char* other,
                       const Value& other_value) {
    Require(value <= other_value, name, value,
            fmt::format("not exceed {}{}, which is {}", prefix_, other, other_value));
  }

  const std::vector<OptionField>& fields() const { return fields_; }
  const std::string& broken_rule() const { return broken_rule_; }  ///< the first; empty: none

 private:
  void Add(const char* name, decltype(OptionField::value) value, OptionRange range,
           const char* unit, const char* help);

  std::string prefix_, broken_rule_;
  std::vector<OptionField> fields_;
};

/// The options of a struct, in the order of its description. They point into it.
template <class Options>
OptionFields FieldsOf(Options& options) {
  OptionFields fields;
  Describe(fields, options);
  return fields;
}

/// The value as the shortest text that reads back to the same bits.
std::string TextOf(const OptionField& field);

/// Sets the option where the text is a value within its range. What is wrong, or an empty string.
std::string SetFrom(const std::string& text, const OptionField& field);

/// The first value out of range, else the first broken rule, else an empty string.
std::string FirstBrokenRule(const OptionFields& fields);

/// The first broken rule of a struct that has a description, with path, value and bound, or an
/// empty string.
template <class Options>
requires requires(OptionFields fields, Options options) { Describe(fields, options); }
std::string Validate(Options options) { return FirstBrokenRule(FieldsOf(options)); }

}  // namespace aisle::slam
