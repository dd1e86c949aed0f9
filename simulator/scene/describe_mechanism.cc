#include <limits>
#include <numbers>

#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

void Vector(Fields& f, const Key& key, Eigen::Vector3d* value, Range range = {-100, 100}) {
  f.Numbers(key, value->data(), 3, range);
}

void DescribeMove(Fields& f, JointMove& move) {
  f.Number({"at_s", "begins to move", "3", true}, &move.at_s, {-3600, 3600});
  f.Number({"over_s", "takes so long", "2"}, &move.over_s, {0.02, 3600});
  double degrees = move.to / kDegree;
  f.Number({"to_deg", "of a hinge: to this angle", "90"}, &degrees, {-36000, 36000});
  if (f.Has("to_deg")) move.to = degrees * kDegree;
  f.Number({"to_m", "of a slider: this far along the axis", "2.2"}, &move.to, {-100, 100});
}

void DescribeRun(Fields& f, RunTimes& run) {
  std::optional<double> from, to;
  f.OptionalNumber({"from_s", "spin, belt: sets off; absent: it has always run", "2"}, &from,
                   {-3600, 3600});
  f.OptionalNumber({"until_s", "spin, belt: begins to stop; absent: never", "12"}, &to,
                   {-3600, 3600});
  if (from) run.from_s = *from;
  if (to) run.to_s = *to;
  f.Number({"ramp_s", "spin, belt: of speeding up and slowing down", "0.5"}, &run.ramp_s,
           {0.01, 60});
}

void DescribeJoint(Fields& f, PartSpec& part) {
  Joint& joint = part.joint;
  part.joint_given =
      f.Given({"moves", "start_deg", "start_m", "rate_hz", "speed_mps", "from_s", "until_s",
               "ramp_s", "length_m", "swing_deg", "swing_m", "decay_s", "at_s"});
  f.Choice({"kind", "how the part moves against what it is on", "hinge"}, &joint.kind,
           {"fixed", "hinge", "slider", "pendulum", "spin", "belt", "chain"});
  Vector(f, {"axis", "turns about it or shifts along it, in the part's own frame", "[0, 0, 1]"},
         &joint.axis, {-1, 1});
  if (joint.axis.norm() > 1e-6) joint.axis.normalize();
  f.List(
      {"moves", "of a hinge or a slider: from rest to rest, by the least jerk",
       "[{at_s: 3, to_m: 2.2, over_s: 2}]"},
      [&](std::size_t count) { joint.moves.resize(count); },
      [&](Fields& move, std::size_t i) {
        DescribeMove(move, joint.moves[i]);
        for (GivenKey& key : move.Given({"to_deg", "to_m"})) {
          part.joint_given.push_back({key.name, key.mark, "moves", i});
        }
      });
  double start_deg = joint.start / kDegree;
  f.Number({"start_deg", "of a hinge: its angle before", "0"}, &start_deg, {-36000, 36000});
  if (f.Has("start_deg")) joint.start = start_deg * kDegree;
  f.Number({"start_m", "of a slider: where it is before", "0"}, &joint.start, {-100, 100});
  double turns = joint.speed / (2 * std::numbers::pi);
  f.Number({"rate_hz", "of a spin: turns a second", "1.5"}, &turns, {-100, 100});
  if (f.Has("rate_hz")) joint.speed = turns * 2 * std::numbers::pi;
  f.Number({"speed_mps", "of a belt", "0.4"}, &joint.speed, {-20, 20});
  DescribeRun(f, joint.run);
  f.Number({"length_m",
            "pendulum: of the simple one that swings alike; chain: top to free end; "
            "belt: way until a copy comes round",
            "2"},
           &joint.length_m, {0.01, 1000});
  double swing_deg = joint.swing / kDegree;
  f.Number({"swing_deg", "of a pendulum: first swing, if nothing damped it", "12"}, &swing_deg,
           {-60, 60});
  if (f.Has("swing_deg")) joint.swing = swing_deg * kDegree;
  f.Number({"swing_m", "of a chain: first swing of its free end", "0.4"}, &joint.swing, {-5, 5});
  std::optional<double> decay;
  f.OptionalNumber({"decay_s", "time constant of the swinging; absent: it never fades", "8"},
                   &decay, {0.05, 3600});
  if (decay) joint.decay_s = *decay;
  f.Number({"at_s", "pendulum, chain: when it is pushed; before that it hangs still", "2"},
           &joint.at_s, {-3600, 3600});
}

