#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

void DescribeSunMove(Fields& f, SunMove& move) {
  f.Number({"at_s", "time at which the change begins", "3", true}, &move.at_s, {-3600, 3600});
  f.Number({"over_s", "duration of the change", "4"}, &move.over_s, {0.02, 3600});
  f.Degrees({"azimuth_deg", "azimuth of the sun afterwards", "-100", true}, &move.azimuth_rad);
  f.Degrees({"elevation_deg", "elevation of the sun afterwards", "35", true}, &move.elevation_rad,
            {1, 90});
  f.Number({"share", "share of the sun's light that clouds let through afterwards", "0.2"},
           &move.share, {0, 1});
}

void DescribeWindow(Fields& f, BeamSpec& beam) {
  f.Numbers({"size_m", "window: width and height", "[2, 1.5]"}, beam.size_m.data(), 2, {0.1, 100});
  f.Degrees({"facing_deg", "window: azimuth of its normal, into the hall", "90"}, &beam.facing_rad);
  f.Flag(
      {"in_roof",
       "window: it lies level in the roof; facing_deg is then the direction of its height", "true"},
      &beam.is_roof);
  f.Integer({"columns", "window: number of panes side by side", "3"}, &beam.columns, {1, 100});
  f.Integer({"rows", "window: number of panes one above another", "2"}, &beam.rows, {1, 100});
  f.Number({"bar_m", "window: width of the bars between the panes", "0.06"}, &beam.bar_m, {0, 2});
  f.ListOf({"moves", "sun: moves of the sun and of clouds before it",
            "[{at_s: 3, azimuth_deg: -100, elevation_deg: 35}]"},
           &beam.moves, DescribeSunMove);
}

}  // namespace

void DescribeBeam(Fields& f, BeamSpec& beam) {
  beam.mark = f.mark();
  beam.given = f.Given({"width_deg", "rate_hz", "from_s", "until_s", "size_m", "facing_deg",
                        "in_roof", "columns", "rows", "bar_m", "moves"});
  f.Name({"name", "name, unique among beams", "beacon", true}, &beam.name);
  f.Choice({"kind", "spot: a lamp that turns; sun: sunlight through a window", "spot"}, &beam.kind,
           {"spot", "sun"});
  f.Choice(
      {"level", "lowest level of dynamics at which it moves; below that it shines without moving",
       "low"},
      &beam.level, {"none", "low", "mid", "high"});
  f.Numbers({"at_m", "position of the spot, or middle of the window", "[7, 1.5, 2.2]", true},
            beam.at.data(), 3, {-1000, 1000});
  f.Number({"brightness",
            "spot: its intensity, in lamps' radiance times m^2; sun: its light across the rays, in "
            "lamps' radiance",
            "20"},
           &beam.brightness, {0.001, 10000});
  f.Degrees({"azimuth_deg", "spot: direction at time 0; sun: its azimuth", "90"},
            &beam.azimuth_rad);
  f.Degrees(
      {"elevation_deg", "spot: elevation of its direction; sun: its elevation, at least 1", "-5"},
      &beam.elevation_rad, {-90, 90});
  f.Degrees({"width_deg", "spot: full angle of its cone", "30"}, &beam.width_rad, {1, 170});
  double turns = beam.rate_rad_s / (2 * std::numbers::pi);
  f.Number({"rate_hz", "spot: turns per second", "1.2"}, &turns, {-20, 20});
  beam.rate_rad_s = turns * 2 * std::numbers::pi;
  std::optional<double> from, to;
  f.OptionalNumber(
      {"from_s", "spot: time at which it begins to turn; absent: it always turns", "2"}, &from,
      {-3600, 3600});
  f.OptionalNumber({"until_s", "spot: time at which it begins to stop; absent: never", "12"}, &to,
                   {-3600, 3600});
  if (from) beam.run.from_s = *from;
  if (to) beam.run.to_s = *to;
  DescribeWindow(f, beam);
}

void DescribeCrowd(Fields& f, CrowdSpec& crowd) {
  crowd.mark = f.mark();
  f.Integer(
      {"people", "number of people; a third of them at level low, two thirds at mid", "12", true},
      &crowd.people, {1, 60});
  std::array<double, 4> in = crowd.in.value_or(std::array<double, 4>{});
  f.Numbers({"in", "area in which they walk: x0, y0, x1, y1; absent: the whole hall",
             "[2, -1.2, 14, 1.2]"},
            in.data(), 4, {-1000, 1000});
  if (f.Has("in")) crowd.in = in;
  std::array<int, 2> racks = {0, 0};
  f.Integers({"between_racks",
              "instead of `in`: the aisle between two rows, by their indices in `racks`, from 0",
              "[0, 1]"},
             racks.data(), 2, {0, 1000});
  if (f.Has("between_racks")) crowd.between_racks = racks;
  f.Number({"speed_mps", "mean of their preferred speeds", "1.34"}, &crowd.speed_mps, {0.2, 2.2});
  f.Number({"speed_spread_mps", "standard deviation of their preferred speeds", "0.26"},
           &crowd.speed_spread_mps, {0, 1});
  f.Number({"pause_s", "longest rest at a destination", "2"}, &crowd.pause_s, {0, 60});
  f.Number({"distance_m", "smallest distance between two people's middles", "0.6"},
           &crowd.distance_m, {0.5, 2});
}

}  // namespace aisle::sim
