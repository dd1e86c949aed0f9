#include "simulator/common/decimal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace aisle::sim {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";
constexpr std::string_view kDigits = "0123456789";

/// The digits of a decimal without its point, and how many of them stand before it, which may be
/// fewer than none or more than there are.
struct Digits {
  bool is_negative = false;
  std::string all = {};
  int before_point = 0;
};

/// All of the text as a whole number, or nothing.
template <class Integer>
std::optional<Integer> WholeOf(std::string_view text) {
  Integer whole = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, whole);
  return error == std::errc() && stopped == end ? std::optional(whole) : std::nullopt;
}

/// What follows the 'e', which may have either sign.
std::optional<int> ExponentOf(std::string_view text) {
  const bool has_sign = text.starts_with('+') || text.starts_with('-');
  if (text.find_first_of(kDigits) != (has_sign ? 1 : 0)) return std::nullopt;
  if (text.starts_with('+')) text.remove_prefix(1);
  constexpr int kMost = 99;  // no seconds have more, and the zeros are written out
  const std::optional<int> exponent = WholeOf<int>(text);
  return exponent && std::abs(*exponent) <= kMost ? exponent : std::nullopt;
}

std::optional<Digits> DigitsOf(std::string_view text) {
  Digits digits{.is_negative = text.starts_with('-')};
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t e = text.find_first_of("eE");
  const std::optional<int> exponent =
      e == std::string_view::npos ? 0 : ExponentOf(text.substr(e + 1));
  const std::string_view mantissa = text.substr(0, e);
  const std::size_t dot = mantissa.find('.');
  digits.all = mantissa.substr(0, dot);
  const auto whole = static_cast<int>(digits.all.size());
  if (dot != std::string_view::npos) digits.all += mantissa.substr(dot + 1);
  constexpr std::size_t kMostDigits = 1000;
  const bool is_number = exponent && !digits.all.empty() && digits.all.size() <= kMostDigits &&
                         digits.all.find_first_not_of(kDigits) == std::string::npos;
  if (!is_number) return std::nullopt;
  digits.before_point = whole + *exponent;
  return digits;
}

}  // namespace

std::vector<std::string_view> WordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t end = 0;;) {
    const std::size_t begin = line.find_first_not_of(kSpaces, end);
    if (begin == std::string_view::npos) return words;
    end = std::min(line.find_first_of(kSpaces, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
  }
}

std::optional<double> DecimalOf(std::string_view text) {
  const bool has_sign = text.starts_with('+');
  if (has_sign) text.remove_prefix(1);
  if (has_sign && text.starts_with('-')) return std::nullopt;
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stopped != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<std::int64_t> NanosecondsOf(std::string_view seconds) {
  const std::optional<Digits> digits = DigitsOf(seconds);
  if (!digits) return std::nullopt;
  constexpr int kNanosecondDigits = 9;
  const int wanted = digits->before_point + kNanosecondDigits;
  const auto digit = [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    return i >= 0 && at < digits->all.size() ? digits->all[at] : '0';
  };
  std::string whole = "0";
  for (int i = 0; i < wanted; ++i) whole += digit(i);
  constexpr std::int64_t kMost = 4'000'000'000'000'000'000;
  std::optional<std::int64_t> nanoseconds = WholeOf<std::int64_t>(whole);
  if (!nanoseconds || *nanoseconds > kMost) return std::nullopt;
  if (digit(wanted) >= '5') ++*nanoseconds;
  return digits->is_negative ? -*nanoseconds : *nanoseconds;
}

}  // namespace aisle::sim
