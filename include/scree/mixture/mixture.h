// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_mixture_mixture_h
#define scree_mixture_mixture_h

#include <scree/mesh/cut_cells.h>

#include <deal.II/base/geometry_info.h>

namespace scree
{
  /// Where soil, water and gaps are, from points that scatter: thresholds, each with its unit and, where it was
  /// switched off by itself, what a scene then shows. They are fractions of a cell, of pores or of a spacing; none is a
  /// length or a time of a case.
  namespace closures
  {
    /// Smallest porosity in the flow between grains: where grains crowd, water shall not race.
    constexpr double least_porosity = 0.01;

    /// Inertia of a phase that the pressure moves at a node, over that of water that would fill its surroundings as far
    /// as B integrates. Without it points that lie on a floor leave nodes above them next to no mass, which p drives
    /// to 1e6 m/s: their gradient is not small.
    constexpr double least_inertia = 0.01;

    /// Mass of the nodes at a segment of the ground over that inside soil, from which on the ground acts on dry soil
    /// in a cell without points. Without these segments, those of thin cells come and go as soil slides past: the force
    /// on a frictionless block varies by 7 % (now .5 %). From .1 on, a block on an arc loses more energy.
    constexpr double least_cover = 0.25;

    /// Mass of a node over that inside soil, from which on it counts wholly at segments of the ground on dry soil. With
    /// .01 the mean force of a piston deviates by .25 % (now .03 %), with .1 a block on an arc loses .7 % more energy.
    constexpr double least_row_inertia = 0.03;

    /// Open fraction of a cut cell; less counts as so much.
    constexpr double least_open_fraction = 1e-6;

    /// Distance from a wall, point spacings, at which a point touches it: a little more than the half that it fills.
    constexpr double reach_of_a_point = 0.6;

    /// Fill of a wet cell from which on there is no gap between it and a wall.
    constexpr double full_cell_at_wall = 0.9;

    /// Heights of a fall, cells: what is slower than after it is stopped once it is in the cells beside a wall.
    constexpr double fall_of_wet_soil = 0.125, ///< in scenes with water
        fall_onto_fixed_wall          = 0.5;   ///< in dry scenes, at fixed walls

    /// Surplus of volume, cells, below which a vertex is full: water at rest must not follow its rounding.
    constexpr double least_surplus = 1e-6;

    /// Thickness, cells, of the layer in which water slips over ground whose wall is no slip.
    constexpr double slip_length = 0.01;

    /// Area of a patch of load that a column of nodes must have from the soil's points to be its surface, over the
    /// patch's. Inside a body it is some hundredths, from the scatter of points.
    constexpr double least_area_of_surface = 0.25;

    /// V/V_0 from which on soil has come apart: no node connects its points.
    constexpr double loose = 1.2;
  } // namespace closures


  /// Speed, m/s, after a fall through `height` cells of this size, m, with gravity in m/s^2.
  inline double speed_after_fall(const double height, const double gravity, const double cell_size)
  {
    return std::sqrt(2. * height * gravity * cell_size);
  }

  /// The porosity about points of water: of the soil in the part of their cell that holds them. The parts are those
  /// that a point of soil has at the start, but for no finer than a quarter (3D: half) of a cell along each axis.
  template <int dim>
  class PorosityOfParts
  {
  public:
    /// @param soil_points in a cell along each axis, at the start
    explicit PorosityOfParts(const unsigned int soil_points)
        : n_1d(std::min(soil_points, most_1d))
    {
    }

    /// Adds a point of soil.
    ///
    /// @param x its place in the cell
    /// @param grains volume of its grains, m^3
    /// @param volume with pores, m^3
    /// @param resistance of its pores to slow flow, times volume, N s/m
    /// @param inertial the same over the discharge, N s^2/m^2
    void add_soil(const dealii::Point<dim> &x,
                  const double grains,
                  const double volume,
                  const double resistance,
                  const double inertial)
    {
      const unsigned int part = part_of(x);
      parts[Sums::grains][part] += grains;
      parts[Sums::soil][part] += volume;
      parts[Sums::linear][part] += resistance;
      parts[Sums::inertial][part] += inertial;
    }

