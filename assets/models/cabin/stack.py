"""Centre stack: vents, radio with screen, climate controls, hazard button."""
from mathutils import Matrix

from cabin.dashboard import add_slats
from cabin.dimensions import CENTRE_X
from craft import prints, scene
from craft.geometry import frame, rounded
from craft.part import Part, bezel

F = frame((CENTRE_X, 0.640, 0.245), 11)


def shifted(x, y, z):
    return F @ Matrix.Translation((x, y, z))


def build():
    scene.empty("CentreStack", F, "Dashboard")
    part = Part("CentreStackBody", F, "CentreStack", smooth=40)
    half = [(-0.128, 0.150), (-0.134, 0.05), (-0.126, -0.10), (-0.116, -0.150)]
    part.panel(F, half + [(-x, z) for x, z in half[::-1]], -0.12, 0.0, "PlasticHard", bevel=0.010, seg=3)
    add_radio(part)
    for side in (-1, 1):
        add_vent(part, side)
    add_climate(part)
    part.build()
    build_screen()
    build_climate_print()
    build_hazard_button()


def add_radio(part):
    part.panel(F, rounded(0.246, 0.125, 0.014, cy=0.016), -0.01, 0.004, "PlasticGloss", bevel=0.002)
    edge = shifted(0, -0.004, 0.016)
    bezel(part, edge, rounded(0.250, 0.129, 0.016), rounded(0.244, 0.123, 0.013), -0.01, 0.003, 0, "MetalSatin")
    knob = [(0.0135, 0), (0.013, 0.010), (0.011, 0.0125), (0.0005, 0.0127)]
    for side in (-1, 1):
        part.lathe(shifted(side * 0.1003, -0.004, 0.016), knob, "PlasticHard", n=18)
    for i in range(5):
        key = rounded(0.030, 0.011, 0.003, cx=(i - 2) * 0.036, cy=-0.057)
        part.panel(F, key, 0, 0.0035, "PlasticHard", bevel=0.001, seg=1)


def add_vent(part, side):
    V = shifted(side * 0.060, 0, 0.116)
    bezel(part, V, rounded(0.112, 0.056, 0.012), rounded(0.100, 0.045, 0.008), -0.006, 0.010, -0.004, "PlasticGloss")
    rim = rounded(0.103, 0.048, 0.009), rounded(0.0985, 0.0435, 0.0075)
    bezel(part, V, *rim, 0.003, 0.0105, 0.002, "MetalSatin")
    part.panel(V, rounded(0.102, 0.047, 0.008), -0.004, -0.0005, "PlasticGloss", bevel=0)
    add_slats(part, V @ Matrix.Translation((0, -0.008, 0)), 0.097, 0.042, 5)


def add_climate(part):
    part.panel(F, rounded(0.236, 0.062, 0.012, cy=-0.098), -0.01, 0.004, "PlasticGloss", bevel=0.002)
    knob = [(0.0235, 0), (0.0235, 0.002), (0.021, 0.003), (0.0205, 0.014), (0.019, 0.0165), (0.016, 0.017)]
    ring = [(0.0215, 0.0028), (0.0222, 0.0045), (0.0215, 0.0062), (0.0205, 0.0064)]
    for i in (-1, 0, 1):
        K = shifted(i * 0.0738, -0.004, -0.098)
        part.lathe(K, knob + [(0.0005, 0.0165)], "PlasticHard", n=20)
        part.lathe(K, ring, "MetalSatin", n=20)
        part.box((0, -0.0172, 0.013), (0.0018, 0.002, 0.010), "Headliner", K, bevel=0.0005, seg=1)


def build_screen():
    S = shifted(0, -0.0046, 0.016)
    part = Part("RadioScreen", S, "CentreStack")
    part.flat(S, rounded(0.166, 0.0934, 0.004), 0, "Prints", (prints.rect("screen"), S, 0.166, 0.0934))
    part.build()


def build_climate_print():
    K = shifted(0, -0.0043, -0.098)
    part = Part("ClimatePrint", K, "CentreStack")
    part.flat(K, rounded(0.234, 0.0585, 0.010), 0, "Prints", (prints.rect("climate"), K, 0.236, 0.059))
    part.build()


def build_hazard_button():
    H = shifted(0, -0.0008, 0.116)
    part = Part("HazardButton", H, "CentreStack")
    part.panel(H, rounded(0.016, 0.030, 0.003), -0.005, 0.0115, "PlasticHard", bevel=0.001)
    part.flat(H, rounded(0.0145, 0.0145, 0.002), 0.0118, "Prints", (prints.rect("hazard"), H, 0.029, 0.0145))
    part.build()
