#include "harness/record/history.h"

#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "harness/io/input_error.h"
#include "harness/record/group.h"
#include "harness/record/seed_values.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// The scores whose way through the nights is worth a look.
constexpr const char* kFollowed[] = {"ate_rmse_m", "coverage", "rpe_1s_trans_rmse_m", "mask_iou",
                                     "ms_process_mean"};

class Database {
 public:
  explicit Database(const fs::path& path) : path_(path.string()) {
    sqlite3* opened = nullptr;
    const int code = ::sqlite3_open(path_.c_str(), &opened);
    handle_.reset(opened);  // also one that could not be opened has to be closed
    if (code != SQLITE_OK) Fail("open");
    ::sqlite3_busy_timeout(opened, 10'000);  // another night may be writing
    // Not WAL, which needs all writers on one host: nights of a cluster share a network folder. A
    // file of before that somebody else reads just now is converted another time.
    ::sqlite3_exec(opened, "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
    Run("CREATE TABLE IF NOT EXISTS medians (suite TEXT, started TEXT, commit_id TEXT, "
        "scene TEXT, twin TEXT, system TEXT, score TEXT, median REAL, seeds INTEGER, "
        "PRIMARY KEY (suite, started, scene, twin, system, score)) WITHOUT ROWID");
    AddMissingColumns();
  }

  void Run(const std::string& sql) {
    if (::sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
      Fail("write");
    }
  }
  [[noreturn]] void Fail(const char* what) const {
    throw MachineError(
        fmt::format("{}: cannot {}: {}; if the file is damaged, move it away to start a new one",
                    path_, what, ::sqlite3_errmsg(handle())));
  }
  sqlite3* handle() const { return handle_.get(); }

 private:
  /// Files of earlier versions lack them.
  void AddMissingColumns() {
    for (const char* column : {"low REAL", "high REAL", "failed INTEGER", "limit_value REAL",
                               "version TEXT", "folder TEXT"}) {
      const std::string name = std::string(column).substr(0, std::string(column).find(' '));
      const bool there =
          ::sqlite3_table_column_metadata(handle(), nullptr, "medians", name.c_str(), nullptr,
                                          nullptr, nullptr, nullptr, nullptr) == SQLITE_OK;
      if (!there) Run(fmt::format("ALTER TABLE medians ADD COLUMN {}", column));
    }
  }

  struct Close {
    void operator()(sqlite3* handle) const { ::sqlite3_close(handle); }
  };
  const std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// SQLite makes an empty file and writes into it later. One that gets its name with its tables in
/// it is never empty, even where the process is killed or another night looks at it meanwhile: so
/// an empty file is one that was truncated.
void MakeHistory(const fs::path& path) {
  struct Aside {
    explicit Aside(fs::path name) : file(std::move(name)) {}
    ~Aside() {
      std::error_code gone;
      fs::remove(file, gone);
    }
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;
    const fs::path file;
  };
  const Aside aside(path.string() + fmt::format(".tmp-{}", ::getpid()));
  { const Database database(aside.file); }
  // A rename would take the place of a file that another night has made meanwhile. Where the file
  // system has no links, SQLite makes the file after all.
  std::error_code no_link;
  fs::create_hard_link(aside.file, path, no_link);
}

/// Throws MachineError for a file of no bytes, too, which SQLite takes for a new database.
Database OpenHistory(const fs::path& path) {
  std::error_code error;
  if (fs::file_size(path, error) == 0) {
    throw MachineError(path.string() +
                       ": damaged: the file is empty and earlier nights are missing; restore it "
                       "from a backup, or delete it to start a new one");
  }
  return Database(path);
}

/// A prepared statement whose values are bound, never pasted.
class Statement {
 public:
  Statement(const Database& database, const char* sql) : database_(database) {
    if (::sqlite3_prepare_v2(database.handle(), sql, -1, &handle_, nullptr) != SQLITE_OK) {
      database.Fail("read");
    }
  }
  ~Statement() { ::sqlite3_finalize(handle_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void Bind(int at, const std::string& text) {
    ::sqlite3_bind_text(handle_, at, text.c_str(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void Bind(int at, const std::optional<double>& value) {
    if (value) {
      ::sqlite3_bind_double(handle_, at, *value);
    } else {
      ::sqlite3_bind_null(handle_, at);
    }
  }
  void Bind(int at, std::size_t value) {
    ::sqlite3_bind_int64(handle_, at, static_cast<sqlite3_int64>(value));
  }
  /// True while there is a row.
  bool Step() {
    const int code = ::sqlite3_step(handle_);
    if (code != SQLITE_ROW && code != SQLITE_DONE) database_.Fail("read");
    return code == SQLITE_ROW;
  }
  void Reset() { ::sqlite3_reset(handle_); }
  std::string Text(int at) const {
    const unsigned char* text = ::sqlite3_column_text(handle_, at);
    return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
  }
  std::optional<double> Number(int at) const {
    if (::sqlite3_column_type(handle_, at) == SQLITE_NULL) return std::nullopt;
    return ::sqlite3_column_double(handle_, at);
  }

 private:
  const Database& database_;
  sqlite3_stmt* handle_ = nullptr;
};

/// What the night held the cell's score against.
std::optional<double> LimitOf(const Results& results, const SceneRuns& scene,
                              const SystemRuns& system, const std::string& score) {
  for (const Verdict& verdict : results.verdicts) {
    if (verdict.scene == scene.scene && verdict.twin == scene.twin &&
        verdict.system == system.system && verdict.name.ends_with(": " + score)) {
      return verdict.limit;
    }
  }
  return std::nullopt;
}

TrendPoint PointOf(const Results& results, const SceneRuns& scene, const SystemRuns& system,
                   const std::string& score) {
  TrendPoint point{.started = results.started,
                   .commit = results.provenance.commit,
                   .scene = scene.scene,
                   .twin = scene.twin,
                   .system = system.system,
                   .score = score,
                   .median = {},
                   .seeds = CountSeeds(system.runs),
                   .limit = LimitOf(results, scene, system, score),
                   .version = system.runs.front()->system_version};
  const std::vector<double> values = ScoresOf(system.runs, score);
  if (!values.empty()) {
    point.low = Quantile(values, 0.25);
    point.median = Quantile(values, 0.5);
    point.high = Quantile(values, 0.75);
  }
  std::vector<const RunRecord*> failed;
  std::ranges::copy_if(system.runs, std::back_inserter(failed),
                       [](const RunRecord* run) { return !IsComplete(run->status); });
  point.failed = CountSeeds(failed);
  return point;
}

/// How the file names a night's folder: from its own on.
std::string FolderFrom(const fs::path& database, const fs::path& report) {
  if (report.empty()) return "";
  fs::path folder = fs::absolute(report).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // "night/" is the folder "night"
  return folder.lexically_relative(fs::absolute(database).lexically_normal().parent_path())
      .string();
}

}  // namespace

std::string HistoryTrouble(const fs::path& path) {
  std::error_code error;
  fs::path folder = fs::absolute(path).parent_path();
  if (!fs::exists(path, error)) {
    while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
    if (!fs::is_directory(folder, error)) return folder.string() + ": not a folder";
    if (::access(folder.c_str(), W_OK) == 0) return "";
    return fmt::format("{}: not writable: {}", folder.string(), std::strerror(errno));
  }
  try {
    Database database = OpenHistory(path);
    Statement check(database, "PRAGMA quick_check(1)");
    if (check.Step() && check.Text(0) == "ok") {
      check.Reset();
      database.Run("BEGIN IMMEDIATE");
      database.Run("ROLLBACK");
      return "";
    }
    return path.string() + ": damaged (" + check.Text(0) + "): move it away to start a new one";
  } catch (const MachineError& trouble) {
    return trouble.what();
  }
}

void AppendToHistory(const fs::path& path, const Results& results, const fs::path& report) {
  std::error_code error;
  if (!fs::exists(path, error)) MakeHistory(path);
  Database database = OpenHistory(path);
  database.Run("BEGIN IMMEDIATE");
  Statement insert(
      database,
      "INSERT OR REPLACE INTO medians (suite, started, commit_id, scene, twin, system, "
      "score, version, folder, median, low, high, limit_value, seeds, failed) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  const std::string folder = FolderFrom(path, report);
  for (const SceneRuns& scene : GroupByScene(results)) {
    for (const SystemRuns& system : scene.systems) {
      for (const char* score : kFollowed) {
        const TrendPoint point = PointOf(results, scene, system, score);
        insert.Reset();
        int at = 0;
        for (const std::string& text :
             {results.suite, point.started, point.commit, point.scene, point.twin, point.system,
              point.score, point.version, folder}) {
          insert.Bind(++at, text);
        }
        for (const auto& value : {point.median, point.low, point.high, point.limit}) {
          insert.Bind(++at, value);
        }
        insert.Bind(++at, point.seeds);
        insert.Bind(++at, point.failed);
        insert.Step();
      }
    }
  }
  insert.Reset();
  database.Run("COMMIT");
}

std::string NightReplaced(const fs::path& path, const Results& results, const fs::path& report) {
  if (!fs::exists(path)) return "";
  try {
    const Database database = OpenHistory(path);
    Statement select(database,
                     "SELECT folder FROM medians WHERE suite = ? AND started = ? AND "
                     "folder NOT IN ('', ?) LIMIT 1");  // where it is not known, it may be this one
    int at = 0;
    for (const std::string& text : {results.suite, results.started, FolderFrom(path, report)}) {
      select.Bind(++at, text);
    }
    if (!select.Step()) return "";
    return fmt::format("this run replaces {} in the trends: both are of {} and started at {}",
                       select.Text(0), results.suite, results.started);
  } catch (const MachineError&) {
    return "";  // who files nights there says what is wrong with it
  }
}

std::vector<TrendPoint> ReadHistory(const fs::path& path, const std::string& suite) {
  std::vector<TrendPoint> points;
  if (!fs::exists(path)) return points;
  const Database database = OpenHistory(path);
  Statement select(database,
                   "SELECT started, commit_id, scene, twin, system, score, version, folder, "
                   "median, low, high, limit_value, seeds, failed FROM medians "
                   "WHERE suite = ? ORDER BY started, scene, twin, system, score");
  select.Bind(1, suite);
  const auto count = [&](int at) {
    return static_cast<std::size_t>(std::max(select.Number(at).value_or(0), 0.0));
  };
  while (select.Step()) {
    points.push_back({.started = select.Text(0),
                      .commit = select.Text(1),
                      .scene = select.Text(2),
                      .twin = select.Text(3),
                      .system = select.Text(4),
                      .score = select.Text(5),
                      .median = select.Number(8),
                      .low = select.Number(9),
                      .high = select.Number(10),
                      .seeds = count(12),
                      .failed = count(13),
                      .limit = select.Number(11),
                      .version = select.Text(6),
                      .folder = select.Text(7)});
  }
  return points;
}

}  // namespace aisle
