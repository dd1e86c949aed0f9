#include "simulator/world/build.h"

#include <algorithm>
#include <stdexcept>

#include "simulator/common/parallel.h"
#include "simulator/mesh/import.h"
#include "simulator/scene/rig_path.h"
#include "simulator/scene/vary.h"
#include "simulator/world/actors.h"
#include "simulator/world/captured_person.h"
#include "simulator/world/colour.h"
#include "simulator/world/fittings.h"
#include "simulator/world/mechanism.h"
#include "simulator/world/own_hall.h"
#include "simulator/world/props.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

constexpr double kNanosecond_s = 1e-9;

/// Which class a vehicle model belongs to.
ObjectClass ClassOfVehicle(const std::string& model) {
  if (model.starts_with("agv")) return ObjectClass::kAgv;
  if (model.starts_with("pallet_jack")) return ObjectClass::kPalletJack;
  if (model.starts_with("car") || model.starts_with("bus")) return ObjectClass::kCar;
  if (model.starts_with("cyclist")) return ObjectClass::kCyclist;
  return ObjectClass::kForklift;
}

/// An actor with its label.
struct Cast {
  std::uint16_t instance = 0;
  MoverMotion motion;
  std::size_t clock = 0;  ///< index of the actor whose clock it keeps
  std::string name = {};
  Grip grip = {};
};

[[noreturn]] void Refuse(const Scene& scene, Mark mark, const std::string& name,
                         const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}: {}", PlaceText(scene.files, mark), name, why));
}

