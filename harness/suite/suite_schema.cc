#include <nlohmann/json.hpp>

#include "harness/suite/describe_suite.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

/// Writes the description as a JSON Schema object; every element of a list is described once.
class SchemaWriter : public Fields {
 public:
  void Name(const Key& key, std::string* value, const Words& words) override {
    Json& property = Add(key, Word(words));
    if (!value->empty()) property["default"] = *value;
    word_[key.name] = Word(words);
  }
  void Text(const Key& key, std::string*) override {
    Add(key, {{"type", "string"}, {"minLength", 1}});
  }
  void Number(const Key& key, double* value, Range range) override {
    Add(key, Numeric("number", range))["default"] = *value;
  }
  void OptionalNumber(const Key& key, std::optional<double>*, Range range) override {
    const bool is_any = range.low <= -1e9 && range.high >= 1e9;
    Add(key, is_any ? Json{{"type", "number"}} : Numeric("number", range));
  }
  void Integer(const Key& key, int* value, Range range) override {
    Add(key, Numeric("integer", range))["default"] = *value;
  }
  void Names(const Key& key, std::vector<std::string>* values, const Words& words) override {
    Add(key, ListOf(Word(words)))["default"] = *values;
  }
  void Texts(const Key& key, std::vector<std::string>*, const Check&) override {
    Add(key, ListOf({{"type", "string"}, {"minLength", 1}}));
  }
  void CountOrList(const Key& key, std::vector<std::uint64_t>* values, int most) override {
    const Json count = {{"type", "integer"}, {"minimum", 1}, {"maximum", most}};
    const Json each = {{"type", "integer"}, {"minimum", 0}};
    const Json list = {{"type", "array"}, {"items", each}, {"minItems", 1}, {"uniqueItems", true}};
    Add(key, {{"anyOf", {count, list}}})["default"] = values->size();
  }
  void Numbers(const Key& key, std::vector<double>*, Range range) override {
    Add(key, ListOf(Numeric("number", range)));
  }
  void Values(const Key& key, std::map<std::string, std::string>*, const CheckValue&) override {
    const Json value = {{"type", {"number", "boolean", "string"}}};
    Add(key, {{"type", "object"}, {"additionalProperties", value}});
  }
  void Group(const Key& key, const Part& part) override {
    SchemaWriter writer;
    part(writer);
    Add(key, writer.Object());
  }
  void List(const Key& key, const std::function<void(std::size_t)>& resize, const Element& element,
            const char* plain) override {
    Json item = ElementOf(resize, element, false).Object();
    if (plain != nullptr) {
      item = {{"anyOf", {ElementOf(resize, element, true).word_.at(plain), item}}};
    }
    Json list = {{"type", "array"}, {"items", item}};
    if (key.required) list["minItems"] = 1;
    Add(key, std::move(list));
  }
  bool Has(const char*) const override { return false; }
  bool IsPlain() const override { return plain_; }
  void Fail(const char*, const std::string&) override {}

  Json Object() const {
    Json object = {{"type", "object"}, {"properties", properties_}};
    object["additionalProperties"] = false;
    if (!required_.empty()) object["required"] = required_;
    return object;
  }

 private:
  static SchemaWriter ElementOf(const std::function<void(std::size_t)>& resize,
                                const Element& element, bool plain) {
    SchemaWriter writer;
    writer.plain_ = plain;
    resize(1);
    element(writer, 0);
    resize(0);
    return writer;
  }
  static Json Word(const Words& words) {
    if (!words.known.empty()) return {{"enum", words.known}};
    return {{"type", "string"}, {"pattern", "^[A-Za-z0-9_.-]{1,80}$"}};
  }
  static Json Numeric(const char* type, Range range) {
    return {{"type", type}, {"minimum", range.low}, {"maximum", range.high}};
  }
  /// One alone may drop its brackets.
  static Json ListOf(const Json& item) {
    const Json list = {{"type", "array"}, {"items", item}, {"minItems", 1}, {"uniqueItems", true}};
    return {{"anyOf", {item, list}}};
  }
  Json& Add(const Key& key, Json property) {
    Json described = {{"description", std::string(key.help) + "; e.g. " + key.example}};
    described.update(property);
    if (key.required) required_.emplace_back(key.name);
    return properties_[key.name] = std::move(described);
  }

  bool plain_ = false;
  Json properties_ = Json::object();
  std::map<std::string, Json> word_;
  std::vector<std::string> required_;
};

}  // namespace

std::string SuiteSchema(const Vocabulary& vocabulary) {
  SchemaWriter writer;
  Suite suite;
  Describe(writer, vocabulary, {}, &suite);
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "aisle suite"}};
  schema.update(writer.Object());
  return schema.dump(2) + "\n";
}

}  // namespace aisle
