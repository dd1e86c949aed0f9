#include "simulator/common/yaml_faults.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <optional>
#include <set>
#include <sstream>

#include "simulator/common/printable.h"

namespace aisle::sim {
namespace {

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxNodes = 100'000;
constexpr std::size_t kMaxFaults = 100;

/// Thrown out of the parser, which has no other end within a document.
struct WentTooFar {};

class Guard : public YAML::EventHandler {
 public:
  explicit Guard(std::vector<YamlFault>* faults) : faults_(faults) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 2) Add(mark, "", "expected one YAML document, got several");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { Node(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    Add(mark, "", "aliases (*name) are not allowed; write the value out");
    Node(mark, 0);
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string& value) override {
    if (!open_.empty() && open_.back().is_map && open_.back().expects_key &&
        !open_.back().keys.insert(value).second) {
      Add(mark, Printable(value), "duplicate key; keep one of them");
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
      Add(mark, "", "a map cannot be a key");
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
    if (anchor != 0) Add(mark, "", "anchors (&name) are not allowed; write the value out");
    if (++nodes_ > kMaxNodes) {
      Stop(mark, fmt::format("the file has more than {} values", kMaxNodes));
    }
    if (!open_.empty() && open_.back().is_map) open_.back().expects_key ^= true;
  }

  void Open(const YAML::Mark& mark, bool is_map) {
    open_.push_back({is_map, true, {}});
    if (open_.size() > kMaxDepth) {
      Stop(mark, fmt::format("nested more than {} levels deep", kMaxDepth));
    }
  }

  void Add(const YAML::Mark& mark, const std::string& key, const std::string& what) {
    if (faults_->size() + 1 >= kMaxFaults) Stop(mark, "too many mistakes; mend those above first");
    faults_->push_back({mark.line + 1, mark.column + 1, key, what});
  }

  [[noreturn]] void Stop(const YAML::Mark& mark, const std::string& why) {
    faults_->push_back({mark.line + 1, mark.column + 1, "", why});
    throw WentTooFar();
  }

  std::vector<YamlFault>* faults_;
  std::vector<Level> open_;
  std::size_t nodes_ = 0;
  int documents_ = 0;
};

/// Where a line begins with a tab, which YAML takes for no indentation; absent where none does.
std::optional<YamlFault> IndentingTab(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first != std::string::npos && line[first] == '\t') {
      return YamlFault{
          number, static_cast<int>(first) + 1, "",
          "not YAML: the line is indented by a tab, which YAML does not allow; use spaces"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<YamlFault> YamlFaults(const std::string& text) {
  std::vector<YamlFault> faults;
  std::istringstream stream(text);
  Guard guard(&faults);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(guard)) {
    }
  } catch (const WentTooFar&) {
    // It has said so.
  } catch (const YAML::Exception& error) {
    const YamlFault wrong{error.mark.line + 1, error.mark.column + 1, "",
                          "not YAML: " + Printable(error.msg, 200)};
    faults.push_back(IndentingTab(text).value_or(wrong));
  }
  return faults;
}

}  // namespace aisle::sim
