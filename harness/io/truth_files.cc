#include "harness/io/truth_files.h"

#include "harness/io/file.h"
#include "harness/io/image.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr double kDepthSteps = 1000;  // per metre: 65.5 m

nlohmann::ordered_json BoxToJson(const cv::Rect2d& box) {
  return {box.x, box.y, box.width, box.height};
}

nlohmann::ordered_json VectorToJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string BoxesJson(const FrameForExport& of) {
  nlohmann::ordered_json json = {
      {"frame", of.number}, {"stamp_ns", of.stamp_ns}, {"scene_frame", of.frame.images.id}};
  json["objects"] = nlohmann::ordered_json::array();
  for (const ObjectTruth& object : of.frame.truth->objects) {
    const Eigen::Vector3d &c = object.center_m, &v = object.velocity_mps;
    json["objects"].push_back({{"instance", object.instance},
                               {"class", object.object_class},
                               {"box_visible_px", BoxToJson(object.box_visible)},
                               {"box_full_px", BoxToJson(object.box_full)},
                               {"center_world_m", {c.x(), c.y(), c.z()}},
                               {"extent_m", VectorToJson(object.extent_m)},
                               {"T_world_object", PoseToJson(object.T_world_object)},
                               {"velocity_world_mps", {v.x(), v.y(), v.z()}},
                               {"visible_fraction", object.visible_fraction},
                               {"visible_pixels", object.visible_pixels},
                               {"dynamic_pixels", object.dynamic_pixels}});
  }
  return json.dump(1) + "\n";
}

/// Class of every pixel from its instance.
cv::Mat1b Classes(const cv::Mat1w& instance, const std::vector<LabelInfo>& labels) {
  cv::Mat1b classes(instance.size());
  std::transform(instance.begin(), instance.end(), classes.begin(), [&](std::uint16_t id) {
    return id < labels.size() ? labels[id].class_id : std::uint8_t{0};
  });
  return classes;
}

/// Middlebury's .flo; what is unknown is 1e10, by its convention.
std::string FloFile(const cv::Mat2f& flow) {
  constexpr float kUnknown = 1e10f;
  std::string bytes = "PIEH";
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  put(std::int32_t{flow.cols});
  put(std::int32_t{flow.rows});
  for (const cv::Vec2f& f : flow) {
    const bool known = std::isfinite(f[0]) && std::isfinite(f[1]);
    put(known ? f[0] : kUnknown);
    put(known ? f[1] : kUnknown);
  }
  return bytes;
}

/// A file that is an image as it stands.
template <typename Image>
TruthFile Plain(const char* kind, const char* ending, Image FrameTruth::*image) {
  return {kind, ending, [=](const fs::path& path, const FrameForExport& of) {
            WriteImage(path, (*of.frame.truth).*image);
          }};
}
template <typename Image>
TruthFile Plain(const char* kind, const char* ending, Image FrameMotion::*image) {
  return {kind, ending, [=](const fs::path& path, const FrameForExport& of) {
            WriteImage(path, of.motion->*image);
          }};
}

}  // namespace

nlohmann::ordered_json PoseToJson(const Eigen::Isometry3d& pose) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (int k = 0; k < 16; ++k) json.push_back(pose.matrix()(k / 4, k % 4));
  return json;
}

cv::Mat1w DepthInSteps(const cv::Mat1f& depth, double per_metre) {
  cv::Mat1w steps(depth.size());
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double value = std::round(depth(y, x) * per_metre);
      steps(y, x) = value <= 65535 ? static_cast<unsigned short>(value) : 0;
    }
  }
  return steps;
}

