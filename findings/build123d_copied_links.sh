#!/usr/bin/env bash
# build123d 0.13.0: links that share one shape come back from a STEP file with the name and the colour of the last of them.
#
# copy.copy makes further instances of a part that share its geometry, each with a label, a colour and a location of its own. export_step
# writes one product for all of them, called like the last, and the labels as the names of the three usages of that product in the assembly.
# import_step takes the name of the product: crank, coupler and rocker, red, green and blue, are three blue rockers, at the right places.
# With copy.deepcopy, or three boxes, the labels and colours come back. The colours are not in the first file; the labels are.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check build123d==0.13.0
cat > "$folder/try.py" <<'PYTHON'
import copy
import importlib.metadata
import re
import sys
from build123d import Box, Color, Compound, Location, export_step, import_step

names, colours = ("crank", "coupler", "rocker"), ("red", "green", "blue")


def there_and_back(instance):
    """Labels and colours after writing and reading, and the names of usages and products in the file."""
    bar = Box(10, 1, 1)
    links = []
    for place, (name, colour) in enumerate(zip(names, colours)):
        link = instance(bar)
        link.label, link.color, link.location = name, Color(colour), Location((0, 3 * place, 0))
        links.append(link)
    path = sys.argv[1] + "/linkage.step"
    export_step(Compound(label="linkage", children=links), path)
    text = open(path).read()
    usages = re.findall(r"NEXT_ASSEMBLY_USAGE_OCCURRENCE\('[^']*','([^']*)'", text)
    products = re.findall(r"PRODUCT\('[^']*','([^']*)'", text)
    read = sorted(import_step(path).children, key=lambda link: link.center().Y)
    hues = [colours[max(range(3), key=lambda part: tuple(link.color)[part])] for link in read]
    assert [round(link.center().Y, 6) for link in read] == [0, 3, 6]
    return [link.label for link in read], hues, usages, products


right = True
for instance, labels, hues, products in (
    (copy.copy, ["rocker"] * 3, ["blue"] * 3, ["linkage", "rocker"]),
    (copy.deepcopy, list(names), list(colours), ["linkage", *names]),
):
    seen = there_and_back(instance)
    print(f"{instance.__name__}: read {seen[0]}, {seen[1]}; in the file usages {seen[2]}, products {seen[3]}")
    right &= seen == (labels, hues, list(names), products)
print("build123d", importlib.metadata.version("build123d"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" | grep -v '^$' | grep -E '^(copy|deepcopy|build123d)'
