"""report.json (DESIGN section 5) from the nodes' own reports, and the table on the terminal."""
import copy
import json
import os
import platform

PROTOCOL = 1  # idl/common.idl, PROTOCOL_VERSION
NONE_US = {"p50": 0.0, "p99": 0.0, "p999": 0.0, "max": 0.0, "count": 0}
NO_LOOP = {"rate_hz": 0.0, "ticks": 0, "missed": 0, "period_us": NONE_US, "compute_us": NONE_US}
# every field that a report has, whatever became of the node
FIELDS = {
    "haptic_node": {"loop": NO_LOOP, "force_n": {"mean": 0.0, "max": 0.0},
                    "contacts": {"ticks_in_contact": 0, "nodes_max": 0}, "faults": []},
    "deform_node": {"loop": NO_LOOP, "states": 0, "steps": 0, "removed_tetrahedra": 0, "faults": []},
    "render_node": {"frames": 0, "frame_us": NONE_US, "faults": []},
    "virtual_device": {"round_trip_us": NONE_US, "sent": 0, "lost": 0, "energy_j": 0.0, "faults": []},
}
LINKS = ("tool_to_force_us", "tool_to_organ_us", "tool_to_picture_us")


def completed(fields, given):
    """`given` with what it lacks taken from `fields`."""
    result = copy.deepcopy(fields)
    for key, value in given.items():
        both = isinstance(value, dict) and isinstance(result.get(key), dict)
        result[key] = completed(result[key], value) if both else value
    return result


def read_node(file, name):
    """A node's own object; one that was killed left none."""
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {"faults": [f"{name} left no report"]}


def merge(scene_name, seconds, realtime, nodes, vendors, folder):
    """`folder` holds NAME.json for each node."""
    report = {
        "scene": scene_name,
        "seconds": round(seconds, 3),
        "protocol": PROTOCOL,
        "machine": {"cores": len(os.sched_getaffinity(0)), "kernel": platform.release(), "realtime": realtime},
        "nodes": {},
        "link": {link: dict(NONE_US) for link in LINKS},
    }
    for node in nodes:
        own = read_node(folder / f"{node.name}.json", node.name)
        report["link"].update(own.pop("link", {}))
        report["nodes"][node.name] = {**completed(FIELDS[node.name], own), "dds": vendors[node.name], "exit": node.exit}
    return report


def write(report, file):
    part = file.with_name(file.name + ".part")
    part.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    part.replace(file)


def span(times):
    """A distribution in words: median, 99 %, largest."""
    if not times["count"]:
        return ["-", "-", "-"]
    return [f"{times[key]:.0f}" for key in ("p50", "p99", "max")]


def table(rows):
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [row[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)


def node_row(name, node):
    loop = node.get("loop")
    if loop:
        return [name, node["dds"], str(node["exit"]), f"{loop['rate_hz']:g}", str(loop["ticks"]), str(loop["missed"]),
                *span(loop["compute_us"])]
    count, times = ("frames", "frame_us") if "frames" in node else ("sent", "round_trip_us")
    missed = str(node["lost"]) if "lost" in node else "-"
    return [name, node["dds"], str(node["exit"]), "-", str(node[count]), missed, *span(node[times])]


def summary(report):
    """A short table, and what a person should know besides."""
    rows = [["", "dds", "exit", "rate Hz", "ticks", "missed", "p50 us", "p99 us", "max us"]]
    rows += [node_row(name, node) for name, node in report["nodes"].items()]
    for link in LINKS:
        rows.append([link.removesuffix("_us").replace("_", " "), "", "", "", str(report["link"][link]["count"]), "",
                     *span(report["link"][link])])
    lines = [table(rows)]
    haptic = report["nodes"].get("haptic_node")
    if haptic:
        force = haptic["force_n"]
        lines.append(f"force: mean {force['mean']:.2f} N, largest {force['max']:.2f} N; "
                     f"{haptic['contacts']['ticks_in_contact']} ticks in contact")
    for name, node in report["nodes"].items():
        lines += [f"{name}: {fault}" for fault in node["faults"]]
    if not report["machine"]["realtime"]:
        lines.append("real-time priority was not granted to haptic_node: missed ticks are likelier")
    return "\n".join(lines)