/// Reads every model that the scene names, so that one that is missing or broken is reported with
/// the place of the key that names it.
void ReadModels(const Scene& scene, AssetLibrary* assets) {
  const auto read_mesh = [&](const MeshSpec& mesh, const std::string& whose) {
    try {
      if (!mesh.name.empty()) assets->LoadStill(mesh.file);
    } catch (const ImportError& error) {
      Refuse(scene, mesh.mark, whose, error.what());
    }
  };
  read_mesh(scene.hall.mesh, "hall.mesh");
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
    read_mesh(prop.mesh, "props.mesh");
    if (!prop.mesh.name.empty()) continue;
    read(prop, "props.model", [&](const std::string& model) { return assets->Prop(model); });
  }
  for (const MechanismSpec& mechanism : scene.mechanisms) {
    for (const PartSpec& part : mechanism.parts) {
      if (part.shape != PartShape::kModel) continue;
      read(part, "mechanisms.parts.model",
           [&](const std::string& model) { return assets->Prop(model); });
    }
  }
  for (const PersonSpec& person : scene.people) {
    if (!person.capture.mesh.name.empty()) continue;  // read where it is made
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
double AheadBy(const Scene& scene, const VehicleSpec& vehicle, const AssetLibrary& assets) {
  if (vehicle.pushed_by.empty()) return 0;
  const auto pusher = std::ranges::find(scene.people, vehicle.pushed_by, &PersonSpec::name);
  if (pusher == scene.people.end()) {
    Refuse(scene, vehicle.mark, vehicle.name,
           fmt::format("no person named '{}' to push it", vehicle.pushed_by));
  }
  const auto& clips = assets.Person(pusher->model).clips;
  const auto push = clips.find("walk_push");
  const double hands = push == clips.end() ? 0 : push->second.handle_ahead_m;
  return hands - assets.Vehicle(vehicle.model).handle_m;
}

/// Called before one more joins the cast.
void ExpectRoom(const std::vector<Cast>& cast) {
  if (cast.size() < kMostMovers) return;
  throw std::runtime_error(
      fmt::format("a scene has at most {} movers: people, vehicles and mechanisms (one with panes "
                  "that others are seen through counts twice)",
                  kMostMovers));
}

bool SharesLoad(const Scene& scene, const std::string& person) {
  return std::ranges::any_of(scene.mechanisms, [&](const MechanismSpec& one) {
    return one.front_by == person || one.rear_by == person;
  });
}

/// Who holds a mechanism, if anybody does.
const std::string& HolderOf(const MechanismSpec& mechanism) {
  if (!mechanism.pushed_by.empty() || mechanism.taken.empty()) {
    return mechanism.pushed_by.empty() ? mechanism.rear_by : mechanism.pushed_by;
  }
  return mechanism.taken.front().by;
}

/// Mechanisms come after the actors who hold them, and keep these' clocks.
void AddMechanisms(const Scene& scene, const Palette& palette, std::uint64_t seed,
                   AssetLibrary* assets, Wardrobe* wardrobe, WorldParts* parts,
                   WorldBuilder* builder, std::vector<Cast>* cast) {
  PartPaints paints(palette, parts);
  for (const MechanismSpec& mechanism : scene.mechanisms) {
    const auto find = [&](const std::string& name) {
      const auto holder = std::ranges::find(*cast, name, &Cast::name);
      if (holder == cast->end() || !holder->grip) {
        throw std::runtime_error(fmt::format("'{}' cannot hold it", name));
      }
      return holder->grip;
    };
    try {
      std::vector<MechanismMesh> made =
          MakeMechanism(mechanism, find, assets, wardrobe, &paints, seed, builder);
      if (made.empty()) continue;
      const std::uint16_t instance = builder->Add(mechanism.name, ClassOf(mechanism), true);
      const auto holder = std::ranges::find(*cast, HolderOf(mechanism), &Cast::name);
      for (MechanismMesh& one : made) {
        ExpectRoom(*cast);
        parts->mover_meshes.push_back(std::move(one.mesh));
        const std::size_t clock =
            holder == cast->end() ? cast->size() : static_cast<std::size_t>(holder - cast->begin());
        cast->push_back({instance, std::move(one.motion), clock, mechanism.name, {}});
      }
    } catch (const std::exception& error) {
      Refuse(scene, mechanism.mark, mechanism.name, error.what());
    }
  }
}

std::vector<Cast> AddActors(const Scene& scene, const Palette& palette, std::uint64_t seed,
                            AssetLibrary* assets, Wardrobe* wardrobe, WorldParts* parts,
                            WorldBuilder* builder) {
  std::vector<Cast> cast;
  const auto enter = [&](const auto& spec, ObjectClass object_class, const auto& make) {
    try {
      ExpectRoom(cast);
      Actor actor = make();
      parts->mover_meshes.push_back(std::move(actor.mesh));
      cast.push_back({builder->Add(spec.name, object_class, true), std::move(actor.motion),
                      cast.size(), spec.name, std::move(actor.grip)});
    } catch (const std::exception& error) {
      Refuse(scene, spec.mark, spec.name, error.what());
    }
  };
  for (const PersonSpec& person : scene.people) {
    enter(person, ObjectClass::kPerson, [&] {
      if (IsCaptured(person)) return MakeCapturedPerson(person, assets, wardrobe);
      return MakePerson(person, assets, palette, Dice(seed, {430, person.place}), wardrobe,
                        SharesLoad(scene, person.name));
    });
  }
  for (const VehicleSpec& vehicle : scene.vehicles) {
    const double ahead_m = AheadBy(scene, vehicle, *assets);
    enter(vehicle, ClassOfVehicle(vehicle.model), [&] {
      return MakeVehicle(vehicle, assets, palette, Dice(seed, {420, vehicle.place}), wardrobe,
                         ahead_m);
    });
  }
  return cast;
}

/// What a hall has besides goods, with materials of its own.
void AddWork(const Scene& scene, const Palette& palette, std::uint64_t seed,
             const AssetLibrary& assets, WorldParts* parts, WorldBuilder* builder) {
  if (scene.fixtures.empty() && scene.hall.clutter <= 0) return;
  const Fittings fittings = AddFittings(assets, parts);
  AddFixtures(scene, {palette, fittings}, seed, builder);
  AddClutter(scene, {palette, fittings}, seed, builder);
}

/// Velocities of an actor that goes through its script at another rate.
void Slow(double rate, MoverState* state) {
  if (rate == 1) return;
  state->velocity_mps *= rate;
  for (Eigen::Vector3f& velocity : state->velocities) velocity *= static_cast<float>(rate);
}

/// An actor at its own time; of a frozen scene nothing moves, not even a breath.
MoverState StateOf(const Cast& actor, const ActorClock& clock, bool frozen, MoverParts parts) {
  const double time_s = static_cast<double>(clock.time_ns) * kNanosecond_s;
  MoverState state = actor.motion(frozen ? 0 : time_s, parts);
  if (frozen) {
    state.velocity_mps.setZero();
    std::ranges::fill(state.velocities, Eigen::Vector3f::Zero());
  }
  Slow(clock.rate, &state);
  state.instance = actor.instance;
  return state;
}

ActorClock ClockOf(const Cast& actor, std::int64_t stamp_ns, std::span<const ActorClock> clocks) {
  return actor.clock < clocks.size() ? clocks[actor.clock] : ActorClock{stamp_ns, 1};
}

Snapshot SnapshotAt(const Scene& scene, const std::vector<Cast>& cast, std::int64_t stamp_ns,
                    std::span<const ActorClock> clocks) {
  const double time_s = static_cast<double>(stamp_ns) * kNanosecond_s;
  Snapshot snapshot;
  snapshot.stamp_ns = stamp_ns;
  snapshot.clocks.assign(clocks.begin(), clocks.end());
  snapshot.light_scale = LightScale(scene, time_s);  // the hall's own, which no twin stops
  if (!scene.beams.empty()) {
    snapshot.beams = BeamsAt(scene, scene.frozen ? 0 : time_s, &snapshot.beam_bounce);
  }
  snapshot.movers.resize(cast.size());
  ParallelFor(std::size_t{0}, cast.size(), [&](std::size_t i) {
    snapshot.movers[i] =
        StateOf(cast[i], ClockOf(cast[i], stamp_ns, clocks), scene.frozen, MoverParts::kAll);
  });
  return snapshot;
}

}  // namespace

