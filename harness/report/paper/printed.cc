#include "harness/report/paper/printed.h"

namespace aisle {
namespace {

// Objects that move, of them found, missed, and what was invented.
const std::vector<PrintedRow> kTable1 = {
    {"KITTI", "paper", {238, 203, 35, 27}},
    {"real scenes", "paper", {184, 165, 26, 16}},
};
// Precision, recall, IoU in per cent.
const std::vector<PrintedRow> kTable2 = {
    {"KITTI", "paper", {88.26, 85.30, 77.82}},
    {"real scenes", "paper", {91.16, 89.76, 82.53}},
};
// t rel in per cent, r rel in deg/100m, absolute RMSE in metres.
const std::vector<PrintedRow> kTable3 = {
    {"KITTI 01", "orbslam2", {1.39, 0.21, 10.4}}, {"KITTI 01", "semantic", {1.57, 0.22, 9.4}},
    {"KITTI 01", "paper", {1.52, 0.18, 9.1}},     {"KITTI 03", "orbslam2", {0.71, 0.18, 0.6}},
    {"KITTI 03", "semantic", {0.69, 0.18, 0.6}},  {"KITTI 03", "paper", {0.76, 0.25, 0.8}},
    {"KITTI 04", "orbslam2", {0.48, 0.13, 0.2}},  {"KITTI 04", "semantic", {0.45, 0.09, 0.2}},
    {"KITTI 04", "paper", {0.40, 0.20, 0.2}},     {"KITTI 05", "orbslam2", {0.40, 0.16, 0.8}},
    {"KITTI 05", "semantic", {0.40, 0.16, 0.8}},  {"KITTI 05", "paper", {0.38, 0.16, 0.7}},
    {"KITTI 07", "orbslam2", {0.50, 0.28, 0.5}},  {"KITTI 07", "semantic", {0.52, 0.29, 0.5}},
    {"KITTI 07", "paper", {0.42, 0.25, 0.4}},     {"KITTI 08", "orbslam2", {1.05, 0.32, 3.6}},
    {"KITTI 08", "semantic", {1.05, 0.32, 3.5}},  {"KITTI 08", "paper", {0.98, 0.29, 3.1}},
};
// Absolute error in metres: RMSE, mean, median, standard deviation.
const std::vector<PrintedRow> kTable4 = {
    {"paper/scene1", "orbslam2", {0.768, 0.534, 0.173, 0.552}},
    {"paper/scene1", "semantic", {0.001, 0.001, 0.001, 0.001}},
    {"paper/scene1", "paper", {0.010, 0.002, 0.001, 0.010}},
    {"paper/scene2", "orbslam2", {0.867, 0.850, 0.794, 0.169}},
    {"paper/scene2", "semantic", {0.085, 0.076, 0.073, 0.037}},
    {"paper/scene2", "paper", {0.086, 0.075, 0.073, 0.038}},
    {"paper/scene3", "orbslam2", {1.016, 0.853, 0.655, 0.552}},
    {"paper/scene3", "semantic", {0.076, 0.067, 0.058, 0.038}},
    {"paper/scene3", "paper", {0.080, 0.070, 0.063, 0.038}},
    {"paper/scene4", "orbslam2", {0.457, 0.413, 0.404, 0.200}},
    {"paper/scene4", "semantic", {0.118, 0.102, 0.091, 0.059}},
    {"paper/scene4", "paper", {0.115, 0.098, 0.088, 0.059}},
    {"paper/scene5", "orbslam2", {0.524, 0.482, 0.477, 0.206}},
    {"paper/scene5", "semantic", {0.115, 0.101, 0.092, 0.053}},
    {"paper/scene5", "paper", {0.113, 0.099, 0.093, 0.053}},
};
// Relative error of translation in metres: RMSE, mean, median, standard deviation.
const std::vector<PrintedRow> kTable5 = {
    {"paper/scene1", "orbslam2", {0.014, 0.009, 0.003, 0.011}},
    {"paper/scene1", "semantic", {0.001, 0.001, 0.001, 0.001}},
    {"paper/scene1", "paper", {0.007, 0.002, 0.001, 0.007}},
    {"paper/scene2", "orbslam2", {0.024, 0.018, 0.014, 0.016}},
    {"paper/scene2", "semantic", {0.017, 0.014, 0.013, 0.010}},
    {"paper/scene2", "paper", {0.018, 0.013, 0.013, 0.011}},
    {"paper/scene3", "orbslam2", {0.022, 0.019, 0.016, 0.012}},
    {"paper/scene3", "semantic", {0.017, 0.015, 0.014, 0.007}},
    {"paper/scene3", "paper", {0.019, 0.015, 0.015, 0.008}},
    {"paper/scene4", "orbslam2", {0.020, 0.017, 0.015, 0.010}},
    {"paper/scene4", "semantic", {0.019, 0.016, 0.014, 0.010}},
    {"paper/scene4", "paper", {0.018, 0.016, 0.015, 0.009}},
    {"paper/scene5", "orbslam2", {0.061, 0.028, 0.019, 0.054}},
    {"paper/scene5", "semantic", {0.018, 0.016, 0.016, 0.008}},
    {"paper/scene5", "paper", {0.021, 0.018, 0.016, 0.011}},
};
// Milliseconds: dynamic segmentation (DynaSLAM's on a graphics card), tracking, whole front end.
const std::vector<PrintedRow> kTable6 = {
    {"real scenes", "orbslam2", {std::nullopt, 49.2, 49.2}},
    {"real scenes", "semantic", {511.3, 73.3, 584.6}},
    {"real scenes", "paper", {82.3, 52.6, 134.9}},
};
// Largest trajectory error in metres; of its own method the paper gives the bound alone.
const std::vector<PrintedRow> kTable11 = {
    {"paper/scene2", "orbslam2", {1.56}}, {"paper/scene2", "paper", {0.31}},
    {"paper/scene3", "orbslam2", {3.85}}, {"paper/scene3", "paper", {0.31}},
    {"paper/scene4", "orbslam2", {1.12}}, {"paper/scene4", "paper", {0.31}},
    {"paper/scene5", "orbslam2", {2.45}}, {"paper/scene5", "paper", {0.31}},
};
const std::vector<PrintedRow> kNone;

}  // namespace

const std::vector<PrintedRow>& PrintedTable(int number) {
  if (number == kFigure11) return kTable11;
  const std::vector<PrintedRow>* tables[] = {&kTable1, &kTable2, &kTable3,
                                             &kTable4, &kTable5, &kTable6};
  return number >= 1 && number <= 6 ? *tables[number - 1] : kNone;
}

}  // namespace aisle
