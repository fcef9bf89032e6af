"""Links and joints as a graph of networkx."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import networkx


def graph(
    links: Iterable[str], ground: str | None, joints: Iterable[Mapping[str, Any]]
) -> networkx.MultiGraph[str]:
    """Links as nodes and joints as edges; each joint has ``name`` and ``links``, and whatever else becomes the edge's data."""
    import networkx

    made: networkx.MultiGraph[str] = networkx.MultiGraph()
    for link in links:
        made.add_node(link, ground=link == ground)
    for joint in joints:
        first, second = joint["links"]
        data = {key: value for key, value in joint.items() if key != "links"}
        made.add_edge(first, second, key=joint["name"], **data)
    return made
