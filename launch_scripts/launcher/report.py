"""report.json (docs/design.md, "Report") from the nodes' own reports, and the table on the terminal."""
import copy
import json
import os
import pathlib
import platform
import re

from .errors import Refusal

IDL = pathlib.Path(__file__).parents[2] / "idl" / "common.idl"
PROTOCOL = int(re.search(r"PROTOCOL_VERSION = (\d+)", IDL.read_text(encoding="utf-8"))[1])
NONE_US = {"p50": 0.0, "p99": 0.0, "p999": 0.0, "max": 0.0, "count": 0}
NO_LOOP = {"rate_hz": 0.0, "ticks": 0, "missed": 0, "period_us": NONE_US, "compute_us": NONE_US}
# every field that a report has, whatever became of the node
FIELDS = {
    "haptic_node": {"loop": NO_LOOP, "force_n": {"mean": 0.0, "max": 0.0},
                    "contacts": {"ticks_in_contact": 0, "nodes_max": 0},
                    "local_models": {"heard": 0, "dropped": 0, "gone": 0}, "hands": [], "faults": []},
    "deform_node": {"loop": NO_LOOP, "states": 0, "stress_states": 0, "touching_moments": 0, "steps": 0, "removed_tetrahedra": 0, "repaired_tetrahedra": 0,
                    "cuts": {"way_cm": 0.0, "lost_cm3": 0.0, "lost_cm3_per_cm": 0.0}, "real_time_factor": 0.0, "faults": []},
    "render_node": {"frames": 0, "frame_us": NONE_US, "deepest_dent_m": 0.0, "unmatched_states": 0, "removed_tetrahedra": 0, "closed": False, "videos": [],
                    "picture": {"level": "", "asked_fps": 0.0, "reached_fps": 0.0, "changes": 0, "share": {}},
                    "faults": []},
    "virtual_device": {"round_trip_us": NONE_US, "sent": 0, "lost": 0, "energy_j": 0.0, "faults": []},
}
MEETING_S = 5.0  # two Fast participants may need 2.9 s to find each other, and haptic_node listens for one
LEAST_STEAL = 0.001  # what is worth a line: a tick in a thousand
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


def merge(scene_name, seconds, machine, nodes, vendors):
    """From what each node wrote itself, and what the launcher saw of it; `machine`: `realtime` and `steal_share`."""
    report = {
        "scene": scene_name,
        "seconds": round(seconds, 3),
        "protocol": PROTOCOL,
        "machine": {"cores": len(os.sched_getaffinity(0)), "kernel": platform.release(), **machine},
        "nodes": {},
        "link": {link: dict(NONE_US) for link in LINKS},
    }
    for node in nodes:
        own = read_node(node.report, node.name) if node.starts else {}
        report["link"].update(own.pop("link", {}))
        report["nodes"][node.name] = {**completed(FIELDS[node.name], own), "dds": vendors[node.name], "exit": node.exit,
                                      "restarts": node.restarts()}
    return report


def write(report, file):
    """Whole or not at all; a link stays one. Raises Refusal."""
    target = file.resolve()
    if target.exists() and not target.is_file():
        raise Refusal(f"{file}: cannot be written: it is no regular file")
    part = target.with_name(target.name + ".part")
    try:
        part.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
        part.replace(target)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise Refusal(f"{file}: cannot be written: {error.strerror}") from error


def seconds_of(node):
    """For how long a node's loop ran."""
    loop = node.get("loop", NO_LOOP)
    return loop["ticks"] / loop["rate_hz"] if loop["rate_hz"] else 0.0


def unanswered_s(report):
    """How long hand and haptic_node ran beside each other without any force; 0 where there was one, or no hand."""
    hand, haptic = report["nodes"].get("virtual_device"), report["nodes"].get("haptic_node")
    if hand is None or haptic is None or hand["sent"] == 0 or hand["round_trip_us"]["count"] > 0:
        return 0.0
    return min(seconds_of(hand), seconds_of(haptic))


def never_answered(report):
    """Whether no force ever came back, though there was time for it."""
    return unanswered_s(report) >= MEETING_S


def duration(us):
    return f"{us:.0f} us" if us < 1000 else f"{us / 1000:.1f} ms"


def span(times):
    """A distribution in words: median, 99 %, longest."""
    if not times["count"]:
        return ["-", "-", "-"]
    return [duration(times[key]) for key in ("p50", "p99", "max")]


