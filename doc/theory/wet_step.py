# SPDX-License-Identifier: LGPL-2.1-or-later
"""The time step of soil and water in 2D, in the order of "Pressure step" in doc/theory/two_phases.md: a reference for readers.

Case: a column of water collapses over elastic soil, which is saturated up to a water table. Double-point water, AFLIP, projected F-bar.
Left out: rigid ground, contact, gaps at walls, drained walls, suction, rain, cavitation, viscosity, bulk modulus, volume correction.
Matrices are dense and S is solved directly. Phases are soil and water, in this order; [node, component] tells what an array runs over.
`python3 doc/theory/wet_step.py` prints results over time. The scene tests/scenes/reference_scenes.py compares them with those of the program."""

from types import SimpleNamespace

import numpy as np
from dry_step import f_bar

H, CELLS, PER_CELL = 0.1, np.array([10, 9]), 4  # cell size, m; cells and points of a cell along each axis
SOIL_HEIGHT, WATER_TABLE, COLUMN_WIDTH, COLUMN_HEIGHT = 0.275, 0.175, 0.325, 0.725  # m
YOUNG, POISSON, GRAIN_DENSITY, POROSITY = 5e5, 0.3, 2650., 0.4  # Pa, -, kg/m^3, -
WATER_DENSITY, CONDUCTIVITY, GRAVITY, TIME_STEP = 1000., 1e-2, 9.81, 1e-3  # kg/m^3, m/s, m/s^2, s

lattice = lambda size: np.stack(np.meshgrid(*map(np.arange, size)), -1).reshape(-1, 2)  # [number, axis], the first axis fastest
NODE, VERTEX = lattice(CELLS + 2), lattice(CELLS + 1)  # of the quadratic splines, of the linear functions
NODE_X, VERTEX_X = H*np.clip(NODE - .5, 0, CELLS), H*VERTEX  # m; nodes lie at the Greville abscissae
HAT_VOLUME = H*H*np.where((VERTEX == 0) | (VERTEX == CELLS), .5, 1).prod(1)  # integral of psi_a, m^2
HELD = ((NODE == 0) | (NODE == [CELLS[0] + 1, -1]))[..., None].repeat(2, 2)  # [node, component, phase]; smooth walls, open top
HELD[NODE[:, 1] == 0, 0, 0] = True  # the bottom is fixed to soil

distance = lambda F: np.where(F < .5, np.sqrt(2*np.minimum(F, .5)) - 1, 1 - np.sqrt(2*np.clip(1 - F, 0, .5)))  # d (Free surface)
affine_sums = lambda phi, x_i, m, x, v, C: phi.T@(m*(v - (C*x).sum(1))) + (x_i*(phi.T@(m[:, None]*C))).sum(1)  # m phi_i [v + C (x_i - x)]


def shapes(x, cell=None):
    """Functions as [point, node or vertex]: splines phi_i and their slopes; linear psi_a, their slopes and h^2 d^2 psi_a/dx dy."""
    cell = (x/H).astype(int) if cell is None else cell
    axes = [[], []]
    for a in range(2):
        s, l, r = x[:, a]/H - cell[:, a], np.where(cell[:, a] == 0, 1, .5), np.where(cell[:, a] == CELLS[a] - 1, 1, .5)
        for functions in ([l*(1 - s)**2, 1 - l*(1 - s)**2 - r*s**2, r*s**2], [-2*l*(1 - s)/H, (2*l*(1 - s) - 2*r*s)/H, 2*r*s/H],
                          [1 - s, s], [0*s - 1/H, 0*s + 1/H]):  # splines, their slopes, linear functions, their slopes
            axes[a].append(np.zeros((len(s), CELLS[a] + len(functions) - 1)))
            np.put_along_axis(axes[a][-1], cell[:, [a]] + np.arange(len(functions)), np.transpose(functions), 1)
    both = lambda of_x, of_y: (axes[1][of_y][:, :, None]*axes[0][of_x][:, None]).reshape(len(x), -1)
    return SimpleNamespace(phi=both(0, 0), slopes=(both(1, 0), both(0, 1)), psi=both(2, 2), psi_slopes=(both(3, 2), both(2, 3)),
                           twist=H*H*both(3, 3), x=x, place=x/H - cell, number=cell@[1, CELLS[0]])


