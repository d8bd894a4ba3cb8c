"""Holds the JSON Schema of scenes against the program: scenes that come along are valid by both, broken ones by neither,
and both know the same keys of every object.

check_scenes.py PROGRAM FOLDER SCENE...: works in the folder. Exit code 77: there is no python3-jsonschema."""

import copy
import json
import pathlib
import re
import subprocess
import sys

SKIPPED = 77
try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(SKIPPED)

PROGRAM, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
SCENES = [pathlib.Path(name) for name in sys.argv[3:]]

ROCK = {"density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2}
GOOD = {
    "$schema": "talus.schema.json",
    "talus": 1,
    "gravity": [0, -10],
    "base_acceleration": [{"scale": 1, "time": [[0, 0], [1, 1]]}, 0],
    "damping": 0,
    "materials": {"rock": ROCK},
    "cover": {"model": "hexagonal", "size": 0.5},
    "contact": {"model": "overlap_area", "vertex_edge": {"calibration": "per_area"}, "cohesive_overlap": {}},
    "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "tangential_stiffness": 1e8,
                    "friction_angle": 20, "normal_damping": 0.3, "tangential_damping": 0.3, "softening_slip": 1e-3}],
    "bodies": [
        {"name": "slab", "polygon": [[-3, -1], [9, -1], [9, 0], [-3, 0]], "material": "rock", "fixed": True},
        {"name": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "rock", "surfaces": {"top": [2]},
         "discontinuities": [{"points": [[0.1, 0.5], [0.9, 0.5]], "surface": "crack"}], "drive": {"x": 0}},
        {"name": "b", "polygon": [[4, 0], [5, 0], [5, 1], [4, 1]], "material": "rock", "cover": {"model": "rigid"}}],
    "blocks": [{"name": "wall", "domain": [[6, 0], [8, 0], [8, 1], [6, 1]], "material": "rock",
                "joint_sets": [{"dip": 45, "spacing": 1}], "joints": [{"points": [[6, 0.5], [8, 0.5]]}],
                "split": {"share": 0}},
               {"name": "bond", "domain": [[6, 2], [8, 2], [8, 3], [6, 3]], "material": "rock",
                "bricks": {"width": 1, "height": 0.5}},
               {"name": "cells", "domain": [[6, 4], [8, 4], [8, 5], [6, 5]], "material": "rock",
                "voronoi": {"count": 4}}],
    "loads": [{"body": "a", "point": [0.5, 0.5], "force": [0, {"scale": 1, "y": [[0, 0], [1, 1]]}]}],
    "surface_loads": [{"body": "a", "surface": "top", "pressure": [1, {"scale": 2}]}],
    "prescribed": [{"body": "a", "surface": "top", "stiffness": 1e6, "displacement": [None, 0]}],
    "absorbing": [{"body": "a", "surface": "top"}],
    "settle": {"duration": 0.1, "damping": "adaptive"},
    "stages": [{"name": "later", "from": 0.5, "set": {"/gravity": [0, 0], "/bodies/2/fix": ["x"]}}],
    "monitors": [{"name": "a", "body": "a", "quantities": ["ux", "stress_xx"]}],
    "time": {"end": 1, "dt": "auto"},
    "sleep": {},
    "output": {"history": 0.01, "frames": 0.1},
    "limits": {},
    "tolerances": [{"monitor": "a", "quantity": "ux", "largest": 1}],
}
REMOVED = object()