    /// Finds porosities and resistances, when all soil is in. Soil that does not fill its part shares it with free
    /// water, but for parts inside the soil: these hold more or fewer of its points by chance, and have its porosity,
    /// or that of the cell where there is none.
    ///
    /// @param volume of the cell that is open, m^3
    /// @param depths signed distances of the vertices from the surface of the soil, positive inside
    void find(const double volume, const std::array<double, (1 << dim)> &depths)
    {
      // Less than `whole` is no scatter of points: to take it for that lends water at a face the grains of its
      // neighbourhood, and consolidating mud blows up.
      const Batch whole = simd::broadcast<Batch>(volume / dealii::Utilities::fixed_power<dim>(n_1d)),
                  one   = simd::broadcast<Batch>(1.);
      std::array<double, Sums::n_components> of_cell{};
      for (unsigned int c = 0; c < of_cell.size(); ++c)
        for (const double of_part : parts[c])
          of_cell[c] += of_part;
      for (unsigned int p = 0; p < n_parts; p += batch_size)
        {
          const simd::Mask<Batch> is_inside = depths_of(p, depths) > 0.,
                                  is_filled = is_inside & (simd::load(&parts[Sums::soil][p]) <= 0.);
          std::array<Batch, Sums::n_components> sums;
          for (unsigned int c = 0; c < sums.size(); ++c)
            sums[c] = simd::select<Batch>(is_filled, simd::broadcast<Batch>(of_cell[c]), simd::load(&parts[c][p]));
          const simd::Mask<Batch> has_soil = sums[Sums::soil] > 0.;
          const Batch share =
              simd::select<Batch>(is_inside, sums[Sums::soil], simd::max<Batch>(sums[Sums::soil], whole));
          const Batch of_part = simd::select<Batch>(has_soil, share, one);
          const Batch porosity =
              simd::max<Batch>(1. - sums[Sums::grains] / of_part, simd::broadcast<Batch>(closures::least_porosity));
          simd::store(simd::select<Batch>(has_soil, 1. / porosity, one), &inverse_porosity[p]);
          simd::store(sums[Sums::linear] / of_part, &parts[Sums::linear][p]);
          simd::store(sums[Sums::inertial] / of_part, &parts[Sums::inertial][p]);
        }
    }

    /// The pores about a point of water.
    struct PoresAbout
    {
      double inverse_porosity; ///< -; 1 without soil
      double resistance;       ///< pressure gradient of slow flow over the discharge, N s/m^4
      double inertial;         ///< what that grows by with the discharge, N s^2/m^5
    };

    /// Pores about a place of the cell, after find().
    PoresAbout at(const dealii::Point<dim> &x) const
    {
      const unsigned int part = part_of(x);
      return { inverse_porosity[part], parts[Sums::linear][part], parts[Sums::inertial][part] };
    }

    /// Their inverse porosity about a batch of places.
    Batch inverse_at(const std::array<Batch, dim> &x) const
    {
      using Integers   = int __attribute__((vector_size(batch_size * sizeof(int))));
      const Batch zero = simd::broadcast<Batch>(0.), last = simd::broadcast<Batch>(n_1d - 1.);
      Integers part{};
      for (unsigned int a = 0; a < dim; ++a)
        part = part * static_cast<int>(n_1d) +
               __builtin_convertvector(simd::min<Batch>(simd::max<Batch>(x[a] * double(n_1d), zero), last), Integers);
      return inverse_of(part, std::make_index_sequence<batch_size>());
    }

  private:
    static constexpr unsigned int most_1d = dim == 2 ? 4 : 2;
    static constexpr unsigned int n_parts = dealii::Utilities::pow(most_1d, dim); // the last axis is the fastest

    // What points of soil add to a part; the two of the resistance are over its volume from find() on.
    struct Sums
    {
      enum Component : unsigned int
      {
        grains,   // m^3
        soil,     // m^3
        linear,   // see PoresAbout, times volume
        inertial, // likewise
        n_components
      };
    };

    // Centres of the parts in the cell, by axis.
    using Centres = std::array<std::array<double, n_parts>, dim>;

