#!/usr/bin/env bash
# Opens a log in the Rerun viewer without a screen or a graphics card, and takes a picture of its window:
#
#     tests/viewers/open_in_rerun.sh LOG.mcap PICTURE.png [--size 1600x1000] [--check]
#
# Debian packages: python3-venv xvfb mesa-vulkan-drivers (software Vulkan). The Python packages are put into
# target/viewer on first use, unless KUTZBACH_PYTHON names an interpreter that has them.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)

python=${KUTZBACH_PYTHON:-}
if [ -z "$python" ] || ! "$python" -c 'import rerun, mcap_protobuf' 2>/dev/null; then
    venv=${CARGO_TARGET_DIR:-$root/target}/viewer
    python=$venv/bin/python
    if ! "$python" -c 'import rerun, mcap_protobuf' 2>/dev/null; then
        python3 -m venv "$venv"
        "$python" -m pip install --quiet --requirement "$here/requirements-viewer.txt"
    fi
fi

command -v xvfb-run >/dev/null || { echo "needs xvfb-run: apt-get install xvfb" >&2; exit 1; }
lavapipe=$(find /usr/share/vulkan/icd.d /etc/vulkan/icd.d -name 'lvp_icd*.json' 2>/dev/null | head -n 1)
[ -n "$lavapipe" ] || { echo "needs software Vulkan: apt-get install mesa-vulkan-drivers" >&2; exit 1; }
export PYTHONDONTWRITEBYTECODE=1
export VK_DRIVER_FILES=$lavapipe VK_ICD_FILENAMES=$lavapipe WGPU_BACKEND=vulkan

# The viewer keeps settings in the home folder and asks about statistics on first use: it gets an empty one of its own.
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
mkdir -m 700 "$home/runtime"
export HOME=$home XDG_RUNTIME_DIR=$home/runtime
"$python" -m rerun analytics disable >/dev/null 2>&1 || true

# The pointer waits in the middle of the screen: far from the window, or it would point at something.
xvfb-run --auto-servernum --server-args="-screen 0 6600x4200x24" "$python" "$here/open_in_rerun.py" "$@"
