#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace aisle {

/// How a text is to look where it goes.
struct TextLook {
  bool color = false;  ///< by ANSI codes
  std::size_t width =
      0;  ///< columns of the terminal; 0: none, as in a log, where a record is a line
};

/// The text in a colour by its ANSI code, "32", where colours are wanted.
std::string Painted(const std::string& text, const char* code, bool color);

/// Columns that a text takes on a terminal: its characters, without the codes of colours.
std::size_t ShownWidth(std::string_view text);

/// The text's first `width` columns; no character of it is cut in two.
std::string FirstColumns(const std::string& text, std::size_t width);

/// The text in lines of at most `width` columns, cut between words; all but the first begin with
/// `indent` spaces. A longer word is left whole, and so is the text where the width is 0.
std::string Wrapped(const std::string& text, std::size_t width, std::size_t indent = 0);

/// A table that fits the terminal: a name and its cells in a line where there is room, the name
/// above its cells where there is not. Titles stand in two lines before that. Rows can be had one
/// by one, while what they tell is measured.
class TextTable {
 public:
  struct Column {
    std::string title;
    std::size_t width = 0;  ///< of the widest cell
    bool is_left = false;   ///< words; numbers stand at the right
  };
  TextTable(Column name, std::vector<Column> columns, std::size_t width);
  /// Widens columns so that they hold these cells, one for each.
  static void Hold(const std::vector<std::string>& cells, std::vector<Column>* columns);

  std::string Heading() const;
  /// `remark` goes to the end of the line, or below it. A name that stood above the row before is
  /// not said again.
  std::string Row(const std::string& name, const std::vector<std::string>& cells,
                  const std::string& remark = "");

 private:
  std::size_t NeededWidth() const;
  /// "name  cells", or the cells alone below a name.
  std::string Line(const std::string& name, const std::vector<std::string>& cells) const;

  Column name_;
  std::vector<Column> columns_;
  std::size_t width_;
  std::size_t gap_ = 2;   ///< between columns
  bool stacked_ = false;  ///< the name above its cells
  std::string above_;     ///< the last name that stands there
};

}  // namespace aisle
