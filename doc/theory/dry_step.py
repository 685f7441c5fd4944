# SPDX-License-Identifier: LGPL-2.1-or-later
"""The time step of dry soil in 2D, in the order of doc/theory/single_phase.md: a reference for readers.

Case: prm/columns/mohr_coulomb_collapse.prm, a column of Mohr-Coulomb soil without cohesion and dilation on a fixed base; FLIP, projected F-bar.
Left out: bed, obstacles, contact of bodies, loads, settling, and the other transfers and laws.
`python3 doc/theory/dry_step.py` prints results over time; `dry_step.py PICTURE results/mohr_coulomb_collapse/statistics.csv` draws them beside those
of the program. The scene tests/scenes/reference_scenes.py compares both.
Components of tensors are xx, yy, zz, with xy apart; [point, 9 nodes] tells what an array runs over."""

import sys
from types import SimpleNamespace

import numpy as np

H, CELLS, PER_CELL, WIDTH, HEIGHT = 0.05, np.array([100, 30]), 4, 1., 1.  # cell size, m; cells and points along each axis; column, m
YOUNG, POISSON, DENSITY, SINE, K0 = 1e6, 0.3, 2650*(1 - 0.4), np.sin(np.radians(30)), 0.5  # Pa, -, kg/m^3, -, -
GRAVITY, PIC_RATE, TIME_STEP = 9.81, 5., 1e-3  # m/s^2, 1/s, s; the program chooses its time step by the wave speed

SPACING, N_NODES = H/PER_CELL, (CELLS + 2).prod()
SHEAR, LAME = YOUNG/(2*(1 + POISSON)), YOUNG*POISSON/((1 + POISSON)*(1 - 2*POISSON))  # Pa
COLUMN, ROW = np.arange(N_NODES) % (CELLS[0] + 2), np.arange(N_NODES)//(CELLS[0] + 2)  # of the nodes
SLOW = [0, np.sqrt(2*.5*GRAVITY*H)]  # m/s; approach to a smooth and to a fixed wall below which it acts at once (Wall gaps)


def shapes(x):
    """Cells of the points, places in them, and functions as [point, 9 nodes]: numbers of the nodes, splines phi_i and their slopes."""
    cell = (x/H).astype(int)
    place, axes = x/H - cell, []
    for a in range(2):
        s, l, r = place[:, a], np.where(cell[:, a] == 0, 1, .5), np.where(cell[:, a] == CELLS[a] - 1, 1, .5)
        axes.append([np.stack(three, 1) for three in ([l*(1 - s)**2, 1 - l*(1 - s)**2 - r*s**2, r*s**2],
                                                      [-2*l*(1 - s)/H, (2*l*(1 - s) - 2*r*s)/H, 2*r*s/H])])
    both = lambda of_x, of_y: (axes[1][of_y][:, :, None]*axes[0][of_x][:, None]).reshape(-1, 9)
    first = cell@[1, CELLS[0] + 2]
    node = first[:, None] + (np.arange(3)[:, None]*(CELLS[0] + 2) + np.arange(3)).ravel()
    return SimpleNamespace(number=cell@[1, CELLS[0]], place=place, node=node, phi=both(0, 0), slopes=(both(1, 0), both(0, 1)))


def at_nodes(at, values):
    """Sums of [point, 9 nodes] over the points."""
    return np.bincount(at.node.ravel(), values.ravel(), N_NODES)


def hold(v, v_free, at):
    """Walls: smooth sides, fixed bottom, open top. A wall acts on a node that a point has reached (Wall gaps)."""
    for a, side, nodes in ((0, 0, COLUMN == 0), (0, 1, COLUMN == CELLS[0] + 1), (1, 0, ROW == 0)):
        nearest, beside = np.full(N_NODES, np.inf), nodes[at.node].any(1)  # of the points in the cells of a node
        place = at.place[beside, a]
        np.minimum.at(nearest, at.node[beside].ravel(), np.repeat(1 - place if side else place, 9))
        gap = nearest*H - .6*SPACING
        approach = v_free[:, a]*(1 if side else -1)
        is_far = nodes & (gap > 0) & (approach > SLOW[a])
        held = nodes & ~(is_far & (approach*TIME_STEP <= gap))
        v[held, a] = 0
        if a == 1:
            v[held, 0] = 0  # fixed
        closes = held & is_far
        v[closes, a] = (1 if side else -1)*gap[closes]/TIME_STEP


