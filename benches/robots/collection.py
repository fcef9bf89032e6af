"""The robots of some folders that ROS's own parser accepts: URDF files, and xacro files expanded by ROS's own xacro."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

EXPAND = """
import sys, xacro
from pathlib import Path
from xacro import substitution_args
sys.path.insert(0, sys.argv[2])
import collection
substitution_args._eval_find = lambda package: str(collection.package(package, Path(sys.argv[3])))
sys.stdout.write(xacro.process_file(sys.argv[1]).toxml())
"""


@dataclass
class Robot:
    path: Path
    # The text that ROS's parser accepts: the file, or what its xacro expands it to.
    text: str


def package(name, root):
    """The folder of a package below a root: by its manifest, otherwise by its own name."""
    for manifest in sorted(root.rglob("package.xml")):
        if re.search(rf"<name>\s*{re.escape(name)}\s*</name>", manifest.read_text(errors="replace")):
            return manifest.parent
    for folder in sorted(root.rglob(name)):
        if folder.is_dir():
            return folder
    raise LookupError(f"there is no package {name}")


def accepted(text):
    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
        file.write(text)
        file.flush()
        beside = Path(sys.executable).parent / "check_urdf"
        program = str(beside) if beside.is_file() else shutil.which("check_urdf")
        found = subprocess.run([program, file.name], capture_output=True, text=True, errors="replace")
    return found.returncode == 0 and "Successfully" in found.stdout


def expanded(path, root):
    row = [sys.executable, "-c", EXPAND, str(path), str(Path(__file__).parent), str(root)]
    try:
        found = subprocess.run(row, capture_output=True, text=True, timeout=120, env={**os.environ, "PYTHONPATH": ""})
    except subprocess.TimeoutExpired:
        return None
    return found.stdout if found.returncode == 0 else None


def robots(roots):
    """All robots below the roots, each root being a repository or a folder of packages; sorted by path."""
    for root in map(Path, roots):
        for path in sorted([*root.rglob("*.urdf"), *root.rglob("*.xacro")]):
            text = path.read_text(errors="replace") if path.suffix == ".urdf" else expanded(path, root)
            if text and accepted(text):
                yield Robot(path, text)
