"""Uniaxial tension of an exported specimen in Yade, as `spall test elastic` and `spall test tension` do it.

    SPALL_SCRIPT=concrete.py SPALL_SIZE="0.4 0.2 0.2" SPALL_AIM=elastic yade -j1 -n -x yade_tension.py

SPALL_SCRIPT is what `spall card export --to yade-...` wrote; the specimen fills [0, size] and is pulled along x. The ends are
layers one element size thick, held along x only; strain is the least-squares slope of displacements far from the faces, stress
the reaction over the nominal section. With SPALL_AIM=elastic it is pulled to a strain of 1e-5 and left to come to rest; with
SPALL_AIM=peak it is pulled at SPALL_SPEED (metres a second) until the stress has fallen. SPALL_LINKS, if set, is the table of
links of `spall card export --to csv`: stiffness and strength of every link are compared with it. Prints one line of JSON.
"""
import json
import os

script = os.environ["SPALL_SCRIPT"]
size = [float(number) for number in os.environ["SPALL_SIZE"].split()]
exec(compile(open(script, encoding="utf-8").read(), script, "exec"), {**globals(), "__file__": script})

bodies = list(O.bodies)
start = [tuple(body.state.pos) for body in bodies]
element = (size[0] * size[1] * size[2] / len(bodies)) ** (1 / 3)
low = [k for k, x in enumerate(start) if x[0] < element]
high = [k for k, x in enumerate(start) if x[0] > size[0] - element]
ends = min(4 * element, 0.3 * size[0])
gauge = [
    k
    for k, x in enumerate(start)
    if ends <= x[0] <= size[0] - ends and min(min(x[c], size[c] - x[c]) for c in (1, 2)) >= 2 * element
]


def slope(axis):
    """Mean normal strain along the axis, extension positive."""
    middle = sum(start[k][axis] for k in gauge) / len(gauge)
    moved = sum((start[k][axis] - middle) * (bodies[k].state.pos[axis] - start[k][axis]) for k in gauge)
    return moved / sum((start[k][axis] - middle) ** 2 for k in gauge)


def stress():
    """Tension positive [Pa]."""
    pull = sum(O.forces.f(k)[0] for k in low) - sum(O.forces.f(k)[0] for k in high)
    return 0.5 * pull / (size[1] * size[2])


def pull(speed, inside):
    """The ends part at this speed; with `inside` the rest begins with the strain rate that goes with it."""
    for k, body in enumerate(bodies):
        along = start[k][0] / size[0] - 0.5
        if inside:
            body.state.vel = (speed * along, 0, 0)
    for layer, sign in ((low, -0.5), (high, 0.5)):
        for k in layer:
            bodies[k].state.blockedDOFs = "x"
            velocity = bodies[k].state.vel
            bodies[k].state.vel = (sign * speed, velocity[1], velocity[2])


def strengths(phys):
    """Tension and shear that a link holds before anything has happened to it [N]."""
    if hasattr(phys, "FnMax"):
        return phys.FnMax, phys.FsMax
    return phys.E * phys.epsCrackOnset * phys.crossSection, phys.undamagedCohesion * phys.crossSection


def worst_link(table):
    """The largest relative difference of any link's stiffness or strength from the table."""
    worst = 0.0
    with open(table, encoding="ascii") as rows:
        head = [name.split("[")[0] for name in next(rows).strip().split(",")]
        for line in rows:
            row = dict(zip(head, map(float, line.split(","))))
            phys = O.interactions[int(row["a"]), int(row["b"])].phys
            ours = (row["Kn"], row["Ks"], row["tensile_force"], row["shear_force"])
            worst = max([worst] + [abs(b / a - 1) for a, b in zip(ours, (phys.kn, phys.ks, *strengths(phys)))])
    return worst


newton = O.engines[-1]
result = {"elements": len(bodies), "links": sum(1 for i in O.interactions if i.isReal and i.phys.isCohesive)}
if "SPALL_LINKS" in os.environ:
    result["worst_link"] = worst_link(os.environ["SPALL_LINKS"])
if os.environ["SPALL_AIM"] == "elastic":
    steps = 800
    pull(1e-5 * size[0] / (steps * O.dt), True)
    O.run(steps, True)
    pull(0, False)
    newton.damping = 0.2
    O.run(2000, True)
    along = slope(0)
    result |= {"E": stress() / along, "nu": -0.5 * (slope(1) + slope(2)) / along}
else:
    newton.damping = 0.3
    pull(float(os.environ["SPALL_SPEED"]), True)
    peak, strain = 0.0, 0.0
    while O.iter < 60000:
        O.run(20, True)
        now = stress()
        if now > peak:
            peak, strain = now, slope(0)
        if now < 0.9 * peak and slope(0) > 2e-5:
            break
    result |= {"peak": peak, "strain": strain, "steps": O.iter}
print("RESULT", json.dumps(result), flush=True)
