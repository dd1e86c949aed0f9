"""Holds every #include of our own against the rooms' arrows.

Usage: arrows.py SOURCE_DIR ARROWS_FILE. The arrows file is written by CMake, a line per room:
"simulator/truth: simulator/trace,simulator/world". A room may include itself and whatever it
reaches through its arrows, and its house's nouns (frames.h), which include nothing of ours. An
arrow that none of its files follows does not belong in the list. Every room has its line in the map
of rooms, a room within a room its name in the line of the one around it. Across houses only the faces
are open, and only to harness/plugs (and to the tests, which may include anything of the room they
test). What renders reaches nothing of what judges it. The SLAM's main face
pulls in options and values alone, so that its insides can change.
"""

import pathlib
import re
import sys

MAPS = ("README.md", "reports/docs/architecture.md")  # where the map of rooms may stand
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
HOUSES = ("simulator", "slam", "harness")
NOUNS = {f"{house}/frames.h" for house in HOUSES}  # any room of the house may include them
FACES = {  # what a foundation shows to harness/plugs, and to other people's programs
    "simulator/simulator.h",
    "simulator/scene_file.h",
    "simulator/site.h",
    "simulator/import_model.h",
    "simulator/calibration/stereo_model.h",
    "simulator/proof/proofs.h",
    "slam/stereo_slam.h",
    "slam/moving_objects.h",
}
RENDERER = "simulator"
JUDGES = {"simulator/proof", "simulator/raster", "simulator/shade/reference", "simulator/foreign"}
LEAN_FACES = {  # what they may pull in, at whatever depth
    "slam/stereo_slam.h": re.compile(
        r"slam/(frames|[a-z0-9_/]+_options|camera/[a-z0-9_]+|common/option_fields"
        r"|dynamic/common/dynamic_regions)\.h"
    ),
}
ROOMS_THAT_SEE = {  # foreign headers that one room alone may see
    "embree3/": {"simulator/trace"},
    "assimp/": {"simulator/mesh"},
    "GL/osmesa": {"simulator/raster"},
    "ceres/": {"slam/optimize"},
}
FOREIGN = re.compile(r"^\s*#\s*include\s+<([^>]+)>", re.MULTILINE)


def read_arrows(text):
    arrows = {}
    for line in text.splitlines():
        room, _, uses = line.partition(":")
        if room.strip():
            arrows[room.strip()] = {use for use in uses.strip().split(",") if use}
    return arrows


def reach(arrows, room):
    seen, queue = set(), [room]
    while queue:
        here = queue.pop()
        if here not in seen:
            seen.add(here)
            queue.extend(arrows.get(here, ()))
    return seen


def cycles(arrows):
    return [room for room in arrows for use in arrows[room] if room in reach(arrows, use)]


def judged_by_itself(arrows):
    """Yields a sentence for each judge that the renderer reaches."""
    for judge in sorted(reach(arrows, RENDERER) & JUDGES):
        yield f"{RENDERER}: what renders must not reach {judge}, which judges it"


def room_of(path):
    """The room of a file such as simulator/trace/rays.h or simulator/simulator.h."""
    return str(pathlib.PurePosixPath(path).parent)


def offences(files, arrows):
    """files: {path: text}. Yields a sentence for each forbidden include."""
    for path, text in sorted(files.items()):
        room = room_of(path)
        house = path.split("/")[0]
        allowed = reach(arrows, room)
        for include in INCLUDE.findall(text):
            target_house = include.split("/")[0]
            if target_house not in HOUSES:
                yield f'{path}: "{include}" is not a path from the root of the tree'
            elif target_house != house:
                if room != "harness/plugs" or include not in FACES:
                    yield f"{path}: {room} must not know {include}"
            elif path in NOUNS:
                yield f"{path}: nouns stand by themselves, without {include}"
            elif include in NOUNS:
                continue
            elif room_of(include) not in allowed:
                yield f"{path}: no arrow leads from {room} to {room_of(include)} ({include})"
        for include in FOREIGN.findall(text):
            for prefix, rooms in ROOMS_THAT_SEE.items():
                if include.startswith(prefix) and room not in rooms:
                    yield f"{path}: only {', '.join(sorted(rooms))} may include <{include}>"


def unused(files, arrows):
    """Yields a sentence for each arrow that no file of its room follows itself."""
    followed = {}
    for path, text in files.items():
        rooms = followed.setdefault(room_of(path), set())
        rooms.update(room_of(include) for include in INCLUDE.findall(text))
    for room, uses in sorted(arrows.items()):
        for use in sorted(uses - followed.get(room, set())):
            yield f"{room}: no file of it includes anything of {use}"


def map_entries(page):
    """{room: what stands in its entry} of the block that lists the rooms, empty where there is none."""
    block = re.search(r"^```\w*\n(simulator/ .*?)^```$", page, re.M | re.S)
    entries, house, rooms = {}, "", []
    for line in block.group(1).splitlines() if block else ():
        if top := re.match(r"(\w+)/ ", line):
            house, rooms = top.group(1), []
        elif entry := re.match(r"  (\S+(?: \S+)*)(?:  .*)?$", line):
            rooms = [f"{house}/{name}" for name in entry.group(1).split()]
        for room in rooms:
            entries[room] = entries.get(room, "") + line + "\n"
    return entries


def unmapped(entries, arrows):
    """Yields a sentence for each room without a line in the map."""
    for room in sorted(arrows):
        house, *names = room.split("/")
        if not names or room in entries:
            continue  # the face of a house is the house's own line
        around = entries.get(f"{house}/{names[0]}", "")
        if len(names) == 1 or not re.search(rf"\b{names[-1]}\b", around):
            yield f"{room}: not in the map of rooms ({' or '.join(MAPS)})"


def pulled_in(files, face):
    """What a header includes at whatever depth, itself left out: {path: the file that includes it}."""
    by, queue = {}, [face]
    while queue:
        here = queue.pop()
        for include in INCLUDE.findall(files.get(here, "")):
            if include != face and include not in by:
                by[include] = here
                queue.append(include)
    return by


def heavy(files):
    """Yields a sentence for each header that a lean face should not pull in."""
    for face, may in LEAN_FACES.items():
        for include, by in sorted(pulled_in(files, face).items()):
            if not may.fullmatch(include):
                yield f"{face}: pulls in {include}, through {by}"


def main(source_dir, arrows_file):
    source = pathlib.Path(source_dir)
    arrows = read_arrows(pathlib.Path(arrows_file).read_text())
    files = {}
    for house in HOUSES:
        for path in source.glob(f"{house}/**/*"):
            if path.suffix in (".h", ".cc"):
                files[path.relative_to(source).as_posix()] = path.read_text()
    found = list(offences(files, arrows)) + list(unused(files, arrows))
    pages = [source / page for page in MAPS if (source / page).exists()]
    maps = [entries for page in pages if (entries := map_entries(page.read_text()))]
    found += list(unmapped(maps[0] if maps else {}, arrows))
    found += list(heavy(files))
    found += [f"{room} is on a cycle" for room in cycles(arrows)]
    found += list(judged_by_itself(arrows))
    for offence in found:
        print(offence)
    print(f"{len(files)} files, {len(arrows)} rooms, {len(found)} offences")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
