"""A chart with two logarithmic axes as SVG, light and dark."""

import math

COLOURS = {  # light, dark
    "kutzbach": ("#1b7f5c", "#5fd3a5"),
    "exudyn": ("#b3541e", "#f2a26b"),
    "mujoco": ("#1f4e9c", "#7fb0ff"),
    "drake": ("#8a3d8f", "#d79be0"),
}
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 860, 500, 78, 836, 64, 440


def style():
    pick = lambda i: "".join(f".{name}{{stroke:{c[i]};fill:{c[i]}}}" for name, c in COLOURS.items())
    return (
        "text{font:12px system-ui,Helvetica,Arial,sans-serif;fill:#223}.title{font-weight:600;font-size:14px}"
        ".mid{text-anchor:middle}.end{text-anchor:end}.small{font-size:11px}.back{fill:#fff}.frame{fill:none;stroke:#9ab}"
        f".grid{{stroke:#e3e9ee}}{pick(0)}.line{{fill:none;stroke-width:1.6}}"
        "@media(prefers-color-scheme:dark){text{fill:#dde3ea}.back{fill:#161b22}.frame{stroke:#56616d}"
        f".grid{{stroke:#2a323b}}{pick(1)}.line{{fill:none}}}}"
    )


def seconds(value):
    return f"{value * 1e6:g} µs" if value < 0.99e-3 else f"{value * 1e3:g} ms" if value < 0.99 else f"{value:g} s"


def chart(title, series, x_title, y_title, x_label, x_ticks=None, joined=True):
    """`series`: (class, label, [(x, y, text or None)]) with x, y > 0; points of a series are joined in their order."""
    points = [p for _, _, row in series for p in row]
    low = lambda i: math.floor(math.log10(min(p[i] for p in points)))
    high = lambda i: math.ceil(math.log10(max(p[i] for p in points)))
    x0, x1, y0, y1 = low(0), high(0), low(1), high(1)
    across = lambda x: LEFT + (RIGHT - LEFT) * (math.log10(x) - x0) / (x1 - x0)
    up = lambda y: BOTTOM - (BOTTOM - TOP) * (math.log10(y) - y0) / (y1 - y0)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" role="img">',
        f"<title>{title}</title>", f"<style>{style()}</style>", '<rect class="back" width="100%" height="100%"/>',
    ]
    for tick in x_ticks or [10.0**e for e in range(x0, x1 + 1)]:
        out.append(f'<path class="grid" d="M{across(tick):.1f} {TOP}V{BOTTOM}"/>')
        out.append(f'<text class="mid" x="{across(tick):.1f}" y="458">{x_label(tick)}</text>')
    for e in range(y0, y1 + 1):
        out.append(f'<path class="grid" d="M{LEFT} {up(10.0**e):.1f}H{RIGHT}"/>')
        out.append(f'<text class="end" x="70" y="{up(10.0**e) + 4:.1f}">{seconds(10.0**e)}</text>')
    out.append(f'<rect class="frame" x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}"/>')
    out.append(f'<text class="mid" x="457" y="482">{x_title}</text>')
    out.append(f'<text class="mid" transform="translate(18 252) rotate(-90)">{y_title}</text>')
    out.append(f'<text class="title" x="{LEFT}" y="22">{title}</text>')
    legend = {}
    for name, label, _ in series:
        legend.setdefault(name, label)
    for i, (name, label) in enumerate(legend.items()):
        out.append(f'<rect class="{name}" x="{LEFT + 190 * i}" y="36" width="18" height="10"/>')
        out.append(f'<text x="{LEFT + 190 * i + 24}" y="45">{label}</text>')
    for name, _, row in series:
        if joined and len(row) > 1:
            path = " L".join(f"{across(x):.1f} {up(y):.1f}" for x, y, _ in row)
            out.append(f'<path class="line {name}" d="M{path}"/>')
        for x, y, text in row:
            out.append(f'<circle class="{name}" cx="{across(x):.1f}" cy="{up(y):.1f}" r="3.2"/>')
            if text:
                out.append(f'<text class="small" x="{across(x) + 6:.1f}" y="{up(y) - 5:.1f}">{text}</text>')
    return "\n".join(out + ["</svg>", ""])
