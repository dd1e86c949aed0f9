#include "slam/options/slam_options.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "slam/common/nearest_name.h"

namespace aisle::slam {
namespace {

using Kind = OptionDescription::Kind;

Kind KindOf(const OptionField& field) {
  struct {
    Kind operator()(const double*) const { return Kind::kNumber; }
    Kind operator()(const int*) const { return Kind::kInteger; }
    Kind operator()(const std::uint64_t*) const { return Kind::kInteger; }
    Kind operator()(const bool*) const { return Kind::kFlag; }
    Kind operator()(const OptionChoice&) const { return Kind::kChoice; }
  } kind_of;
  return std::visit(kind_of, field.value);
}

/// What is wrong with a path that names no option.
std::string UnknownPath(const std::string& path, const OptionFields& fields) {
  std::vector<std::string> paths;
  for (const OptionField& field : fields.fields()) {
    if (field.path.starts_with(path + ".")) {
      return fmt::format("{} is a group of options, such as {}", path, field.path);
    }
    paths.push_back(field.path);
  }
  return fmt::format("unknown option {}{}", path, DidYouMean(path, paths));
}

/// Sets every option to what `base` has published; what the driver owns is no option and stays.
void StartFrom(Base base, const OptionFields& fields) {
  SlamOptions published = OptionsOf(base);
  const OptionFields from = FieldsOf(published);
  for (std::size_t i = 0; i < fields.fields().size(); ++i) {
    SetFrom(TextOf(from.fields()[i]), fields.fields()[i]);
  }
}

/// Options that one base alone looks at. Of two prefixes that fit, the longer one decides.
struct HeededBy {
  const char* prefix;
  std::optional<Base> base;  ///< none: by all
};
constexpr HeededBy kHeeded[] = {
    {"track.", Base::kPlain},
    {"track.longest_gap_s", std::nullopt},  // the rejection of movers predicts by it
    {"keyframe.", Base::kPlain},
    {"mapping.create.", Base::kPlain},
    {"mapping.cull.", Base::kPlain},
    {"mapping.triangulate.worst_depth_ratio", Base::kPlain},
    {"new_part_after_s", Base::kPlain},  // the published system begins no parts
    {"least_keyframes", Base::kPlain},
    {"least_first_points", Base::kPlain},
    {"orbslam2.", Base::kOrbSlam2},
    {"orbslam2_mapping.", Base::kOrbSlam2},
};

/// Options that are of use to one way of finding movers.
struct HeededByMethod {
  const char* prefix;
  DynamicMethod method;
  const char* name;
};
constexpr HeededByMethod kHeededByMethod[] = {
    {"dynamic.paper.", DynamicMethod::kPaper, "paper"},
    {"dynamic.robust.", DynamicMethod::kRobust, "robust"},
    {"track.prior_map_share", DynamicMethod::kRobust, "robust"},
};

std::string NameOf(Base base) { return base == Base::kPlain ? "plain" : "orbslam2"; }

constexpr int kAll = 1'000'000;  // keyframes: no map has more

SlamOptions OrbSlam2Published() {
  SlamOptions options;
  options.base = Base::kOrbSlam2;
  options.feature.least_corner_ratio = 0;
  options.keypoint_noise_px = 1;
  options.equal_columns = true;
  options.stereo.refinement = RowRefinement::kParabola;
  options.stereo.patch_radius_px = 5;
  options.mapping.triangulate = {
      .neighbours = 10, .descriptor_distance = 50, .descriptor_ratio = 0.6};
  options.mapping.fuse.neighbours = 10;
  options.mapping.adjust = {.free_keyframes = kAll,
                            .fixed_keyframes = kAll,
                            .least_shared = 15,
                            .robust_iterations = 5,
                            .final_iterations = 10,
                            .second_chance = false};
  // Three keyframes in turn, each with its share of points; how far apart is not asked.
  options.loop.consistent_loops = 3;
  options.loop.neighbours = 0;
  options.loop.drift_m = 1e6;
  options.schedule.mapping_frames = 1;
  return options;
}

}  // namespace

SlamOptions OptionsOf(Base base) {
  return base == Base::kOrbSlam2 ? OrbSlam2Published() : SlamOptions();
}

void Describe(OptionFields& fields, SlamOptions& options) {
  fields.Choice("base", &options.base, {"plain", "orbslam2"},
                "Rules by which tracking and mapping decide: ours, or the published ORB-SLAM2's; "
                "setting it sets all other options to that one's.");
  fields.Group("dynamic", &options.dynamic);
  fields.Group("feature", &options.feature);
  fields.Group("stereo", &options.stereo);
  fields.Group("track", &options.track);
  fields.Group("keyframe", &options.keyframe);
  fields.Group("orbslam2", &options.orbslam2);
  fields.Group("orbslam2_mapping", &options.orbslam2_mapping);
  fields.Group("mapping", &options.mapping);
  fields.Group("loop", &options.loop);
  fields.Group("global", &options.global);
  fields.Group("schedule", &options.schedule);
  fields.Number("new_part_after_s", &options.new_part_after_s, {0, 1e6}, "s",
                "Time without a pose after which a new part of the map is begun.");
  fields.Integer("least_keyframes", &options.least_keyframes, {0, 100000}, "keyframes",
                 "A smaller map is given up where a new part is begun.");
  fields.Number("keypoint_noise_px", &options.keypoint_noise_px, {0.01, 100}, "px",
                "Deviation of a corner's position, in pixels of its level.");
  fields.Flag("equal_columns", &options.equal_columns,
              "A stereo point's right column counts as exact as its left one, whatever its patches "
              "say.");
  fields.Integer("least_first_points", &options.least_first_points, {10, 10000}, "",
                 "Stereo points of the frame that starts a map or a part of it.");
  fields.Require(options.threads >= 0, "threads", options.threads, "be 0 or more");
  fields.Require(!options.localise_only || !options.map_file.empty(), "localise_only",
                 options.localise_only,
                 "be false without a map_file: there is nothing to localise in");
}

std::vector<OptionDescription> DescribeOptions(const SlamOptions& options) {
  SlamOptions described = options;
  const OptionFields fields = FieldsOf(described);
  std::vector<OptionDescription> descriptions;
  for (const OptionField& field : fields.fields()) {
    const auto* choice = std::get_if<OptionChoice>(&field.value);
    descriptions.push_back({field.path, KindOf(field), TextOf(field), field.unit, field.help,
                            field.range.low, field.range.high,
                            choice ? choice->names : std::vector<std::string>{}});
  }
  return descriptions;
}

std::string SetOption(const std::string& path, const std::string& text, SlamOptions* options) {
  const OptionFields fields = FieldsOf(*options);
  for (const OptionField& field : fields.fields()) {
    if (field.path != path) continue;
    std::string wrong = SetFrom(text, field);
    if (wrong.empty() && path == "base") StartFrom(options->base, fields);
    return wrong;
  }
  return UnknownPath(path, fields);
}

std::string WhyWithoutEffect(const std::string& path, const SlamOptions& options) {
  for (const HeededByMethod& one : kHeededByMethod) {
    if (path.starts_with(one.prefix) && options.dynamic.method != one.method)
      return fmt::format("{} has no effect: dynamic.method is not {}", path, one.name);
  }
  std::optional<Base> heeded_by;
  std::size_t longest = 0;
  for (const HeededBy& one : kHeeded) {
    const std::size_t length = std::string_view(one.prefix).size();
    if (length <= longest || !path.starts_with(one.prefix)) continue;
    longest = length;
    heeded_by = one.base;
  }
  if (!heeded_by || *heeded_by == options.base) return {};
  return fmt::format("{} has no effect with base {}; only base {} uses it", path,
                     NameOf(options.base), NameOf(*heeded_by));
}

std::string Validate(const SlamOptions& options) {
  SlamOptions checked = options;
  return FirstBrokenRule(FieldsOf(checked));
}

}  // namespace aisle::slam
