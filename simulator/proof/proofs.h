#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <string>

namespace aisle::sim {

class Simulator;

// What judges a simulator from outside, times it, and finds where two machines part. Nothing that
// renders includes it; a program that uses it links simulator_proof. `frame_index` is that of a
// planned frame, as Simulator has it; all is a pure function of simulator and arguments but the
// times. Throws std::invalid_argument for a count that is not positive.

/// What Verify says of one frame.
struct VerifyReport {
  double raster_agreement_left = 0;   ///< share of pixels away from silhouettes where OSMesa agrees
  double raster_agreement_right = 0;  ///< in label and in depth to 1e-3
  int raster_compared = 0, raster_pixels = 0;  ///< of both pictures; the latter all there are
  double stereo_median_px = 0;  ///< left warped to right by disparity, error of geometry
  double flow_median_px = 0;    ///< left warped to the next left by flow, as disparity
  int surface_pixels = 0;       ///< of the left picture: that show anything
  int stereo_compared = 0, flow_compared = 0;
  /// Grey against grey over three frames without noise, see proof/picture_change.h: rms change of
  /// things at rest along their flow, flicker of movers and of moving shadows; grey levels, 0 where
  /// too little of it is seen.
  double static_change_grey = 0, mover_flicker_grey = 0, shadow_flicker_grey = 0;
  std::string picture_failure = {};  ///< of the three, or empty
  /// The sentence that says what failed its bound (0.999 agreement on at least a tenth of the
  /// pixels, 0.05 px on at least a hundredth of those that show anything), or empty.
  std::string failure() const;
};

/// Proves one planned frame: its truth against an independent rasteriser and by warping it to the
/// right camera and to the next frame, its picture by warping it to the next two.
VerifyReport Verify(const Simulator& simulator, int frame_index);

/// How long rendering a frame of a drive takes, beside the bare cost of its primary rays in the
/// same process.
struct RenderBench {
  double pair_ms = 0;        ///< a stereo pair with all truth, median
  double after_jump_ms = 0;  ///< one that comes after a jump to another place of the drive, median
  double bare_primary_ms = 0;  ///< primary ray packets of the same two images alone, median
  double ratio = 0;            ///< pair_ms / bare_primary_ms
  int frames = 0;
  std::int64_t triangles = 0, moving_triangles = 0;  ///< of the world; the movers' among them
  std::map<std::string, double> stage_ms;            ///< medians by stage
};

/// Times Render over `frames` frames spread over the scene, and the bare primary rays of the same
/// frames, interleaved so that both meet the same machine.
RenderBench BenchRender(const Simulator& simulator, int frames);

/// The stages of a frame, in the order in which they feed each other.
inline constexpr std::array kStages = {"triangles", "points", "static light", "radiance",
                                       "pictures"};

/// A hash of what each of kStages made of a frame for both cameras: which triangle a pixel sees;
/// where on it (t, u, v); the light on the static world; the radiance before the sensor; the
/// pictures. For finding where two machines part.
using StageHashes = std::array<std::uint64_t, kStages.size()>;

/// Renders one planned frame and hashes what its stages made.
StageHashes HashStages(const Simulator& simulator, int frame_index);

/// The light of one left image as Render has it beside the path tracer's, before the sensor:
/// linear, in shares of the sensor's white.
struct LightCheck {
  cv::Mat1f rendered, reference;
  double median_relative_error = 0;  ///< over pixels
  double ssim = 0;                   ///< structural similarity, what is over white cut to white
  double mean_ratio = 0;             ///< rendered over reference
  /// The same of two references of half as many paths each, against each other: what of the error
  /// is the paths' own noise.
  double noise_median_relative = 0, noise_ssim = 0;
  std::array<cv::Mat1f, 2> halves;  ///< these two; the reference is their mean
};

/// Renders one planned left image as Render does and by path tracing, `samples` paths a pixel:
/// minutes. Both are compared at a size reduced by a whole factor, which leaves the paths' noise
/// the smaller. Throws std::runtime_error where the scene has what the path tracer does not draw:
/// beams, and panes that are seen through.
LightCheck CheckLight(const Simulator& simulator, int frame_index, int samples, int reduce);

/// How the light of one left image changes to the next frame's, beside how the path tracer's does.
struct LightChangeCheck {
  struct Part {
    int pixels = 0;
    double rms_rendered = 0, rms_reference = 0;  ///< of the changes, in shares of white
    double rms_between = 0;                      ///< of one change less the other
    double rms_noise = 0;                        ///< what of it is the paths' own noise
    double correlation = 0;                      ///< of the two changes
  };
  LightCheck now;
  Part everywhere, on_movers;  ///< the latter in either frame, and the pixel around them
};

/// CheckLight of a frame, and how its light changes to the next one's, whose paths have the same
/// seeds. Throws likewise.
LightChangeCheck CheckLightChange(const Simulator& simulator, int frame_index, int samples,
                                  int reduce);

struct ForeignOptions {
  int samples = 256;  ///< paths a pixel
  int depth = 8;      ///< surfaces a path may touch; 1 shows luminaires alone
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has
};

/// Path-traces a scene of another renderer (simulator/foreign describes the dialect), so that the
/// judge of our light can be held against theirs, each colour by itself: linear radiance, channels
/// in OpenCV's order B, G, R. Throws std::runtime_error: "file: key: what is wrong".
cv::Mat3f TraceForeignScene(const std::string& file, const ForeignOptions& options);

}  // namespace aisle::sim
