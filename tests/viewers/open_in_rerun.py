#!/usr/bin/env python3
"""Opens a log in the Rerun viewer and takes a picture of its window.

    python open_in_rerun.py LOG.mcap PICTURE.png [--size 1600x1000] [--check]

The viewer reads the log itself: `/tf`, `/robot_description`, `/log` and the numbers. This script gives it a layout
and a place for the camera, nothing else. With --check the picture must show the mechanism: it counts the pixels that have
the colours of links and joints. Needs a display; `open_in_rerun.sh` brings one without a screen.
"""

import argparse
import colorsys
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import rerun as rr
import rerun.blueprint as rrb
from PIL import Image
from rerun.blueprint.encodings import ComponentSourceKind, VisualizerComponentMapping

import read_log

# The viewer starts, loads and draws in seconds even in software.
PATIENCE = 180


def places_of(log):
    """Where links and shapes of the log are in `world`, at a handful of moments."""
    centres = {}
    for scene in log["scene"]:
        for entity in scene["entities"].values():
            centres.setdefault(entity["frame"], []).extend(entity["centres"])
    places = []
    # Both streams have their turn: the step is odd.
    for moment in log["poses"][:: len(log["poses"]) // 100 * 2 + 1]:
        offset = log["offsets"][moment["stream"]]
        for link, pose in moment["links"].items():
            for centre in centres.get(f"{moment['stream']}/{link}", []):
                turned = read_log.rotate(pose["rotation"], centre)
                places.append([o + t + c for o, t, c in zip(offset, pose["translation"], turned)])
    return places


def unit(v):
    return [x / math.hypot(*v) for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def camera(places):
    """A view from the front and above, as close as everything fits."""
    low = [min(place[i] for place in places) for i in range(3)]
    high = [max(place[i] for place in places) for i in range(3)]
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    extent = math.dist(low, high) or 1.0
    back = unit((0.1, -0.9, 1.2))
    right = unit(cross([0.0, 0.0, 1.0], back))
    up = cross(back, right)

    def fits(distance):
        # The viewer's eye opens to 55 degrees from top to bottom; the view is more than twice as wide as high.
        half = math.tan(math.radians(55) / 2)
        for place in places:
            x, y, z = (sum((p - m) * e for p, m, e in zip(place, middle, axis)) for axis in (right, up, back))
            depth = distance - z
            if depth <= 0 or abs(y) > 0.8 * half * depth or abs(x) > 1.7 * half * depth:
                return False
        return True

    distance = 0.3 * extent
    while not fits(distance):
        distance *= 1.05
    return rrb.EyeControls3D(
        position=[m + distance * d for m, d in zip(middle, back)],
        look_target=middle,
        eye_up=[0.0, 0.0, 1.0],
    )


def series(name, component, selector, colour):
    """One line of a plot: a number inside a message."""
    source = VisualizerComponentMapping(
        "Scalars:scalars",
        ComponentSourceKind.SourceComponent,
        source_component=component,
        selector=selector,
    )
    return rr.SeriesLines(names=name, colors=colour, widths=2).visualizer(mappings=[source])


def layout(log):
    blue, amber = [90, 150, 240], [245, 190, 50]
    mechanism = rrb.Spatial3DView(
        name="predicted (left) and simulated (right)",
        origin="/",
        contents=["$origin/**"],
        eye_controls=camera(places_of(log)),
        line_grid=False,
        background=[250, 250, 250],
        # Primitive shapes of a robot description are drawn as wires unless the view says otherwise.
        defaults=[
            kind.from_fields(fill_mode=rr.components.FillMode.Solid)
            for kind in (rr.Boxes3D, rr.Cylinders3D, rr.Ellipsoids3D)
        ],
    )
    closure = rrb.TimeSeriesView(
        name="/mobility/closure: largest gap (m)",
        origin="/mobility/closure",
        overrides={
            "/mobility/closure": [
                series("predicted", "closure.Closure:message", ".predicted.position", blue),
                series("simulated", "closure.Closure:message", ".simulated.position", amber),
            ]
        },
    )
    drive = rrb.TimeSeriesView(
        name="/mobility/prediction: driven joint (rad)",
        origin="/mobility/prediction",
        overrides={
            "/mobility/prediction": [
                series("predicted", "prediction.Prediction:message", ".predicted", blue)
            ]
        },
    )
    error = rrb.TimeSeriesView(
        name="/mobility/error: about how far the scene is off",
        origin="/mobility/error",
        overrides={
            "/mobility/error": [series("error", "estimate.Estimate:message", ".error", amber)]
        },
    )
    return rrb.Blueprint(
        rrb.Vertical(
            mechanism,
            rrb.Horizontal(closure, drive, error, rrb.TextLogView(name="/log", origin="/log")),
            row_shares=[3, 1],
        ),
        rrb.BlueprintPanel(state="hidden"),
        rrb.SelectionPanel(state="hidden"),
        rrb.TimePanel(state="collapsed", timeline="message_log_time", play_state="following"),
        auto_views=False,
        auto_layout=False,
    )


def shows_the_mechanism(picture):
    """Whether there are links (blue to violet) and joints (amber) to see, by hue."""
    hues = {"links": 0, "joints": 0}
    image = Image.open(picture).convert("RGB")
    # Without the viewer's own bars and plots, which are colourful too.
    width, height = image.size
    scene = image.crop((0, height // 12, width, int(0.68 * height)))
    for red, green, blue in scene.get_flattened_data():
        hue, saturation, value = colorsys.rgb_to_hsv(red / 255, green / 255, blue / 255)
        if saturation > 0.25 and value > 0.25:
            if 0.45 < hue < 0.70:
                hues["links"] += 1
            elif 0.09 < hue < 0.18:
                hues["joints"] += 1
    share = {name: count / (scene.width * scene.height) for name, count in hues.items()}
    print("pixels:", share)
    return share["links"] > 1e-3 and share["joints"] > 1e-4


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("log", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--size", default="1600x1000")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    log = read_log.read(arguments.log)
    if not log["poses"]:
        sys.exit("the log has no motion to show")
    with tempfile.TemporaryDirectory() as folder:
        # The viewer's own importer reads the log; the layout goes into the same file, or else the viewer would make up one.
        both = Path(folder) / "log_and_layout.rrd"
        with rr.RecordingStream("kutzbach") as recording:
            recording.save(both, default_blueprint=layout(log))
            recording.log_file_from_path(arguments.log)
        command = [sys.executable, "-m", "rerun", "--port", "auto", "--hide-welcome-screen"]
        command += ["--renderer", "vulkan", "--window-size", arguments.size]
        command += ["--screenshot-to", arguments.picture, both]
        subprocess.run(command, check=True, timeout=PATIENCE)
    if not arguments.picture.exists():
        sys.exit("the viewer took no picture")
    if arguments.check and not shows_the_mechanism(arguments.picture):
        sys.exit("the picture does not show the mechanism")
    # The viewer draws two pixels for each one asked for.
    size = tuple(int(x) for x in arguments.size.split("x"))
    picture = Image.open(arguments.picture).convert("RGB").resize(size, Image.Resampling.LANCZOS)
    picture.save(arguments.picture, optimize=True)


if __name__ == "__main__":
    main()
