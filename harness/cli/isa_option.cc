#include "harness/cli/isa_option.h"

namespace aisle {

void AddIsaOption(CLI::App* command, std::string* isa) {
  command->add_option("--isa", *isa, "instruction set of the tracer; avx2 (default) or native")
      ->check(CLI::IsMember({"avx2", "native"}));
}

}  // namespace aisle
