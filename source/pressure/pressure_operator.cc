// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/pressure/pressure_operator.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  template <int dim>
  PressureOperator<dim>::PressureOperator(const BackgroundGrid<dim> &grid,
                                          const NodeNumbering<dim> &vertices,
                                          const PressureNumbering<dim> &numbering)
      : grid(grid)
      , vertices(vertices)
      , numbering(numbering)
  {
    // Hat functions on the unit cell: one-dimensional mass and stiffness, multiplied.
    for (unsigned int v = 0; v < n_vertices; ++v)
      for (unsigned int w = 0; w < n_vertices; ++w)
        {
          double sum = 0;
          for (unsigned int a = 0; a < dim; ++a)
            {
              double product = 1;
              for (unsigned int b = 0; b < dim; ++b)
                {
                  const bool same = ((v ^ w) >> b & 1) == 0;
                  product *= b == a ? (same ? 1. : -1.) : (same ? 1. / 3. : 1. / 6.);
                }
              sum += product;
            }
          laplacian[v][w] = sum;
        }
  }


  template <int dim>
  void PressureOperator<dim>::reinit()
  {
    beside_surface.reinit(numbering.partitioner());
    whole_diagonal.reinit(numbering.partitioner());
  }


  template <int dim>
  void PressureOperator<dim>::assemble(const Mixture<dim> &mixture,
                                       const FreeSurface<dim> &surface,
                                       const double time_step,
                                       const std::function<double(unsigned int vertex)> &storage)
  {
    unknown.assign(numbering.n_local(), false);
    diagonal.assign(numbering.partitioner()->locally_owned_size(), 0.);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      if (surface.kind(numbering.vertex(i)) == PressureDofType::unknown)
        {
          unknown[i]  = true;
          diagonal[i] = storage(numbering.vertex(i));
        }

    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    const double scale       = time_step * cell_volume / (grid.cell_size() * grid.cell_size());
    bool is_anchored         = false; // something beside differences of pressure matters
    double largest_mobility  = 0;
    beside_surface           = 0.;
    whole_diagonal           = 0.;
    wet_cells.clear();
    for (const MixtureCell<dim> &mixed : mixture.cells())
      if (mixed.water_volume > 0)
        {
          wet_cells.emplace_back();
          Cell &cell              = wet_cells.back();
          cell.mobility           = scale * mixed.mobility;
          largest_mobility        = std::max(largest_mobility, cell.mobility);
          const CellMatrix own    = matrix(cell);
          const unsigned int *all = vertices.nodes(mixed.cell);
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              cell.numbers[v] = numbering.number(all[v]);
              is_anchored     = is_anchored || surface.kind(all[v]) != PressureDofType::unknown || storage(all[v]) > 0.;
              if (surface.kind(all[v]) != PressureDofType::unknown)
                continue;
              unknown[cell.numbers[v]] = true;
              whole_diagonal.local_element(cell.numbers[v]) += own[v][v];
              // A vertex beside the surface follows the unknown one; this keeps the matrix symmetric.
              for (unsigned int w = 0; w < n_vertices; ++w)
                if (surface.kind(all[w]) == PressureDofType::surface)
                  beside_surface.local_element(cell.numbers[v]) += own[v][w] * surface.ratio(all[w], all[v]);
            }
        }
    beside_surface.compress(VectorOperation::add);
    whole_diagonal.compress(VectorOperation::add);
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      {
        diagonal[i] += beside_surface.local_element(i);
        whole_diagonal.local_element(i) += diagonal[i];
      }
    const std::vector<double> own{ largest_mobility, double(is_anchored) };
    std::vector<double> all_ranks(2);
    Utilities::MPI::max(own, grid.communicator(), all_ranks);
    AssertThrow(all_ranks[0] == 0. || all_ranks[1] == 1.,
                ExcMessage("Water fills the box, and all its walls are closed: nothing sets the level of its pressure. "
                           "Remedies: a drained wall in subsection Boundaries/Water, a 'Bulk modulus' in subsection "
                           "Water, or a box that is higher than the water."));
  }

  template class PressureOperator<2>;
  template class PressureOperator<3>;
} // namespace scree