    static constexpr std::array<Centres, most_1d> make_centres()
    {
      std::array<Centres, most_1d> centres{};
      for (unsigned int n_1d = 1; n_1d <= most_1d; ++n_1d)
        for (unsigned int p = 0; p < n_parts; ++p)
          for (unsigned int a = dim, rest = p; a-- > 0; rest /= n_1d)
            centres[n_1d - 1][a][p] = (rest % n_1d + 0.5) / n_1d;
      return centres;
    }

    // A function that is linear along each axis, at the centres of parts from `first` on.
    Batch depths_of(const unsigned int first, const std::array<double, (1 << dim)> &depths) const
    {
      static constexpr std::array<Centres, most_1d> centres = make_centres();
      Batch values[1 << dim];
      for (unsigned int v = 0; v < depths.size(); ++v)
        values[v] = simd::broadcast<Batch>(depths[v]);
      for (unsigned int a = dim; a-- > 0;)
        {
          const Batch x = simd::load(&centres[n_1d - 1][a][first]);
          for (unsigned int v = 0; v < (1u << a); ++v)
            values[v] += x * (values[v | 1u << a] - values[v]);
        }
      return values[0];
    }

    /// In registers: numbers that are stored one by one and read as a vector wait for each other.
    template <typename Integers, std::size_t... lane>
    Batch inverse_of(const Integers &part, std::index_sequence<lane...>) const
    {
      return Batch{ inverse_porosity[part[lane]]... };
    }

    unsigned int part_of(const dealii::Point<dim> &x) const
    {
      unsigned int part = 0;
      for (unsigned int a = 0; a < dim; ++a)
        part = part * n_1d + std::min(n_1d - 1, static_cast<unsigned int>(std::max(0., x[a] * n_1d)));
      return part;
    }

    unsigned int n_1d;                                                   // parts along an axis
    std::array<std::array<double, n_parts>, Sums::n_components> parts{}; // by Sums, then part
    std::array<double, n_parts> inverse_porosity;                        // of parts; after find()
  };

  /// What the points of a cell weigh and fill (2D: per m).
  template <int dim>
  struct MixtureCell
  {
    static constexpr unsigned int n_vertices = 1 << dim; ///< vertices of a cell
    using AtVertices = std::array<double, n_vertices>;   ///< a number a vertex, in deal.II's order

    unsigned int cell;           ///< active cell index
    double volume;               ///< of the cell, without what rigid ground fills, m^3
    double soil_mass    = 0,     ///< kg
        water_mass      = 0;     ///< kg
    double grain_volume = 0,     ///< m^3
        water_volume    = 0;     ///< m^3
    double pore_volume  = 0;     ///< of the soil, m^3
    bool is_rigid       = false; ///< whether the soil is held at its place

    // Sums weighted with the linear functions of the vertices.
    AtVertices grains_at_vertex{},   ///< volume of grains, m^3
        water_at_vertex{};           ///< volume of water, m^3
    AtVertices pressure_at_vertex{}; ///< volume of water times pressure there, Pa m^3
    AtVertices soil_depths{};        ///< signed distances from the surface of the soil, cells; positive inside
    AtVertices bulk_at_vertex{};     ///< volume of water and the grains about it, sum V/n_p, m^3

    double bulk_volume  = 0, ///< sum V/n_p, m^3
        mass_of_flux    = 0, ///< sum m/n_p, kg
        inertia_of_flux = 0; ///< sum m/n_p^2, kg
    double drag_of_flux = 0; ///< sum V/n_p times the resistance of the pores, N s/m

    double mobility = 0; ///< kappa: what a pressure gradient does to the mixture's flow, m^dim/kg

    /// @param cell active cell index
    /// @param volume open to soil and water, m^3
    MixtureCell(const unsigned int cell, const double volume)
        : cell(cell)
        , volume(volume)
    {
    }
  };

  /// The pressure at a cell's vertices, Pa, in deal.II's order.
  template <int dim>
  using PressureOfCell = std::function<std::array<double, (1 << dim)>(const unsigned int cell)>;

  /// A pressure that is linear along each axis of a cell: coefficients of the monomials of the cell's coordinates from
  /// 0 to 1; bit a of the index stands for a factor x_a.
  template <int dim>
  using Multilinear = std::array<double, (1 << dim)>;

