"""The guard of the arrows catches what it is there to catch."""

import unittest

import arrows

ROOMS = arrows.read_arrows(
    "simulator/world: simulator/scene\nsimulator/scene: \nsimulator/trace: simulator/world\n"
    "harness/score: harness/contract\nharness/contract: \nharness/plugs: harness/contract,simulator\n"
    "harness/cli: harness/score\n"
)


def check(path, text):
    return list(arrows.offences({path: text}, ROOMS))


class ArrowsTest(unittest.TestCase):
    def test_an_arrow_and_what_it_reaches_is_allowed(self):
        self.assertEqual(check("simulator/trace/a.cc", '#include "simulator/scene/scene.h"'), [])

    def test_against_the_arrow_is_refused(self):
        self.assertEqual(len(check("simulator/scene/a.cc", '#include "simulator/world/w.h"')), 1)

    def test_the_foundations_do_not_know_each_other(self):
        self.assertEqual(len(check("simulator/trace/a.cc", '#include "slam/stereo_slam.h"')), 1)
        self.assertEqual(len(check("slam/map/a.h", '#include "simulator/simulator.h"')), 1)

    def test_only_plugs_knows_the_faces_and_only_the_faces(self):
        face, inside = "simulator/simulator.h", "simulator/trace/rays.h"
        self.assertEqual(check("harness/plugs/a.cc", f'#include "{face}"'), [])
        self.assertEqual(len(check("harness/plugs/a.cc", f'#include "{inside}"')), 1)
        self.assertEqual(len(check("harness/score/a.cc", f'#include "{face}"')), 1)

    def test_the_slam_has_a_second_face(self):
        self.assertEqual(check("harness/plugs/a.cc", '#include "slam/moving_objects.h"'), [])
        self.assertEqual(len(check("harness/cli/a.cc", '#include "slam/moving_objects.h"')), 1)

    def test_the_face_pulls_in_options_and_values_alone(self):
        files = {
            "slam/stereo_slam.h": '#include "slam/frames.h"\n#include "slam/map/map_options.h"',
            "slam/map/map_options.h": '#include "slam/common/option_fields.h"',
        }
        self.assertEqual(list(arrows.heavy(files)), [])
        files["slam/map/map_options.h"] += '\n#include "slam/map/cull.h"'
        files["slam/map/cull.h"] = '#include "slam/map/map.h"'
        self.assertEqual(
            list(arrows.heavy(files)),
            [
                "slam/stereo_slam.h: pulls in slam/map/cull.h, through slam/map/map_options.h",
                "slam/stereo_slam.h: pulls in slam/map/map.h, through slam/map/cull.h",
            ],
        )

    def test_the_roof_keeps_to_its_list_too(self):
        self.assertEqual(check("harness/cli/a.cc", '#include "harness/contract/run.h"'), [])
        self.assertEqual(len(check("harness/cli/a.cc", '#include "harness/plugs/systems.h"')), 1)

    def test_a_face_may_be_several_headers(self):
        self.assertEqual(check("harness/plugs/a.cc", '#include "simulator/proof/proofs.h"'), [])
        self.assertEqual(len(check("harness/plugs/a.cc", '#include "simulator/proof/light.h"')), 1)

    def test_what_renders_does_not_reach_what_judges_it(self):
        text = "simulator/raster: \nsimulator/trace: {}\nsimulator: simulator/trace\nsimulator/proof: simulator\n"
        good, bad = (arrows.read_arrows(text.format(uses)) for uses in ("", "simulator/raster"))
        self.assertEqual(list(arrows.judged_by_itself(good)), [])
        self.assertEqual(len(list(arrows.judged_by_itself(bad))), 1)

    def test_nouns_are_everybodys_in_their_house_and_stand_alone(self):
        nouns = "simulator/frames.h"
        self.assertEqual(check("simulator/scene/a.cc", f'#include "{nouns}"'), [])
        self.assertEqual(len(check("harness/score/a.cc", f'#include "{nouns}"')), 1)
        self.assertEqual(len(check(nouns, '#include "simulator/scene/scene.h"')), 1)

    def test_foreign_libraries_stay_in_their_room(self):
        self.assertEqual(len(check("simulator/world/a.cc", "#include <embree3/rtcore.h>")), 1)
        self.assertEqual(check("simulator/trace/a.cc", "#include <embree3/rtcore.h>"), [])

    def test_an_arrow_that_no_file_follows_is_found(self):
        rooms = arrows.read_arrows("slam/track: slam/map,slam/camera\nslam/map: slam/camera\nslam/camera: \n")
        files = {
            "slam/track/a.cc": '#include "slam/map/map.h"',
            "slam/map/map.h": '#include "slam/camera/camera.h"',
        }
        found = list(arrows.unused(files, rooms))
        self.assertEqual(found, ["slam/track: no file of it includes anything of slam/camera"])
        files["slam/track/b.h"] = '#include "slam/camera/camera.h"'
        self.assertEqual(list(arrows.unused(files, rooms)), [])

    def test_a_room_that_the_map_lacks_is_found(self):
        page = (
            "# Rooms\n```\nsimulator/     pictures\n  world scene\n  trace          rays: lanes of\n"
            "                 eight, and deep ones\nharness/       the roof\n  cli            main()\n```\n"
        )
        entries = arrows.map_entries(page)
        self.assertEqual(
            set(entries), {"simulator/world", "simulator/scene", "simulator/trace", "harness/cli"}
        )
        there = {"simulator": set(), "simulator/scene": set(), "simulator/trace/deep": set()}
        self.assertEqual(list(arrows.unmapped(entries, there)), [])
        for lacking in ("simulator/mesh", "harness/scene", "simulator/trace/roof"):
            self.assertEqual(len(list(arrows.unmapped(entries, {lacking: set()}))), 1, lacking)
        self.assertEqual(arrows.map_entries("# A page without"), {})

    def test_cycles_are_found(self):
        self.assertTrue(arrows.cycles(arrows.read_arrows("a/b: a/c\na/c: a/b\n")))
        self.assertFalse(arrows.cycles(ROOMS))


if __name__ == "__main__":
    unittest.main()
