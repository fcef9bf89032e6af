"""The tables and figures of docs/src/comparison.md, from the record."""

import math
import re
import statistics
from pathlib import Path

import figure
from run import PEERS, accepted, quickest

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs" / "src" / "comparison.md"
NAMES = {"kutzbach": "kutzbach", "exudyn": "Exudyn", "mujoco": "MuJoCo", "drake": "Drake"}
SHOWN = (
    "bennett_rational", "planar_4r_general", "sarrus_6r", "stewart_6UPS", "delta_3RRPaR", "quattro_par4", "miura_3x3",
    "steffen_polyhedron", "hoberman_ring_8", "bennett_perturbed_1e-6", "delassus_4h_parallelogram", "collinear_3r_shaky",
    "k33_on_conic_shaky", "planar_4r_stretched_isolated", "double_watt_cusp", "planar_kite_flat", "miura_3x3_flat",
    "ppsrr_plane_torus_isolated", "kong_7r_transition",
)


def time_of(value):
    if value is None:
        return "–"
    for factor, name in ((1e6, "µs"), (1e3, "ms"), (1.0, "s")):
        if value * factor < 999.5 or name == "s":
            return f"{value * factor:.3g} {name}" if value * factor < 99.5 else f"{value * factor:.0f} {name}"


def error_of(value):
    return f"{value:.1e}".replace("e-0", "e-")


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def facts(record):
    v = record["versions"]
    return (
        f"Measured on {record['date']} on {record['machine']}: kutzbach {v['kutzbach']}, Exudyn {v['exudyn']}, MuJoCo "
        f"{v['mujoco']}, Drake {v['drake']}, NumPy {v['numpy']}, Python {v['python']}. Times are medians of {record['rounds']} "
        "rounds, fewer where they come to more than 5 s; least and greatest are in `benches/record/peers.json`."
    )


def zoo(record):
    rows, data = [], record["zoo"]
    differ = [n for n, e in data.items() if e["finite"] != e["instantaneous"]]
    for question in ("rank", "verdict", "everything"):
        own = lambda n, key: data[n]["kutzbach"][key]["median"]
        rank = question == "rank"
        found = (lambda n: data[n]["kutzbach"]["instantaneous_found"]) if rank else (lambda n: data[n]["kutzbach"]["freedom"])
        count = [own(n, question) for n in data]
        rows.append([
            f"kutzbach, {question}", len(data), sum(data[n]["kutzbach"]["instantaneous_found"] == data[n]["instantaneous"] for n in data),
            sum(found(n) == data[n]["finite"] for n in data), sum(found(n) == data[n]["finite"] for n in differ),
            time_of(statistics.median(count)), time_of(sum(count)), time_of(sum(count) + sum(own(n, "read") for n in data)),
            time_of(own("bennett_rational", "process")) if question == "everything" else "",
        ])
    for tool in PEERS:
        known = [n for n in data if "why_not" not in data[n][tool]]
        answer = lambda n: data[n][tool]["freedom"]
        count = [data[n][tool]["count"]["median"] for n in known]
        both = [c + data[n][tool]["build"]["median"] for c, n in zip(count, known)]
        rows.append([
            f"{NAMES[tool]}, rank", len(known), sum(answer(n) == data[n]["instantaneous"] for n in known),
            sum(answer(n) == data[n]["finite"] for n in known), sum(answer(n) == data[n]["finite"] for n in differ if n in known),
            time_of(statistics.median(count)), time_of(sum(count)), time_of(sum(both)),
            time_of(record["processes"][tool]["count"]["median"]),
        ])
    head = ["", f"described, of {len(data)}", "instantaneous freedom right", "finite mobility right",
            f"the same, of {len(differ)} where they differ", "one answer, median", "all answers", "all, with reading or building",
            "whole process, Bennett"]
    text = [table(head, rows), ""]
    missing = {n: data[n]["exudyn"]["why_not"] for n in data if "why_not" in data[n]["exudyn"]}
    text.append("Not described for Exudyn: " + ", ".join(f"`{n}` ({why})" for n, why in missing.items()) + ".\n" if missing else "")
    rows = []
    for n in (n for n in SHOWN if n in data):
        own = data[n]["kutzbach"]
        cell = lambda tool: "–" if "why_not" in data[n][tool] else (
            f"{data[n][tool]['freedom']}" + ("" if data[n][tool]["freedom"] == data[n]["finite"] else " ✗")
            + f", {time_of(data[n][tool]['count']['median'])}")
        rows.append([f"`{n}`", data[n]["finite"], data[n]["instantaneous"],
                     f"{own['instantaneous_found']}" + ("" if own["instantaneous_found"] == data[n]["finite"] else " ✗")
                     + f", {time_of(own['rank']['median'])}",
                     f"{own['freedom']}" + ("" if own["freedom"] == data[n]["finite"] else " ✗") + f", {time_of(own['verdict']['median'])}",
                     *map(cell, PEERS)])
    text.append(table(["mechanism", "finite", "instantaneous", "kutzbach: rank", "kutzbach: verdict",
                       *(f"{NAMES[p]}: rank" for p in PEERS)], rows))
    text.append("\n✗: not the finite mobility. *Rank*, *verdict* and *everything* are the depths of an analysis "
                "(`kutzbach::mobility::Depth`): the freedom at the pose; the finite freedom and how the pose is singular; and all "
                "that a report shows, with advice and exact algebra.")
    return "\n".join(text)


