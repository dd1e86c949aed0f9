#include "harness/cli/help_format.h"

#include <sstream>

#include "harness/common/text_layout.h"

namespace aisle {

std::string HelpFormat::InColumn(const std::string& description) const {
  if (width_ == 0) return description;
  constexpr std::size_t kLeast = 30;  // columns: narrower text is no easier to read
  const std::size_t taken = get_column_width();
  return Wrapped(description, width_ > taken + kLeast ? width_ - taken : kLeast);
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  return InColumn(CLI::Formatter::make_option_desc(option));
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_display_name(true),
                           InColumn(command->get_description()), get_column_width());
  return out.str();
}

}  // namespace aisle
