// Writes the report of a made-up night: write_night DIR SCENES SEEDS. For the browser, and for
// looking at.
#include "harness/report/report.h"
#include "tests/harness/report/night.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: write_night DIR SCENES SEEDS\n");
    return 4;
  }
  aisle::NightOptions options;
  options.scenes = std::stoul(argv[2]);
  options.seeds = std::stoul(argv[3]);
  aisle::WriteReport(aisle::MakeNight(options, argv[1]), argv[1]);
  return 0;
}
