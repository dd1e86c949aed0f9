#include "simulator/mesh/obj_check.h"

#include <charconv>

#include "simulator/mesh/import.h"

namespace aisle::sim {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kLongestFace = 1000;

/// Statements that need no look inside: groups, smoothing, materials, display.
constexpr std::array<std::string_view, 13> kOtherStatements = {
    "o",   "g",     "s",        "mg",       "usemtl",     "mtllib",   "usemap",
    "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
constexpr std::array<std::string_view, 8> kGeometryStatements = {"v", "vt", "vn", "vp",
                                                                 "f", "fo", "l",  "p"};

template <class List>
bool IsOneOf(std::string_view word, const List& words) {
  return std::ranges::find(words, word) != words.end();
}

std::vector<std::string_view> WordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

/// Calls `take(words, line number)` for every statement: lines that end in a backslash are joined,
/// comments and empty lines left out.
template <class Take>
void ForEachStatement(std::string_view text, const Take& take) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string joined;
  std::size_t number = 0, first = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    while (line.ends_with('\r')) line.remove_suffix(1);
    if (joined.empty()) first = number;
    const bool goes_on = line.ends_with('\\');
    if (goes_on) line.remove_suffix(1);
    joined += line.substr(0, std::min(line.find('#'), line.size()));
    joined += ' ';
    if (goes_on && !text.empty()) continue;
    if (const auto words = WordsOf(joined); !words.empty() && !take(words, first)) return;
    joined.clear();
  }
}

[[noreturn]] void Fail(std::size_t line, const std::string& what) {
  throw ImportError(fmt::format("line {}: {}", line, what));
}

std::optional<float> NumberIn(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  float number = 0;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (failed != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

void CheckNumbers(const std::vector<std::string_view>& words, std::size_t line, std::size_t least,
                  std::size_t most) {
  const std::size_t count = words.size() - 1;
  if (count < least || count > most) {
    Fail(line, fmt::format("{} has {} numbers; it takes {} to {}", words[0], count, least, most));
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (!NumberIn(words[i]))
      Fail(line, fmt::format("expected a finite number, got '{}'", words[i]));
  }
}

/// How many positions, texture coordinates and normals there are.
using Counts = std::array<long long, 3>;
constexpr std::array<const char*, 3> kCounted = {"vertex", "texture coordinate", "normal"};

/// One corner, v, v/t, v//n or v/t/n, counted from 1 or, below 0, from the last one so far.
void CheckCorner(std::string_view corner, std::size_t line, const Counts& so_far,
                 const Counts& in_all) {
  const std::string_view whole = corner;
  for (std::size_t kind = 0;; ++kind) {
    if (kind == 3) Fail(line, fmt::format("'{}' names more than v/t/n", whole));
    const std::size_t slash = std::min(corner.find('/'), corner.size());
    const std::string_view word = corner.substr(0, slash);
    long long index = 0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), index);
    const bool left_out = word.empty() && kind == 1 && slash < corner.size();
    if (!left_out && (failed != std::errc() || end != word.data() + word.size())) {
      Fail(line,
           fmt::format("'{}' is not a corner of a face, such as 1, 1/2, 1//3 or 1/2/3", whole));
    }
    if (!left_out && (index == 0 || index > in_all[kind] || index < -so_far[kind])) {
      Fail(line, fmt::format("{} {} does not exist; there are {}", kCounted[kind], index,
                             index < 0 ? so_far[kind] : in_all[kind]));
    }
    if (slash == corner.size()) return;
    corner.remove_prefix(slash + 1);
  }
}

std::optional<std::size_t> KindOf(std::string_view statement) {
  if (statement == "v") return 0;
  if (statement == "vt") return 1;
  if (statement == "vn") return 2;
  return std::nullopt;
}

void CheckElement(const std::vector<std::string_view>& words, std::size_t line,
                  const Counts& so_far, const Counts& in_all) {
  const std::size_t corners = words.size() - 1;
  const std::size_t least = words[0] == "p" ? 1 : words[0] == "l" ? 2 : 3;
  if (corners < least || corners > kLongestFace) {
    Fail(line, fmt::format("{} has {} corners; it takes {} to {}", words[0], corners, least,
                           kLongestFace));
  }
  for (std::size_t i = 1; i < words.size(); ++i) CheckCorner(words[i], line, so_far, in_all);
}

}  // namespace

bool LooksLikeObj(std::string_view text) {
  bool looks = false;
  ForEachStatement(text, [&](const auto& words, std::size_t) {
    looks = IsOneOf(words[0], kGeometryStatements) || IsOneOf(words[0], kOtherStatements);
    return false;
  });
  return looks;
}

void CheckObj(std::string_view text) {
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    Fail(1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + zero, '\n')),
         "there is a zero byte; OBJ is text");
  }
  Counts in_all = {0, 0, 0}, so_far = {0, 0, 0};
  ForEachStatement(text, [&](const auto& words, std::size_t) {
    if (const auto kind = KindOf(words[0])) ++in_all[*kind];
    return true;
  });
  ForEachStatement(text, [&](const auto& words, std::size_t line) {
    if (const auto kind = KindOf(words[0])) {
      CheckNumbers(words, line, *kind == 1 ? 1 : 3, *kind == 0 ? 7 : 3);
      ++so_far[*kind];
    } else if (words[0] == "f" || words[0] == "fo" || words[0] == "l" || words[0] == "p") {
      CheckElement(words, line, so_far, in_all);
    } else if (!IsOneOf(words[0], kOtherStatements)) {
      Fail(line,
           fmt::format(
               "'{}' is not a statement of a polygon mesh; save curves and surfaces as polygons",
               words[0]));
    }
    return true;
  });
}

}  // namespace aisle::sim
