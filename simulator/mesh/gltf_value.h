#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace aisle::sim {

/// A value in the JSON of a glTF file that knows where it stands, so that every mistake found in it
/// is reported as "accessors[3].count: ...". Looks into JSON that must outlive it. Its functions
/// throw ImportError where the value is not what they are asked for.
class GltfValue {
 public:
  GltfValue(const nlohmann::json* json, std::string path) : json_(json), path_(std::move(path)) {}

  bool Has(const char* key) const;
  /// The member of an object; it must be there.
  GltfValue Get(const char* key) const;
  /// The number of items of the list under `key`; 0 when it is absent.
  std::size_t Count(const char* key) const;
  /// An item of the list under `key`; it must be there.
  GltfValue Item(const char* key, std::size_t index) const;
  /// The items of the list under `key`; none when it is absent.
  std::vector<GltfValue> Items(const char* key) const;

  /// The value itself as a whole number from 0 to 2^53.
  std::size_t Whole() const;
  /// The value itself as a place in a list of `count` things that are called `what`.
  std::size_t IndexBelow(std::size_t count, const char* what) const;
  std::size_t Whole(const char* key, std::size_t otherwise) const;
  std::optional<std::size_t> IndexBelow(const char* key, std::size_t count, const char* what) const;
  float Number(const char* key, float otherwise) const;
  bool Flag(const char* key, bool otherwise) const;
  std::string Text() const;
  std::string Text(const char* key, const std::string& otherwise) const;
  /// Exactly `count` finite numbers under `key`; empty when it is absent.
  std::vector<float> Numbers(const char* key, std::size_t count) const;

  [[noreturn]] void Fail(const std::string& what) const;

 private:
  float Number() const;

  const nlohmann::json* json_;
  std::string path_;
};

}  // namespace aisle::sim