def lift(record):
    data, stages = record["lift"], [row["stages"] for row in record["lift"]["kutzbach"]]
    rows = []
    for n in stages:
        cells = []
        for tool in ("kutzbach", *PEERS):
            found = next((r for r in data[tool] if r["stages"] == n), None)
            if found is None:
                cells.append("–")
            elif "why_not" in found:
                cells.append(found["why_not"].removeprefix("Error: "))
            elif tool == "kutzbach":
                read = found["read"]["median"]
                cells += [f"{found['freedom']}, {time_of(found[q]['median'])} ({time_of(read + found[q]['median'])})" for q in ("rank", "verdict")]
                cells.append(time_of(found["process"]["median"]))
            else:
                cells.append(f"{found['freedom']}, {time_of(found['count']['median'])} ({time_of(found['build']['median'] + found['count']['median'])})")
        rows.append([n, 3 * n + 4, *cells])
    return "\n".join([
        table(["stages", "joints", "kutzbach: rank (with reading)", "kutzbach: verdict (with reading)", "kutzbach: process of a report",
               *(f"{NAMES[p]}: rank (with building)" for p in PEERS)], rows),
        "", "The freedom found, then the time. A tool is left out above the first size that takes it more than "
        f"{record['limit']:.0f} s; matrices are ranked with one and with two threads, and the faster is shown.",
        "", "![Time to a mobility answer over the stages of a scissor lift](images/peers_lift.svg)",
    ])


def lift_figure(record):
    series = []
    for question in ("rank", "verdict", "report"):
        total = lambda r: r["process"]["median"] if question == "report" else r["read"]["median"] + r[question]["median"]
        rows = record["lift"]["kutzbach"]
        marks = [(r["stages"], total(r), question if r is rows[-1] else None) for r in rows]
        series.append(("kutzbach", "kutzbach, read and ranked; verdict; report", marks))
    for tool in PEERS:
        rows = [r for r in record["lift"][tool] if "why_not" not in r]
        total = lambda r: r["build"]["median"] + r["count"]["median"]
        series.append((tool, f"{NAMES[tool]}, built and ranked", [(r["stages"], total(r), None) for r in rows]))
    ticks = [row["stages"] for row in record["lift"]["kutzbach"]]
    return figure.chart("A scissor lift: time to a mobility answer", series, "stages of the lift", "time", lambda t: f"{t:g}", ticks)


def words(tool, row):
    if tool == "exudyn":
        model = {"planar": "in the plane", "relaxed": "in space, loop joint relaxed", "spatial": "in space, all hinges"}[row["model"]]
        return f"{model}, index {row['index']}, {row['newton']} Newton"
    if tool == "mujoco":
        rule = "default softness" if row["solref"] == "default" else f"time constant of {row['solref']:g} steps"
        return f"{row['integrator']}, {rule}"
    if tool == "drake":
        return "time steps (SAP)" if row["model"] == "discrete" else f"inverse kinematics, tolerance {row['tolerance']:g}"
    return f"trace, {row.get('model', 'whole process')}"