void DescribeLooks(Fields& f, PartSpec& part) {
  f.Choice({"shape", "what it is", "box"}, &part.shape,
           {"box", "cylinder", "link", "model", "pallet"});
  f.Choice({"paint", "its surface; film mirrors, one sees through glass, glow shines", "steel"},
           &part.paint,
           {"steel", "wood", "carton", "wrap", "stripes", "tote", "door", "wall", "white", "dark",
            "film", "glass", "glow"});
  f.Name({"model", "of shape model: file in assets/kit or assets/street without .glb", "roll_cage"},
         &part.model);
  part.model_mark = f.MarkOf("model");
  f.Choice({"goods", "of shape pallet: what is on it", "cartons"}, &part.goods,
           {"mixed", "cartons", "drums", "totes", "wrapped", "identical", "nothing"});
  f.Number({"goods_m", "of shape pallet: height of the goods", "1"}, &part.goods_m, {0.1, 3});
  Vector(f,
         {"size_m", "of a box along x, y and z; of the box around a cylinder along z or a link",
          "[0.1, 2.4, 2.5]"},
         &part.size_m, {0.001, 100});
  Vector(f,
         {"center_m", "middle of the shape in its joint's frame; of a pallet its foot",
          "[0, 0, 1.25]"},
         &part.center_m);
}

void DescribePart(Fields& f, PartSpec& part) {
  part.mark = f.mark();
  f.Name({"name", "what other parts are `on`", "arm"}, &part.name);
  f.Name({"on", "a part named before, whose motion it shares; absent: the mechanism itself", "arm"},
         &part.on);
  DescribeLooks(f, part);
  Vector(f, {"at_m", "where its joint is, in the frame of what it is on", "[0, 0, 1]"}, &part.at_m);
  f.Degrees({"heading_deg", "of its joint's frame, about z", "90"}, &part.heading_rad);
  f.Degrees(
      {"roll_deg", "of its joint's frame, about x, after that; 90 lays a cylinder along y", "90"},
      &part.roll_rad);
  f.Integer({"count", "copies of it; of a chain its links, of a belt what lies on it", "12"},
            &part.count, {1, 400});
  Vector(f, {"step_m", "from copy to copy", "[0, 0.2, 0]"}, &part.step_m);
  f.Number({"delay_s", "by which each copy moves later than the one before", "0.1"}, &part.delay_s,
           {0, 60});
  f.Group({"joint", "how it moves; absent: not at all", "{kind: spin, rate_hz: 1}"},
          [&](Fields& joint) { DescribeJoint(joint, part); });
}

void DescribeTaken(Fields& f, TakenSpec& taken) {
  taken.mark = f.mark();
  f.Name({"by", "a vehicle with forks", "truck", true}, &taken.by);
  f.Number({"at_s", "when the forks have it", "6", true}, &taken.at_s, {0, 3600});
  f.Number({"until_s", "when they leave it where it is then; absent: never", "20"}, &taken.until_s,
           {0, 1e9});
}

}  // namespace

void DescribeMechanism(Fields& f, MechanismSpec& mechanism) {
  mechanism.mark = f.mark();
  f.Name({"name", "unique; ends up in labels and reports", "gate", true}, &mechanism.name);
  f.Choice({"class", "what labels call it", "furniture"}, &mechanism.object_class,
           {"furniture", "goods", "wall"});
  f.Choice({"level",
            "moves from this level of dynamics on; below it stands still, or stays away if people "
            "bring it",
            "low"},
           &mechanism.level, {"none", "low", "mid", "high"});
  f.Point({"at", "where its origin stands", "[6, 1]"}, &mechanism.at);
  f.Number({"above_m", "its origin above the floor", "0"}, &mechanism.above_m, {-10, 100});
  f.Degrees({"heading_deg", "where its x points", "90"}, &mechanism.heading_rad);
  f.Name({"pushed_by", "a person before whose hands it goes; leave out `at`", "fitter"},
         &mechanism.pushed_by);
  f.Number({"reach_m", "pushed: from those hands to its origin", "0.4"}, &mechanism.reach_m,
           {-5, 5});
  f.Name({"front_by", "a person who plays walk_carry and holds its +x end", "anton"},
         &mechanism.front_by);
  f.Name({"rear_by", "the person at its other end", "bea"}, &mechanism.rear_by);
  f.ListOf({"taken", "forks that have it for a while", "[{by: truck, at_s: 6, until_s: 20}]"},
           &mechanism.taken, DescribeTaken);
  f.ListOf({"parts", "what it is made of; those that never move are part of the building",
            "[{shape: box, size_m: [0.1, 2, 2]}]", true},
           &mechanism.parts, DescribePart);
}

}  // namespace aisle::sim
