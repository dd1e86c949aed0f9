#include "simulator/mesh/gltf_value.h"

#include <nlohmann/json.hpp>

#include "simulator/mesh/import.h"

namespace aisle::sim {
namespace {

constexpr std::size_t kLargestWhole = std::size_t{1} << 53;

}  // namespace

void GltfValue::Fail(const std::string& what) const {
  throw ImportError(path_.empty() ? what : fmt::format("{}: {}", path_, what));
}

bool GltfValue::Has(const char* key) const { return json_->is_object() && json_->contains(key); }

GltfValue GltfValue::Get(const char* key) const {
  if (!json_->is_object()) Fail("it must be an object, {...}");
  const auto member = json_->find(key);
  if (member == json_->end()) Fail(fmt::format("'{}' is missing", key));
  return {&*member, path_.empty() ? key : fmt::format("{}.{}", path_, key)};
}

std::size_t GltfValue::Count(const char* key) const {
  if (!Has(key)) return 0;
  const GltfValue list = Get(key);
  if (!list.json_->is_array()) list.Fail("it must be a list, [...]");
  return list.json_->size();
}

GltfValue GltfValue::Item(const char* key, std::size_t index) const {
  const std::size_t count = Count(key);
  if (index >= count) Fail(fmt::format("{}[{}] does not exist; there are {}", key, index, count));
  const GltfValue list = Get(key);
  return {&(*list.json_)[index], fmt::format("{}[{}]", list.path_, index)};
}

std::vector<GltfValue> GltfValue::Items(const char* key) const {
  std::vector<GltfValue> items;
  const std::size_t count = Count(key);
  for (std::size_t i = 0; i < count; ++i) items.push_back(Item(key, i));
  return items;
}

std::size_t GltfValue::Whole() const {
  // A number such as 3.0 is whole too (glTF 2.0, 2.6).
  const bool is_number = json_->is_number();
  const double number = is_number ? json_->get<double>() : -1;
  if (!(number >= 0) || number > static_cast<double>(kLargestWhole) ||
      number != std::floor(number)) {
    Fail("it must be a whole number, 0 or more");
  }
  return static_cast<std::size_t>(number);
}

std::size_t GltfValue::IndexBelow(std::size_t count, const char* what) const {
  const std::size_t index = Whole();
  if (index >= count) Fail(fmt::format("{} {} does not exist; there are {}", what, index, count));
  return index;
}

std::size_t GltfValue::Whole(const char* key, std::size_t otherwise) const {
  return Has(key) ? Get(key).Whole() : otherwise;
}

std::optional<std::size_t> GltfValue::IndexBelow(const char* key, std::size_t count,
                                                 const char* what) const {
  if (!Has(key)) return std::nullopt;
  return Get(key).IndexBelow(count, what);
}

float GltfValue::Number() const {
  const float number = json_->is_number() ? static_cast<float>(json_->get<double>()) : NAN;
  if (!std::isfinite(number)) Fail("it must be a finite number");
  return number;
}

float GltfValue::Number(const char* key, float otherwise) const {
  return Has(key) ? Get(key).Number() : otherwise;
}

bool GltfValue::Flag(const char* key, bool otherwise) const {
  if (!Has(key)) return otherwise;
  const GltfValue flag = Get(key);
  if (!flag.json_->is_boolean()) flag.Fail("it must be true or false");
  return flag.json_->get<bool>();
}

std::string GltfValue::Text() const {
  if (!json_->is_string()) Fail("it must be a text");
  return json_->get<std::string>();
}

std::string GltfValue::Text(const char* key, const std::string& otherwise) const {
  return Has(key) ? Get(key).Text() : otherwise;
}

std::vector<float> GltfValue::Numbers(const char* key, std::size_t count) const {
  if (!Has(key)) return {};
  if (Count(key) != count) Get(key).Fail(fmt::format("it must have {} numbers", count));
  std::vector<float> numbers;
  for (const GltfValue& item : Items(key)) numbers.push_back(item.Number());
  return numbers;
}

}  // namespace aisle::sim
