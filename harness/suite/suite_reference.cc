#include "harness/suite/describe_suite.h"

namespace aisle {
namespace {

/// Writes the description as rows of a table: path, meaning, what may stand there, default,
/// example.
class ReferenceWriter : public Fields {
 public:
  explicit ReferenceWriter(std::string path = "") : path_(std::move(path)) {}

  void Name(const Key& key, std::string* value, const Words& words) override {
    Row(key, words.known.empty() ? "a name" : OneOf(words), *value);
  }
  void Text(const Key& key, std::string*) override { Row(key, "a text", ""); }
  void Number(const Key& key, double* value, Range range) override {
    Row(key, "a number" + ToText(range), fmt::format("{}", *value));
  }
  void OptionalNumber(const Key& key, std::optional<double>*, Range range) override {
    Row(key, "a number" + ToText(range), "");
  }
  void Integer(const Key& key, int* value, Range range) override {
    Row(key, "an integer" + ToText(range), fmt::format("{}", *value));
  }
  void Names(const Key& key, std::vector<std::string>* values, const Words& words) override {
    Row(key, "a list of " + OneOf(words), fmt::format("{}", fmt::join(*values, ", ")));
  }
  void Texts(const Key& key, std::vector<std::string>*, const Check&) override {
    Row(key, "a list of texts", "");
  }
  void CountOrList(const Key& key, std::vector<std::uint64_t>* values, int most) override {
    Row(key, fmt::format("1 to {}, or a list", most), fmt::format("{}", values->size()));
  }
  void Numbers(const Key& key, std::vector<double>*, Range range) override {
    Row(key, "a list of numbers" + ToText(range), "");
  }
  void Values(const Key& key, std::map<std::string, std::string>*, const CheckValue&) override {
    Row(key, "a map of values", "");
  }
  void Group(const Key& key, const Part& part) override {
    Row(key, "a map", "");
    ReferenceWriter writer(path_ + key.name + ".");
    part(writer);
    text_ += writer.text();
  }
  void List(const Key& key, const std::function<void(std::size_t)>& resize, const Element& element,
            const char* plain) override {
    Row(key, plain == nullptr ? "a list of maps" : "a list of names or maps", "");
    ReferenceWriter writer(path_ + key.name + "[].");
    resize(1);
    element(writer, 0);
    resize(0);
    text_ += writer.text();
  }
  bool Has(const char*) const override { return false; }
  bool IsPlain() const override { return false; }
  void Fail(const char*, const std::string&) override {}

  const std::string& text() const { return text_; }

 private:
  static std::string OneOf(const Words& words) {
    return fmt::format("{}", fmt::join(words.known, ", "));
  }
  static std::string ToText(Range range) {
    if (range.low <= -1e9 && range.high >= 1e9) return "";
    if (range.high >= 1e9) return fmt::format(", {:g} or more", range.low);
    return fmt::format(", {:g} to {:g}", range.low, range.high);
  }
  void Row(const Key& key, const std::string& what, const std::string& value) {
    const std::string otherwise = key.required ? "(required)" : value.empty() ? "" : value;
    text_ += fmt::format("| `{}{}` | {} | {} | {} | `{}` |\n", path_, key.name, key.help, what,
                         otherwise, key.example);
  }

  std::string path_;
  std::string text_;
};

}  // namespace

std::string SuiteReference(const Vocabulary& vocabulary) {
  ReferenceWriter writer;
  Suite suite;
  Describe(writer, vocabulary, {}, &suite);
  return "| key | meaning | allowed values | default | example |\n|---|---|---|---|---|\n" +
         writer.text();
}

}  // namespace aisle
