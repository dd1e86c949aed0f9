#include "simulator/world/build.h"

#include <algorithm>
#include <stdexcept>

#include "simulator/motion/rig_mount.h"
#include "simulator/scene/vary.h"
#include "simulator/world/actors.h"
#include "simulator/world/fittings.h"
#include "simulator/world/props.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

constexpr double kNanosecond_s = 1e-9;

/// Which class a vehicle model belongs to.
ObjectClass ClassOfVehicle(const std::string& model) {
  if (model.starts_with("agv")) return ObjectClass::kAgv;
  if (model.starts_with("pallet_jack")) return ObjectClass::kPalletJack;
  if (model.starts_with("car")) return ObjectClass::kCar;
  if (model.starts_with("cyclist")) return ObjectClass::kCyclist;
  return ObjectClass::kForklift;
}

/// An actor with its label.
struct Cast {
  std::uint16_t instance = 0;
  std::function<MoverState(double)> at;
};

[[noreturn]] void Refuse(const Scene& scene, Mark mark, const std::string& name,
                         const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}: {}", PlaceText(scene.files, mark), name, why));
}

/// Reads every model that the scene names, so that one that is missing or broken is reported with
/// the place of the key that names it.
void ReadModels(const Scene& scene, AssetLibrary* assets) {
  const auto read = [&](const auto& spec, const std::string& whose, const auto& asset_of) {
    try {
      assets->Load(asset_of(spec.model));
    } catch (const std::system_error&) {
      throw;  // the machine's, not the model's
    } catch (const std::exception& error) {
      Refuse(scene, spec.model_mark, whose, error.what());
    }
  };
  for (const PropSpec& prop : scene.props) {
    read(prop, "props.model", [&](const std::string& model) { return assets->Prop(model); });
  }
  for (const PersonSpec& person : scene.people) {
    read(person, "model of " + person.name, [&](const std::string& model) {
      assets->Person(model);  // the manifest must know it
      return "people/" + model;
    });
  }
  for (const VehicleSpec& vehicle : scene.vehicles) {
    read(vehicle, "model of " + vehicle.name, [&](const std::string& model) {
      assets->Vehicle(model);
      return "vehicles/" + model;
    });
  }
}

/// How far ahead of the person behind its handle a pushed vehicle's origin is.
double AheadOfPusher(const Scene& scene, const VehicleSpec& vehicle, const AssetLibrary& assets) {
  if (vehicle.pushed_by.empty()) return 0;
  const auto pusher = std::ranges::find(scene.people, vehicle.pushed_by, &PersonSpec::name);
  if (pusher == scene.people.end()) {
    Refuse(scene, vehicle.mark, vehicle.name,
           fmt::format("there is nobody '{}' to push it", vehicle.pushed_by));
  }
  const auto& clips = assets.Person(pusher->model).clips;
  const auto push = clips.find("walk_push");
  const double hands = push == clips.end() ? 0 : push->second.handle_ahead_m;
  return hands - assets.Vehicle(vehicle.model).handle_m;
}

std::vector<Cast> AddActors(const Scene& scene, const Palette& palette, std::uint64_t seed,
                            AssetLibrary* assets, Wardrobe* wardrobe, WorldParts* parts,
                            Site* site) {
  std::vector<Cast> cast;
  const auto enter = [&](const auto& spec, ObjectClass object_class, const auto& make) {
    try {
      Actor actor = make();
      parts->mover_meshes.push_back(std::move(actor.mesh));
      cast.push_back({site->Add(spec.name, object_class, true), std::move(actor.at)});
    } catch (const std::exception& error) {
      Refuse(scene, spec.mark, spec.name, error.what());
    }
  };
  for (const PersonSpec& person : scene.people) {
    enter(person, ObjectClass::kPerson, [&] {
      return MakePerson(person, assets, palette, Dice(seed, {430, person.place}), wardrobe);
    });
  }
  for (const VehicleSpec& vehicle : scene.vehicles) {
    const double ahead_m = AheadOfPusher(scene, vehicle, *assets);
    enter(vehicle, ClassOfVehicle(vehicle.model), [&] {
      return MakeVehicle(vehicle, assets, palette, Dice(seed, {420, vehicle.place}), wardrobe,
                         ahead_m);
    });
  }
  return cast;
}

