#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace aisle {

/// Help whose descriptions of options and commands end at column `width`; 0: each in one line, as
/// for a file. Examples, which are there to be copied, stay whole.
class HelpFormat : public CLI::Formatter {
 public:
  explicit HelpFormat(std::size_t width) : width_(width) {}

  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;

 private:
  std::string InColumn(const std::string& description) const;

  std::size_t width_;
};

}  // namespace aisle
