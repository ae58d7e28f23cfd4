"""Dimensions of the gearbox in metres; x right, y forward along the shaft, z up; origin: centre of the hub.

The sleeve's teeth end 10.5 mm from its middle. Moved by 5 mm they meet the ring's teeth (15.5 mm), by 7 mm the dog
teeth (17.5 mm); at 9 mm the gear is engaged.
"""
from math import cos, radians, sin

SHAFT_R, SHAFT_HALF = 0.0145, 0.064
TEETH = 30  # number of splines on hub and sleeve, and of teeth on rings and dogs
SPLINE_R, SPLINE_DEPTH = 0.0320, 0.0022  # [m] pitch radius, half height of a tooth
HUB_HALF = 0.0105
SLEEVE_HALF, SLEEVE_R = 0.0125, 0.0425
SLEEVE_TOOTH_HALF = 0.0105
GROOVE_HALF, GROOVE_R = 0.0042, 0.0385  # [m] the fork's groove in the sleeve: half width, radius of the groove's floor
RING_NEAR, RING_FAR = 0.0155, 0.0173  # [m] extent of the ring's teeth along the shaft
DOG_NEAR, DOG_FAR = 0.0175, 0.0208
GEAR_NEAR, GEAR_FAR = 0.0225, 0.0415
# Number of teeth, tip radius and root radius [m], helix angle [deg].
GEAR_TEETH, GEAR_TIP_R, GEAR_ROOT_R, GEAR_HELIX = 30, 0.0480, 0.0435, 22.0
TRAVEL = 0.009

CUT = (140.0, 230.0)  # [deg] sector cut out of the sleeve; angles from +x towards +z

RAIL_ANGLE, RAIL_DISTANCE = 60.0, 0.072  # angle [deg] and distance [m] from the shaft to the rail
RAIL = (RAIL_DISTANCE * cos(radians(RAIL_ANGLE)), RAIL_DISTANCE * sin(radians(RAIL_ANGLE)))
RAIL_R, RAIL_HALF = 0.0065, 0.072
DETENT_Y = -0.052  # [m] y of the detent ball and the middle notch; the other two notches are TRAVEL away
FINGER_AXIS = 0.042  # [m] height of the finger's axis above the rail's axis
FINGER_REACH = 0.030  # [m] distance from the finger's axis to the middle of its tip