def f_bar(at, n_cells, h, V, strain, is_loaded, dF):
    """Projected F-bar, with the elastic volume strain ln J_e of the points. The scale of dF, also along the third axis, and the change of volume."""
    change, green = np.linalg.det(dF), (dF.transpose(0, 2, 1)@dF - np.eye(2))/2
    shear = np.sqrt(2*((green**2).sum((1, 2)) - np.trace(green, axis1=1, axis2=2)**2/3))
    corners = np.array([[0, 0], [1, 0], [0, 1], [1, 1]])
    away = at.place[:, None] - corners  # from the vertices, in cells, [point, 4 vertices, axis]
    number = np.stack(np.divmod(at.number, n_cells[0])[::-1], 1)[:, None] + corners  # of the vertices along each axis
    vertex = number@[1, n_cells[0] + 1]
    seen = h**2/2**((number == 0) | (number == n_cells)).sum(2)  # volume of the box about a vertex
    psi = (1 - abs(away)).prod(2)
    weight = psi*np.where(is_loaded, V, 0)[:, None]
    sums = lambda values: np.bincount(vertex.ravel(), (weight*values).ravel())[vertex]
    volume = np.maximum(sums(1), 1e-300)
    mean = lambda values: sums(values)/volume  # about the vertices
    axes = range(2)
    away = away - np.stack([mean(away[..., a]) for a in axes], 2)  # from the centre of the points about a vertex
    variance = np.stack([np.stack([mean(away[..., a]*away[..., b]) for b in axes], 2) for a in axes], 3)
    least = (.002 + .2*np.maximum(0, 1 - 2*volume/seen)**2)[..., None, None]*np.eye(2)

    def linear(values, kept_slope):  # the functions l_a of the vertices, at the points
        slope = np.linalg.solve(variance + least, np.stack([mean(away[..., a]*values[:, None]) for a in axes], 2)[..., None])[..., 0]
        return mean(values[:, None]) + kept_slope*(slope*away).sum(2)
    relaxed = 1 - np.exp(-100*mean(shear[:, None]))
    rest = (psi*relaxed*(strain[:, None] - linear(strain, 1))).sum(1)
    averaged = np.where(is_loaded, (psi*linear(change, .15)).sum(1)*np.exp(-rest), change)
    return np.cbrt(averaged/change), averaged


def mohr_coulomb(strain):
    """Logarithmic strain and Kirchhoff stress of the trial strain, principal values [point, 3]; no cohesion, no dilation."""
    volume = strain.sum(1, keepdims=True)
    order = np.argsort(-strain, 1)
    trial = np.take_along_axis(2*SHEAR*strain + LAME*volume, order, 1)
    mean, ratio = trial.mean(1), (1 + SINE)/(1 - SINE)
    excess = np.maximum(0, (1 + SINE)*trial[:, 0] - (1 - SINE)*trial[:, 2])/2
    stress = trial + excess[:, None]*[-1, 0, 1]  # the face f_13; the mean stays
    edge = np.where(stress[:, 1] > stress[:, 0], mean*3/(2 + ratio), mean*3/(1 + 2*ratio))  # largest stress on an edge
    on_edge = (excess > 0) & ((stress[:, 1] > stress[:, 0]) | (stress[:, 1] < stress[:, 2]))
    middle = np.where(stress[:, 1] > stress[:, 0], edge, ratio*edge)
    stress = np.where(on_edge[:, None], np.stack([edge, middle, ratio*edge], 1), stress)
    np.put_along_axis(returned := np.empty_like(stress), order, stress, 1)
    is_apart = volume >= 0  # the gap stays as isotropic strain
    elastic = volume/3 + (returned - mean[:, None])/(2*SHEAR)
    return np.where(is_apart, volume/3, elastic), np.where(is_apart, 0, returned)


def update_stress(soil, dF, scale):
    """Trial b_e, principal values and axes, the law, and back (Kinematics)."""
    F = scale[:, None, None]*dF
    b = F@np.stack([soil.b[:, 0], soil.b_xy, soil.b_xy, soil.b[:, 1]], 1).reshape(-1, 2, 2)@F.transpose(0, 2, 1)
    half, middle = (b[:, 0, 0] - b[:, 1, 1])/2, (b[:, 0, 0] + b[:, 1, 1])/2
    radius = np.hypot(half, b[:, 0, 1])
    cosine, sine = (np.where(radius > 0, one/np.where(radius > 0, radius, 1), unit) for one, unit in ((half, 1), (b[:, 0, 1], 0)))
    determinant = b[:, 0, 0]*b[:, 1, 1] - b[:, 0, 1]**2
    trial = np.log(np.stack([middle + radius, determinant/(middle + radius), soil.b[:, 2]*scale**2], 1))/2
    strain, tau = mohr_coulomb(trial)
    soil.shear += np.sqrt(2/3*(((trial - strain) - (trial - strain).mean(1, keepdims=True))**2).sum(1))*(strain.sum(1) < 0)
    components = lambda p: (np.stack([(p[:, 0] + p[:, 1])/2 + s*cosine*(p[:, 0] - p[:, 1])/2 for s in (1, -1)] + [p[:, 2]], 1),
                            sine*(p[:, 0] - p[:, 1])/2)
    soil.b, soil.b_xy = components(np.exp(2*strain))
    soil.stress, soil.stress_xy = components(tau*(soil.V0/soil.V)[:, None])  # sigma = tau/J


