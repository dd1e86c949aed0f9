#include "simulator/mesh/gltf_clips.h"

#include "simulator/mesh/gltf_accessor.h"

namespace aisle::sim {
namespace {

Interpolation InterpolationOf(const GltfValue& sampler) {
  const std::string name = sampler.Text("interpolation", "LINEAR");
  if (name == "LINEAR") return Interpolation::kLinear;
  if (name == "STEP") return Interpolation::kStep;
  if (name == "CUBICSPLINE") return Interpolation::kCubic;
  sampler.Fail(
      fmt::format("interpolation '{}' does not exist; there are LINEAR, STEP, CUBICSPLINE", name));
}

/// Times are kept through milliseconds, as results so far were measured with them: at most one bit
/// of rounding, less than 1e-7 of the time.
float KeptTime(float time_s) {
  return static_cast<float>(static_cast<double>(time_s * 1000.0f) / 1000.0);
}

std::vector<float> TimesOf(const GltfDocument& document, const GltfValue& sampler,
                           std::size_t max_count) {
  const std::size_t accessors = document.root().Count("accessors");
  const GltfArray<float> input = ReadFloats(
      document, sampler.Get("input").IndexBelow(accessors, "accessor"), {"SCALAR", max_count});
  std::vector<float> times;
  for (const float time : input.numbers) {
    times.push_back(KeptTime(time));
    if (!(time >= 0) || !std::isfinite(times.back())) {
      sampler.Fail(fmt::format("key time {} s is not 0 or more", time));
    }
    if (times.size() > 1 && times.back() < times[times.size() - 2]) {
      sampler.Fail(fmt::format("its keys are not in order of time: {} s at place {}", time,
                               times.size() - 1));
    }
  }
  return times;
}

Eigen::Vector3f ValueFrom(const float* n, const Eigen::Vector3f& /*like*/) {
  return {n[0], n[1], n[2]};
}
Eigen::Quaternionf ValueFrom(const float* n, const Eigen::Quaternionf& /*like*/) {
  return {n[3], n[0], n[1], n[2]};
}

/// Fills `curve` from a sampler: keys, and for splines (in-tangent, value, out-tangent) each.
template <class Value>
void ReadCurve(const GltfDocument& document, const GltfValue& sampler, std::size_t max_count,
               KeyCurve<Value>* curve) {
  constexpr bool kTurns = std::is_same_v<Value, Eigen::Quaternionf>;
  if (!curve->keys.empty()) sampler.Fail("two channels of the animation move the same thing");
  curve->interpolation = InterpolationOf(sampler);
  const bool cubic = curve->interpolation == Interpolation::kCubic;
  const std::vector<float> times = TimesOf(document, sampler, max_count);
  const GltfArray<float> output = ReadFloats(
      document, sampler.Get("output").IndexBelow(document.root().Count("accessors"), "accessor"),
      {kTurns ? "VEC4" : "VEC3", 3 * max_count});
  if (output.count != (cubic ? 3 : 1) * times.size()) {
    sampler.Fail(fmt::format("{} times have {} values; {} are needed", times.size(), output.count,
                             (cubic ? 3 : 1) * times.size()));
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto value = [&](std::size_t place) { return ValueFrom(output[place], Value()); };
    Value key = value(cubic ? 3 * i + 1 : i);
    if constexpr (kTurns) {
      if (!(key.norm() > 0)) sampler.Fail(fmt::format("key {} is not a rotation: it is 0", i));
      if (!cubic) key.normalize();
    }
    curve->keys.emplace_back(times[i], key);
    if (cubic) curve->slopes.push_back({value(3 * i), value(3 * i + 2)});
  }
}

/// Reads one channel into the clip's channel of its node.
void ReadChannel(const GltfDocument& document, const GltfValue& animation, const GltfValue& channel,
                 const GltfNodes& nodes, std::size_t max_count,
                 std::map<std::size_t, ClipChannel>* by_node) {
  const GltfValue target = channel.Get("target");
  const std::optional<std::size_t> node = target.IndexBelow("node", nodes.of_file.size(), "node");
  const std::size_t index =
      channel.Get("sampler").IndexBelow(animation.Count("samplers"), "sampler");
  const GltfValue sampler = animation.Item("samplers", index);
  if (!node || nodes.of_file[*node] < 0) return;
  const std::string path = target.Get("path").Text();
  if (path == "weights") {
    target.Fail("morph targets are not read; bake the shape or move it with joints");
  }
  ClipChannel& moved = (*by_node)[*node];
  moved.node = nodes.of_file[*node];
  if (path == "translation") {
    ReadCurve(document, sampler, max_count, &moved.translations);
  } else if (path == "rotation") {
    ReadCurve(document, sampler, max_count, &moved.rotations);
  } else if (path == "scale") {
    ReadCurve(document, sampler, max_count, &moved.scales);
  } else {
    target.Fail(fmt::format("path '{}' does not exist", path));
  }
}

/// What no channel moves keeps the value that the node states, without a detour over its matrix.
void KeepTheRest(const GltfValue& node, ClipChannel* channel) {
  const GltfPose stated = StatedPose(node);
  if (channel->translations.keys.empty() && stated.translation) {
    channel->translations.keys = {{0.0f, *stated.translation}};
  }
  if (channel->rotations.keys.empty() && stated.rotation) {
    channel->rotations.keys = {{0.0f, stated.rotation->normalized()}};
  }
  if (channel->scales.keys.empty() && stated.scale) {
    channel->scales.keys = {{0.0f, *stated.scale}};
  }
}

template <class Value>
float EndOf(const KeyCurve<Value>& curve) {
  return curve.keys.empty() ? 0 : curve.keys.back().first;
}

}  // namespace

void AddGltfClips(const GltfDocument& document, const GltfNodes& nodes,
                  const ImportOptions& options, Model* model) {
  for (const GltfValue& animation : document.root().Items("animations")) {
    Clip clip;
    clip.name = animation.Text("name", "");
    std::map<std::size_t, ClipChannel> by_node;
    for (const GltfValue& channel : animation.Items("channels")) {
      ReadChannel(document, animation, channel, nodes, options.max_triangles, &by_node);
    }
    for (auto& [node, channel] : by_node) {
      KeepTheRest(document.root().Item("nodes", node), &channel);
      clip.duration_s = std::max({clip.duration_s, EndOf(channel.translations),
                                  EndOf(channel.rotations), EndOf(channel.scales)});
      clip.channels.push_back(std::move(channel));
    }
    model->clips.push_back(std::move(clip));
  }
}

}  // namespace aisle::sim
