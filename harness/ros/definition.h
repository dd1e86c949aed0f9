#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "harness/ros/cdr.h"

namespace aisle::ros {

/// "sensor_msgs/Image" -> "sensor_msgs/msg/Image", as bags name types.
std::string FullTypeName(const std::string& type);

/// Writes message definitions: a line "type name" per field, then each type it uses once, behind a
/// line of 80 "=" and "MSG: package/Type". Fields alone: constants and comments change no byte.
class DefinitionWriter {
 public:
  template <class T>
  void operator()(const char* name, const T& /*sample*/) {
    text_ += TypeText<T>() + ' ' + name + '\n';
  }

  template <Message T>
  std::string Of() {
    Add<T>();
    while (!waiting_.empty()) {
      const auto [type, add] = waiting_.front();
      waiting_.erase(waiting_.begin());
      text_.append(80, '=').append("\nMSG: ").append(type).append("\n");
      (this->*add)();
    }
    return text_;
  }

 private:
  template <class T>
  struct ElementOf;
  template <class T>
  struct ElementOf<std::vector<T>> {
    using Type = T;
  };

  template <class T>
  void Add() {
    const T sample;
    T::Fields(*this, sample);
  }

  template <class T>
  std::string TypeText() {
    if constexpr (std::is_same_v<T, bool>) {
      return "bool";
    } else if constexpr (std::is_floating_point_v<T>) {
      return "float" + std::to_string(8 * sizeof(T));
    } else if constexpr (std::is_integral_v<T>) {
      return (std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      return "string";
    } else if constexpr (Message<T>) {
      if (known_.insert(T::kType).second) waiting_.push_back({T::kType, &DefinitionWriter::Add<T>});
      return T::kType;
    } else if constexpr (requires { typename ElementOf<T>::Type; }) {
      return TypeText<typename ElementOf<T>::Type>() + "[]";
    } else {  // std::array
      return TypeText<typename T::value_type>() + '[' + std::to_string(std::tuple_size_v<T>) + ']';
    }
  }

  std::string text_;
  std::set<std::string> known_;
  std::vector<std::pair<std::string, void (DefinitionWriter::*)()>> waiting_;
};

template <Message T>
std::string DefinitionOf() {
  return DefinitionWriter().Of<T>();
}

}  // namespace aisle::ros
