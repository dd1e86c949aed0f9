#include <pybind11/stl.h>

#include "harness/python/arrays.h"
#include "harness/python/module.h"
#include "harness/python/track.h"
#include "harness/score/coverage.h"
#include "harness/score/masks.h"
#include "harness/score/score_names.h"
#include "harness/score/scorecard.h"

namespace aisle::python {
namespace {

AssociationRule RuleFromName(const std::string& name) {
  if (name == "nearest") return AssociationRule::kNearest;
  if (name == "evo") return AssociationRule::kEvo;
  if (name == "tum") return AssociationRule::kTum;
  if (name == "index") return AssociationRule::kIndex;
  throw py::value_error("association '" + name + "': expected nearest, evo, tum or index");
}

DeltaUnit UnitFromName(const std::string& name) {
  if (name == "frames") return DeltaUnit::kFrames;
  if (name == "metres") return DeltaUnit::kMetres;
  if (name == "seconds") return DeltaUnit::kSeconds;
  throw py::value_error("unit '" + name + "': expected frames, metres or seconds");
}

/// What a reader must know besides: two files that name different frames, say.
void Warn(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) {
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 1) != 0) throw py::error_already_set();
  }
}

Scorecard ScoreTracks(const Track& truth, const Track& estimate, const std::string& align,
                      const std::string& association, double delta, const std::string& unit,
                      double rate_hz) {
  ScoreOptions options;
  options.alignment.method = AlignmentFromName(align);
  options.association.rule = RuleFromName(association);
  options.relative = {.delta = delta, .unit = UnitFromName(unit)};
  TrajectoryScore score;
  {
    const py::gil_scoped_release others_may_run;
    score = ScoreTrajectory(truth.poses, estimate.poses, options);
    const std::int64_t interval_ns =
        rate_hz > 0 ? std::llround(1e9 / rate_hz) : FrameIntervalNs(truth.poses, estimate.poses);
    AddCoverage(ErrorsOverFrames(truth.poses, score, interval_ns), align, &score.scores);
  }
  Warn(score.notes);
  return score.scores;
}

Scorecard ScoreMaskArrays(const std::vector<ByteArray>& truth,
                          const std::vector<ByteArray>& masks) {
  if (truth.size() != masks.size()) {
    throw py::value_error(
        fmt::format("{} true masks, but {} to score", truth.size(), masks.size()));
  }
  RunResult run;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const cv::Mat1b is = MaskFrom(truth[i], fmt::format("truth[{}]", i));
    const cv::Mat1b said = MaskFrom(masks[i], fmt::format("masks[{}]", i));
    if (is.size() != said.size()) {
      throw py::value_error(fmt::format("masks[{}] has another size than its true mask", i));
    }
    run.facts.emplace_back().mask = CompareMaskBlobs(is, said);
  }
  Scorecard scores = ScoreMasks(run);
  scores.erase("static_features_lost");  // needs the pictures, which nobody gave
  return scores;
}

double Number(const Score& score) {
  if (!score.value) throw py::value_error("no value: " + score.absent);
  return *score.value;
}

py::dict NamesOfScores() {
  py::dict names;
  for (const ScoreDescription& score : ScoreNames()) {
    names[py::str(score.name)] = py::make_tuple(score.unit, score.help);
  }
  return names;
}

}  // namespace

void BindScores(py::module_& module) {
  py::class_<Score>(module, "Score",
                    "A number that travels with its meaning; float(score) is the number.")
      .def_readonly("value", &Score::value, "None where there is none: see `absent`.")
      .def_readonly("unit", &Score::unit, "\"m\", \"deg\", \"1\", \"ms\", \"%\", ...")
      .def_readonly("alignment", &Score::alignment, "\"se3\", ...; empty where it has no meaning.")
      .def_readonly("n", &Score::n, "Samples behind the value.")
      .def_readonly("absent", &Score::absent, "Why there is no value; else empty.")
      .def("__float__", Number)
      .def("__repr__", [](const Score& score) { return "<aisle.Score " + ToText(score) + ">"; });
  module.def(
      "score", ScoreTracks, py::arg("truth"), py::arg("estimate"), py::kw_only(),
      py::arg("align") = "se3", py::arg("association") = "nearest", py::arg("delta") = 1.0,
      py::arg("unit") = "frames", py::arg("rate_hz") = 0.0,
      "{name: Score} of an estimated Trajectory: absolute errors after `align` (none, origin, "
      "posyaw, se3, sim3),\nrelative ones over `delta` of `unit` (frames, metres, seconds), "
      "KITTI's drift, coverage. association: nearest,\nevo, tum or index. rate_hz: of the "
      "camera, for coverage; 0: the slower of both. Warns where the two look as\nif they "
      "named different frames.");
  module.def(
      "score_masks", ScoreMaskArrays, py::arg("truth"), py::arg("masks"),
      "{name: Score} of masks, a list of arrays each, uint8 or bool (height, width), not 0 = "
      "moves: pixels, outlines,\nand objects, which are blobs.");
  module.def("score_names", NamesOfScores, "{name: (unit, sentence)} of every score there is.");
}

}  // namespace aisle::python