def within(data):
    """Traces within a running program, as rows of their own."""
    return [{**r, "time": r["within"], "model": "within a program"} for r in data["kutzbach"] if "within" in r]


def settings(tool, row):
    return tuple((k, row.get(k)) for k in ("model", "index", "newton", "integrator", "solref", "tolerance"))


def turn(record):
    """What the quickest run of every setting takes below each error; a row per setting."""
    text = []
    levels = ((1e-3, 0), (1e-6, 0), (1e-9, 0), (1e-12, 0), (1e-6, 240), (1e-9, 240), (1e-12, 240))
    head = ["", "setting"] + [f"{error_of(e).replace('1.0', '1')}" + (f", {n}+ poses" if n else "") for e, n in levels] + ["least error"]
    for name, data in record["turn"].items():
        rows = []
        for tool in ("kutzbach", *PEERS):
            groups = {}
            for r in within(data) + data[tool] if tool == "kutzbach" else data[tool]:
                groups.setdefault(settings(tool, r), []).append(r)
            for group in groups.values():
                if all("hinges about z" in r.get("why_not", "") for r in group):
                    continue
                cells = []
                for error, poses in levels:
                    best = quickest(group, error, poses)
                    cells.append("–" if best is None else f"{time_of(best['time']['median'])} ({best['steps']})")
                good = [r for r in group if accepted(r, 1e-1)]
                least = min(good, key=lambda r: r["closure_error"], default=None)
                cells.append("gives up" if least is None else error_of(least["closure_error"])
                             + (f", {least['unconfirmed']} poses not confirmed" if least.get("unconfirmed") else ""))
                rows.append([NAMES[tool], words(tool, group[0]), *cells])
        text += [f"**{name}**", "", table(head, rows), ""]
    text.append("The least wall time with which a setting stays below a closure error all the way round, and in brackets in how many poses; "
                "then the same where at least 240 poses are wanted. *Not confirmed*: poses that the solver did not call a success. "
                f"Starting kutzbach with nothing to do takes {time_of(record['processes']['kutzbach']['median'])}, which every trace has in it.")
    text.append("\n![Wall time of one turn of the four-bar over its closure error](images/peers_turn.svg)")
    return "\n".join(text)


def turn_figure(record):
    series, data = [], record["turn"]["four-bar"]
    for tool in ("kutzbach", *PEERS):
        groups = {}
        for r in within(data) + data[tool] if tool == "kutzbach" else data[tool]:
            if tool == "kutzbach" or accepted(r, 1e-1):
                groups.setdefault(settings(tool, r), []).append(r)
        for group in groups.values():
            marks = [(max(r["closure_error"], 1e-16), r["time"]["median"], f"{r['steps']} poses" if tool == "kutzbach" and r["steps"] in (240, 4000) else None) for r in group]
            series.append((tool, {"kutzbach": "kutzbach, whole"}.get(tool, f"{NAMES[tool]}, steps alone"), marks))
    return figure.chart("One turn of a four-bar: every setting tried", series, "closure error", "wall time",
                        lambda t: f"1e{round(math.log10(t))}", [10.0**e for e in range(-16, 1, 2)])


def ratio(a, b):
    return f"{a / b:.1f}" if a / b < 9.95 else f"{a / b:.0f}"