def step(soil):
    """Advances the points by a time step."""
    at = shapes(soil.x)
    # Points to nodes: mass, momentum, forces of stress and weight; explicit update; walls.
    mass = at_nodes(at, soil.m[:, None]*at.phi)
    inverse = np.where(mass > 0, 1/np.where(mass > 0, mass, 1), 0)[:, None]
    v_n = inverse*np.stack([at_nodes(at, (soil.m*soil.v[:, c])[:, None]*at.phi) for c in range(2)], 1)
    rows = ((soil.stress[:, 0], soil.stress_xy), (soil.stress_xy, soil.stress[:, 1]))
    force = -np.stack([at_nodes(at, sum((soil.V*of_axis)[:, None]*slope for of_axis, slope in zip(row, at.slopes))) for row in rows], 1)
    v_free = v_n + TIME_STEP*(inverse*force + np.array([0, -GRAVITY])*(mass > 0)[:, None])
    v = v_free.copy()
    hold(v, v_free, at)
    # Nodes to points: FLIP.
    v_bar, change = (np.einsum("pi,pic->pc", at.phi, one[at.node]) for one in (v, v - v_n))
    L = np.stack([np.einsum("pi,pic->pc", slope, v[at.node]) for slope in at.slopes], 2)
    kept = np.exp(-PIC_RATE*TIME_STEP)
    soil.v = kept*(soil.v + change) + (1 - kept)*v_bar
    soil.x = soil.x + TIME_STEP*v_bar
    dF = np.eye(2) + TIME_STEP*L
    strain = np.log(soil.b.prod(1) - soil.b_xy**2*soil.b[:, 2])/2  # ln J_e
    scale, change_of_volume = f_bar(at, CELLS, H, soil.V, strain, (soil.stress**2).sum(1) > 0, dF)
    soil.V = soil.V*change_of_volume
    update_stress(soil, dF, scale)


def start():
    """Points on a lattice, at rest, under the weight of the soil above (K0)."""
    x = (np.stack(np.meshgrid(*map(np.arange, CELLS*PER_CELL)), -1).reshape(-1, 2) + .5)*SPACING
    x = x[(x[:, 0] < WIDTH) & (x[:, 1] < HEIGHT)]
    stress = -DENSITY*GRAVITY*(HEIGHT - x[:, [1]])*[K0, 1, K0]
    strain = (stress*(1 + POISSON) - POISSON*stress.sum(1, keepdims=True))/YOUNG
    V = np.full(len(x), SPACING**2)
    return SimpleNamespace(x=x, v=0*x, V=V, V0=V, m=DENSITY*V, b=np.exp(2*strain), b_xy=0*V, stress=stress, stress_xy=0*V, shear=0*V)


def kinetic_energy(soil):
    """J per m."""
    return (soil.m*(soil.v**2).sum(1)).sum()/2


def draw(rows, soil, picture, program):
    """The history of the reference beside that of the program (statistics.csv), and the points at the end."""
    import matplotlib.pyplot as plt
    of_program = np.genfromtxt(program, delimiter=",", names=True, deletechars="", replace_space=" ")
    figure, panels = plt.subplots(3, 1, figsize=(7, 7), constrained_layout=True, height_ratios=(1, 1, 1.3))
    time, energy, *fronts = np.transpose(rows)
    for panel, label, curves in ((panels[0], "kinetic energy (J)", [(energy, "Kinetic energy (J)")]),
                                 (panels[1], "front (m)", [(fronts[0], "Front 90 % (m)"), (fronts[1], "Front 99 % (m)")])):
        for values, column in curves:
            panel.plot(of_program["Time (s)"], of_program[column], "C0", label="program")
            panel.plot(time, values, "k.", label="dry_step.py")
        panel.set(xlabel="time (s)", ylabel=label, xlim=(0, 3))
    panels[0].legend()
    colours = panels[2].scatter(*soil.x.T, s=1, c=soil.shear, vmin=0, vmax=3)
    panels[2].set(xlim=(0, 3), ylim=(0, 1.05), aspect="equal", xlabel="x (m)", ylabel="y (m)")
    figure.colorbar(colours, ax=panels[2], label="plastic shear strain")
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    column, history = start(), []
    print("time (s)   kinetic energy (J)   90 % front (m)   99 % front (m)")
    for step_number in range(3001):
        if step_number % 100 == 0:
            history.append([step_number*TIME_STEP, kinetic_energy(column), *np.quantile(column.x[:, 0], [.9, .99])])
            print("%8.2f%21.6f%17.4f%17.4f" % tuple(history[-1]), flush=True)
        step(column)
    if len(sys.argv) > 1:
        draw(history, column, *sys.argv[1:])