World BuildWorld(const Scene& written, const std::string& assets_dir, std::uint64_t seed) {
  WorldParts parts;
  WorldBuilder builder(&parts);
  AssetLibrary assets(assets_dir, written.camera.colour);
  const Scene scene = WithLooks(Seeded(written, seed), seed, assets.PeopleNames());
  ReadModels(scene, &assets);
  const Palette palette = AddPalette(scene, seed, assets, &parts);
  Wardrobe wardrobe(&parts);
  const bool is_own = !scene.hall.mesh.name.empty();
  if (is_own) AddOwnHall(scene, &assets, &wardrobe, &builder);
  if (!is_own) AddFloor(scene, palette, seed, &builder);
  AddMarkings(scene, palette, &builder);
  if (!is_own) AddWalls(scene, palette, seed, &builder);
  AddDoors(scene, palette, &builder);
  AddColumns(scene, palette, &builder);
  AddRacks(scene, palette, seed, &builder);
  AddStacks(scene, palette, seed, &builder);
  AddMezzanines(scene, palette, seed, &builder);
  AddLights(scene, palette, &parts, &builder);
  AddWork(scene, palette, seed, assets, &parts, &builder);
  AddWindows(scene, palette, &parts, &builder);
  AddProps(scene, seed, &assets, &wardrobe, &builder);
  std::vector<Cast> cast = AddActors(scene, palette, seed, &assets, &wardrobe, &parts, &builder);
  AddMechanisms(scene, palette, seed, &assets, &wardrobe, &parts, &builder, &cast);
  if (scene.camera.colour) parts.colour = ColourOf(parts, wardrobe.worn(), assets);

  parts.has_beams = !scene.beams.empty();
  const auto shared = std::make_shared<const std::vector<Cast>>(std::move(cast));
  parts.at_clocks = [scene, shared](std::int64_t stamp_ns, std::span<const ActorClock> clocks) {
    return SnapshotAt(scene, *shared, stamp_ns, clocks);
  };
  parts.at = [at = parts.at_clocks](std::int64_t stamp_ns) { return at(stamp_ns, {}); };
  parts.velocities = [frozen = scene.frozen, shared](std::size_t mover, std::int64_t stamp_ns,
                                                     std::span<const ActorClock> clocks) {
    const Cast& actor = (*shared)[mover];
    const ActorClock clock = ClockOf(actor, stamp_ns, clocks);
    return StateOf(actor, clock, frozen, MoverParts::kVelocities).velocities;
  };
  parts.rig = RigPathOf(scene);
  parts.files_digest = assets.Digest();
  return World(std::move(parts));
}

}  // namespace aisle::sim
