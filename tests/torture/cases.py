"""The runs that ./dev torture strikes at: seconds each, with checkpoints on the way."""

CARD = '''E = "30 GPa"
nu = 0.2
T = "3.1 MPa"
Co = "36 MPa"
zeta = 5
phi_i = "6 degree"
phi_c = "6 degree"
alpha = 3.7
beta = 2.198
gamma = 3.79
'''

CALIBRATE = '''name = "small"
[targets]
E = "30 GPa"
nu = 0.2
ft = "3 MPa"
[fixed]
zeta = 5
Co = "8 MPa"
[specimen]
size = "0.36x0.2x0.2 m"
elements = 1000
fit_seeds = [1]
check_seeds = []
'''

IMPACT = '''model = "coupled"
card = "card.toml"

[structure]
size = "0.6x0.3x0.12 m"
elements = 4000

[zone]
low = "0.15,0,0 m"
high = "0.45,0.3,0.12 m"
layers = 3

[mesh]
elements = [20, 10, 4]

[[support]]
name = "left"
low = "0,0,0 m"
high = "0.03,0.3,0.12 m"
lock = ["z"]

[impactor]
shape = "sphere"
diameter = "60 mm"
density = "7850 kg/m3"
speed = "25 m/s"
aim = "0.3,0.15,0.06 m"

[[probe]]
name = "under"
point = "0.3,0.15,0 m"

[run]
duration = "{duration}"
samples = 60

[output]
frames = 6
'''

STUDY = '''name = "small"
card = "card.toml"
[[specimen]]
name = "prism"
size = "0.3x0.2x0.2 m"
elements = 1100
seeds = 1
[[test]]
kind = "elastic"
[[test]]
kind = "tension"
rate = 0.1
stop_at = 0.8
[[test]]
kind = "compression"
rate = 0.1
stop_at = 0.9
'''


class Case:
    """Files by name, and the command that makes the folder `out` from them.

    interval: seconds between checkpoints, so that there are some; None: as many as there usually are. usual: how often else.
    """

    def __init__(self, name, files, command, before=(), done=(0,), interval="0.3", usual=0):
        self.name, self.files, self.command, self.before, self.done = name, files, command, before, done
        self.interval, self.usual = interval, usual


def cases():
    impact = IMPACT.replace("{duration}", "0.8 ms")
    return [
        Case("calibrate", {"case.toml": CALIBRATE}, ["calibrate", "case.toml", "--frames", "0"], done=(0, 4)),
        Case("impact", {"card.toml": CARD, "slab.toml": impact}, ["impact", "slab.toml"]),
        Case("study", {"card.toml": CARD.replace("36 MPa", "3.6 MPa"), "study.toml": STUDY},
             ["study", "run", "study.toml"]),
        Case("test", {"card.toml": CARD},
             ["test", "compression", "--specimen", "s1.h5", "--card", "card.toml", "--velocity", "0.05 m/s"],
             before=[["specimen", "make", "--size", "0.36x0.2x0.2 m", "--elements", "1000", "-o", "s1.h5", "--quiet"]]),
    ]


def long_cases():
    """Real work: more than ten seconds each, 20,000 elements and more, a fit on two specimens."""
    impact = IMPACT.replace("{duration}", "1 ms").replace("elements = 4000", "elements = 40000")
    fit = CALIBRATE.replace("elements = 1000", "elements = 4000").replace("fit_seeds = [1]", "fit_seeds = [1, 2]")
    study = STUDY.replace("elements = 1100", "elements = 40000")
    return [Case("calibrate", {"case.toml": fit}, ["calibrate", "case.toml", "--frames", "0"], done=(0, 4), interval=None),
            Case("impact", {"card.toml": CARD, "slab.toml": impact}, ["impact", "slab.toml"], interval="1", usual=120),
            Case("study", {"card.toml": CARD.replace("36 MPa", "3.6 MPa"), "study.toml": study},
                 ["study", "run", "study.toml"], interval="1", usual=120)]
