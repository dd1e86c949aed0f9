"""Ctrl-C is answered: between frames, and while a scene's light is solved."""

import os
import signal
import subprocess
import sys
import time

RENDER = """
import aisle
scene = aisle.Simulator("smoke/short")
print("open", flush=True)
while True:
    scene.render(0)
"""
OPEN = """
import aisle
print("open", flush=True)
aisle.Simulator("street/town")
"""


def interrupt(script, after_s, **environment):
    # What runs in a shell's background was told to ignore the signal, and its children with it.
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, text=True, env=os.environ | environment,
                             preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    assert child.stdout.readline() == "open\n"
    time.sleep(after_s)
    child.send_signal(signal.SIGINT)
    began = time.monotonic()
    _, errors = child.communicate(timeout=600)
    return child.returncode, errors, time.monotonic() - began


def test_between_frames():
    code, errors, seconds = interrupt(RENDER, 1)
    assert "KeyboardInterrupt" in errors and code != 0, errors
    assert seconds < 60


def test_while_the_light_of_a_street_is_solved(tmp_path):
    code, errors, _ = interrupt(OPEN, 3, AISLE_CACHE=str(tmp_path))
    assert "KeyboardInterrupt" in errors and code != 0, errors
    assert not list(tmp_path.rglob("*light*")), "half a light was kept"
