#include "harness/report/paper/tables.h"

#include <set>

#include "harness/contract/twin.h"
#include "harness/record/seed_values.h"
#include "harness/report/paper/base_table.h"
#include "harness/report/paper/printed.h"
#include "harness/report/paper/spread.h"

namespace aisle {
namespace {

constexpr int kNotThePapers = 0;  ///< number of a table that the paper has none of

struct Column {
  const char* title;
  const char* score;
  double factor;
  int decimals;
};

struct Kind {
  int number;  ///< of the paper's table
  const char* title;
  const char* caption;
  const char* unit;  ///< of all columns; empty where they name their own
  std::vector<Column> columns;
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = {
      {1,
       "Moving objects",
       "Each object of each frame, found where the rectangles overlap by half (IoU 0.5) or more. "
       "The paper's Table 1.",
       "",
       {{"moving", "objects_moving", 1, 0},
        {"found", "objects_found", 1, 0},
        {"missed", "objects_missed", 1, 0},
        {"invented", "objects_invented", 1, 0}}},
      {2,
       "Detection of moving objects",
       "By rectangle, found where the overlap (IoU) is 0.5 or more; the paper's equations (12) to "
       "(14). The paper's Table 2.",
       "",
       {{"precision [%]", "object_precision", 100, 1},
        {"recall [%]", "object_recall", 100, 1},
        {"IoU [%]", "object_iou", 100, 1}}},
      {3,
       "Drift and absolute error",
       "KITTI's segments at 5, 10, … 40 m, all segments pooled; absolute error as RMSE after rigid "
       "alignment. The paper's Table 3 has KITTI's own lengths.",
       "",
       {{"t rel [%]", "t_rel_short_percent", 1, 2},
        {"r rel [deg/100m]", "r_rel_short_deg_per_100m", 1, 2},
        {"t abs [m]", "ate_rmse_m", 1, 4}}},
      {4,
       "Absolute trajectory error [m]",
       "Final track, rigid alignment (SE(3)), never scaled; median over seeds. The paper's Table "
       "4.",
       "m",
       {{"RMSE", "ate_rmse_m", 1, 4},
        {"mean", "ate_mean_m", 1, 4},
        {"median", "ate_median_m", 1, 4},
        {"S.D.", "ate_std_m", 1, 4}}},
      {kNotThePapers,
       "Frames with a pose [%]",
       "What share of its drive each error above is of; a track with the hard part missing has a "
       "small error. Median over seeds. The paper states none.",
       "%",
       {{"coverage", "coverage", 100, 1}}},
      {5,
       "Relative pose error, translation [m]",
       "From each frame to the next; median over seeds. The paper's Table 5.",
       "m",
       {{"RMSE", "rpe_trans_rmse_m", 1, 4},
        {"mean", "rpe_trans_mean_m", 1, 4},
        {"median", "rpe_trans_median_m", 1, 4},
        {"S.D.", "rpe_trans_std_m", 1, 4}}},
      {6,
       "Time of the front end [ms]",
       "Mean per frame on this machine, in the caller's thread; tracking: features, stereo, pose, "
       "waiting for the map. The paper's Table 6.",
       "ms",
       {{"dynamic", "ms_dynamic_mean", 1, 1},
        {"tracking", "ms_tracking_mean", 1, 1},
        {"front end", "ms_front_end_mean", 1, 1}}},
      {kFigure11,
       "Largest trajectory error [m]",
       "Final track, rigid alignment (SE(3)); median over seeds. What the paper says of its Fig. "
       "11, "
       "for its own method the bound over all four scenes.",
       "m",
       {{"max", "ate_max_m", 1, 4}}},
      {kNotThePapers,
       "What movers cost",
       "RMSE of the final track over that of the same drive without people and vehicles (the twin "
       "empty): 1 where they cost nothing. The paper has no such twin.",
       "",
       {{"penalty", "dynamic_penalty", 1, 2}}}};
  return kinds;
}

std::vector<std::string> SystemsOf(const std::vector<SceneRuns>& scenes) {
  std::vector<std::string> names;
  for (const SceneRuns& scene : scenes) {
    for (const SystemRuns& system : scene.systems) {
      if (IsOnAnotherBase(system.runs.front()->spec.system)) continue;
      const bool known = std::find(names.begin(), names.end(), system.system) != names.end();
      if (!known) names.push_back(system.system);
    }
  }
  return names;
}

std::string Text(double value, const Column& column) {
  return fmt::format("{:.{}f}", value * column.factor, column.decimals);
}

std::string Cell(const SceneRuns& scene, const std::string& system, const Column& column) {
  for (const SystemRuns& runs : scene.systems) {
    if (runs.system != system) continue;
    const std::optional<double> value = MedianScore(runs.runs, column.score);
    if (value) return Text(*value, column);
  }
  return "-";
}

bool HasNumber(const NumberTable::Row& row) {
  return std::any_of(row.cells.begin(), row.cells.end(),
                     [](const std::string& cell) { return cell != "-"; });
}

/// How the seeds differ, as `write` (SpreadText, IntervalText) says it; "-" where MedianScore would
/// have none.
template <typename Write>
std::string SeedsCell(const SceneRuns& scene, const std::string& system, const Column& column,
                      const Write& write) {
  for (const SystemRuns& runs : scene.systems) {
    if (runs.system != system || !MedianScore(runs.runs, column.score)) continue;
    return write(ScoresOf(runs.runs, column.score),
                 [&](double value) { return Text(value, column); });
  }
  return "-";
}

std::size_t SeedsOf(const SceneRuns& scene) {
  std::size_t most = 0;
  for (const SystemRuns& runs : scene.systems) most = std::max(most, CountSeeds(runs.runs));
  return most;
}

/// Of Fig. 11 the scenes it shows; of the tables all.
bool BelongsInto(const Kind& kind, const std::string& scene) {
  const std::vector<PrintedRow>& printed = PrintedTable(kind.number);
  return kind.number != kFigure11 ||
         std::any_of(printed.begin(), printed.end(),
                     [&](const PrintedRow& row) { return scene == row.row; });
}

template <typename CellOf>
std::vector<std::string> CellsOf(const std::vector<std::string>& systems,
                                 const std::vector<Column>& columns, const CellOf& cell) {
  std::vector<std::string> cells;
  for (const std::string& system : systems) {
    for (const Column& column : columns) cells.push_back(cell(system, column));
  }
  return cells;
}

/// The medians, and of several seeds how they differ.
std::vector<NumberTable::Row> RowsOf(const SceneRuns& scene,
                                     const std::vector<std::string>& systems,
                                     const std::vector<Column>& columns) {
  const std::size_t seeds = SeedsOf(scene);
  const auto differ = [&](const auto& write) {
    return CellsOf(systems, columns, [&](const std::string& system, const Column& column) {
      return SeedsCell(scene, system, column, write);
    });
  };
  NumberTable::Row median{.name = scene.scene,
                          .scene = scene.scene,
                          .cells = CellsOf(systems, columns,
                                           [&](const std::string& system, const Column& column) {
                                             return Cell(scene, system, column);
                                           }),
                          .seeds = seeds,
                          .intervals = {}};
  if (seeds < 2) return {median};
  median.intervals = differ(IntervalText);
  return {median,
          {.name = SpreadRowName(seeds, scene.scene),
           .scene = scene.scene,
           .cells = differ(SpreadText),
           .spread = true,
           .seeds = seeds,
           .intervals = {}}};
}

/// Systems without any number in a table need no column in it.
void DropEmptyGroups(NumberTable* table) {
  const std::size_t width = table->columns.size();
  for (std::size_t g = table->groups.size(); g-- > 0;) {
    const auto at = static_cast<std::ptrdiff_t>(g * width);
    const auto step = static_cast<std::ptrdiff_t>(width);
    const bool empty =
        std::all_of(table->rows.begin(), table->rows.end(), [&](const NumberTable::Row& row) {
          return std::all_of(row.cells.begin() + at, row.cells.begin() + at + step,
                             [](const std::string& cell) { return cell == "-"; });
        });
    if (!empty) continue;
    table->groups.erase(table->groups.begin() + static_cast<std::ptrdiff_t>(g));
    for (NumberTable::Row& row : table->rows) {
      for (std::vector<std::string>* cells : {&row.cells, &row.intervals}) {
        if (!cells->empty()) cells->erase(cells->begin() + at, cells->begin() + at + step);
      }
    }
  }
}

/// What the paper printed under one name, in the columns of the systems that stand for its own.
/// Absent where it printed nothing of these.
std::optional<NumberTable::Row> PrintedRowOf(const std::string& name, const Kind& kind,
                                             const NumberTable& table) {
  const std::size_t width = kind.columns.size();
  NumberTable::Row row{.name = "as printed: " + name,
                       .scene = name,
                       .cells = std::vector<std::string>(table.groups.size() * width),
                       .printed = true,
                       .intervals = {}};
  bool any = false;
  for (const PrintedRow& printed : PrintedTable(kind.number)) {
    const auto group = std::find(table.groups.begin(), table.groups.end(), printed.system);
    if (printed.row != name || group == table.groups.end()) continue;
    const auto first = static_cast<std::size_t>(group - table.groups.begin()) * width;
    for (std::size_t c = 0; c < width; ++c) {
      Column as_printed = kind.columns[c];
      as_printed.factor = 1;
      row.cells[first + c] = printed.values[c] ? Text(*printed.values[c], as_printed) : "-";
    }
    any = true;
  }
  return any ? std::optional(row) : std::nullopt;
}

/// The paper's rows under our scenes of the same number, and after them those of its other data.
void AddPrinted(const Kind& kind, NumberTable* table) {
  std::vector<NumberTable::Row> rows;
  std::set<std::string> ours;
  std::optional<NumberTable::Row> printed;  // of the latest scene: stands under its spread
  const auto put_printed = [&] {
    if (printed) rows.push_back(*printed);
    printed.reset();
  };
  for (const NumberTable::Row& row : table->rows) {
    if (!row.spread) {
      put_printed();
      ours.insert(row.name);
      printed = PrintedRowOf(row.name, kind, *table);
    }
    rows.push_back(row);
  }
  put_printed();
  for (const PrintedRow& other : PrintedTable(kind.number)) {
    const std::string name = other.row;
    if (name.starts_with("paper/") || !ours.insert(name).second) continue;
    if (const auto row = PrintedRowOf(name, kind, *table)) rows.push_back(*row);
  }
  table->rows = std::move(rows);
}

/// Reports on other scenes need not be reminded of the paper.
bool FollowsThePaper(const std::vector<SceneRuns>& scenes) {
  return std::any_of(scenes.begin(), scenes.end(), [](const SceneRuns& scene) {
    return scene.scene.starts_with("paper/") || scene.scene.starts_with("street/");
  });
}

}  // namespace

std::vector<NumberTable> PaperTables(const std::vector<SceneRuns>& scenes) {
  std::vector<NumberTable> tables;
  for (const Kind& kind : Kinds()) {
    NumberTable table{.title = kind.title,
                      .caption = kind.caption,
                      .groups = SystemsOf(scenes),
                      .columns = {},
                      .unit = kind.unit,
                      .rows = {}};
    for (const Column& column : kind.columns) table.columns.emplace_back(column.title);
    for (const SceneRuns& scene : scenes) {
      if (scene.twin != twin::kLive || !BelongsInto(kind, scene.scene)) continue;
      const std::vector<NumberTable::Row> rows = RowsOf(scene, table.groups, kind.columns);
      if (HasNumber(rows.front())) table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    }
    if (table.rows.empty()) continue;
    DropEmptyGroups(&table);
    if (FollowsThePaper(scenes)) AddPrinted(kind, &table);
    tables.push_back(table);
  }
  if (auto by_base = BaseTable(scenes)) tables.push_back(std::move(*by_base));
  return tables;
}

}  // namespace aisle
