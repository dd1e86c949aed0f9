#include <charconv>

#include "harness/io/trajectory.h"

namespace aisle {
namespace {

constexpr int kNanosecondDigits = 9;

struct Decimal {
  bool negative = false;
  std::string digits;  ///< without point
  int point = 0;       ///< digits before the decimal point; may lie outside the digits
};

bool SplitDecimal(std::string_view text, Decimal* decimal) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    decimal->negative = text.front() == '-';
    text.remove_prefix(1);
  }
  const std::size_t e = text.find_first_of("eE");
  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view power = text.substr(e + 1);
    if (!power.empty() && power.front() == '+') power.remove_prefix(1);
    const auto [end, error] = std::from_chars(power.data(), power.data() + power.size(), exponent);
    if (error != std::errc() || end != power.data() + power.size()) return false;
    text = text.substr(0, e);
  }
  const std::size_t dot = text.find('.');
  decimal->digits = std::string(text.substr(0, dot));
  decimal->point = static_cast<int>(decimal->digits.size()) + exponent;
  if (dot != std::string_view::npos) decimal->digits += text.substr(dot + 1);
  return !decimal->digits.empty() &&
         decimal->digits.find_first_not_of("0123456789") == std::string::npos &&
         std::abs(exponent) < 100;
}

}  // namespace

bool ParseSecondsToNs(std::string_view text, std::int64_t* stamp_ns) {
  Decimal decimal;
  if (!SplitDecimal(text, &decimal)) return false;
  const int wanted = decimal.point + kNanosecondDigits;  // digits down to whole nanoseconds
  std::string whole;
  for (int i = 0; i < wanted; ++i) {
    const auto at = static_cast<std::size_t>(i);
    whole += at < decimal.digits.size() ? decimal.digits[at] : '0';
  }
  const bool round_up = wanted >= 0 && static_cast<std::size_t>(wanted) < decimal.digits.size() &&
                        decimal.digits[static_cast<std::size_t>(wanted)] >= '5';
  std::int64_t value = 0;
  if (!whole.empty()) {
    const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), value);
    if (error != std::errc() || value >= std::int64_t{9'000'000'000'000'000'000}) return false;
  }
  value += round_up ? 1 : 0;
  *stamp_ns = decimal.negative ? -value : value;
  return true;
}

std::string FormatSeconds(std::int64_t stamp_ns) {
  const std::uint64_t magnitude = stamp_ns < 0 ? 0 - static_cast<std::uint64_t>(stamp_ns)
                                               : static_cast<std::uint64_t>(stamp_ns);
  return fmt::format("{}{}.{:09}", stamp_ns < 0 ? "-" : "", magnitude / 1'000'000'000,
                     magnitude % 1'000'000'000);
}

}  // namespace aisle