# Pointer, value: what makes the good scene bad, for the schema as for the reader.
BROKEN = [
    # a wrong key
    ("/gravitty", [0, 0]), ("/materials/rock/young_moduls", 1), ("/materials/rock/dilation_angle", 1),
    ("/cover/plane", "strain"), ("/contact/overlap_area", {"calibration": "springs"}), ("/contact/friction", {}),
    ("/interfaces/0/friction", 1), ("/contact", {"model": "overlap_area"}), ("/bodies/1/colour", "red"), ("/bodies/2/cover/size", 1), ("/time/step", 1),
    ("/blocks/0/joint_sets/0/strike", 1), ("/settle/force", 1), ("/bodies/1/drive/z", 1),
    ("/base_acceleration/0/x", [[0, 0], [1, 1]]), ("/stages/0/set", {"/title": "no"}),
    # a wrong type
    ("/gravity", -10), ("/gravity", [0, -10, 0]), ("/title", 1), ("/materials", []), ("/bodies/1/fixed", "yes"),
    ("/bodies/1/polygon", [[0, 0], [1, 0]]), ("/bodies/1/polygon/0", [0, "0"]), ("/interfaces/0/between", ["*"]),
    ("/time/dt", "fast"), ("/monitors/0/quantities", []), ("/monitors/0/quantities/0", "u"), ("/bodies/1/fix", ["z"]),
    ("/blocks/2/voronoi/count", 1.5), ("/loads/0/force/0", None), ("/surface_loads/0/pressure", []),
    ("/$schema", 1), ("/talus", 2), ("/damping", "kinetik"), ("/contact/model", "overlap_aera"),
    # out of range
    ("/materials/rock/density", 0), ("/materials/rock/poisson_ratio", 0.5), ("/cover/size", 0),
    ("/interfaces/0/friction_angle", 90), ("/interfaces/0/cohesion", -1), ("/interfaces/0/softening_slip", -1), ("/interfaces/0/normal_damping", 11),
    ("/time/end", 0), ("/time/safety", 0.95), ("/limits/penetration", 0), ("/blocks/0/joint_sets/0/jitter", 0.6),
    ("/settle/until", 2), ("/tolerances/0/largest", -1), ("/bodies/0/polygon/0/0", 1e10), ("/sleep/after", -1),
    # a missing key
    ("/talus", REMOVED), ("/time", REMOVED), ("/time/end", REMOVED), ("/materials", REMOVED),
    ("/materials/rock/density", REMOVED), ("/materials/rock/young_modulus", REMOVED), ("/cover/size", REMOVED),
    ("/interfaces/0/friction_angle", REMOVED), ("/interfaces/0/between", REMOVED), ("/bodies/1/name", REMOVED),
    ("/bodies/1/polygon", REMOVED), ("/bodies/1/material", REMOVED), ("/loads/0/force", REMOVED),
    ("/surface_loads/0/pressure", REMOVED), ("/prescribed/0/stiffness", REMOVED), ("/blocks/0/domain", REMOVED),
    ("/blocks/2/voronoi/count", REMOVED), ("/stages/0/set", REMOVED), ("/tolerances/0/largest", REMOVED),
    ("/contact/model", REMOVED), ("/settle/duration", REMOVED),
    # keys that do not go together
    ("/bodies/0/fix", ["x"]), ("/bodies/0/drive", {"x": 0}), ("/bodies/1/mesh", "a.msh"), ("/blocks/2/voronoi/spacing", 1),
    ("/blocks/2/voronoi/jitter", 0.1), ("/blocks/0/joint_sets/0/persistence", 0.5),
    ("/blocks/0/joint_sets/0/gap", 1),
    # names
    ("/bodies/1/name", " a"), ("/bodies/1/name", "a "), ("/bodies/1/name", "*"), ("/monitors/0/name", "a.b"),
    ("/blocks/0/name", "w" * 201), ("/materials", {"rock": ROCK, "rock ": ROCK}),
]

# A scene needs something in one of them.
NOTHING = [{"bodies": [], "blocks": []}, {"bodies": []}, {"blocks": []}, {}]

# Pointer, value: what leaves it good.
VARIED = [
    ("/contact", {"model": "vertex_edge", "cohesive_overlap": {}}), ("/interfaces/0/cohesion", 1), ("/cover", REMOVED), ("/sleep", REMOVED),
    ("/cover", {"model": "hexagonal", "size": 0.5, "slivers": "keep"}), ("/contact/model", "frictionless"),
    ("/blocks/2/voronoi", {"spacing": 0.5, "jitter": 0.1, "seed": 3}), ("/damping", "kinetic"), ("/limits", REMOVED),
    ("/blocks/0/joint_sets/0", {"dip": 45, "spacing": 1, "persistence": 0.9, "gap": 0.1}), ("/time/dt", 1e-5),
    ("/contact/cohesive_overlap", {}), ("/bodies/0/fix", []), ("/bodies/0/drive", {}),
    ("/bodies/0/discontinuities", []),
    ("/materials/rock", {"density": 1, "model": "mohr_coulomb", "young_modulus": 1e8, "poisson_ratio": 0.2,
                         "friction_angle": 30, "cohesion": 1e6}),
]


def without_comments(text):
    """Of a scene; comments stand outside of strings."""
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda found: found[1] or "", text, flags=re.DOTALL)


def parts(pointer):
    return [int(part) if part.isdigit() else part for part in pointer.split("/")[1:]]