def table(rows):
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [row[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)


def loop_figures(node):
    loop = node["loop"]
    return [f"{loop['rate_hz']:g} Hz", f"{loop['ticks']} ticks", f"{loop['missed']} missed", "step", *span(loop["compute_us"])]


def picture_figures(node):
    return ["", f"{node['frames']} frames", "", "frame", *span(node["frame_us"])]


def device_figures(node):
    rate = f"{node['loop']['rate_hz']:g} Hz" if "loop" in node else ""
    return [rate, f"{node['sent']} poses", f"{node['lost']} lost", "round trip", *span(node["round_trip_us"])]


FIGURES = {"haptic_node": loop_figures, "deform_node": loop_figures, "render_node": picture_figures,
           "virtual_device": device_figures}


def node_row(name, node):
    if node["exit"] is None:
        exit_code = "-"
    else:
        exit_code = str(node["exit"]) + (f" ({node['restarts']} restarts)" if node["restarts"] else "")
    return [name, node["dds"], exit_code, *FIGURES[name](node)]


def link_row(link, times):
    return [link.removesuffix("_us").replace("_", " "), "", "", "", f"{times['count']} seen", "", "latency", *span(times)]


def removed_line(organs):
    """What the organs lack at the end; repairs are counted over the whole session, resets included."""
    line = f"removed tetrahedra: {organs['removed_tetrahedra']}"
    if organs["repaired_tetrahedra"]:
        line += f"; {organs['repaired_tetrahedra']} went because they hung on a node or an edge"
    cuts = organs["cuts"]
    return line + (f"; {cuts['lost_cm3']:.1f} cm^3 lost over {cuts['way_cm']:.1f} cm of cut" if cuts["way_cm"] else "")


def hand_line(hand):
    line = f"hand {hand['tool']}: largest force {hand['force_max_n']:.2f} N"
    if hand["pull_max_n"]:
        line += f", largest pull {hand['pull_max_n']:.2f} N, {hand['pulls_beyond_limit']} beyond the limit"
    grasps = hand.get("grasps", {"begun": 0})
    ends = [f"{grasps[end]} {end}" for end in ("empty", "torn", "lost") if grasps.get(end)]
    if grasps["begun"] or ends:
        line += f"; {grasps['begun']} grasps" + (f" ({', '.join(ends)})" if ends else "")
        line += f", up to {1e3 * hand['grip_torque_max_nm']:.1f} mN m on the jaws"
    return line


def score_lines(haptic, organs):
    """The trainee's score (docs/score.md), of a scene that plans a cut, and of hands whose jaws closed."""
    score = organs.get("score") if organs else None
    lines = []
    if score and not score["way_mm"] and not score["removed_cm3"]:
        lines.append("cut: nothing since the start or the last reset")
    elif score:
        lines.append(f"cut: {score['mean_mm']:.1f} mm from the planned line in the mean, {score['largest_mm']:.1f} mm at most, over "
                     f"{score['way_mm']:.0f} mm; {score['outside_cm3']:.1f} of {score['removed_cm3']:.1f} cm^3 outside of it; "
                     f"{score['seconds']:.1f} s")
    for hand in haptic["hands"] if haptic else []:
        if score or any(hand.get("grasps", {}).values()):
            lines.append(hand_line(hand))
    return lines


def camera_line(camera):
    """How the endoscope was held (docs/score.md)."""
    line = (f"camera: target {camera['mean_deg']:.1f} degrees off centre in the mean, {camera['largest_deg']:.1f} at most; centred "
            f"{100 * camera['within_share']:.0f} %, in sight {100 * camera['in_sight_share']:.0f} % of {camera['seconds']:.1f} s")
    if camera["roll_mean_deg"] is not None:
        line += f"; rolled by {camera['roll_mean_deg']:.1f} degrees, {camera['roll_largest_deg']:.1f} at most"
    return line


def summary(report):
    """A short table, and what a person should know besides."""
    rows = [["", "dds", "exit", "rate", "done", "not done", "time of", "median", "99 %", "longest"]]
    rows += [node_row(name, node) for name, node in report["nodes"].items()]
    rows += [link_row(link, report["link"][link]) for link in LINKS]
    lines = [table(rows)]
    haptic, organs, picture = (report["nodes"].get(name) for name in ("haptic_node", "deform_node", "render_node"))
    if haptic:
        force = haptic["force_n"]
        lines.append(f"force: mean {force['mean']:.2f} N, largest {force['max']:.2f} N; "
                     f"{haptic['contacts']['ticks_in_contact']} ticks in contact")
    if organs and organs["removed_tetrahedra"]:
        lines.append(removed_line(organs))
    lines += score_lines(haptic, organs)
    if picture:
        lines.append(f"deepest dent: {1e3 * picture['deepest_dent_m']:.1f} mm")
    exposed = picture.get("exposed_share") if picture else None
    if exposed and exposed["first"] is not None:
        lines.append(f"exposed: {100 * exposed['first']:.0f} % at first, {100 * exposed['newest']:.0f} % at the end, "
                     f"{100 * exposed['largest']:.0f} % at most")
    if picture and picture.get("camera", {}).get("seconds"):
        lines.append(camera_line(picture["camera"]))
    for name, node in report["nodes"].items():
        lines += [f"{name}: {fault}" for fault in node["faults"]]
        if node["exit"] is None:
            lines.append(f"{name} was not started: the session ended before")
    if never_answered(report):
        lines.append("no answer ever came to the hand: the processes did not hear each other (is the network interface lo "
                     "up, and does nothing block UDP between them?)")
    elif unanswered_s(report) > 0:
        lines.append(f"no answer came to the hand: processes may need {MEETING_S:.0f} s to find each other, and the session "
                     "ended before")
    if report["machine"]["steal_share"] >= LEAST_STEAL:
        lines.append(f"the hypervisor took {100 * report['machine']['steal_share']:.1f} % of the processors' time")
    if not report["machine"]["realtime"]:
        lines.append("real-time priority was not granted to haptic_node: missed ticks are likelier")
    return "\n".join(lines)