def ratios(record):
    text = []
    for name, data in record["turn"].items():
        own = {r["steps"]: r for r in data["kutzbach"] if r["closure_error"] <= 1e-12}
        least = min(own.values(), key=lambda r: r["time"]["median"])
        inside = {r["steps"]: r["time"]["median"] for r in within(data)}
        text.append(f"- **Turn, {name}.** The trace closes to {error_of(max(r['closure_error'] for r in own.values()))} at every number of "
                    f"poses. Within a program it takes {time_of(inside[12])} for 12 poses and {time_of(inside[240])} for 240, its "
                    f"analysis included; as a process {time_of(least['time']['median'])} at the least ({least['steps']} poses) and "
                    f"{time_of(own[240]['time']['median'])} for 240 poses. Soonest at 1e-6 or better, steps alone:")
        for poses in (0, 240):
            cells = []
            for tool in PEERS:
                best = quickest(data[tool], 1e-6, poses)
                cells.append(f"{NAMES[tool]} " + (
                    f"{time_of(best['time']['median'])} ({words(tool, best)}; {best['steps']} poses, {error_of(best['closure_error'])}"
                    + (f", {best['unconfirmed']} of them not confirmed" if best["unconfirmed"] else "") + ")"
                    if best else "at no setting"))
            text.append(f"  - {'with any number of poses' if not poses else 'with at least 240 poses'}: " + "; ".join(cells) + ".")
        whole = [f"{NAMES[t]} {time_of(record['processes'][t][name]['median'])}" for t in PEERS if name in record["processes"][t]]
        text.append(f"  - the same settings as whole processes: {'; '.join(whole)}.")
    data = record["zoo"]
    known = [n for n in data if "why_not" not in data[n]["exudyn"]]
    peer = lambda n, *keys: sum(data[n]["exudyn"][k]["median"] for k in keys)
    own = lambda n, key: data[n]["kutzbach"][key]["median"]
    start = record["processes"]["exudyn"]["count"]["median"]
    right = [n for n in known if data[n]["exudyn"]["freedom"] == data[n]["finite"]]
    for question, words_for in (("rank", "The rank at the pose"), ("verdict", "The verdict")):
        within_time = lambda n: own(n, question)
        text.append(
            f"- **{words_for} against Exudyn's count**, {len(known)} mechanisms that both describe. No slower than the count alone: "
            f"{sum(within_time(n) <= peer(n, 'count') for n in known)}, of the {len(right)} where that count is the finite freedom "
            f"{sum(within_time(n) <= peer(n, 'count') for n in right)}; with reading, no slower than building and counting: "
            f"{sum(within_time(n) + own(n, 'read') <= peer(n, 'count', 'build') for n in known)}, and "
            f"{sum(within_time(n) + own(n, 'read') <= peer(n, 'count', 'build') for n in right)} of the {len(right)}. "
            f"All together {time_of(sum(map(within_time, known)))} against {time_of(sum(peer(n, 'count') for n in known))}; the median "
            f"of the quotients is {ratio(statistics.median(within_time(n) / peer(n, 'count') for n in known), 1)}.")
    text.append(
        f"- **A report, whole process, against Exudyn's**, which takes {time_of(start)} for Bennett: quicker for "
        f"{sum(own(n, 'process') <= start for n in known)} of {len(known)}.")
    for n in (100, 300, 1000):
        mine = next((r for r in record["lift"]["kutzbach"] if r["stages"] == n), None)
        if not mine:
            continue
        read = mine["read"]["median"]
        bare, verdict = mine["rank"]["median"], mine["verdict"]["median"]
        cells = []
        for tool in PEERS:
            r = next((r for r in record["lift"][tool] if r["stages"] == n), None)
            if r and "why_not" not in r:
                total = r["build"]["median"] + r["count"]["median"]
                cells.append(f"{NAMES[tool]} builds and counts for {ratio(total, verdict)} times as long as the verdict and "
                             f"{ratio(total, bare)} times as long as the rank ({ratio(total, read + verdict)} and "
                             f"{ratio(total, read + bare)} with our reading), and counts for "
                             f"{ratio(r['count']['median'], verdict)} and {ratio(r['count']['median'], bare)} times as long")
            elif r and "more than" not in r["why_not"]:
                cells.append(f"{NAMES[tool]} does not load it")
            elif r:
                cells.append(f"{NAMES[tool]} more than {ratio(record['limit'], verdict)} times as long as the verdict")
        text.append(f"- **Lift of {n} stages**, kutzbach: verdict {time_of(verdict)}, rank {time_of(bare)}, reading the file {time_of(read)}; "
                    f"report as a process {time_of(mine['process']['median'])}. " + "; ".join(cells) + ".")
    return "\n".join(text)


def update(record):
    page = PAGE.read_text()
    for name, block in (("facts", facts), ("zoo", zoo), ("lift", lift), ("turn", turn), ("ratios", ratios)):
        begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
        page, found = re.subn(re.escape(begin) + ".*?" + re.escape(end), lambda _: f"{begin}\n\n{block(record)}\n\n{end}", page, flags=re.S)
        if not found:
            raise SystemExit(f"{PAGE.name} has no marks for {name}")
    PAGE.write_text(page)
    images = PAGE.parent / "images"
    (images / "peers_lift.svg").write_text(lift_figure(record))
    (images / "peers_turn.svg").write_text(turn_figure(record))
