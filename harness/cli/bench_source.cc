#include "harness/cli/bench_source.h"

#include <charconv>
#include <sstream>

#include "harness/cli/common_options.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/suite/suite.h"

namespace aisle {

void AddSourceOptions(CLI::App* command, BenchSource* source) {
  AddFolderFormat(command, &source->format);
  AddTwin(command, &source->twin);
  AddSeed(command, &source->seed);
  AddFramesDir(command, &source->frames_dir);
  AddThreads(command, &source->threads, "changes times, never results");
}

namespace {

/// Takes "@SEED" off the end of a view.
std::optional<std::uint64_t> TakeSeed(std::string* text) {
  const std::size_t at = text->rfind('@');
  if (at == std::string::npos) return std::nullopt;
  const char* const digits = text->data() + at + 1;
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(digits, text->data() + text->size(), seed);
  if (error != std::errc() || end != text->data() + text->size()) {
    throw InputError(Printable(*text) + ": expected a seed after @, for example paper/scene2@3");
  }
  text->resize(at);
  return seed;
}

bool IsThere(const std::string& source) {
  std::error_code error;
  return !source.empty() && std::filesystem::exists(SceneFile(source), error);
}

/// Takes "FROM-TO" from behind the last colon into the view; false where none stands there.
bool TakeStretch(std::string* text, BenchView* view) {
  const std::size_t colon = text->rfind(':');
  if (colon == std::string::npos) return false;
  int from = 0, to = 0;
  const char *begin = text->data() + colon + 1, *end = text->data() + text->size();
  const auto first = std::from_chars(begin, end, from);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != '-') return false;
  const auto last = std::from_chars(first.ptr + 1, end, to);
  if (last.ec != std::errc() || last.ptr != end || from < 0 || to <= from) return false;
  text->resize(colon);
  view->from = from;
  view->to = to;
  return true;
}

/// What is there may have a colon or an @ in its name: it is taken whole, or up to its stretch.
bool TakeByWholeName(std::string* text, BenchView* view) {
  if (IsThere(*text)) return true;
  std::string source = *text;
  BenchView stretch = *view;
  if (!TakeStretch(&source, &stretch) || !IsThere(source)) return false;
  *text = source;
  *view = stretch;
  return true;
}

}  // namespace

BenchView ParseView(const std::string& text) {
  BenchView view{.text = text, .path = {}};
  std::string source = text;
  if (!TakeByWholeName(&source, &view)) {
    view.seed = TakeSeed(&source);
    if (source.find(':') != std::string::npos && !TakeStretch(&source, &view)) {
      throw InputError(Printable(text) +
                       ": expected SOURCE:FROM-TO, for example paper/scene2:90-130");
    }
  }
  view.path = SceneFile(source);
  if (!std::filesystem::exists(view.path)) {
    throw InputError(Printable(source) +
                     ": not found: expected a scene (a file, or a name like paper/scene2) or a "
                     "recording's folder");
  }
  if (std::filesystem::is_directory(view.path)) {
    if (!view.seed) return view;
    throw InputError(Printable(text) + ": a recording has no seed; remove @ and what follows it");
  }
  view.scene = SceneName(view.path);
  view.assets_dir = AssetsDir().string();
  RefuseOutside(view, static_cast<std::size_t>(CountSceneFrames(view.path)));
  return view;
}

std::vector<BenchView> ReadViews(const std::string& file) {
  std::istringstream text(ReadFile(file));
  std::vector<BenchView> views;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line.empty() || line.starts_with('#')) continue;
    try {
      views.push_back(ParseView(line));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}:{}: {}", Printable(file), number, error.what()));
    }
  }
  if (views.empty())
    throw InputError(Printable(file) + ": no views in this file; expected one per line");
  return views;
}

}  // namespace aisle
