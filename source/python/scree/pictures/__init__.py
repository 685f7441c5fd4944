# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of points, in the plane and in space, and of tables.

fields: names, units and colours. frame: the part of the box that is shown. rigid: bed and obstacles. plane, space: drawing of points.
panels: several times in one picture, and films. tables: statistics and probes. paraview: a state script. display: the X server of VTK.
"""
