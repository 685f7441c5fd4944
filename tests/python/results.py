# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the package reads: tables, rasters."""

import pathlib

import numpy as np

from scree.results import Fields, bare_name, column, read_raster, read_statistics, read_table, write_raster

from test_tools import raises, run_tests


def test_tables():
    head = "Time (s),Front 90 % (m)\n"
    pathlib.Path("statistics.csv").write_text(head + "0,1.5\n0.1,nan\n0.2,1.7\n0.3,1.", encoding="utf-8")  # the last row is being written
    table = read_statistics(".")
    assert list(table) == ["Time (s)", "Front 90 % (m)"]
    np.testing.assert_array_equal(table["Time (s)"], [0., 0.1, 0.2])
    np.testing.assert_array_equal(column(table, "Front 90 % (m)"), [1.5, np.nan, 1.7])
    raises(r"there are: Time \(s\), Front 90 % \(m\)", column, table, "Front (m)", kind=KeyError)
    pathlib.Path("empty").write_text(head, encoding="utf-8")
    assert [len(values) for values in read_table("empty").values()] == [0, 0]


def test_rasters():
    heights = np.array([[1., 2., 3.], [4., -9999., 6.]])  # the southern row first
    write_raster("heights.asc", heights, 10.)
    raster = read_raster("heights.asc")
    np.testing.assert_array_equal(raster.values, [[4., np.nan, 6.], [1., 2., 3.]])
    assert raster.extent == (-5., 25., -5., 15.)
    pathlib.Path("short.asc").write_text("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n", encoding="utf-8")
    raises("short.asc: GDAL reads no complete raster", read_raster, "short.asc")


def test_fields():
    assert [bare_name(name) for name in ("velocity [m/s]", "velocity", "odd [name]")] == ["velocity", "velocity", "odd"]
    fields = Fields({"pore_pressure [Pa]": 1, "porosity": 2})
    assert list(fields) == ["pore_pressure", "porosity"] and fields.units == {"pore_pressure": "Pa", "porosity": ""}
    assert fields["pore_pressure"] == 1


run_tests(globals())
