"""Dimensions of the gearbox in metres; x right, y forward along the shaft, z up; origin: centre of the hub.

The sleeve's teeth end 10.5 mm from its middle. Moved by 5 mm they meet the ring's teeth (15.5 mm), by 7 mm the dog
teeth (17.5 mm); at 9 mm the gear is in.
"""
from math import cos, radians, sin

SHAFT_R, SHAFT_HALF = 0.0145, 0.064
TEETH = 30  # number of splines on hub and sleeve, and of teeth on ring and dogs
SPLINE_R, SPLINE_DEPTH = 0.0320, 0.0022  # pitch radius, half height
HUB_HALF = 0.0105
SLEEVE_HALF, SLEEVE_R = 0.0125, 0.0425
SLEEVE_TOOTH_HALF = 0.0105
GROOVE_HALF, GROOVE_R = 0.0042, 0.0385  # the fork's groove in the sleeve
RING_NEAR, RING_FAR = 0.0155, 0.0173  # extent of the ring's teeth along the shaft
DOG_NEAR, DOG_FAR = 0.0175, 0.0208
GEAR_NEAR, GEAR_FAR = 0.0225, 0.0415
GEAR_TEETH, GEAR_TIP_R, GEAR_ROOT_R, GEAR_HELIX = 30, 0.0480, 0.0435, 22.0  # m, m, deg
TRAVEL = 0.009

CUT = (140.0, 230.0)  # sector cut out of the sleeve [deg] from +x upwards

RAIL_ANGLE, RAIL_DISTANCE = 60.0, 0.072  # where the rail runs, seen from the shaft
RAIL = (RAIL_DISTANCE * cos(radians(RAIL_ANGLE)), RAIL_DISTANCE * sin(radians(RAIL_ANGLE)))
RAIL_R, RAIL_HALF = 0.0065, 0.072
DETENT_Y = -0.052  # the ball's position along the rail; notches at DETENT_Y and TRAVEL to either side
FINGER_AXIS = 0.042  # above the rail's axis
FINGER_REACH = 0.030  # from the axis to the middle of the tip
