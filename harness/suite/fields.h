#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace aisle {

/// One key of a file.
struct Key {
  const char* name;
  const char* help;     ///< a sentence on what it is, with its unit
  const char* example;  ///< what may stand after the colon
  bool required = false;
};

struct Range {
  double low = -1e9, high = 1e9;
};

/// The words that may stand somewhere. Empty: any name.
struct Words {
  std::vector<std::string> known;
};

/// A file is described once, as a function that names every key of a struct, and the description is
/// used thrice: to read a file with every mistake at its place, to write its JSON Schema, and to
/// write its page in the reference. Each call leaves the value alone where the key is absent, so
/// defaults stand in the struct and nowhere else. Keys are visited in the order of the description,
/// not of the file: a later one may depend on what an earlier one has filled.
class Fields {
 public:
  virtual ~Fields() = default;
  using Part = std::function<void(Fields&)>;
  using Element = std::function<void(Fields&, std::size_t)>;
  /// What is wrong with a value, or an empty string.
  using Check = std::function<std::string(const std::string&)>;
  using CheckValue = std::function<std::string(const std::string& key, const std::string& value)>;

  /// Letters, digits, '_', '.' and '-', 1 to 80 of them; one of `words` where there are any.
  virtual void Name(const Key& key, std::string* value, const Words& words = {}) = 0;
  virtual void Text(const Key& key, std::string* value) = 0;
  virtual void Number(const Key& key, double* value, Range range) = 0;
  /// One that may be absent; then `*value` stays empty.
  virtual void OptionalNumber(const Key& key, std::optional<double>* value, Range range) = 0;
  virtual void Integer(const Key& key, int* value, Range range) = 0;
  /// A list of names, each once; one alone may drop its brackets.
  virtual void Names(const Key& key, std::vector<std::string>* values, const Words& words) = 0;
  /// A list of texts, each once and held against `check`; one alone may drop its brackets.
  virtual void Texts(const Key& key, std::vector<std::string>* values, const Check& check) = 0;
  /// A list of whole numbers, each once, or how many of them: 3 means 1, 2, 3.
  virtual void CountOrList(const Key& key, std::vector<std::uint64_t>* values, int most) = 0;
  /// A list of numbers, each within the range; one alone may drop its brackets.
  virtual void Numbers(const Key& key, std::vector<double>* values, Range range) = 0;
  /// A map from words to plain values, each held against `check`.
  virtual void Values(const Key& key, std::map<std::string, std::string>* values,
                      const CheckValue& check) = 0;
  virtual void Group(const Key& key, const Part& part) = 0;
  /// A list of maps; `resize` is called with their number before `element` is for each. A plain
  /// word in the list stands for a map of that one key, where `plain` is not null.
  virtual void List(const Key& key, const std::function<void(std::size_t)>& resize,
                    const Element& element, const char* plain = nullptr) = 0;

  /// Whether the key is there.
  virtual bool Has(const char* key) const = 0;
  /// Whether the map that is being described is a plain word in a list.
  virtual bool IsPlain() const = 0;
  /// A mistake that no single value shows, at the place of that key; of the map where it is absent.
  virtual void Fail(const char* key, const std::string& what) = 0;
};

}  // namespace aisle
