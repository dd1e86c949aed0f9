#include "harness/common/text_layout.h"

#include <algorithm>
#include <utility>

namespace aisle {
namespace {

constexpr std::size_t kBelow = 1;   // how far cells below their name stand in
constexpr std::size_t kRemark = 4;  // and remarks below their row

bool BeginsCharacter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) != 0x80;  // in UTF-8
}

std::vector<std::string> WordsOf(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

bool IsBlank(const std::string& text) { return text.find_first_not_of(' ') == std::string::npos; }

std::vector<std::string> Lines(const std::string& text, std::size_t first, std::size_t others) {
  std::vector<std::string> lines;
  for (const std::string& word : WordsOf(text)) {
    const std::size_t room = lines.size() > 1 ? others : first;
    const bool fits = !lines.empty() && ShownWidth(lines.back()) + 1 + ShownWidth(word) <= room;
    const bool is_indent = !lines.empty() && IsBlank(lines.back());  // stays with its first word
    if (fits || is_indent) {
      lines.back().append(" ").append(word);
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::size_t LongestWord(const std::string& text) {
  std::size_t longest = 0;
  for (const std::string& word : WordsOf(text)) longest = std::max(longest, ShownWidth(word));
  return longest;
}

std::string Padded(const std::string& text, const TextTable::Column& column) {
  const std::size_t shown = ShownWidth(text);
  const std::string spaces(column.width > shown ? column.width - shown : 0, ' ');
  return column.is_left ? text + spaces : spaces + text;
}

std::string WithoutTrailingSpaces(std::string text) {
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

}  // namespace

std::string Painted(const std::string& text, const char* code, bool color) {
  return color ? "\x1b[" + std::string(code) + "m" + text + "\x1b[0m" : text;
}

std::size_t ShownWidth(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\x1b') {
      i = std::min(text.find('m', i), text.size() - 1);
    } else {
      width += BeginsCharacter(text[i]) ? 1 : 0;
    }
  }
  return width;
}

std::string FirstColumns(const std::string& text, std::size_t width) {
  std::size_t shown = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    shown += BeginsCharacter(text[i]) ? 1 : 0;
    if (shown > width) return text.substr(0, i);
  }
  return text;
}

std::string Wrapped(const std::string& text, std::size_t width, std::size_t indent) {
  if (width == 0) return text;
  std::string wrapped;
  for (const std::string& line : Lines(text, width, width > indent ? width - indent : 1)) {
    if (!wrapped.empty()) wrapped.append("\n").append(indent, ' ');
    wrapped += line;
  }
  return wrapped;
}

TextTable::TextTable(Column name, std::vector<Column> columns, std::size_t width)
    : name_(std::move(name)), columns_(std::move(columns)), width_(width) {
  name_.is_left = true;
  name_.width = std::max(name_.width, ShownWidth(name_.title));
  const std::vector<Column> narrow = columns_;
  const auto hold_titles = [&](const auto& width_of) {
    columns_ = narrow;
    for (Column& column : columns_) column.width = std::max(column.width, width_of(column.title));
  };
  hold_titles([](const std::string& title) { return ShownWidth(title); });
  if (width_ == 0 || NeededWidth() <= width_) return;
  hold_titles(LongestWord);
  for (const auto& [stacked, gap] : {std::pair(false, 2), {false, 1}, {true, 2}, {true, 1}}) {
    stacked_ = stacked;
    gap_ = static_cast<std::size_t>(gap);
    if (NeededWidth() <= width_) return;
  }
}

void TextTable::Hold(const std::vector<std::string>& cells, std::vector<Column>* columns) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Column& column = (*columns)[i];
    column.width = std::max(column.width, ShownWidth(cells[i]));
  }
}

std::size_t TextTable::NeededWidth() const {
  std::size_t needed = stacked_ ? kBelow : name_.width + gap_;
  for (const Column& column : columns_) needed += column.width;
  return needed + gap_ * (columns_.size() - 1);
}

std::string TextTable::Line(const std::string& name, const std::vector<std::string>& cells) const {
  std::string line = stacked_ ? std::string(kBelow, ' ') : Padded(name, name_);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (i > 0 || !stacked_) line.append(gap_, ' ');
    line += Padded(cells[i], columns_[i]);
  }
  return line;
}

std::string TextTable::Heading() const {
  std::vector<std::vector<std::string>> titles;
  std::size_t rows = 1;
  for (const Column& column : columns_) {
    titles.push_back(Lines(column.title, column.width, column.width));
    rows = std::max(rows, titles.back().size());
  }
  std::string text = stacked_ ? name_.title + "\n" : "";
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<std::string> cells;
    for (const std::vector<std::string>& title : titles) {
      const std::size_t above = rows - title.size();  // they stand on the rows
      cells.push_back(row < above ? "" : title[row - above]);
    }
    text += WithoutTrailingSpaces(Line(row + 1 == rows ? name_.title : "", cells)) + "\n";
  }
  return text;
}

std::string TextTable::Row(const std::string& name, const std::vector<std::string>& cells,
                           const std::string& remark) {
  std::string text = stacked_ && name != above_ ? name + "\n" : "";
  above_ = name;
  const std::string line = Line(name, cells);
  const bool beside = width_ == 0 || ShownWidth(line) + 2 + ShownWidth(remark) <= width_;
  if (beside && !remark.empty()) return text + line + "  " + remark + "\n";
  text += WithoutTrailingSpaces(line) + "\n";
  return remark.empty()
             ? text
             : text + Wrapped(std::string(kRemark, ' ') + remark, width_, kRemark) + "\n";
}

}  // namespace aisle
