#include "tests/system/program.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "harness/io/file.h"

namespace aisle {

namespace fs = std::filesystem;

namespace {

/// The smoke scene, cut to a dozen frames: enough for a map, two masks and a track.
std::string ShortScene() {
  std::string text = ReadFile(fs::path(AISLE_SOURCE_DIR) / "scenes/smoke/short.yaml");
  const std::string frames = "frames: 40";
  text.replace(text.find(frames), frames.size(), "frames: 12");
  const std::size_t schema = text.find('\n');  // the editor's line names a file of another folder
  return text.substr(schema + 1);
}

std::vector<std::string> Argv(const std::vector<std::string>& arguments) {
  std::vector<std::string> argv{AISLE_PROGRAM};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return argv;
}

}  // namespace

fs::path ProgramTest::root_;

namespace {

/// What all tests share: scenes and the cache of their frames.
class SharedFolder : public testing::Environment {
 public:
  explicit SharedFolder(fs::path path) : path_(std::move(path)) {}
  void TearDown() override { fs::remove_all(path_); }

 private:
  fs::path path_;
};

}  // namespace

void ProgramTest::SetUpTestSuite() {
  if (!root_.empty()) return;
  root_ = fs::temp_directory_path() / fmt::format("aisle_system_{}", ::getpid());
  fs::create_directories(root_);
  testing::AddGlobalTestEnvironment(new SharedFolder(root_));
  ::setenv("AISLE_CACHE", (root_ / "cache").c_str(), 1);
}

void ProgramTest::TearDownTestSuite() {}

void ProgramTest::SetUp() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  folder_ = root_ / test.test_suite_name() / test.name();
  // Scenes stand beside each other under one name, so that all tests share their frames.
  scene_ = (root_ / "scenes" / "short.yaml").string();
  if (!fs::exists(scene_)) WriteFileAtomically(scene_, ShortScene());
}

void ProgramTest::TearDown() { fs::remove_all(folder_); }

Said ProgramTest::Run(const std::vector<std::string>& arguments, double timeout_s) {
  Process process(Argv(arguments), {.wall_s = timeout_s, .log_bytes = std::size_t{1} << 22});
  while (!process.Poll()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const ProcessResult& result = process.result();
  return {result.end == ProcessResult::End::kExited ? result.code : -1, result.log};
}

bool ProgramTest::Kill(const std::vector<std::string>& arguments, double after_s) {
  Process process(Argv(arguments), {});
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(after_s);
  while (std::chrono::steady_clock::now() < end) {
    if (process.Poll()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;  // the destructor kills it
}

std::string ProgramTest::Suite(const std::string& name, const std::string& systems,
                               const std::string& more) const {
  const fs::path path = folder_ / "suites" / (name + ".yaml");
  WriteFileAtomically(path, fmt::format("suite: {}\nquestion: Does it hold?\nscenes: [{}]\n"
                                        "systems:\n{}{}",
                                        name, scene_, systems, more));
  return path.string();
}

std::map<std::string, std::string> ProgramTest::Bits(const std::string& out) {
  std::map<std::string, std::string> bits;
  for (const RunRecord& run : ResultsOf(out).runs) {
    std::string& text = bits[RunId(run.spec)];
    text = Name(run.status) + " " + run.output_hash;
    for (const auto& [name, score] : run.scores) {
      if (name.starts_with("ms_") || name == "peak_rss_mib") continue;
      text += fmt::format(" {}={}", name, score.value ? fmt::format("{}", *score.value) : "-");
    }
  }
  return bits;
}

}  // namespace aisle
