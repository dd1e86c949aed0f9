#include "harness/loop/server.h"

namespace aisle {

Server::Server(QueueRule rule, std::function<std::int64_t(std::int64_t)> latency_ns)
    : rule_(rule), latency_ns_(std::move(latency_ns)) {}

void Server::Begin(const Exposure& exposure, std::int64_t at_ns) {
  ++shown_;
  std::int64_t due = at_ns + latency_ns_(exposure.id);
  // Answers come in the order of their frames.
  if (!working_.empty()) due = std::max(due, working_.back().due_ns);
  working_.push_back({exposure.stamp_ns, due, std::nullopt});
  asked_ = exposure;
  asked_->wheels_before = wheels_before_;
  wheels_before_ = exposure.wheels;
}

void Server::Tell(const std::optional<Eigen::Isometry3d>& T_slam_rig, int map_id) {
  working_.back().T_slam_rig = T_slam_rig;
  working_.back().map_id = map_id;
  asked_.reset();
}

void Server::Offer(const Exposure& exposure) {
  if (working_.empty() || rule_ == QueueRule::kPipeline) {
    Begin(exposure, exposure.stamp_ns);
  } else if (rule_ == QueueRule::kNewest) {
    waiting_ = exposure;
  }
}

std::vector<Answer> Server::Due(std::int64_t now_ns) {
  std::vector<Answer> due;
  while (!asked_ && !working_.empty() && working_.front().due_ns <= now_ns) {
    due.push_back(working_.front());
    working_.pop_front();
    if (waiting_ && working_.empty()) {
      const Exposure next = *std::move(waiting_);
      waiting_.reset();
      Begin(next, std::max(due.back().due_ns, next.stamp_ns));
    }
  }
  return due;
}

std::optional<std::int64_t> Server::NextDue() const {
  if (working_.empty()) return std::nullopt;
  return working_.front().due_ns;
}

}  // namespace aisle
