#include <limits>
#include <numbers>

#include "simulator/scene/degree.h"
#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

void Vector(Fields& f, const Key& key, Eigen::Vector3d* value, Range range = {-100, 100}) {
  f.Numbers(key, value->data(), 3, range);
}

void DescribeMove(Fields& f, JointMove& move) {
  f.Number({"at_s", "time at which the move begins", "3", true}, &move.at_s, {-3600, 3600});
  f.Number({"over_s", "duration of the move", "2"}, &move.over_s, {0.02, 3600});
  double degrees = move.to / kDegree;
  f.Number({"to_deg", "hinge: angle after the move", "90"}, &degrees, {-36000, 36000});
  if (f.Has("to_deg")) move.to = degrees * kDegree;
  f.Number({"to_m", "slider: position along the axis after the move", "2.2"}, &move.to,
           {-100, 100});
}

void DescribeRun(Fields& f, RunTimes& run) {
  std::optional<double> from, to;
  f.OptionalNumber({"from_s", "spin, belt: time at which it starts; absent: it always runs", "2"},
                   &from, {-3600, 3600});
  f.OptionalNumber({"until_s", "spin, belt: time at which it begins to stop; absent: never", "12"},
                   &to, {-3600, 3600});
  if (from) run.from_s = *from;
  if (to) run.to_s = *to;
  f.Number({"ramp_s", "spin, belt: time to speed up and to slow down", "0.5"}, &run.ramp_s,
           {0.01, 60});
}

void DescribeJoint(Fields& f, PartSpec& part) {
  Joint& joint = part.joint;
  part.joint_given =
      f.Given({"moves", "start_deg", "start_m", "rate_hz", "speed_mps", "from_s", "until_s",
               "ramp_s", "length_m", "swing_deg", "swing_m", "decay_s", "at_s"});
  f.Choice({"kind", "how the part moves relative to what it is on", "hinge"}, &joint.kind,
           {"fixed", "hinge", "slider", "pendulum", "spin", "belt", "chain"});
  Vector(f,
         {"axis", "axis that it turns about or shifts along, in the part's own frame", "[0, 0, 1]"},
         &joint.axis, {-1, 1});
  if (joint.axis.norm() > 1e-6) joint.axis.normalize();
  f.List(
      {"moves", "hinge, slider: moves from rest to rest, with least jerk",
       "[{at_s: 3, to_m: 2.2, over_s: 2}]"},
      [&](std::size_t count) { joint.moves.resize(count); },
      [&](Fields& move, std::size_t i) {
        DescribeMove(move, joint.moves[i]);
        for (GivenKey& key : move.Given({"to_deg", "to_m"})) {
          part.joint_given.push_back({key.name, key.mark, "moves", i});
        }
      });
  double start_deg = joint.start / kDegree;
  f.Number({"start_deg", "hinge: angle before the first move", "0"}, &start_deg, {-36000, 36000});
  if (f.Has("start_deg")) joint.start = start_deg * kDegree;
  f.Number({"start_m", "slider: position before the first move", "0"}, &joint.start, {-100, 100});
  double turns = joint.speed / (2 * std::numbers::pi);
  f.Number({"rate_hz", "spin: turns per second", "1.5"}, &turns, {-100, 100});
  if (f.Has("rate_hz")) joint.speed = turns * 2 * std::numbers::pi;
  f.Number({"speed_mps", "belt: its speed", "0.4"}, &joint.speed, {-20, 20});
  DescribeRun(f, joint.run);
  f.Number({"length_m",
            "pendulum: length of the simple pendulum with the same period; chain: length from top "
            "to free end; belt: distance after which a copy comes round",
            "2"},
           &joint.length_m, {0.01, 1000});
  double swing_deg = joint.swing / kDegree;
  f.Number({"swing_deg", "pendulum: first amplitude, without damping", "12"}, &swing_deg,
           {-60, 60});
  if (f.Has("swing_deg")) joint.swing = swing_deg * kDegree;
  f.Number({"swing_m", "chain: first amplitude of its free end", "0.4"}, &joint.swing, {-5, 5});
  std::optional<double> decay;
  f.OptionalNumber(
      {"decay_s", "time constant with which the swinging decays; absent: it never does", "8"},
      &decay, {0.05, 3600});
  if (decay) joint.decay_s = *decay;
  f.Number({"at_s", "pendulum, chain: time at which it is pushed; before that it hangs still", "2"},
           &joint.at_s, {-3600, 3600});
}