  /// The multilinear function with the given values at the vertices (deal.II's order).
  template <int dim>
  inline Multilinear<dim> multilinear_of(std::array<double, (1 << dim)> values)
  {
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int m = 0; m < values.size(); ++m)
        if ((m >> a) & 1)
          values[m] -= values[m ^ (1 << a)];
    return values;
  }

  /// Soil and water in the cells that hold points: sums of each cell, and the porosity of its parts.
  template <int dim>
  class Mixture
  {
  public:
    /// @param soil_points of a cell along each axis at the start; of the body that has fewest
    /// @param cut_cells what rigid ground leaves of the cells; null: all
    Mixture(const BackgroundGrid<dim> &grid, const unsigned int soil_points, const CutCells<dim> *cut_cells = nullptr)
        : grid(grid)
        , soil_points(soil_points)
        , cell_volume(dealii::Utilities::fixed_power<dim>(grid.cell_size()))
        , cut_cells(cut_cells)
    {
      reinit();
    }

    /// Fits the mixture to the grid's current cells.
    void reinit()
    {
      records.clear();
      record_of_cell.assign(grid.triangulation().n_active_cells(), dealii::numbers::invalid_unsigned_int);
    }

    /// Empties the mixture, before a new step.
    void clear()
    {
      for (const MixtureCell<dim> &cell : records)
        record_of_cell[cell.cell] = dealii::numbers::invalid_unsigned_int;
      records.clear();
      porosities.clear();
    }

    /// The number of a cell's record, which is made if there is none.
    unsigned int record(const unsigned int cell)
    {
      unsigned int &record = record_of_cell[cell];
      if (record == dealii::numbers::invalid_unsigned_int)
        {
          record = records.size();
          records.emplace_back(cell, cell_volume * (cut_cells ? cut_cells->open_fraction(cell) : 1.));
        }
      return record;
    }

    /// Masses of the cells times a factor.
    void scale_inertia(const double factor)
    {
      if (factor == 1.)
        return;
      for (MixtureCell<dim> &cell : records)
        {
          cell.soil_mass *= factor;
          cell.water_mass *= factor;
          cell.mass_of_flux *= factor;
          cell.inertia_of_flux *= factor;
        }
    }

    /// Counts a volume of water, m^3, about a place of a cell, from 0 to 1 along each axis, for which there is no point
    /// yet: where an inflow is between two layers. It fills the cell's vertices, if points have brought water there,
    /// and has no other effect.
    void add_entering(const unsigned int cell, const dealii::Point<dim> &place, const double volume)
    {
      const unsigned int record = record_of_cell[cell];
      if (record == dealii::numbers::invalid_unsigned_int || records[record].water_volume <= 0)
        return;
      for (unsigned int v = 0; v < MixtureCell<dim>::n_vertices; ++v)
        records[record].bulk_at_vertex[v] += volume * dealii::GeometryInfo<dim>::d_linear_shape_function(place, v);
    }

    /// Records of the cells that hold points, by the numbers of record().
    std::vector<MixtureCell<dim>> &cells()
    {
      return records;
    }

    /// Read-only access.
    const std::vector<MixtureCell<dim>> &cells() const
    {
      return records;
    }

    /// Soil in the parts of a cell: room for it is made. Records of cells with soil have to come before the others.
    PorosityOfParts<dim> &soil_parts(const unsigned int record)
    {
      while (record >= porosities.size())
        porosities.emplace_back(soil_points);
      return porosities[record];
    }

    /// Finds the porosities of a cell's parts, when all soil of the cell is in its record.
    void find_porosities(const unsigned int record)
    {
      porosities[record].find(records[record].volume, records[record].soil_depths);
    }

    /// The porosities of a cell's parts; null if nothing has been put into soil_parts() there.
    const PorosityOfParts<dim> *porosity_of_parts(const unsigned int cell) const
    {
      const unsigned int record = record_of_cell[cell];
      return record < porosities.size() ? &porosities[record] : nullptr;
    }

  private:
    const BackgroundGrid<dim> &grid;
    const unsigned int soil_points;
    const double cell_volume;       // m^3
    const CutCells<dim> *cut_cells; // may be null
    std::vector<MixtureCell<dim>> records;
    std::vector<unsigned int> record_of_cell;     // by active cell index
    std::vector<PorosityOfParts<dim>> porosities; // of the first records, which have soil
  };
} // namespace scree

#endif
