// Results, baselines (which are results), records, frames.csv and closed drives with any values.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "harness/record/frames_csv.h"
#include "harness/record/results.h"
#include "tests/support/arbitrary.h"

namespace aisle {
namespace {

Score AnyScore() {
  return {.value = Perhaps(AnyNumber),
          .unit = AnyText(),
          .alignment = AnyText(),
          .n = AnyWhole<std::size_t>(),
          .absent = AnyText(),
          .basis = AnyText()};
}

RunRecord AnyRecord() {
  RunRecord record;
  record.spec.scene = AnyName();
  record.spec.scene_file = AnyText();
  record.spec.twin = AnyName();
  record.spec.system.name = AnyName();
  record.spec.system.like = AnyText();
  record.spec.system.options = AnyMap(3, AnyText);
  record.spec.seed = AnyWhole<std::uint64_t>();
  record.spec.repeat = AnyOf(1, 9);
  record.hall = AnyText();
  record.status = static_cast<RunStatus>(AnyOf(0, 5));
  record.status_why = AnyText();
  record.frames = AnyWhole<std::size_t>();
  record.rate_hz = AnyNumber();
  record.wall_s = AnyNumber();
  record.threads = AnyOf(0, 1 << 20);
  record.content_hash = AnyText();
  record.inputs_hash = AnyText();
  record.output_hash = AnyText();
  record.program = AnyText();
  record.commit = AnyText();
  record.cpu = AnyText();
  record.system_version = AnyText();
  record.last_words = AnyText();
  record.attempts = AnyOf(1, 3);
  record.flaky = AnyFlag();
  record.scores = AnyMap(4, AnyScore);
  record.notes = AnyList(3, AnyText);
  record.artifacts = AnyMap(3, AnyText);
  return record;
}

bool Equal(const Score& a, const Score& b) {
  return a.value == b.value && a.unit == b.unit && a.alignment == b.alignment && a.n == b.n &&
         a.absent == b.absent && a.basis == b.basis;
}

bool Equal(const RunRecord& a, const RunRecord& b) {
  const auto same_score = [](const auto& x, const auto& y) {
    return x.first == y.first && Equal(x.second, y.second);
  };
  return a.spec == b.spec && a.hall == b.hall && a.status == b.status &&
         a.status_why == b.status_why && a.frames == b.frames && a.rate_hz == b.rate_hz &&
         a.wall_s == b.wall_s && a.threads == b.threads && a.content_hash == b.content_hash &&
         a.inputs_hash == b.inputs_hash && a.output_hash == b.output_hash &&
         a.program == b.program && a.commit == b.commit && a.cpu == b.cpu &&
         a.system_version == b.system_version && a.last_words == b.last_words &&
         a.attempts == b.attempts && a.flaky == b.flaky && a.notes == b.notes &&
         a.artifacts == b.artifacts &&
         std::equal(a.scores.begin(), a.scores.end(), b.scores.begin(), b.scores.end(), same_score);
}

TEST(RecordRoundTrip, OfOneRun) {
  EXPECT_TRUE(rc::check([] {
    const RunRecord record = AnyRecord();
    RC_ASSERT(Equal(RecordFromJson(ToJson(record), "x"), record));
  }));
}

Verdict AnyVerdict() {
  return {.name = AnyText(),
          .passed = AnyFlag(),
          .flaky = AnyFlag(),
          .value = Perhaps(AnyNumber),
          .limit = Perhaps(AnyNumber),
          .why = AnyText(),
          .scene = AnyText(),
          .twin = AnyText(),
          .system = AnyText()};
}

bool Equal(const Verdict& a, const Verdict& b) {
  return a.name == b.name && a.passed == b.passed && a.flaky == b.flaky && a.value == b.value &&
         a.limit == b.limit && a.why == b.why && a.scene == b.scene && a.twin == b.twin &&
         a.system == b.system;
}

bool Equal(const FrameRow& a, const FrameRow& b);

template <class T>
bool AllEqual(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return Equal(x, y); });
}

