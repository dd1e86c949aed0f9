#include <pybind11/stl.h>

#include "harness/python/arrays.h"
#include "harness/python/module.h"
#include "harness/python/track.h"
#include "harness/score/coverage.h"
#include "harness/score/mask_images.h"
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

/// What would have no effect is a mistake about what was asked.
void RefuseIdle(const ScoreOptions& options) {
  if (options.relative.along_estimate && options.relative.unit != DeltaUnit::kMetres) {
    throw py::value_error("along_estimate measures metres: it is for unit=\"metres\"");
  }
  if (options.alignment.first_n > 0 && options.alignment.method == AlignmentMethod::kNone) {
    throw py::value_error("align_first: nothing is aligned with align=\"none\"");
  }
}

std::int64_t NanosecondsOf(double seconds, const char* name) {
  if (seconds >= 0 && seconds <= 1e6) return std::llround(seconds * 1e9);
  throw py::value_error(fmt::format("{} is {}: expected 0 to 1e6 seconds", name, seconds));
}

Scorecard ScoreTracks(const Track& truth, const Track& estimate, const std::string& align,
                      const std::string& association, double delta, const std::string& unit,
                      double rate_hz, std::size_t align_first,
                      const std::optional<double>& max_difference_s, bool all_pairs,
                      bool along_estimate) {
  ScoreOptions options;
  options.alignment = {.method = AlignmentFromName(align), .first_n = align_first};
  options.association.rule = RuleFromName(association);
  if (max_difference_s) {
    options.association.max_difference_ns = NanosecondsOf(*max_difference_s, "max_difference_s");
  }
  options.relative = {.delta = delta,
                      .unit = UnitFromName(unit),
                      .all_pairs = all_pairs,
                      .along_estimate = along_estimate};
  RefuseIdle(options);
  TrajectoryScore score;
  {
    const py::gil_scoped_release others_may_run;
    score = ScoreTrajectory(truth.poses, estimate.poses, options);
    AddCoverageOfFiles(truth.poses, estimate.poses, options, rate_hz, &score);
  }
  Warn(score.notes);
  return score.scores;
}

OutlineOptions OutlineFrom(const std::optional<double>& px, const std::optional<double>& share,
                           bool davis) {
  if (px.has_value() + share.has_value() + davis > 1) {
    throw py::value_error("boundary_px, boundary_share and boundary_davis exclude each other");
  }
  if (px && !(*px >= 0 && *px <= 1e4)) throw py::value_error("boundary_px: expected 0 to 1e4");
  if (share && !(*share >= 0 && *share <= 1))
    throw py::value_error("boundary_share: expected 0 to 1");
  return {.px = px, .share = share, .davis = davis};
}

Scorecard ScoreMaskArrays(const std::vector<ByteArray>& truth, const std::vector<ByteArray>& masks,
                          const std::optional<double>& boundary_px,
                          const std::optional<double>& boundary_share, bool boundary_davis) {
  if (truth.size() != masks.size()) {
    throw py::value_error(
        fmt::format("{} true masks, but {} to score", truth.size(), masks.size()));
  }
  const auto pair_at = [&](std::size_t i) -> MaskPair {
    MaskPair pair{MaskFrom(truth[i], fmt::format("truth[{}]", i)),
                  MaskFrom(masks[i], fmt::format("masks[{}]", i))};
    if (pair.truth.size() != pair.mask.size()) {
      throw py::value_error(fmt::format("masks[{}] has another size than its true mask", i));
    }
    return pair;
  };
  return ScoreMaskImages(truth.size(), pair_at,
                         OutlineFrom(boundary_px, boundary_share, boundary_davis));
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
      .def_readonly("value", &Score::value, "None where it is undefined: see `absent`.")
      .def_readonly("unit", &Score::unit, "\"m\", \"deg\", \"1\", \"ms\", \"%\", ...")
      .def_readonly("alignment", &Score::alignment, "\"se3\", ...; empty where it has no meaning.")
      .def_readonly("n", &Score::n, "Samples behind the value.")
      .def_readonly("absent", &Score::absent, "Why there is no value; else empty.")
      .def("__float__", Number)
      .def("__repr__", [](const Score& score) { return "<aisle.Score " + ToText(score) + ">"; });
  module.def(
      "score", ScoreTracks, py::arg("truth"), py::arg("estimate"), py::kw_only(),
      py::arg("align") = "se3", py::arg("association") = "nearest", py::arg("delta") = 1.0,
      py::arg("unit") = "frames", py::arg("rate_hz") = 0.0, py::arg("align_first") = 0,
      py::arg("max_difference_s") = py::none(), py::arg("all_pairs") = false,
      py::arg("along_estimate") = false,
      "{name: Score} of an estimated Trajectory: absolute errors after `align` (none, origin, "
      "posyaw, se3, sim3),\nrelative ones over `delta` of `unit` (frames, metres, seconds), "
      "KITTI's drift, coverage. association: nearest,\nevo, tum or index. rate_hz: of the "
      "camera, for coverage; 0: the slower of both. align_first: "
      "align on the first so many\npairs only; 0: all. max_difference_s: between stamps that "
      "belong together; None: the rule's own. all_pairs: a\nrelative error from every pose on. "
      "along_estimate: measure metres along the estimate. Warns where the two look\nas if they "
      "named different frames.");
  module.def(
      "score_masks", ScoreMaskArrays, py::arg("truth"), py::arg("masks"), py::kw_only(),
      py::arg("boundary_px") = py::none(), py::arg("boundary_share") = py::none(),
      py::arg("boundary_davis") = false,
      "{name: Score} of masks, a list of arrays each, uint8 or bool (height, width), not 0 = "
      "moves: pixels, outlines,\nand objects, which are blobs. Outlines meet within boundary_px "
      "(3), or "
      "boundary_share of the image's diagonal,\nor with boundary_davis as DAVIS's own program has "
      "it: its outline, 0.008 of the diagonal, mean over frames.");
  module.def("score_names", NamesOfScores, "{name: (unit, sentence)} of every score there is.");
}

}  // namespace aisle::python
