"""Dimensions of the car. Metres and degrees; x right, y forward, z up; origin: the driver's H-point."""
from mathutils import Vector

EYE = Vector((0.0, -0.05, 0.635))
CENTRE_X = 0.335  # x of the car's centre line, to the right of the driver
HALF_BELT = 0.70  # inner half width at the belt line
HALF_ROOF = 0.56  # inner half width at the roof rail
FLOOR_Z = -0.27
GROUND_Z = -0.53  # road surface: 0.26 m below the driver's heel, 1.165 m below the eye
BELT_Z = 0.42  # top of the door panels
ROOF_Z = 0.945  # highest point of the roof lining, on the centre line
RAIL_Z = 0.885  # height of the roof lining at the roof rails
SCREEN_BASE = (1.20, 0.405)  # (y, z) of the windscreen's lower edge on the centre line; rake 31 deg
SCREEN_HEAD = (0.42, 0.875)  # (y, z) of the windscreen's upper edge on the centre line
DASH_TOP_Z, DASH_NOSE_Y = 0.445, 0.655

WHEEL_CENTRE, WHEEL_D, WHEEL_TILT = Vector((0, 0.40, 0.365)), 0.37, 25.0
RIM_R = 0.0155  # half the thickness of the rim

CLUSTER_CENTRE, CLUSTER_TILT = Vector((0, 0.70, 0.366)), 18.0
DIAL_R, DIAL_DX = 0.046, 0.070  # radius of a dial; distance of the dials' centres from the cluster's centre
DIAL_SWEEP = 270.0  # [deg] range of the needle, clockwise from 135 deg left of twelve o'clock
# Tachometer: end of the scale and start of the red zone [1000/min]. Speedometer: end of the scale [km/h].
TACH_TOP, TACH_RED, SPEED_TOP = 8, 6.5, 220

LEVER_LENGTH = 0.120  # from the pivot to the knob's centre; the yoke of the real device has the same radius
KNOB_CENTRE = Vector((CENTRE_X - 0.005, 0.27, 0.127))
KNOB_D = 0.048
LEVER_PIVOT = KNOB_CENTRE - Vector((0, 0, LEVER_LENGTH))
GATE_Z = LEVER_PIVOT.z + 0.030  # upper face of the gate plate
# Gate plate: outer size of the frame, and size of the frame's opening, whose corners have a radius of 10 mm.
GATE_OUTER, GATE_OPENING = (0.128, 0.136), (0.098, 0.106)
GATE_INSERT_DEPTH = 0.003  # depth of the insert's surface below the frame's surface

PEDALS = {  # x of the centre, pad width, pad height
    "Clutch": (-0.135, 0.070, 0.062),
    "Brake": (-0.005, 0.085, 0.062),
    "Throttle": (0.125, 0.052, 0.125),
}
PEDAL_PIVOT, PEDAL_PAD = (0.90, 0.13), (0.815, -0.105)  # (y, z)

SEAT_W, SEAT_TILT = 0.50, 17.0
SEAT_X = {"Driver": 0.0, "Passenger": 2 * CENTRE_X}
HANDBRAKE_PIVOT = Vector((CENTRE_X, -0.17, -0.03))

ROOF_RAIL = [(0.40, 0.868), (0.25, 0.882), (0.0, RAIL_Z), (-0.35, RAIL_Z), (-0.80, 0.870), (-1.22, 0.835)]  # (y, z)
PILLAR_FOOT = (1.085, 0.405)  # (y, z) of the A-pillar's foot


def side_x(side, z):
    """x of the inner side wall: vertical up to the belt, leaning inwards above. side: -1 left, +1 right."""
    if z < BELT_Z:
        return CENTRE_X + side * HALF_BELT
    k = (z - BELT_Z) / (RAIL_Z - BELT_Z)
    return CENTRE_X + side * (HALF_BELT + (HALF_ROOF - HALF_BELT) * k)