TEST(RecordRoundTrip, OfANightAndSoOfABaseline) {
  EXPECT_TRUE(rc::check([] {
    const Results results{.provenance = {.version = AnyText(),
                                         .commit = AnyText(),
                                         .cpu = AnyText(),
                                         .os = AnyText(),
                                         .threads = AnyWhole<int>()},
                          .suite = AnyText(),
                          .question = AnyText(),
                          .started = AnyText(),
                          .rerun = AnyText(),
                          .suite_file = AnyText(),
                          .wall_s = AnyNumber(),
                          .runs = AnyList(3, AnyRecord),
                          .verdicts = AnyList(3, AnyVerdict)};
    const Results read = ResultsFromJson(ToJson(results), "x");
    RC_ASSERT(read.suite == results.suite && read.question == results.question);
    RC_ASSERT(read.started == results.started && read.rerun == results.rerun);
    RC_ASSERT(read.suite_file == results.suite_file && read.wall_s == results.wall_s);
    RC_ASSERT(read.provenance.cpu == results.provenance.cpu);
    RC_ASSERT(read.provenance.threads == results.provenance.threads);
    RC_ASSERT(AllEqual(read.runs, results.runs));
    RC_ASSERT(AllEqual(read.verdicts, results.verdicts));
    RC_ASSERT(ToJson(read) == ToJson(results));
  }));
}

Eigen::Vector3d AnyPoint() { return {AnyNumber(), AnyNumber(), AnyNumber()}; }

FrameRow AnyRow() {
  const auto thousandth = [] { return AnyOf(0, 1'000'000) / 1000.0; };  // of a ms, as printed
  return {.id = AnyWhole<std::int64_t>(),
          .stamp_ns = AnyWhole<std::int64_t>(),
          .state = static_cast<TrackingState>(AnyOf(0, 3)),
          .truth_m = AnyPoint(),
          .live_m = Perhaps(AnyPoint),
          .final_m = Perhaps(AnyPoint),
          .live_error_m = Perhaps(AnyNumber),
          .final_error_m = Perhaps(AnyNumber),
          .movers_share = AnyNumber(),
          .actors_share = AnyNumber(),
          .features = AnyWhole<int>(),
          .features_on_movers = AnyWhole<int>(),
          .inliers_on_movers = AnyWhole<int>(),
          .mask_iou = Perhaps(AnyNumber),
          .corners_rejected = Perhaps(AnyWhole<int>),
          .difficulty = {.static_texture_share = Perhaps(AnyNumber),
                         .flow_px = Perhaps(AnyNumber),
                         .blur_px = Perhaps(AnyNumber),
                         .parallax_px = Perhaps(AnyNumber)},
          .render_ms = thousandth(),
          .process_ms = thousandth()};
}

bool Equal(const FrameRow& a, const FrameRow& b) {
  const Difficulty &x = a.difficulty, &y = b.difficulty;
  return a.id == b.id && a.stamp_ns == b.stamp_ns && a.state == b.state && a.truth_m == b.truth_m &&
         a.live_m == b.live_m && a.final_m == b.final_m && a.live_error_m == b.live_error_m &&
         a.final_error_m == b.final_error_m && a.movers_share == b.movers_share &&
         a.actors_share == b.actors_share && a.features == b.features &&
         a.features_on_movers == b.features_on_movers &&
         a.inliers_on_movers == b.inliers_on_movers && a.mask_iou == b.mask_iou &&
         a.corners_rejected == b.corners_rejected &&
         x.static_texture_share == y.static_texture_share && x.flow_px == y.flow_px &&
         x.blur_px == y.blur_px && x.parallax_px == y.parallax_px && a.render_ms == b.render_ms &&
         a.process_ms == b.process_ms;
}

TEST(RecordRoundTrip, OfTheFramesOfARun) {
  EXPECT_TRUE(rc::check([] {
    const std::vector<FrameRow> rows = AnyList(5, AnyRow);
    RC_ASSERT(AllEqual(FrameRowsFromCsv(ToCsv(rows), "x"), rows));
  }));
}

}  // namespace
}  // namespace aisle