def pores(soil, s, w):
    """1/n_p and Q/n^2, of the part of the cell in which a water point lies (Unknowns)."""
    parts = CELLS*PER_CELL
    part_of = lambda at: (at.x*PER_CELL/H).astype(int)@[1, parts[0]]
    in_cell = lambda of_part: np.kron(of_part.reshape(CELLS[1], PER_CELL, CELLS[0], PER_CELL).sum((1, 3)), np.ones((PER_CELL, PER_CELL))).ravel()
    grains, volume = (np.bincount(part_of(s), weight, parts.prod()) for weight in (soil.m/GRAIN_DENSITY, soil.V))
    bulk = soil.m/GRAIN_DENSITY*in_cell(volume)[part_of(s)]/in_cell(grains)[part_of(s)]
    depth = shapes((lattice(parts) + .5)*H/PER_CELL).psi@distance(s.psi.T@bulk/HAT_VOLUME)
    is_inside = (depth > 0) & (in_cell(volume) > 0)
    grains, volume = (np.where(is_inside & (volume == 0), in_cell(of_part), of_part) for of_part in (grains, volume))
    whole = np.where(is_inside, volume, np.maximum(volume, (H/PER_CELL)**2))  # at its surface soil shares a part with free water
    return 1/np.maximum(.01, 1 - grains/whole)[part_of(w)], WATER_DENSITY*9.81/CONDUCTIVITY*(volume/whole)[part_of(w)]


