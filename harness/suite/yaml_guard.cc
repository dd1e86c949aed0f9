#include "harness/suite/yaml_guard.h"

#include <yaml-cpp/eventhandler.h>

#include <sstream>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20;
constexpr int kMaxDepth = 32;

/// Sees the text as a stream of events, before any tree exists.
class Guard : public YAML::EventHandler {
 public:
  explicit Guard(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 2) FailAt(file_, mark, "expected one YAML document, got several");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { Check(mark, anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    FailAt(file_, mark, "aliases (*name) are not allowed; write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    Check(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Enter(mark, anchor);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Enter(mark, anchor);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void Check(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor != 0) FailAt(file_, mark, "anchors (&name) are not allowed; write the value out");
  }
  void Enter(const YAML::Mark& mark, YAML::anchor_t anchor) {
    Check(mark, anchor);
    if (++depth_ > kMaxDepth) {
      FailAt(file_, mark, fmt::format("nested deeper than {} levels", kMaxDepth));
    }
  }

  const std::string& file_;
  int documents_ = 0;
  int depth_ = 0;
};

/// Where a line begins with a tab, which YAML takes for no indentation; absent where none does.
std::optional<YAML::Mark> IndentingTab(const std::string& text) {
  YAML::Mark mark;
  for (std::size_t begin = 0; begin < text.size(); ++mark.line) {
    const std::size_t first = text.find_first_not_of(' ', begin);
    if (first != std::string::npos && text[first] == '\t') {
      mark.column = static_cast<int>(first - begin);
      return mark;
    }
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;
    begin = end + 1;
  }
  return std::nullopt;
}

void RefuseDuplicateKeys(const YAML::Node& node, const std::string& file) {
  std::map<std::string, YAML::Mark> seen;
  for (const auto& entry : node) {
    if (!node.IsMap()) {
      RefuseDuplicateKeys(entry, file);
      continue;
    }
    if (!entry.first.IsScalar()) FailAt(file, entry.first.Mark(), "a key must be a plain word");
    const auto [at, is_new] = seen.emplace(entry.first.Scalar(), entry.first.Mark());
    if (!is_new) {
      FailAt(file, entry.first.Mark(),
             fmt::format("duplicate key '{}' (first in line {}); keep one of them",
                         Printable(entry.first.Scalar()), at->second.line + 1));
    }
    RefuseDuplicateKeys(entry.second, file);
  }
}

}  // namespace

void FailAt(const std::string& file, const YAML::Mark& mark, const std::string& message) {
  throw InputError(
      fmt::format("{}:{}:{}: {}", Printable(file, 4096), mark.line + 1, mark.column + 1, message));
}

YAML::Node ParseYaml(const std::string& text, const std::string& file) {
  try {
    std::istringstream events(text);
    YAML::Parser parser(events);
    Guard guard(file);
    while (parser.HandleNextDocument(guard)) {
    }
    YAML::Node node = YAML::Load(text);
    RefuseDuplicateKeys(node, file);
    return node;
  } catch (const YAML::ParserException& error) {
    if (const auto tab = IndentingTab(text)) {
      FailAt(file, *tab,
             "not YAML: lines are indented by a tab, which YAML does not allow; use spaces");
    }
    FailAt(file, error.mark, "not YAML: " + error.msg);
  }
}

YAML::Node LoadYaml(const std::string& file) {
  const std::string text = ReadFile(file);
  if (text.size() > kMaxBytes) {
    throw InputError(file, 0, fmt::format("larger than {} bytes", kMaxBytes));
  }
  return ParseYaml(text, file);
}

}  // namespace aisle
