# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of points, in the plane and in space, and of tables.

fields: names, units and colours. rigid: bed and obstacles. plane, space: the part of the box that is shown, and drawing of points.
panels: several times in one picture, and films. tables: statistics and probes. paraview: a state script.
"""