def free_surface(water, w, n):
    """d, T and p^n at the vertices; the corners of the wet cells (Free surface)."""
    number = np.unique(w.number)
    corners = (number + number//CELLS[0])[:, None] + [0, 1, CELLS[0] + 1, CELLS[0] + 2]
    wet = (corners[..., None] == np.arange(len(VERTEX))).any(1)*1
    d = distance(np.minimum(w.psi.T@(water.V*n), wet.sum(0)*H*H/4)/HAT_VOLUME)
    shared = wet.T@wet  # number of wet cells that two vertices share; a neighbour counts once in each
    unknown = followed = known = d >= .15 - 1e-9
    T = np.diag(unknown*1.)
    for _ in range(2):  # surface, then beyond
        beside = ~known & shared[:, followed].any(1)
        weights = shared[beside][:, followed]
        T[beside] = d[beside, None]*(weights@T[followed])/(weights@d[followed])[:, None]
        known, followed = known | beside, beside & (d > 1e-6)
    p = affine_sums(w.psi, VERTEX_X, water.V, water.x, water.p, water.dp)[unknown]/(w.psi.T@water.V)[unknown]
    return d, T[:, unknown], T[:, unknown]@p, corners


def wet_part(polygon):
    """Corners (x, y, d) of the part of a polygon where d is positive."""
    part = []
    for one, other in zip(polygon, polygon[1:] + polygon[:1]):
        part += [one] if one[2] >= 0 else []
        part += [one + one[2]/(one[2] - other[2])*(other - one)] if one[2]*other[2] < 0 else []
    return part if max(corner[2] for corner in polygon) > 0 else []


def quadrature(d, corners):
    """Shapes and weights of points in Omega (Divergence and force)."""
    gauss, points = (np.transpose(np.polynomial.legendre.leggauss(4)) + [1, 0])/2, []
    for of_cell in corners:
        p00, p10, p01, p11 = np.column_stack([VERTEX_X[of_cell], d[of_cell]])
        for triangle in ([p00, p10, p11], [p00, p11, p01]):  # d is linear in each
            part = wet_part(triangle)
            for a, b, c in zip(part[:1]*2, part[1:], part[2:]):
                area = abs((b - a)[0]*(c - a)[1] - (b - a)[1]*(c - a)[0])
                points += [[*VERTEX[of_cell[0]], *(a + u*(b - a) + u*v*(c - b))[:2], area*u*i*j] for u, i in gauss for v, j in gauss]
    cell, x, weight = np.split(np.array(points), [2, 4], axis=1)
    return shapes(x, cell.astype(int)), weight[:, 0]


def pressure_pair(d, corners, volume_of_water):
    """B of u, and of q beside it, as [component, vertex, node]; int phi_i; cells of Omega, their volumes (Divergence and force).

    Gamma consists of walls that hold u . nu = 0: its integral changes their reactions alone and is left out."""
    at, weight = quadrature(d, corners)
    B_u = -np.array([at.psi.T*weight@slope for slope in at.slopes])
    cells = np.unique(at.number)
    in_cell = weight*(at.number == cells[:, None])
    phi, volume = in_cell@at.phi, in_cell.sum(1)
    centre = shapes(in_cell@at.x/volume[:, None], np.stack([cells % CELLS[0], cells//CELLS[0]], 1))
    of_node, delta = phi.sum(0), 0
    rest = np.clip(volume_of_water - of_node, -of_node/2, of_node/2)  # Delta_i
    for _ in range(8):
        share = phi*rest/np.maximum(of_node, 1e-300)
        passed_on = phi*(share.sum(1)/volume)[:, None]
        delta, rest = delta + share - passed_on, passed_on.sum(0)
    return B_u, np.array([slope.T@delta for slope in centre.psi_slopes]), of_node, centre, volume


def inverse(mass, C, held):
    """A^-1 as [node, component, phase, phase]; 0 where walls hold a phase or it is absent (Unknowns)."""
    A = C[:, None, None]*np.array([[1, -1], [-1, 1]]) + mass[:, :, None]*np.eye(2)
    out = held | (mass == 0)[:, None]
    return np.linalg.inv(np.where(out[..., None] | out[..., None, :], np.eye(2), A[:, None])) - out[..., None]*np.eye(2)


def step(soil, water):
    """Advances the points by a time step."""
    dt, s, w = TIME_STEP, shapes(soil.x), shapes(water.x)
    # 1. Masses, momenta [node, component, phase], forces; n_i and C_i (Unknowns). n is 1/n_p, R is Q/n^2.
    n, R = pores(soil, s, w)
    momentum_of = lambda points, m, at: np.stack([affine_sums(at.phi, NODE_X, m, points.x, points.v[:, c], points.C[:, c]) for c in range(2)], 1)
    mass = np.stack([s.phi.T@soil.m, w.phi.T@water.m], 1)
    n_i = mass[:, 1]/np.maximum(w.phi.T@(water.m*n), 1e-300)
    excess = np.maximum(n_i**2*(w.phi.T@(water.m*n*n)) - mass[:, 1], 0)  # C_i without drag
    C = excess + dt*n_i**2*(w.phi.T@(water.V*n*R))
    of_water = n_i[:, None]*momentum_of(water, water.m*n, w)
    momentum = np.stack([momentum_of(soil, soil.m, s) + momentum_of(water, water.m, w) - of_water, of_water], 2)
    of_stress = -sum(s.slopes[a].T@(soil.V[:, None]*soil.stress[..., a]) for a in range(2))
    force = of_stress[..., None]*[1, 0] + mass[:, None]*[[0], [-GRAVITY]]
    # 2. Free surface, p^n, and B. With u = v_s + q and q = n_i (v_w - v_s), B acts on v_s and v_w; n_i = 1: water alone.
    d, T, p, corners = free_surface(water, w, n)
    B_u, B_q, filled, centre, volume = pressure_pair(d, corners, w.phi.T@(water.V*n))
    B = np.stack([(n_i < 1)*(B_u - n_i*(B_u + B_q)), n_i*(B_u + B_q)])  # [phase, component, vertex, node]
    # 3. Predictor. Pressure acts on a least mass, and p^n on lighter nodes in proportion (Light nodes).
    pressed = np.where(mass > 0, np.maximum(mass, .01*WATER_DENSITY*filled[:, None]), 0)
    force -= (mass/np.maximum(pressed, 1e-300))[:, None]*np.einsum("kcai,a->ick", B, p)
    v_n = np.einsum("ickl,icl->ick", inverse(mass, excess, np.zeros_like(HELD)), momentum)
    v = np.einsum("ickl,icl->ick", inverse(mass, C, HELD), momentum + dt*force)
    # 5. and 6. H with the mobility kappa of a cell; pressure system; corrector.
    m_s, m_w, V, m_1, m_2 = (np.bincount(at.number, weight, CELLS.prod())[centre.number] for at, weight in (
        (s, soil.m), (w, water.m), (w, water.V*n), (w, water.m*n), (w, water.m*n*n + dt*water.V*n*R)))
    kappa = V*V/np.minimum(V, H*H)*np.where(m_s > 0, (m_2 - 2*m_1 + m_s + m_w)/np.where(m_s > 0, (m_s + m_w)*m_2 - m_1*m_1, 1), 1/m_2)
    hourglass = centre.twist.T*(.01*dt*kappa*volume/H**2)@centre.twist  # twist p: p_00 - p_10 - p_01 + p_11
    A_inverse, B_T = inverse(pressed, C, HELD), np.einsum("kcai,ab->kcib", B, T)  # B_T: B^T T
    S = dt*np.einsum("kcia,ickl,lcib->ab", B_T, A_inverse, B_T, optimize=True) + T.T@hourglass@T
    change = np.linalg.solve(S, np.einsum("kcia,ick->a", B_T, v) - T.T@hourglass@p)
    v -= dt*np.einsum("ickl,lcib,b->ick", A_inverse, B_T, change, optimize=True)
    p += T@change
    # 7. Soil moves with v_s, water with v_s + n_i/n_p (v_w - v_s) (Water points), by AFLIP (single_phase.md, Transfers).
    kept = np.exp(-5*np.sqrt(GRAVITY/H)*dt)
    for points, at, part in ((soil, s, np.outer(0*soil.m, n_i)), (water, w, np.outer(n, n_i))):
        at_points = lambda function, of_nodes: (function*(1 - part))@of_nodes[..., 0] + (function*part)@of_nodes[..., 1]
        v_bar, L = at_points(at.phi, v), np.stack([at_points(slope, v) for slope in at.slopes], 2)
        points.v = kept*(points.v + at_points(at.phi, v - v_n)) + (1 - kept)*v_bar
        points.x, points.dF = points.x + dt*v_bar, np.eye(2) + dt*L
        carried = L@np.linalg.inv(points.dF)
        is_smaller = (np.linalg.det(points.dF) > 0) & (np.linalg.norm(carried, axis=(1, 2)) < np.linalg.norm(L, axis=(1, 2)))
        points.C = np.where(is_smaller[:, None, None], carried, L)
    water.p, water.dp = w.psi@p, np.stack([slope@p for slope in w.psi_slopes], 1)
    # Soil: tau = 2 G eps + lambda tr(eps) I of the logarithmic strain eps of b_e; F-bar scales the third axis, too.
    strain, is_loaded = np.log(np.linalg.det(soil.b)*soil.b_zz)/2, (np.einsum("pii->pi", soil.stress)**2).sum(1) > 0
    scale, change_of_volume = f_bar(s, CELLS, H, soil.V, strain, is_loaded, soil.dF)
    dF, soil.V, soil.b_zz = scale[:, None, None]*soil.dF, soil.V*change_of_volume, soil.b_zz*scale**2
    soil.b = dF@soil.b@dF.transpose(0, 2, 1)
    squares, axes = np.linalg.eigh(soil.b)
    volume = np.log(squares).sum(1, keepdims=True) + np.log(soil.b_zz)[:, None]
    tau = YOUNG/(1 + POISSON)/2*(np.log(squares) + POISSON/(1 - 2*POISSON)*volume)
    soil.stress = (axes*tau[:, None])@axes.transpose(0, 2, 1)*(soil.V0/soil.V)[:, None, None]


def start():
    """Points of soil and of water on a lattice, at rest, without stress and pressure."""
    x = (lattice(CELLS*PER_CELL) + .5)*H/PER_CELL
    is_wet = (x[:, 1] < WATER_TABLE) | ((x[:, 0] < COLUMN_WIDTH) & (x[:, 1] < COLUMN_HEIGHT))
    points = [SimpleNamespace(x=x[x[:, 1] < SOIL_HEIGHT]), SimpleNamespace(x=x[is_wet])]
    for one, density, share in zip(points, (GRAIN_DENSITY*(1 - POROSITY), WATER_DENSITY), (1, POROSITY)):
        one.V = one.V0 = (H/PER_CELL)**2*np.where(one.x[:, 1] < SOIL_HEIGHT, share, 1)
        one.m, one.v, one.p, one.dp, one.b_zz = density*one.V, 0*one.x, 0*one.V, 0*one.x, 1 + 0*one.V
        one.C, one.stress, one.b = (factor*np.eye(2) + 0*one.V[:, None, None] for factor in (0, 0, 1))
    return points


def kinetic_energy(*phases):
    """J; with that of the affine field, whose inertia along an axis is m h^2/4, and falls to 0 on a wall."""
    inertia = lambda x: H*H/4*(1 - np.maximum(1 - x/H, 0)**2 - np.maximum(x/H - CELLS + 1, 0)**2)
    return sum((points.m*((points.v**2).sum(1) + ((points.C**2).sum(1)*inertia(points.x)).sum(1))).sum()/2 for points in phases)


if __name__ == "__main__":
    of_soil, of_water = start()
    print("time (s)   kinetic energy (J)   front of water (m)   largest p (Pa)")
    for step_number in range(1, 101):
        step(of_soil, of_water)
        if step_number % 10 == 0:
            results = kinetic_energy(of_soil, of_water), of_water.x[of_water.x[:, 1] > SOIL_HEIGHT, 0].max(), of_water.p.max()
            print(f"{step_number*TIME_STEP:8.3f}" + "%21.9f%21.6f%17.3f" % results)
