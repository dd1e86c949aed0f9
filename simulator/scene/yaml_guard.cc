#include "simulator/scene/yaml_guard.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <optional>
#include <set>
#include <sstream>

namespace aisle::sim {
namespace {

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxNodes = 100'000;

class Guard : public YAML::EventHandler {
 public:
  Guard(int file, Issues* issues) : file_(file), issues_(issues) {}

  bool went_too_far() const { return nodes_ > kMaxNodes || too_deep_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 2)
      issues_->Add(ToMark(mark), "", "expected one YAML document, got several");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { Node(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    issues_->Add(ToMark(mark), "", "aliases (*name) are not allowed; write the value out");
    Node(mark, 0);
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string& value) override {
    if (!open_.empty() && open_.back().is_map && open_.back().expects_key &&
        !open_.back().keys.insert(value).second) {
      issues_->Add(ToMark(mark), value, "duplicate key; keep one of them");
    }
    Node(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Node(mark, anchor);
    Open(mark, false);
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    if (!open_.empty() && open_.back().is_map && open_.back().expects_key) {
      issues_->Add(ToMark(mark), "", "a map cannot be a key");
    }
    Node(mark, anchor);
    Open(mark, true);
  }
  void OnMapEnd() override { open_.pop_back(); }

 private:
  struct Level {
    bool is_map;
    bool expects_key;
    std::set<std::string> keys;
  };

  void Node(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) {
      issues_->Add(ToMark(mark), "", "anchors (&name) are not allowed; write the value out");
    }
    if (++nodes_ == kMaxNodes + 1) {
      issues_->Add(ToMark(mark), "", fmt::format("the file has more than {} values", kMaxNodes));
    }
    if (!open_.empty() && open_.back().is_map) open_.back().expects_key ^= true;
  }

  void Open(const YAML::Mark& mark, bool is_map) {
    open_.push_back({is_map, true, {}});
    if (open_.size() == kMaxDepth + 1 && !too_deep_) {
      too_deep_ = true;
      issues_->Add(ToMark(mark), "", fmt::format("nested more than {} levels deep", kMaxDepth));
    }
  }

  Mark ToMark(const YAML::Mark& mark) const { return {mark.line + 1, mark.column + 1, file_}; }

  const int file_;
  Issues* issues_;
  std::vector<Level> open_;
  std::size_t nodes_ = 0;
  int documents_ = 0;
  bool too_deep_ = false;
};

/// Where a line begins with a tab, which YAML takes for no indentation; absent where none does.
std::optional<Mark> IndentingTab(const std::string& text, int file) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && line[first] == '\t') {
      return Mark{number, static_cast<int>(first) + 1, file};
    }
  }
  return std::nullopt;
}

}  // namespace

void GuardYaml(const std::string& text, int file, Issues* issues) {
  std::istringstream stream(text);
  Guard guard(file, issues);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(guard) && !guard.went_too_far()) {
    }
  } catch (const YAML::Exception& error) {
    if (const std::optional<Mark> tab = IndentingTab(text, file)) {
      issues->Add(*tab, "",
                  "not YAML: the line is indented by a tab, which YAML does not allow; use spaces");
      return;
    }
    issues->Add({error.mark.line + 1, error.mark.column + 1, file}, "", "not YAML: " + error.msg);
  }
}

}  // namespace aisle::sim
