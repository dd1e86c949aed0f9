"""Measures what a clip does to the floor: slip of what stands on it, and penetration."""

import numpy as np

CONTACT = 0.006  # a sole point this close to the floor, in metres, is standing on it


def measure(glb, clip, stride=0.0, turn_deg=0.0, samples=240):
    """Moves the object along as a simulator would and watches every vertex of the shoes.

    Returns {"slip_m", "slip_point_m", "sink_m", "gap_m"}: the longest way the standing foot (the
    mean of its touching points) slides during one contact, the same for the worst single vertex,
    the deepest vertex under the floor, and the largest height of the lower foot above the floor.
    """
    rest = glb.vertices()
    soles = np.nonzero(rest[:, 2] < 0.03)[0]
    left = rest[soles, 1] > 0
    sides = [np.nonzero(left)[0], np.nonzero(~left)[0]]
    duration = glb.duration(clip)
    times = np.linspace(0, 2, 2 * samples + 1)
    slip = point = sink = gap = 0.0
    run = [np.zeros(2), np.zeros(2)]
    last, single = [None, None], [np.zeros((len(s), 2)) for s in sides]
    if not np.isfinite(glb.vertices(clip, 0.9 * duration)).all():
        raise ValueError(f"clip {clip} is not finite")
    places = glb.track(clip, (times % 1.0) * duration, soles)
    for t, v in zip(times, places):
        lowest = []
        for k, side in enumerate(sides):
            p = v[side]
            yaw = np.radians(turn_deg * t)
            c, s = np.cos(yaw), np.sin(yaw)
            ground = np.stack(
                [c * p[:, 0] - s * p[:, 1] + stride * t, s * p[:, 0] + c * p[:, 1]], -1
            )
            touch = p[:, 2] < CONTACT
            sink = max(sink, float(-p[:, 2].min()))
            lowest.append(p[:, 2].min())
            if last[k] is not None:
                both = touch & last[k][1]
                step = ground - last[k][0]
                run[k] = run[k] + step[both].mean(0) if both.any() else np.zeros(2)
                single[k] = np.where(both[:, None], single[k] + step, 0.0)
                slip = max(slip, float(np.hypot(*run[k])))
                point = max(point, float(np.hypot(single[k][:, 0], single[k][:, 1]).max()))
            last[k] = (ground, touch)
        gap = max(gap, float(min(lowest)))
    return {"slip_m": slip, "slip_point_m": point, "sink_m": sink, "gap_m": gap}
