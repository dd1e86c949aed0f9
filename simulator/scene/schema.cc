#include <algorithm>
#include <nlohmann/json.hpp>

#include "simulator/scene/extend.h"
#include "simulator/scene/fields.h"
#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Writes the description as a JSON Schema object; every element of a list is described once.
class SchemaWriter : public Fields {
 public:
  void Number(const Key& key, double* value, Range range) override {
    Json& property = Add(key, Numeric("number", range));
    if (!key.required && range.Holds(*value)) property["default"] = Rounded(*value);
  }
  void Integer(const Key& key, int* value, Range range) override {
    Add(key, Numeric("integer", range))["default"] = *value;
  }
  void Flag(const Key& key, bool* value) override {
    Add(key, {{"type", "boolean"}})["default"] = *value;
  }
  void Name(const Key& key, std::string*) override {
    Add(key, {{"type", "string"}, {"pattern", "^[A-Za-z0-9_-]{1,80}$"}});
  }
  void Sentence(const Key& key, std::string*) override {
    Add(key, {{"type", "string"}, {"minLength", 1}});
  }
  void Sentences(const Key& key, std::vector<std::string>*) override {
    const Json text = {{"type", "string"}, {"minLength", 1}};
    Add(key, {{"type", "array"}, {"minItems", 1}, {"items", text}});
  }
  void Numbers(const Key& key, double*, std::size_t count, Range range) override {
    Add(key, Tuple("number", count, range));
  }
  void Integers(const Key& key, int*, std::size_t count, Range range) override {
    Add(key, Tuple("integer", count, range));
  }
  void Points(const Key& key, std::vector<Eigen::Vector2d>*, std::vector<Mark>*) override {
    Add(key, {{"type", "array"}, {"minItems", 1}, {"items", Tuple("number", 2, {-1000, 1000})}});
  }
  void Group(const Key& key, const Part& part) override {
    SchemaWriter writer;
    part(writer);
    Add(key, writer.Object());
    if (const Json needs = writer.Requirements(); !needs.empty()) needs_[key.name] = needs;
  }
  void List(const Key& key, const std::function<void(std::size_t)>& resize,
            const Element& element) override {
    SchemaWriter writer;
    resize(1);
    element(writer, 0);
    resize(0);
    Json item = writer.Object();  // a list is never made of two files: each is whole
    item.merge_patch(writer.Requirements());
    Json list = {{"type", "array"}, {"items", std::move(item)}};
    if (key.required) list["minItems"] = 1;
    Add(key, std::move(list));
  }
  Mark mark() const override { return {}; }
  Mark MarkOf(const char* /*key*/) const override { return {}; }
  bool Has(const char*) const override { return false; }

  Json Object() const {
    Json object = {{"type", "object"}, {"properties", properties_}};
    object["additionalProperties"] = false;
    return object;
  }
  /// What must be there, the groups included; empty where nothing must.
  Json Requirements() const {
    Json requirements = Json::object();
    if (!required_.empty()) requirements["required"] = required_;
    if (either_.size() == 1) requirements["anyOf"] = either_.front();
    if (either_.size() > 1) {
      for (const Json& one : either_) requirements["allOf"].push_back({{"anyOf", one}});
    }
    if (!needs_.empty()) requirements["properties"] = needs_;
    return requirements;
  }

 protected:
  void ChoiceIndex(const Key& key, int* index, std::initializer_list<const char*> names) override {
    Json& property = Add(key, {{"enum", std::vector<std::string>(names.begin(), names.end())}});
    property["default"] = *(names.begin() + *index);
  }

 private:
  /// Radians that come back as degrees carry rounding noise.
  static double Rounded(double value) { return std::round(value * 1e9) / 1e9; }

  static Json Numeric(const char* type, Range range) {
    return {{"type", type}, {"minimum", range.low}, {"maximum", range.high}};
  }
  static Json Tuple(const char* type, std::size_t count, Range range) {
    return {{"type", "array"},
            {"items", Numeric(type, range)},
            {"minItems", count},
            {"maxItems", count}};
  }
  Json& Add(const Key& key, Json property) {
    Json described = {{"description", std::string(key.help) + "; e.g. " + key.example}};
    described.update(property);
    if (key.required && key.unless == nullptr) required_.emplace_back(key.name);
    if (key.required && key.unless != nullptr) {
      either_.push_back(Json::array(
          {{{"required", Json::array({key.name})}}, {{"required", Json::array({key.unless})}}}));
    }
    return properties_[key.name] = std::move(described);
  }

  Json properties_ = Json::object();
  std::vector<std::string> required_;
  std::vector<Json> either_;     ///< for a key in whose place another may stand, the two
  Json needs_ = Json::object();  ///< requirements of groups, by their name
};

/// What must be there where a file says the rest: `less` of the top's keys need not, and `key` must
/// have `inner`.
Json Otherwise(Json needs, const std::vector<std::string>& less, const char* key,
               const char* inner) {
  Json required = Json::array({key});
  for (const Json& name : needs["required"]) {
    if (name != key && std::ranges::find(less, name.get<std::string>()) == less.end()) {
      required.push_back(name);
    }
  }
  needs["required"] = required;
  needs["properties"][key]["required"] = {inner};
  return needs;
}

}  // namespace

std::string SceneSchema() {
  SchemaWriter writer;
  Scene scene;
  Describe(writer, scene);
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "aisle scene"}};
  schema.update(writer.Object());
  // A scene that extends another has of it what it does not say itself, one that names a hall the
  // lamps; a hall's file with views is a scene of its own.
  const Json needs = writer.Requirements(), views = {{"required", {kViewsKey}}};
  schema["anyOf"] = {{{"required", {kExtendKey}}},
                     needs,
                     views,
                     Otherwise(needs, {"lights"}, kHallKey, kUseKey),
                     Otherwise(needs, {kHallKey, "lights"}, kVaryKey, kHallKey)};
  return schema.dump(2) + "\n";
}

}  // namespace aisle::sim
