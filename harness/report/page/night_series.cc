#include "harness/report/page/night_series.h"

#include <chrono>
#include <map>
#include <set>

#include "harness/judge/onset.h"
#include "harness/record/group.h"

namespace aisle {
namespace {

using Key = std::tuple<std::string, std::string, std::string, std::string>;

/// Days since 1970 of "2026-01-31T02:00:00Z"; nothing for another text.
std::optional<double> DayOf(const std::string& iso) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  const int read =
      std::sscanf(iso.c_str(), "%d-%d-%dT%d:%d:%d", &year, &month, &day, &hour, &minute, &second);
  if (read != 6) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return static_cast<double>(days) + (hour * 3600 + minute * 60 + second) / 86400.0;
}

/// Places of the nights in time; their numbers where a date is none or they do not rise.
void PlaceNights(std::vector<Night>* nights) {
  std::vector<double> days;
  for (const Night& night : *nights) {
    if (const auto day = DayOf(night.started)) days.push_back(*day);
  }
  const bool dated = days.size() == nights->size() && std::is_sorted(days.begin(), days.end());
  for (std::size_t i = 0; i < nights->size(); ++i) {
    (*nights)[i].day = dated ? days[i] - days.front() : static_cast<double>(i);
  }
}

std::optional<NightChange> FailureOf(const NightSeries& series) {
  std::vector<bool> failed;
  for (const TrendPoint* point : series.points) {
    failed.push_back(point != nullptr && point->failed > 0);
  }
  const auto since = FailingSince(failed);
  if (!since) return std::nullopt;
  const TrendPoint& last = *series.points.back();
  return NightChange{.series = &series,
                     .night = *since,
                     .failing = true,
                     .before = 0,
                     .after = static_cast<double>(last.failed)};
}

std::optional<NightChange> ShiftOf(const NightSeries& series) {
  std::vector<std::optional<double>> values;
  for (const TrendPoint* point : series.points) {
    values.push_back(point == nullptr ? std::nullopt : point->median);
  }
  const auto onset = FindOnset(values);
  if (!onset) return std::nullopt;
  return NightChange{
      .series = &series,
      .night = onset->night,
      .before = onset->before,
      .after = onset->after,
      .worse = (onset->after > onset->before) != Followed(series.score).more_is_better};
}

/// What is read first: failures, then what got worse by the greatest factor.
double Urgency(const NightChange& change) {
  if (change.failing) return 1e9 + change.after;
  constexpr double kTiny = 1e-9;
  const double factor = std::abs(
      std::log(std::max(std::abs(change.after), kTiny) / std::max(std::abs(change.before), kTiny)));
  return change.worse ? 1e3 + factor : factor;
}

}  // namespace

const FollowedScore& Followed(const std::string& score) {
  static const FollowedScore kFollowed[] = {
      {"ate_rmse_m", "ATE RMSE", "cm", 100, false},
      {"ms_process_mean", "step", "ms", 1, false},
      {"coverage", "coverage", "%", 100, true},
      {"rpe_1s_trans_rmse_m", "RPE over 1 s", "cm", 100, false},
      {"mask_iou", "pixel IoU of the mask", "%", 100, true}};
  for (const FollowedScore& followed : kFollowed) {
    if (score == followed.score) return followed;
  }
  static const FollowedScore kUnknown{"", "score", "", 1, false};
  return kUnknown;
}

NightBook ReadNights(const std::vector<TrendPoint>& points) {
  NightBook book;
  std::set<std::string> systems;
  std::map<Key, std::map<std::size_t, const TrendPoint*>> by_key;
  for (const TrendPoint& point : points) {
    const bool same = !book.nights.empty() && book.nights.back().started == point.started &&
                      book.nights.back().commit == point.commit;
    if (!same) book.nights.push_back({point.started, point.commit, point.folder});
    if (point.score == "ate_rmse_m") book.nights.back().failed += point.failed;
    systems.insert(point.system);
    by_key[{point.scene, point.twin, point.system, point.score}][book.nights.size() - 1] = &point;
  }
  PlaceNights(&book.nights);
  const auto styles = StylesOf(systems);
  for (const auto& [key, of_night] : by_key) {
    NightSeries series;
    std::tie(series.scene, series.twin, series.system, series.score) = key;
    series.style = styles.at(series.system);
    series.points.resize(book.nights.size(), nullptr);
    for (const auto& [night, point] : of_night) series.points[night] = point;
    book.series.push_back(std::move(series));
  }
  return book;
}

std::vector<NightChange> ChangesOf(const NightBook& book) {
  std::vector<NightChange> changes;
  for (const NightSeries& series : book.series) {
    if (series.points.empty() || series.points.back() == nullptr) continue;
    if (const auto failure = FailureOf(series)) {  // what it leaves undone is no other news
      if (series.score == "ate_rmse_m") changes.push_back(*failure);
      continue;
    }
    if (const auto shift = ShiftOf(series)) changes.push_back(*shift);
  }
  std::stable_sort(changes.begin(), changes.end(), [](const NightChange& a, const NightChange& b) {
    return Urgency(a) > Urgency(b);
  });
  return changes;
}

}  // namespace aisle
