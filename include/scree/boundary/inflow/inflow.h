// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_boundary_inflow_inflow_h
#define scree_boundary_inflow_inflow_h

#include <scree/boundary/inflow/inflow_parameters.h>
#include <scree/mixture/mixture.h>

namespace scree
{
  /// A section of the box through which points enter during the run, a layer of the lattice each time that what enters
  /// has moved by the points' spacing.
  ///
  /// A layer stands behind the section as seeding would put it there, and its places do not change. The nodes of the
  /// face move as what enters, so that nothing flows back.
  template <int dim>
  class Inflow
  {
  public:
    /// A point of a layer.
    struct Place
    {
      dealii::Point<dim> location; ///< m
      double volume;               ///< m^3 (2D: per m)
    };

    /// Collective; throws EntryError if the section is nowhere open.
    /// @param spacing of the points, m
    /// @param porosity of the body; read if it is saturated
    /// @param ground only what is in its open is filled; null: all
    Inflow(const InflowParameters &parameters,
           const BackgroundGrid<dim> &grid,
           const double spacing,
           const double porosity,
           const LevelSet<dim> *ground);

    /// Sets velocity() to the mean of the step, s, that comes.
    void begin_step(const double time, const double time_step)
    {
      const double end = std::min(time + time_step, end_time);
      const double sum = end > time ? hydrograph.integral(time, end) : 0.;
      is_open          = lasts(time);
      mean_velocity    = velocity_of(sum / time_step);
      step_advance     = time_step * (mean_velocity * normal);
    }

    /// Moves the front by the step of begin_step(); returns how many layers have entered with it.
    unsigned int end_step()
    {
      front += step_advance;
      const unsigned long long before = n_layers;
      // Rounding of the front must not choose the step.
      n_layers = static_cast<unsigned long long>(std::max(std::floor(front / spacing + 1e-9), double(n_layers)));
      AssertThrow(step_advance < grid.cell_size(),
                  dealii::ExcMessage(
                      "Inflow " + name + " enters at " + number_text(mean_velocity.norm()) +
                      " m/s, by more than a cell in a step. Remedies: a smaller 'Maximum time step' in subsection "
                      "Time step, a lower speed."));
      return n_layers - before;
    }

    /// How far the layer that entered last but `back` is beyond its place, m: along the normal.
    double advance_of(const unsigned int back) const
    {
      return front - (n_layers - back) * spacing;
    }

    /// Whether the inflow goes on at a time, s.
    bool lasts(const double time) const
    {
      return time < end_time;
    }

    /// In the current step, m/s.
    const dealii::Tensor<1, dim> &velocity() const
    {
      return mean_velocity;
    }

    /// The points of a layer, of all ranks, in an order that does not depend on their number.
    const std::vector<Place> &places() const
    {
      return layer;
    }

    /// The inward unit normal of the section.
    const dealii::Tensor<1, dim> &inward() const
    {
      return normal;
    }

    /// Open area, m^2 (2D: m).
    double area() const
    {
      return open_area;
    }

    /// Whether the inflow moves a node of the grid.
    bool moves(const unsigned int node) const;

    /// The blocks in which points enter.
    const Blocks &blocks() const
    {
      return section_blocks;
    }

    /// What the water behind the section does to that before it, W (2D: per m): the integral of p v . n over this
    /// rank's part.
    double power_of_pressure(const PressureOfCell<dim> &pressure) const;

    /// Tells the mixture of what has entered of the next layer, water and wet grains.
    void add_to(Mixture<dim> &mixture) const;

    const std::string name;   ///< name of its subsection without the prefix
    const std::string body;   ///< that it feeds, or Water
    const std::string region; ///< the entry
    const bool brings_soil;   ///< or only water
    const double water_share; ///< volume of water over that of what enters: 1, a porosity, or 0
    bool is_open = true;      ///< whether it lasted as the step began

    /// What a run that goes on needs.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &front &n_layers &is_open;
    }

  private:
    /// Finds the points of a layer. Collective.
    void find_places(const InflowParameters &parameters, const LevelSet<dim> *ground);

    /// Of a value of the hydrograph.
    dealii::Tensor<1, dim> velocity_of(const double value) const
    {
      return value / (tells_discharge ? open_area * (direction * normal) : 1.) * direction;
    }

    const BackgroundGrid<dim> &grid;
    const Hydrograph hydrograph;
    const double spacing;  // m
    const double end_time; // s
    const bool is_at_wall, tells_discharge;
    const unsigned int face; // in deal.II's numbering
    const double section;    // m
    dealii::Tensor<1, dim> normal, direction;
    std::vector<Place> layer;
    std::vector<CellPlace<dim>> cells_of_layer; // those of its points, each once
    Blocks section_blocks;
    double open_area = 0;
    dealii::Tensor<1, dim> mean_velocity;
    double step_advance         = 0; // m
    double front                = 0; // how far what has entered first would have come, along the normal, m
    unsigned long long n_layers = 0; // that have entered
  };
} // namespace scree

#endif