void DescribeLooks(Fields& f, PartSpec& part) {
  part.shape_given = f.Given({"model", "goods", "goods_m", "size_m"});
  f.Choice({"shape", "shape of the part", "box"}, &part.shape,
           {"box", "cylinder", "link", "model", "pallet"});
  f.Choice({"paint", "surface of the part; film is a mirror, glass is transparent, glow shines",
            "steel"},
           &part.paint,
           {"steel", "wood", "carton", "wrap", "stripes", "tote", "door", "wall", "white", "dark",
            "film", "glass", "glow"});
  f.Name({"model", "shape model: file in assets/kit or assets/street, without .glb", "roll_cage"},
         &part.model);
  part.model_mark = f.MarkOf("model");
  f.Choice({"goods", "shape pallet: goods on it", "cartons"}, &part.goods,
           {"mixed", "cartons", "drums", "totes", "wrapped", "identical", "nothing"});
  f.Number({"goods_m", "shape pallet: height of the goods", "1"}, &part.goods_m, {0.1, 3});
  Vector(f,
         {"size_m",
          "size along x, y and z of a box, or of the box around a cylinder along z or a link",
          "[0.1, 2.4, 2.5]"},
         &part.size_m, {0.001, 100});
  Vector(f,
         {"center_m", "middle of the shape in its joint's frame; for a pallet, its foot",
          "[0, 0, 1.25]"},
         &part.center_m);
}

void DescribePart(Fields& f, PartSpec& part) {
  part.mark = f.mark();
  f.Name({"name", "name of the part, for the `on` of other parts", "arm"}, &part.name);
  f.Name(
      {"on", "name of an earlier part whose motion it shares; absent: the mechanism itself", "arm"},
      &part.on);
  DescribeLooks(f, part);
  Vector(f, {"at_m", "position of its joint, in the frame of what it is on", "[0, 0, 1]"},
         &part.at_m);
  f.Degrees({"heading_deg", "yaw of its joint's frame, about z", "90"}, &part.heading_rad);
  f.Degrees({"roll_deg",
             "roll of its joint's frame, about x, after the yaw; 90 lays a cylinder along y", "90"},
            &part.roll_rad);
  f.Integer({"count", "number of copies; links of a chain, things on a belt", "12"}, &part.count,
            {1, 400});
  Vector(f, {"step_m", "offset from copy to copy", "[0, 0.2, 0]"}, &part.step_m);
  f.Number({"delay_s", "time by which each copy moves later than the previous one", "0.1"},
           &part.delay_s, {0, 60});
  f.Group({"joint", "motion of the part; absent: none", "{kind: spin, rate_hz: 1}"},
          [&](Fields& joint) { DescribeJoint(joint, part); });
}

void DescribeTaken(Fields& f, TakenSpec& taken) {
  taken.mark = f.mark();
  f.Name({"by", "name of a vehicle with forks", "truck", true}, &taken.by);
  f.Number({"at_s", "time at which the forks take it", "6", true}, &taken.at_s, {0, 3600});
  f.Number({"until_s", "time at which they leave it where it is then; absent: never", "20"},
           &taken.until_s, {0, 1e9});
}

}  // namespace

void DescribeMechanism(Fields& f, MechanismSpec& mechanism) {
  mechanism.mark = f.mark();
  f.Name({"name", "name in labels and reports, unique", "gate", true}, &mechanism.name);
  f.Choice({"class", "class of the object in labels", "furniture"}, &mechanism.object_class,
           {"furniture", "goods", "wall"});
  f.Choice({"level",
            "lowest level of dynamics at which it moves; below that it stands still or, if people "
            "bring it, is absent",
            "low"},
           &mechanism.level, {"none", "low", "mid", "high"});
  f.Point({"at", "position of its origin", "[6, 1]"}, &mechanism.at);
  f.Number({"above_m", "height of its origin above the floor", "0"}, &mechanism.above_m,
           {-10, 100});
  f.Degrees({"heading_deg", "direction of its x axis", "90"}, &mechanism.heading_rad);
  f.Name({"pushed_by", "person who pushes it; instead of `at`", "fitter"}, &mechanism.pushed_by);
  f.Number({"reach_m", "pushed: distance from that person's hands to its origin", "0.4"},
           &mechanism.reach_m, {-5, 5});
  f.OnlyWith("pushed_by", {"reach_m"});
  f.Name({"front_by", "person who plays walk_carry and holds its +x end", "anton"},
         &mechanism.front_by);
  f.Name({"rear_by", "person who holds its other end", "bea"}, &mechanism.rear_by);
  f.ListOf({"taken", "vehicles that have it on their forks for a while",
            "[{by: truck, at_s: 6, until_s: 20}]"},
           &mechanism.taken, DescribeTaken);
  f.ListOf({"parts", "parts it is made of; those that never move belong to the building",
            "[{shape: box, size_m: [0.1, 2, 2]}]", true},
           &mechanism.parts, DescribePart);
}

}  // namespace aisle::sim
