#include "harness/score/continuity.h"

#include "harness/common/seconds.h"
#include "harness/score/scorecard.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// A frame in which an object was asked for.
struct Observation {
  std::size_t frame = 0;
  const ObjectOutcome* object = nullptr;
};
using Observations = std::vector<Observation>;

std::map<int, Observations> ObservationsByInstance(std::span<const FrameFacts> frames,
                                                   const ObjectRule& asked_for) {
  std::map<int, Observations> observations;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].mask) continue;
    for (const ObjectOutcome& object : frames[i].mask->objects) {
      if (asked_for(object)) observations[object.instance].push_back({i, &object});
    }
  }
  return observations;
}

std::vector<Observations> PartAtPauses(const Observations& all, int max_pause_frames) {
  std::vector<Observations> parts;
  for (const Observation& observation : all) {
    const bool goes_on = !parts.empty() && observation.frame - parts.back().back().frame <=
                                               static_cast<std::size_t>(max_pause_frames) + 1;
    if (!goes_on) parts.emplace_back();
    parts.back().push_back(observation);
  }
  return parts;
}

/// Per frame, from true poses. Nobody knows how the rig came to the first: it counts as still.
std::vector<bool> TurningFrames(std::span<const FrameFacts> frames, double turning_dps) {
  std::vector<bool> turning(frames.size());
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Eigen::Matrix3d turn =
        frames[i - 1].T_world_rig.linear().transpose() * frames[i].T_world_rig.linear();
    const double angle_deg = Eigen::AngleAxisd(turn).angle() * 180 / M_PI;
    const double time_s = ToSeconds(frames[i].stamp_ns - frames[i - 1].stamp_ns);
    turning[i] = time_s > 0 && angle_deg >= turning_dps * time_s;
  }
  return turning;
}

MoverSpell SpellOf(const Observations& observations, std::span<const FrameFacts> frames,
                   const std::vector<bool>& turning) {
  MoverSpell spell;
  spell.instance = observations.front().object->instance;
  spell.object_class = observations.front().object->object_class;
  spell.first_ns = frames[observations.front().frame].stamp_ns;
  spell.last_ns = frames[observations.back().frame].stamp_ns;
  spell.frames = static_cast<int>(observations.size());
  int gap = 0, gap_turning = 0;
  for (const auto& [frame, object] : observations) {
    spell.mean_speed_mps += object->speed_mps / spell.frames;
    spell.largest_share = std::max(spell.largest_share, object->share);
    const bool covered = IsCovered(*object);
    if (!spell.delay_s) {
      if (!covered) continue;
      spell.delay_s = ToSeconds(frames[frame].stamp_ns - spell.first_ns);
    }
    const int turns = turning[frame] ? 1 : 0;
    spell.turning_frames += turns;
    gap = covered ? 0 : gap + 1;
    gap_turning = covered ? 0 : gap_turning + turns;
    spell.gap_frames = std::max(spell.gap_frames, gap);
    spell.gap_turning_frames = std::max(spell.gap_turning_frames, gap_turning);
  }
  return spell;
}

void AddKind(const std::string& kind, const Continuity& c, const ContinuityOptions& options,
             Scorecard* scores) {
  const std::string mover = "mover_" + kind + "_";
  const auto add = [&](const std::string& name, const auto& value, const std::string& unit,
                       std::size_t n) {
    if (value) (*scores)[mover + name] = Present(static_cast<double>(*value), unit, n);
  };
  const auto share = [&](std::size_t part) {
    return Ratio(static_cast<double>(part), static_cast<double>(c.judged));
  };
  add(fmt::format("found_within_{:g}s", options.within_s), share(c.found_in_time), "1", c.judged);
  add("found", share(c.judged - c.never_found), "1", c.judged);
  add("delay_median_s", c.delay_median_s, "s", c.judged);
  add("delay_max_s", c.delay_max_s, "s", c.judged);
  add("gap_max_frames", c.gap_max_frames, "frames", c.found);
  add("gap_turning_max_frames", c.gap_turning_max_frames, "frames", c.turning);
}

}  // namespace

std::vector<MoverSpell> FollowMovers(std::span<const FrameFacts> frames,
                                     const ObjectRule& asked_for,
                                     const ContinuityOptions& options) {
  const std::vector<bool> turning = TurningFrames(frames, options.turning_dps);
  std::vector<MoverSpell> spells;
  for (const auto& [instance, observations] : ObservationsByInstance(frames, asked_for)) {
    for (const Observations& part : PartAtPauses(observations, options.max_pause_frames)) {
      spells.push_back(SpellOf(part, frames, turning));
    }
  }
  return spells;
}

Continuity Summarize(std::span<const MoverSpell> spells, const ContinuityOptions& options) {
  Continuity c;
  std::vector<double> delays_s;
  for (const MoverSpell& spell : spells) {
    if (spell.delay_s) {
      ++c.found;
      c.gap_max_frames = std::max(c.gap_max_frames.value_or(0), spell.gap_frames);
    }
    if (spell.turning_frames > 0) {
      ++c.turning;
      c.gap_turning_max_frames =
          std::max(c.gap_turning_max_frames.value_or(0), spell.gap_turning_frames);
    }
    if (spell.length_s() < options.within_s) continue;
    ++c.judged;
    c.found_in_time += spell.delay_s && *spell.delay_s <= options.within_s;
    c.never_found += !spell.delay_s;
    delays_s.push_back(spell.delay_s.value_or(spell.length_s()));
  }
  if (delays_s.empty()) return c;
  c.delay_median_s = Quantile(delays_s, 0.5);
  c.delay_max_s = Quantile(delays_s, 1);
  return c;
}

SpellsByKind FollowKinds(std::span<const FrameFacts> frames, const ContinuityOptions& options) {
  const auto is_large = [](const ObjectOutcome& object) { return IsLargeMover(object); };
  const auto is_slow = [](const ObjectOutcome& object) { return IsSlowMover(object); };
  return {{"large", FollowMovers(frames, is_large, options)},
          {"slow", FollowMovers(frames, is_slow, options)}};
}

void AddContinuity(const SpellsByKind& spells, const ContinuityOptions& options,
                   Scorecard* scores) {
  for (const auto& [kind, of_kind] : spells) {
    AddKind(kind, Summarize(of_kind, options), options, scores);
  }
}

}  // namespace aisle