std::string LabelsJson(const std::vector<LabelInfo>& labels) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (std::size_t id = 0; id < labels.size(); ++id) {
    json.push_back({{"id", id},
                    {"name", labels[id].name},
                    {"class", labels[id].object_class},
                    {"class_id", labels[id].class_id},
                    {"moving", labels[id].moving}});
  }
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::vector<TruthFile> TruthFiles(const ExportOptions& options) {
  const TruthSelection& truth = options.truth;
  std::vector<TruthFile> files;
  if (truth.depth) {
    files.push_back(Plain("depth", ".pfm", &FrameTruth::depth));
    files.push_back(Plain("depth_right", ".pfm", &FrameTruth::depth_right));
    files.push_back({"depth_mm", ".png", [](const fs::path& path, const FrameForExport& of) {
                       WriteImage(path, DepthInSteps(of.frame.truth->depth, kDepthSteps));
                     }});
  }
  if (truth.labels) {
    files.push_back(Plain("instance", ".png", &FrameTruth::instance));
    files.push_back(Plain("instance_right", ".png", &FrameTruth::instance_right));
    files.push_back({"class", ".png", [&](const fs::path& path, const FrameForExport& of) {
                       WriteImage(path, Classes(of.frame.truth->instance, options.labels));
                     }});
    files.push_back({"class_right", ".png", [&](const fs::path& path, const FrameForExport& of) {
                       WriteImage(path, Classes(of.frame.truth->instance_right, options.labels));
                     }});
  }
  if (truth.dynamic) {
    files.push_back(Plain("dynamic", ".png", &FrameTruth::dynamic));
    files.push_back(Plain("dynamic_right", ".png", &FrameTruth::dynamic_right));
    files.push_back(Plain("actor", ".png", &FrameTruth::actor));
  }
  if (truth.boxes) {
    files.push_back({"boxes", ".json", [](const fs::path& path, const FrameForExport& of) {
                       WriteFileAtomically(path, BoxesJson(of));
                     }});
  }
  if (truth.flow) {
    files.push_back({"flow", ".flo", [](const fs::path& path, const FrameForExport& of) {
                       WriteFileAtomically(path, FloFile(of.motion->flow));
                     }});
    files.push_back({"scene_flow", ".pfm", [](const fs::path& path, const FrameForExport& of) {
                       WriteVectorPfm(path, of.motion->scene_flow);
                     }});
  }
  if (truth.stereo) {
    files.push_back(Plain("disparity", ".pfm", &FrameMotion::disparity));
    files.push_back(Plain("occluded", ".png", &FrameMotion::occluded));
  }
  if (truth.shadows) {
    files.push_back(Plain("moving_shadow", ".png", &FrameMotion::moving_shadow));
  }
  return files;
}

std::string TruthReadme(DatasetFormat format) {
  std::string text = R"(# Truth of this dataset

Every file is named as the left image it belongs to. Truth is that of the left camera, of the right one
in folders that end in `_right`, at pixel centres; the centre of pixel (0, 0) is u = 0, v = 0. Camera:
x right, y down, z forward; the right camera stands at (+baseline, 0, 0). World: z up, metres.

| folder | file | what it holds |
|---|---|---|
| `depth`, `depth_right` | PFM, 1 channel | z along the optical axis, metres; inf: nothing was hit |
| `depth_mm` | PNG, 16 bit | the same in millimetres, rounded; 0: nothing, or beyond 65.535 m |
| `instance`, `instance_right` | PNG, 16 bit | the id in `labels.json`; 0: nothing was hit |
| `class`, `class_right` | PNG, 8 bit | the `class_id` in `labels.json` |
| `dynamic`, `dynamic_right` | PNG, 8 bit | 255: the surface moves now, that is during the exposure around the stamp |
| `actor` | PNG, 8 bit | 255: what may move, moving or not: people, vehicles, doors, conveyors, chains |
| `boxes` | JSON | the movers: 2-D boxes (x, y, width, height in pixels), 3-D box, pose and velocity in the world (metres, m/s) |
| `flow` | Middlebury .flo | u, v: displacement to the next frame's left image, pixels; 1e10: unknown |
| `scene_flow` | PFM, 3 channels | x, y, z: the surface point's own way until the next frame, metres, world axes; 0 where it rests, NaN where it is gone (a belt's box that begins anew) |
| `disparity` | PFM, 1 channel | left u - right u = fx * baseline / z, pixels; 0: nothing was hit |
| `occluded` | PNG, 8 bit | 255: the right camera does not see the point |
| `moving_shadow` | PNG, 8 bit | 255: the surface rests, and something that moves takes light from it |

PFM: rows from the bottom up, 32-bit floats, little endian (the scale line is negative), channels in the
order given. `.flo` and PNG: rows from the top down; 16-bit PNG is big endian, as PNG always is.
"The next frame" of the last one is the one that the scene would go on with.

`../aisle.json`: `first_frame` is the scene's number of the first frame here, frames follow each other
without gaps; a stamp here is the scene's time plus `stamp_offset_ns`; `T_world_poses` (4 x 4, row by
row) takes the dataset's poses into the world. )";
  text += format == DatasetFormat::kKitti
              ? "KITTI's poses are relative to the first frame, so that it is the first pose.\n"
              : "Poses here are those of the world, so that it is the identity.\n";
  return text;
}

}  // namespace aisle
