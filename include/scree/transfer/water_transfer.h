// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_transfer_water_transfer_h
#define scree_transfer_water_transfer_h

#include <scree/bodies/phases.h>
#include <scree/mesh/node_rows.h>
#include <scree/mixture/mixture.h>
#include <scree/mixture/wet_nodes.h>
#include <scree/transfer/transfer.h>

#include <cstring>
#include <list>
#include <type_traits>

namespace scree
{
  /// What the pictures of a coupled run show beside the soil.
  template <int dim>
  struct WaterView
  {
    const std::list<WaterPhase<dim>> &water; ///< points of the water
    const NodalField<dim> &field;            ///< the water's, solved: its mass and velocity are read
    /// Asked for the cells of this rank that hold points; 0 where there is no pressure.
    PressureOfCell<dim> pressure_of_cell;
  };

  /// Carries what water and pores need from points to cells and nodes, and velocity and pressure back to the water.
  template <int dim>
  class WaterTransfer
  {
  public:
    /// Keeps a reference to the grid.
    WaterTransfer(const BackgroundGrid<dim> &grid, const TransferParameters &transfer, const WaterParameters &water);

    /// Density of the water at the nodes, kg/m^3.
    double water_density() const
    {
      return density;
    }

    /// Part of the points' velocity that remains over a step beside that of the nodes, see kept_velocity().
    double kept(const double time_step) const;

    /// Adds pores, drag and grains of a body's points to the mixture.
    void soil_to_grid(const SoilBody<dim> &soil, Mixture<dim> &mixture) const;

    /// Adds mass and momentum of the water's points and the pores about them to the nodes, volume and pressure to the
    /// mixture. All soil has to be in.
    void to_grid(const WaterPhase<dim> &water, Mixture<dim> &mixture, WetNodes<dim> &nodes) const;

    /// One pass over the water's points at the end of a step: velocity, pressure with its gradient, and place, if they
    /// are the water's own; else the volume of the pores. Points of the water's own take the velocity of PoreVelocity.
    /// Returns the largest speed, m/s; not a number if any point's is not.
    ///
    /// @param nodes velocities of both phases; masses and pores as to_grid() has left them, summed over ranks
    /// @param mixture as to_grid() has left it
    double to_points(WaterPhase<dim> &water,
                     const WetNodes<dim> &nodes,
                     const Mixture<dim> &mixture,
                     const PressureOfCell<dim> &pressure,
                     const double time_step) const;

  private:
    template <int n, bool is_affine>
    void add_water(const WaterPhase<dim> &water, Mixture<dim> &mixture, WetNodes<dim> &nodes) const;

    /// Velocity, pressure and, if the points are the water's own, place of a cell's points.
    ///
    /// @param porosity about the cell's points; may be null
    /// @param keep see kept_velocity()
    template <int n, TransferMethod method>
    void move_cell(const WaterPhase<dim> &water,
                   const CellPoints<dim> &cell,
                   const WetNodes<dim> &nodes,
                   const PorosityOfParts<dim> *porosity,
                   const Multilinear<dim> &pressure,
                   const double time_step,
                   const double keep,
                   LargestSquare &largest) const;

    const BackgroundGrid<dim> &grid;
    const TransferMethod method;
    const double pic_rate;
    const PointSets point_sets;
    const double density; // of the water at the nodes, kg/m^3
  };

  // What a point of soil or water adds to the sums of its cell of the mixture.

  /// Adds a row to sums of a cell.
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline void add_row(const VertexRow<dim> &row, typename MixtureCell<dim>::AtVertices &sums)
  {
    VertexRow<dim> sum;
    std::memcpy(&sum, sums.data(), sizeof(sum));
    sum += row;
    std::memcpy(sums.data(), &sum, sizeof(sum));
  }

  /// The monomials x^m of places of a cell but that of all axes, bit a of m standing for x_a.
  template <int dim, typename Number, typename Place>
  std::array<Number, (1 << dim) - 1> monomials(const Place &x)
  {
    std::array<Number, (1 << dim) - 1> values;
    values[0] = simd::broadcast<Number>(1.);
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int m = 0; m < (1u << a); ++m)
        if (const unsigned int with = m | (1 << a); with < values.size())
          values[with] = values[m] * x[a];
    return values;
  }

  /// Adds a point's number, shared by the shape functions, to rows of nodes.
  template <typename Shape, unsigned long n_rows>
  DEAL_II_ALWAYS_INLINE inline void add_row_sums(const Shape &shape, const double number, NodeRow (&sums)[n_rows])
  {
    const NodeRow number_x = shape.value_x * number;
    for (unsigned int r = 0; r < n_rows; ++r)
      sums[r] += number_x * shape.rows.value[r];
  }

  /// Adds volume and pressure of a point of water to the corners of its cell.
  ///
  /// @param rise of the pressure along each axis over the cell's width, Pa
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline void add_to_vertices(const dealii::Point<dim> &x,
                                                    const double volume,
                                                    const double pressure,
                                                    const std::array<double, dim> &rise,
                                                    MixtureCell<dim> &sums)
  {
    double pressure_at_lower = pressure;
    for (unsigned int a = 0; a < dim; ++a)
      pressure_at_lower -= rise[a] * x[a];
    VertexRow<dim> pressure_at_vertex = on_faces<dim>(0, pressure_at_lower, pressure_at_lower + rise[0]);
    for (unsigned int a = 1; a < dim; ++a)
      pressure_at_vertex += on_faces<dim>(a, 0., rise[a]);
    const VertexRow<dim> volume_at_vertex = volume * vertex_values(x);
    add_row<dim>(volume_at_vertex, sums.water_at_vertex);
    add_row<dim>(volume_at_vertex * pressure_at_vertex, sums.pressure_at_vertex);
  }
} // namespace scree

#endif