/// What a hall has besides goods, with materials of its own.
void AddWork(const Scene& scene, const Palette& palette, std::uint64_t seed,
             const AssetLibrary& assets, WorldParts* parts, Site* site) {
  if (scene.fixtures.empty() && scene.hall.clutter <= 0) return;
  const Fittings fittings = AddFittings(assets, parts);
  AddFixtures(scene, {palette, fittings}, seed, site);
  AddClutter(scene, {palette, fittings}, seed, site);
}

/// Velocities of an actor that goes through its script at another rate.
void Slow(double rate, MoverState* state) {
  if (rate == 1) return;
  state->velocity_mps *= rate;
  for (Eigen::Vector3f& velocity : state->velocities) velocity *= static_cast<float>(rate);
}

}  // namespace

World BuildWorld(const Scene& written, const std::string& assets_dir, std::uint64_t seed) {
  WorldParts parts;
  Site site(&parts);
  AssetLibrary assets(assets_dir);
  const Scene scene = WithLooks(Seeded(written, seed), seed, assets.PeopleNames());
  ReadModels(scene, &assets);
  const Palette palette = AddPalette(scene, seed, assets, &parts);
  AddFloor(scene, palette, seed, &site);
  AddMarkings(scene, palette, &site);
  AddWalls(scene, palette, seed, &site);
  AddDoors(scene, palette, &site);
  AddColumns(scene, palette, &site);
  AddRacks(scene, palette, seed, &site);
  AddStacks(scene, palette, seed, &site);
  AddMezzanines(scene, palette, seed, &site);
  AddLights(scene, palette, &parts, &site);
  AddWork(scene, palette, seed, assets, &parts, &site);
  Wardrobe wardrobe(&parts);
  AddProps(scene, seed, &assets, &wardrobe, &site);
  const std::vector<Cast> cast = AddActors(scene, palette, seed, &assets, &wardrobe, &parts, &site);

  parts.at_clocks = [scene, cast](std::int64_t stamp_ns, std::span<const ActorClock> clocks) {
    Snapshot snapshot;
    snapshot.stamp_ns = stamp_ns;
    snapshot.clocks.assign(clocks.begin(), clocks.end());
    snapshot.light_scale = LightScale(scene, static_cast<double>(stamp_ns) * kNanosecond_s);
    for (std::size_t i = 0; i < cast.size(); ++i) {
      const ActorClock clock = clocks.empty() ? ActorClock{stamp_ns, 1} : clocks[i];
      const double time_s = static_cast<double>(clock.time_ns) * kNanosecond_s;
      MoverState state = cast[i].at(scene.frozen ? 0 : time_s);
      if (scene.frozen) {  // nothing moves, not even a breath
        state.velocity_mps.setZero();
        std::ranges::fill(state.velocities, Eigen::Vector3f::Zero());
      }
      Slow(clock.rate, &state);
      state.instance = cast[i].instance;
      snapshot.movers.push_back(std::move(state));
    }
    return snapshot;
  };
  parts.at = [at = parts.at_clocks](std::int64_t stamp_ns) { return at(stamp_ns, {}); };
  if (!scene.rig.poses.empty()) {
    const RigMount& mount = scene.rig.mount;
    const Eigen::Isometry3d T_body_rig =
        scene.rig.body == TrajectoryBody::kCamera
            ? Eigen::Isometry3d::Identity()
            : RigPose({.position = Eigen::Vector2d::Zero(), .heading_rad = 0}, mount, {}, 0);
    parts.rig = [path = RecordedPath(scene.rig.poses), T_body_rig](std::int64_t stamp_ns) {
      return path.At(stamp_ns) * T_body_rig;
    };
    return World(std::move(parts));
  }
  const Route route(scene.rig.route.plan, scene.rig.route.limits);
  parts.rig = [route, rig = scene.rig](std::int64_t stamp_ns) {
    const double time_s = static_cast<double>(stamp_ns) * kNanosecond_s;
    return RigPose(route.At(time_s), rig.mount, rig.bumps, time_s);
  };
  return World(std::move(parts));
}

}  // namespace aisle::sim
