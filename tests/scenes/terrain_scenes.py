# SPDX-License-Identifier: LGPL-2.1-or-later
"""terrain_scenes.py SCREE SCENE: slides on mountains of scree-mountain, as scenes.py. The whole bank is scree-terrain-bank."""

from scree import terrain_bank

from scene_tools import check, main


def terrain_bank_short(scree):
    """No point is thrown, lost or pressed into the ground; the soil weighs what its map says; no energy from nothing. These three
    meet the bound of depth at 15 s; others do not (doc/verification/bed_and_contact.md, "Terrain")."""
    for seed, options in ((1, {}), (2, {}), (3, {"rim": "cut"})):
        for method in ("FLIP", "AFLIP", "TPIC"):
            numbers = terrain_bank.run_case(scree, "%d_%s" % (seed, method), seed, options, 20., {"End time": "15", "Transfer/Method": method})
            for key, bound in terrain_bank.BOUNDS.items():
                check("mountain %d, %s: %s" % (seed, method, key), numbers[key], 0, bound)


if __name__ == "__main__":
    main(globals())
