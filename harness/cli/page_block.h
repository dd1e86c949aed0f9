#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace aisle {

/// The option --into of a measuring command: a block of a Markdown page that its table goes to.
class PageBlock {
 public:
  /// `usual`: the block of a page that is named alone.
  explicit PageBlock(std::string usual) : usual_(std::move(usual)) {}

  CLI::Option* AddTo(CLI::App* command);
  /// Throws InputError where the page has no such block: before the first hour, not after the last.
  void Check() const;
  /// Writes the table and what it is of; nothing where nobody asked for it.
  void Write(const std::string& table) const;

 private:
  std::string usual_, into_;
};

}  // namespace aisle
