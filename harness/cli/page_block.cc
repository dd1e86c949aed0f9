#include "harness/cli/page_block.h"

#include "harness/cli/typed_command.h"
#include "harness/io/file.h"
#include "harness/report/block/block.h"

namespace aisle {

CLI::Option* PageBlock::AddTo(CLI::App* command) {
  return command->add_option(
      "--into", into_,
      "Write the table into a block of a Markdown page: PAGE#BLOCK, or PAGE for its block '" +
          usual_ + "'");
}

void PageBlock::Check() const {
  if (into_.empty()) return;
  const BlockPlace place = ParseBlockPlace(into_, usual_);
  WithBlock(ReadFile(place.file), place, "");
}

void PageBlock::Write(const std::string& table) const {
  if (!into_.empty()) WriteBlock(ParseBlockPlace(into_, usual_), table, TypedCommand());
}

}  // namespace aisle
