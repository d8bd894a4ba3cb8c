"""The sliding bodies of scenes/generate/sliding.py in the words of the peers."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "scenes" / "generate"))

import sliding  # noqa: E402

ROUNDING = 0.02  # m, diameter of the rounded corners of LAMMPS's polygons
CONTACT_LENGTH = 0.35  # m of a side that one of its two corners answers for
# In the release of Debian 12 the friction of body/rounded/polygon acts along the normal. What resists sliding is the
# tangential damping alone; small, it lets the blocks slide, and what it costs to compute does not depend on its size.
TANGENTIAL = 1e3  # N s/m


def write_box2d(path, bodies):
    """One line per body: velocity or "fixed", number of vertices, vertices [m]."""
    with open(path, "w") as file:
        for _, outline, velocity, _ in bodies:
            first = "fixed" if velocity is None else f"{velocity[0]!r} {velocity[1]!r}"
            points = " ".join(f"{x!r} {y!r}" for x, y in outline)
            file.write(f"{first} {len(outline)} {points}\n")


def area_and_centre(outline):
    area = x = y = 0.0
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
        cross = ax * by - bx * ay
        area += cross / 2
        x += (ax + bx) * cross / 6
        y += (ay + by) * cross / 6
    return area, (x / area, y / area)


def polar_moment(outline):
    """Integral of x^2 + y^2 over a polygon given about its centroid, m^4."""
    moment = 0.0
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
        cross = ax * by - bx * ay
        moment += cross * (ax * ax + ax * bx + bx * bx + ay * ay + ay * by + by * by) / 12
    return moment


def shrunk(outline, by):
    """The outline with every side moved inwards: what is rounded by that much reaches the old sides again."""
    sides = []
    for (ax, ay), (bx, by_) in zip(outline, outline[1:] + outline[:1]):
        length = math.hypot(bx - ax, by_ - ay)
        nx, ny = (ay - by_) / length, (bx - ax) / length  # inwards
        sides.append((nx, ny, nx * ax + ny * ay + by))
    corners = []
    for (n1x, n1y, c1), (n2x, n2y, c2) in zip(sides[-1:] + sides[:-1], sides):
        determinant = n1x * n2y - n1y * n2x
        corners.append(((c1 * n2y - c2 * n1y) / determinant, (n1x * c2 - n2x * c1) / determinant))
    return corners


def tiles(base):
    """The base as a row of fixed bodies about as large as a block: LAMMPS looks for neighbours by their radius."""
    (left, bottom), (right, _), (_, top) = base[0], base[1], base[2]
    count = round(right - left)
    width = (right - left) / count
    depth = min(sliding.HEIGHT, top - bottom)
    for i in range(count):
        x = left + i * width
        tile = [(x, top - depth), (x + width, top - depth), (x + width, top), (x, top)]
        yield [sliding.down_the_slope(p) for p in tile]


def base_in_its_frame(blocks):
    rows = sliding.rows_of_blocks(blocks)
    left, right = -sliding.OVERHANG, len(rows[0]) * sliding.LENGTH + sliding.OVERHANG
    return [(left, -sliding.BASE_HEIGHT), (right, -sliding.BASE_HEIGHT), (right, 0.0), (left, 0.0)]


def write_lammps(data_path, input_path, blocks, bodies, steps, warm_up, dt):
    """The data file of the bodies and the script that runs them. Blocks are of type 1, tiles of type 2."""
    polygons = [(outline, velocity, 1) for _, outline, velocity, _ in bodies if velocity is not None]
    polygons += [(outline, (0.0, 0.0), 2) for outline in tiles(base_in_its_frame(blocks))]
    xs = [x for outline, _, _ in polygons for x, _ in outline]
    ys = [y for outline, _, _ in polygons for _, y in outline]
    atoms, velocities, shapes = [], [], []
    for number, (outline, velocity, kind) in enumerate(polygons, 1):
        area, (cx, cy) = area_and_centre(outline)
        core = shrunk([(x - cx, y - cy) for x, y in outline], ROUNDING / 2)
        moment = sliding.DENSITY * polar_moment([(x - cx, y - cy) for x, y in outline])
        atoms.append(f"{number} {kind} 1 {sliding.DENSITY * area!r} {cx!r} {cy!r} 0")
        velocities.append(f"{number} {velocity[0]!r} {velocity[1]!r} 0 0 0 0")
        shapes.append(f"{number} 1 {6 + 3 * len(core) + 1}\n{len(core)}")
        shapes.append(f"{moment / 2!r} {moment / 2!r} {moment!r} 0 0 0")
        shapes += [f"{x!r} {y!r} 0" for x, y in core]
        shapes.append(f"{ROUNDING}")
    margin = 10.0
    with open(data_path, "w") as file:
        file.write(
            f"sliding blocks\n\n{len(polygons)} atoms\n{len(polygons)} bodies\n2 atom types\n"
            f"{min(xs) - margin} {max(xs) + margin} xlo xhi\n{min(ys) - margin} {max(ys) + margin} ylo yhi\n"
            "-0.5 0.5 zlo zhi\n\nAtoms\n\n" + "\n".join(atoms) + "\n\nVelocities\n\n" + "\n".join(velocities)
            + "\n\nBodies\n\n" + "\n".join(shapes) + "\n"
        )
    stiffness = sliding.STIFFNESS * CONTACT_LENGTH  # N/m of a corner
    mass = sliding.DENSITY * sliding.LENGTH * sliding.HEIGHT / 2  # kg, reduced
    damping = 2 * sliding.DAMPING * math.sqrt(stiffness * mass) / 2
    with open(input_path, "w") as file:
        file.write(f"""units si
dimension 2
boundary f f p
atom_style body rounded/polygon 1 6
atom_modify map array sort 1000 0
comm_modify vel yes
read_data {data_path}
# normal and tangential damping, friction, scaling of several contacts, reach of cohesion
pair_style body/rounded/polygon {damping:g} {TANGENTIAL:g} 0 1 0
pair_coeff * * {stiffness:g} 0
neighbor 0.1 bin
neigh_modify every 1 delay 0 check yes exclude type 2 2
group blocks type 1
fix 1 blocks nve/body
fix 2 blocks gravity {sliding.GRAVITY} vector 0 -1 0
fix 3 all enforce2d
timestep {dt!r}
compute energy blocks ke
thermo_style custom step atoms c_energy pe
thermo_modify lost error
thermo {steps}
run {warm_up}
run {steps}
""")
