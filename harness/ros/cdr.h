#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace aisle::ros {

/// The bytes are no message of the type that was asked for.
class CdrError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A struct that lists its fields (messages.h).
template <class T>
concept Message = requires {
  T::kType;
};

inline constexpr std::size_t kEncapsulation = 4;  ///< bytes before the first field

/// XCDR version 1, little endian, as rmw implementations write it. A number stands at a multiple of
/// its size, counted from behind the encapsulation; a text has its length with its end's zero; a
/// sequence its count; arrays and structs are bare.
class CdrWriter {
 public:
  CdrWriter() : bytes_("\0\1\0\0", kEncapsulation) {}
  std::string Take() { return std::move(bytes_); }

  template <class T>
  void operator()(const char* /*name*/, const T& value) {
    Put(value);
  }

 private:
  void Align(std::size_t size) {
    const std::size_t past = (bytes_.size() - kEncapsulation) % size;
    if (past != 0) bytes_.append(size - past, '\0');
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void Put(T value) {
    Align(sizeof value);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void Put(const std::string& text) {
    Put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text.c_str(), text.size() + 1);
  }
  template <class T>
  void Put(const std::vector<T>& sequence) {
    Put(static_cast<std::uint32_t>(sequence.size()));
    PutAll(sequence.data(), sequence.size());
  }
  template <class T, std::size_t n>
  void Put(const std::array<T, n>& array) {
    PutAll(array.data(), n);
  }
  template <Message T>
  void Put(const T& message) {
    T::Fields(*this, message);
  }
  template <class T>
  void PutAll(const T* first, std::size_t count) {
    if constexpr (std::is_arithmetic_v<T>) {
      if (count == 0) return;
      Align(sizeof(T));
      bytes_.append(reinterpret_cast<const char*>(first), count * sizeof(T));
    } else {
      for (std::size_t i = 0; i < count; ++i) Put(first[i]);
    }
  }

  std::string bytes_;
};

/// Reads XCDR version 1 of either byte order. Everything throws CdrError where the bytes run out or
/// say what cannot be; nothing is believed that is longer than they are.
class CdrReader {
 public:
  explicit CdrReader(std::string_view bytes);

  template <class T>
  void operator()(const char* /*name*/, T& value) {
    Get(&value);
  }
  /// Throws where more is left than padding.
  void ExpectEnd() const;

 private:
  std::string_view Take(std::size_t count);
  void Align(std::size_t size);

  template <class T>
  requires std::is_arithmetic_v<T>
  void Get(T* value) {
    Align(sizeof *value);
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), Take(raw.size()).data(), raw.size());
    if (swap_) std::reverse(raw.begin(), raw.end());
    if constexpr (std::is_same_v<T, bool>) {
      *value = raw[0] != 0;
    } else {
      *value = std::bit_cast<T>(raw);
    }
  }
  void Get(std::string* text);
  template <class T>
  void Get(std::vector<T>* sequence) {
    std::uint32_t count = 0;
    Get(&count);
    // An element takes a byte at the least: a larger count is a lie.
    if (count > bytes_.size() - at_) throw CdrError("a sequence is longer than the message");
    if constexpr (sizeof(T) == 1) {
      const std::string_view raw = Take(count);
      sequence->assign(raw.begin(), raw.end());
    } else {
      sequence->clear();
      for (std::uint32_t i = 0; i < count; ++i) Get(&sequence->emplace_back());
    }
  }
  template <class T, std::size_t n>
  void Get(std::array<T, n>* array) {
    for (T& element : *array) Get(&element);
  }
  template <Message T>
  void Get(T* message) {
    T::Fields(*this, *message);
  }

  std::string_view bytes_;  ///< behind the encapsulation
  std::size_t at_ = 0;
  bool swap_ = false;
};

/// The message's bytes, encapsulation first.
template <Message T>
std::string Serialize(const T& message) {
  CdrWriter writer;
  T::Fields(writer, message);
  return writer.Take();
}

/// Throws CdrError where the bytes are no such message.
template <Message T>
T Deserialize(std::string_view bytes) {
  CdrReader reader(bytes);
  T message;
  T::Fields(reader, message);
  reader.ExpectEnd();
  return message;
}

}  // namespace aisle::ros
