#include "harness/campaign/ros_domain.h"

#include <unistd.h>

#include <cstdlib>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr int kLast = 101;  // ports of those above may be taken by outgoing connections

}  // namespace

RosDomain::RosDomain(const std::filesystem::path& locks) : number_(1 + ::getpid() % kLast) {
  try {
    for (int number = 1; number <= kLast && !lock_; ++number) {
      std::optional<FileLock> lock = FileLock::Try(locks / fmt::format("domain-{}.lock", number));
      if (!lock) continue;
      lock_.emplace(*std::move(lock));
      number_ = number;
    }
  } catch (const MachineError&) {
  } catch (const InputError&) {
  }
}

std::vector<std::string> RosDomain::Variables() const {
  std::vector<std::string> variables;
  const auto is_set = [](const char* name) { return std::getenv(name) != nullptr; };
  if (!is_set("ROS_DOMAIN_ID")) variables.push_back(fmt::format("ROS_DOMAIN_ID={}", number_));
  // The latter is what newer releases ask first, and what a user may have chosen.
  if (!is_set("ROS_LOCALHOST_ONLY") && !is_set("ROS_AUTOMATIC_DISCOVERY_RANGE")) {
    variables.emplace_back("ROS_LOCALHOST_ONLY=1");
  }
  return variables;
}

}  // namespace aisle
