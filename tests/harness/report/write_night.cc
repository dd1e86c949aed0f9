// Writes the report of a made-up night: write_night DIR SCENES SEEDS. For the browser, and for
// looking at.
#include "harness/judge/limit.h"
#include "harness/report/report.h"
#include "tests/harness/record/night.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: write_night DIR SCENES SEEDS\n");
    return 4;
  }
  aisle::NightOptions options;
  options.scenes = std::stoul(argv[2]);
  options.seeds = std::stoul(argv[3]);
  options.pictures = true;
  aisle::Results night = aisle::MakeNight(options, argv[1]);
  night.verdicts = aisle::Judge(
      night.runs,
      {{.score = "ate_rmse_m", .scene = "", .twin = "live", .system = "", .min = {}, .max = 0.02}});
  aisle::WriteReport(night, argv[1]);
  return 0;
}
