"""From a scene to files that the nodes can load: phantom, organ, fitted scene; cached by what they are made of."""
import json
import pathlib
import re
import subprocess
import time

from .cache import PATIENCE_S, Cache
from .errors import Refusal
from .telling import tell

SMALLEST_ORGAN_M = 0.01  # organ_build warns of what is smaller
LARGEST_ORGAN_M = 1.0  # a mesh without --scale that would be larger is taken to be in millimetres
# Of a foreign mesh's length, where --fixed is not given: an organ is held at an edge (ligaments), but lies on its whole
# underside; held at its lowest tip only, it would rock under the hand.
SUPPORTED_PART = {"x": 0.05, "y": 0.05, "z": 0.3}
MOVING_PART = 1 / 3  # of a foreign mesh's length from where it is not held, in a scene of a hybrid organ
PHANTOM_PARTS = ("gallbladder", "colon", "cavity", "omentum", "plate", "cylinder", "cylinder-upper",
                 "cylinder-lower")  # beside the liver, in one size each

NO_FILE = ("plane:", "box:", "label:")  # what a SPEC that names no CSV begins with

told_warnings = set()  # without the program's name: organ_build and scene_prepare say the same of one organ


def pass_on_warnings(messages):
    for line in messages.strip().splitlines():
        _, is_warning, sentence = line.partition("warning: ")
        if is_warning and sentence not in told_warnings:
            told_warnings.add(sentence)
            tell(line)


def run_tool(options, arguments, doing):
    """Runs one of our programs; its one-line refusal becomes ours. Returns what it printed."""
    command = [str(options.programs / arguments[0]), *map(str, arguments[1:])]
    begin = time.monotonic()
    told = False
    try:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    except OSError as error:
        raise Refusal(f"{command[0]}: {error.strerror}") from error
    try:
        while True:
            try:
                out, err = process.communicate(timeout=PATIENCE_S)
                break
            except subprocess.TimeoutExpired:
                tell(f"run: {doing} ... {time.monotonic() - begin:.0f} s")
                told = True
    except BaseException:
        process.kill()
        process.wait()
        raise
    if process.returncode != 0:
        lines = err.strip().splitlines() or [f"{arguments[0]} ended with code {process.returncode}"]
        raise Refusal(lines[-1])
    pass_on_warnings(err)
    if told:
        tell(f"run: {doing}: done after {time.monotonic() - begin:.1f} s")
    return out


def describe(options, scene):
    return json.loads(run_tool(options, ["scene_prepare", scene, "--describe"], "reading the scene"))


def phantom_mesh(options, cache, kind):
    """`kind`: what a scene's mesh "phantom:KIND" says, a part of the phantom or a size of the liver."""
    program = options.programs / "organ_phantom"
    option, name, what = (("--part", kind, f"the {kind}") if kind in PHANTOM_PARTS else
                          ("--size", f"liver_{kind}", f"the liver ({kind} size)"))
    return cache.get(f"{name}.msh", ["phantom", kind, program],
                     lambda file: run_tool(options, ["organ_phantom", option, kind, "-o", file], f"making {what}"))


def support_spec(measured, scale, scene_fixed):
    """A plane through the mesh on the axis and side on which the scene supports its own organ."""
    match = re.match(r"plane:([xyz])([<>])", scene_fixed)
    axis, side = match.groups() if match else ("z", "<")
    low, high = (scale * measured[end]["xyz".index(axis)] for end in ("min", "max"))
    held = SUPPORTED_PART[axis] * (high - low)
    at = low + held if side == "<" else high - held
    return f"plane:{axis}{side}{at:.6g}"


def dynamic_spec(measured, scale, scene_fixed):
    """The end of the mesh that lies opposite to where support_spec() holds it."""
    match = re.match(r"plane:([xyz])([<>])", scene_fixed)
    axis, side = match.groups() if match else ("z", "<")
    low, high = (scale * measured[end]["xyz".index(axis)] for end in ("min", "max"))
    moving = MOVING_PART * (high - low)
    return f"plane:{axis}>{high - moving:.6g}" if side == "<" else f"plane:{axis}<{low + moving:.6g}"


def guessed_scale(name, measured):
    """Metres, or millimetres where metres would make a giant; said with its reason, since it is a guess."""
    largest = max(high - low for low, high in zip(measured["min"], measured["max"]))
    scale = 0.001 if largest > LARGEST_ORGAN_M else 1.0
    taken, why = (("millimetres", f"in metres it would be longer than {LARGEST_ORGAN_M:g} m") if scale != 1.0 else
                  ("metres", f"that makes it no longer than {LARGEST_ORGAN_M:g} m"))
    kind = "warning: " if scale != 1.0 or largest < SMALLEST_ORGAN_M else ""
    tell(f"run: {kind}{name} is {largest:.4g} units long: taken as {taken}, since {why}: an organ of "
         f"{1000 * scale * largest:.4g} mm (--scale says otherwise)")
    return scale


def foreign_terms(options, spec):
    """Scale, supports and, in place of a hybrid organ's, dynamic part of a user's mesh: given, or found and said."""
    measured = json.loads(run_tool(options, ["scene_prepare", "--measure", options.organ], "measuring the mesh"))
    scale = options.scale
    if scale is None:
        scale = guessed_scale(options.organ.name, measured)
    fixed = options.fixed or support_spec(measured, scale, spec["fixed"])
    if not options.fixed:
        tell(f"run: {options.organ.name} is supported at {fixed} (--fixed says otherwise)")
    dynamic = (spec.get("dynamic") or spec.get("dynamic_mesh", "")) and dynamic_spec(measured, scale, spec["fixed"])
    if dynamic:
        tell(f"run: {options.organ.name} moves by itself and can be cut at {dynamic}")
    return scale, fixed, dynamic


