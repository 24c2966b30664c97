"""One specimen stepped by Yade's CpmMat, in turns with Spall. Run by side_by_side.py, inside Yade:

    SPALL_PEER_SPECIMEN=specimen.txt yade -j1 -n -x yade_cpm.py

Reads what `spall_performance --export` wrote, makes the same links, and refuses to go on if one differs. Then every line
"steps" on standard input is answered with the seconds of the processor's time that so many steps took. Set-up and the
collider's first passes are not in these seconds.
"""
import math
import os
import sys
import time

from yade import Vector3, utils

with open(os.environ["SPALL_PEER_SPECIMEN"], encoding="ascii") as file:
    head = file.readline().split()
    elements, links, factor, axis = int(head[0]), int(head[1]), float(head[2]), int(head[3])
    rows = [[float(number) for number in file.readline().split()] for _ in range(elements)]
    wanted = {tuple(map(int, file.readline().split())) for _ in range(links)}

# Strengths are high: no link softens in either code, which is each one's fast path.
O.materials.append(CpmMat(young=30e9, poisson=0.2, density=2400, frictionAngle=math.atan(0.8), sigmaT=3.5e9,
                          epsCrackOnset=0.1, relDuctility=30))
for x, y, z, radius, vx, vy, vz, held in rows:
    body = utils.sphere((x, y, z), radius)
    body.state.vel = Vector3(vx, vy, vz)
    if held:
        body.state.blockedDOFs = "xyz"[axis]
    O.bodies.append(body)

enlarged = factor * (1 + 1e-9)  # boxes a hair larger than the reach, which Ig2 then keeps to


def engines(collider, detection):
    return [
        ForceResetter(),
        collider,
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=detection)],
                        [Ip2_CpmMat_CpmMat_CpmPhys()], [Law2_ScGeom_CpmPhys_Cpm()]),
        NewtonIntegrator(damping=0.3),
    ]


O.dt = 0.3 * utils.PWaveTimeStep()
O.engines = engines(InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=enlarged)]), factor)
O.step()  # makes the links

made = {(min(i.id1, i.id2), max(i.id1, i.id2)) for i in O.interactions if i.isReal and i.phys.isCohesive}
if made != wanted:
    sys.exit(f"yade_cpm.py: Yade made {len(made)} links, {len(made - wanted)} of them others than Spall's {links}")

# A fresh collider with boxes of the spheres' own size: without the pairs that the enlarged boxes left in the loop.
for body in O.bodies:
    body.bound = None
O.engines = engines(InsertionSortCollider([Bo1_Sphere_Aabb()]), 1.0)
O.run(12, True)

print("ready", links, flush=True)
for line in sys.stdin:
    steps = int(line)
    start = time.process_time()
    O.run(steps, True)
    print("seconds", repr(time.process_time() - start), flush=True)
left = sum(1 for i in O.interactions if i.isReal and i.phys.isCohesive)
print("left", left, flush=True)
