#pragma once

#include <memory>
#include <vector>

#include "harness/contract/sequence.h"
#include "harness/contract/system_option.h"
#include "harness/contract/system_spec.h"
#include "harness/loop/drive_scene.h"
#include "harness/vehicle/odometry.h"

namespace aisle {

SystemOption DescribeOdometry();
/// Whether a system is to be handed it.
bool WantsOdometry(const SystemSpec& system);

/// What is wrong with the value of kOdometryOption, or an empty string.
std::string CheckOdometry(const std::string& value);

/// How a vehicle's wheels err, and what rolls on them: where nobody says it, a differential drive.
struct Wheels {
  OdometryOptions odometry = {};
  PlantOptions plant = {};
};

/// What the wheels of a rig's vehicle make of its planned way, for every frame but the first: the
/// motion of the rig since the frame before. The rig is mounted as the first frame shows it, on a
/// vehicle that turns about some point beneath it; what the vehicle does besides rolling (jolts) is
/// not measured, but allowed for. Errors as of an Odometer of these wheels; the covariance counts
/// those of its calibration as if they were drawn anew every 5 m. Nothing is measured to or from a
/// frame whose pose nobody knows.
WheelMotions MeasureByWheels(const std::vector<FrameRequest>& schedule, const Wheels& wheels,
                             std::uint64_t seed);

/// Of a sequence: what was recorded of its wheels, else the same. Throws InputError for one whose
/// way nobody knows, or whose truth has its z anywhere but up.
WheelMotions MeasureByWheels(const Sequence& sequence, std::uint64_t seed,
                             const Wheels& wheels = {});

/// The same frames with what the wheels measured. Throws InputError for a sequence whose way nobody
/// knows.
std::unique_ptr<Sequence> WithOdometry(std::unique_ptr<Sequence> sequence, std::uint64_t seed,
                                       const Wheels& wheels = {});

/// The same drive, whose pictures come with what the vehicle's own wheels have measured since the
/// picture that the system looked at before: the very readings by which the vehicle steers between
/// pictures.
std::unique_ptr<DriveScene> WithOdometry(std::unique_ptr<DriveScene> scene);

}  // namespace aisle