def support_files(fixed):
    """The CSV that a --fixed or --dynamic SPEC names, without the components that may follow it (nodes.csv:xz)."""
    if fixed.startswith(NO_FILE):
        return []
    return [pathlib.Path(re.sub(r":[xyz]+$", "", fixed))]


def relative_to(scene, fixed):
    """A scene's SPEC: like its mesh, a CSV in it lies relative to the scene's file."""
    return fixed if fixed.startswith(NO_FILE) else str(scene.parent / fixed)


def mesh_file(options, cache, named):
    """The file that a scene's mesh is: the phantom's part that it names, or itself."""
    kind, _, part = named.partition(":")
    return phantom_mesh(options, cache, part) if kind == "phantom" else pathlib.Path(named)


def build_organ(options, cache, mesh, name, spec, scale, fixed, dynamic="", dynamic_mesh=None):
    program = options.programs / "organ_build"
    terms = ["--young", spec["young_pa"], "--poisson", spec["poisson"], "--density", spec["density_kg_m3"],
             "--scale", scale, "--fixed", fixed, *(part for region in spec["regions"] for part in ("--region", region)),
             *(["--dynamic", dynamic] if dynamic else [])]
    if dynamic_mesh:
        terms += ["--dynamic-mesh", dynamic_mesh]
    inputs = [mesh, *([dynamic_mesh] if dynamic_mesh else []), *support_files(fixed), *(support_files(dynamic) if dynamic else [])]
    if mesh.suffix.lower() in (".node", ".ele"):
        inputs += [mesh.with_suffix(suffix) for suffix in (".node", ".ele", ".NODE", ".ELE")]
    return cache.get(f"{name}.h5", ["organ", program, *terms, *inputs],
                     lambda file: run_tool(options, ["organ_build", mesh, "-o", file, *terms],
                                           f"precomputing the force tensors of {mesh.name}"))


def users_organ_file(options, cache, spec):
    """Of the organ that the user gives instead of `spec`, the scene's first one."""
    if options.organ.suffix.lower() == ".h5":
        return options.organ
    if not spec["young_pa"]:
        raise Refusal(f"{options.scene}: the organ {spec['name']} is an organ file, without a material for the mesh "
                      f"{options.organ.name}: expected --organ FILE.h5, or young_pa, poisson and density_kg_m3 beside it")
    scale, fixed, dynamic = foreign_terms(options, spec)
    if spec["regions"]:
        tell(f"run: {options.organ.name} is of one material: the scene's regions lie in its own organ")
    return build_organ(options, cache, options.organ, options.organ.stem, {**spec, "regions": []}, scale, fixed, dynamic)


def organ_file(options, cache, spec):
    """Of an organ as the scene describes it."""
    if spec["file"] or spec["mesh"].lower().endswith(".h5"):
        return pathlib.Path(spec["file"] or spec["mesh"])
    second = spec.get("dynamic_mesh", "")
    return build_organ(options, cache, mesh_file(options, cache, spec["mesh"]), spec["name"], spec,
                       spec["metres_per_unit"], relative_to(options.scene, spec["fixed"]),
                       spec.get("dynamic", "") and relative_to(options.scene, spec["dynamic"]),
                       mesh_file(options, cache, second) if second else None)


def organ_files(options, cache, specs):
    """Of all organs that have one, in the scene's order. One after the other: organ_build computes on all processors by
    itself."""
    first = specs[0]
    if options.organ and not first["has_file"]:
        raise Refusal(f"--organ: the first organ of {options.scene}, {first['name']}, is made from the scene's numbers: "
                      "no file takes its place")
    return [(users_organ_file if options.organ and spec is first else organ_file)(options, cache, spec)
            for spec in specs if spec["has_file"]]


def scenery_files(options, cache, specs):
    """Of all scenery, in the scene's order; of none where a user's organ takes the place of the scene's: it lies and is
    as large as it likes."""
    if options.organ:
        return []
    kinds = [spec["mesh"].partition(":") for spec in specs]
    return [phantom_mesh(options, cache, word) if kind == "phantom" else spec["mesh"]
            for spec, (kind, _, word) in zip(specs, kinds)]


def prepare(options):
    """Makes what is missing; returns the fitted scene and its name. Raises Refusal."""
    wanted, cache = describe(options, options.scene), Cache()
    files = organ_files(options, cache, wanted["organs"])
    scenery = scenery_files(options, cache, wanted["scenery"])
    try:
        options.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Refusal(f"--out: {options.out}: {error.strerror}") from error
    scene = (options.out / "scene.toml").resolve()
    keep = [] if options.organ else ["--keep-points"]
    given = [word for file in files for word in ("--organ", file)]
    given += [word for file in scenery for word in ("--scenery", file)]
    notes = run_tool(options, ["scene_prepare", options.scene, *given, "-o", scene, *keep], "fitting the scene")
    for line in notes.strip().splitlines():
        tell(f"run: {line}")
    return scene, describe(options, scene)["name"]