def changed(pointer, value):
    scene = copy.deepcopy(GOOD)
    *way, last = parts(pointer)
    at = scene
    for part in way:
        at = at[part]
    if value is REMOVED:
        del at[last]
    else:
        at[last] = value
    return scene


def read(scene):
    """Whether the program takes the scene, and what it says."""
    file = FOLDER / "scene.json"
    file.write_text(json.dumps(scene))
    call = subprocess.run([PROGRAM, "blocks", str(file)], capture_output=True, text=True)
    assert call.returncode in (0, 2), call
    return call.returncode == 0, call.stderr


def object_schemas(schema, value, pointer=""):
    """Pointers to the objects of a scene, with the part of the schema that says which keys they have."""
    def resolved(node):
        while "$ref" in node:
            node = schema["$defs"][node["$ref"].rsplit("/", 1)[1]]
        return node

    def walk(node, value, pointer):
        node = resolved(node)
        if isinstance(value, dict):
            if "properties" in node:
                yield pointer, node, value
            for key, below in value.items():
                inner = node.get("properties", {}).get(key, node.get("additionalProperties"))
                if isinstance(inner, dict):
                    yield from walk(inner, below, f"{pointer}/{key}")
        elif isinstance(value, list) and isinstance(node.get("items"), dict):
            for number, below in enumerate(value):
                yield from walk(node["items"], below, f"{pointer}/{number}")

    yield from walk(schema, value, pointer)


def fulfilled(schema, value):
    """What conditions of a schema say of a value."""
    for choice in schema.get("allOf", []):
        if "then" in choice and jsonschema.Draft202012Validator(choice["if"]).is_valid(value):
            yield choice["then"].get("properties", {})


def keys_of(schema, part, value, pointer):
    """Keys that an object may have: those that follow its "model" too, of interfaces those of the laws in the scene."""
    keys = set(part["properties"])
    for properties in fulfilled(part, value):
        keys |= set(properties)
    if re.fullmatch(r"/interfaces/\d+", pointer):
        for properties in fulfilled(schema, GOOD):
            row = properties["interfaces"]["items"]["properties"]
            keys -= {key for key, allowed in row.items() if allowed is False}
    return keys


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    written = subprocess.run([PROGRAM, "schema"], capture_output=True, text=True, check=True).stdout
    schema = json.loads(written)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failed = []

    def expect(good, scene, name):
        problem = jsonschema.exceptions.best_match(validator.iter_errors(scene))
        if (problem is None) != good:
            failed.append(f"{name}: the schema {'refuses' if good else 'takes'} it: {problem and problem.message}")

    for file in SCENES:
        expect(True, json.loads(without_comments(file.read_text())), file.name)
    for pointer, value in [("/title", "as it is")] + VARIED:
        scene = changed(pointer, value)
        expect(True, scene, f"{pointer}: {value}")
        good, words = read(scene)
        if not good:
            failed.append(f"{pointer}: {value}: the program refuses it: {words}")
    for pointer, value in BROKEN:
        scene = changed(pointer, value)
        expect(False, scene, f"{pointer}: {value}")
        if read(scene)[0]:
            failed.append(f"{pointer}: {value}: the program takes it")

    for lists in NOTHING:
        scene = {"talus": 1, "materials": {"rock": ROCK}, "time": {"end": 1}} | lists
        expect(False, scene, str(lists))
        if read(scene)[0]:
            failed.append(f"{lists}: the program takes it")

    compared = set()
    for pointer, part, value in object_schemas(schema, GOOD):
        kind = re.sub(r"/[0-9]+", "/*", pointer)
        if kind in compared or not part["properties"]:
            continue
        compared.add(kind)
        words = read(changed(pointer + "/not_a_key", 1))[1]
        known = re.search(r"unknown key.*? allowed here: (.*)", words)
        if known is None or set(known[1].split(", ")) != keys_of(schema, part, value, pointer):
            failed.append(f"{pointer}: the schema has {sorted(keys_of(schema, part, value, pointer))}, "
                          f"the program says {words}")
    for place in ("", "/bodies/*", "/interfaces/*", "/materials/rock", "/cover", "/time", "/blocks/*/joint_sets/*"):
        if place not in compared:
            failed.append(f"{place}: its keys were not compared")

    print(f"{len(SCENES)} scenes, {len(VARIED) + 1} good and {len(BROKEN) + len(NOTHING)} bad variants, "
          f"keys of {len(compared)} objects: {len(failed)} wrong")
    print("\n".join(failed))
    return 1 if failed else 0


sys.exit(main())
