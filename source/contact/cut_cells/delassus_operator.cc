// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/contact/cut_cells/delassus_operator.h>

#include <deal.II/base/mpi.h>

#include <tuple>

namespace scree
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    bool has_mass(const MixtureNodes<dim> &nodes, const unsigned int node)
    {
      return nodes.soil[node][NodalField<dim>::mass] > 0. || nodes.water[node][NodalField<dim>::mass] > 0.;
    }
  } // namespace


  template <int dim>
  DelassusOperator<dim>::DelassusOperator(const BackgroundGrid<dim> &grid, const CutCells<dim> &cut_cells)
      : grid(grid)
      , cut_cells(cut_cells)
      , is_parallel(Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      , messages(grid.numbering())
  {
    reinit();
  }


  template <int dim>
  void DelassusOperator<dim>::reinit()
  {
    messages.reinit();
    nodes.clear();
    numbers.assign(grid.numbering().n_local(), numbers::invalid_unsigned_int);
    shared_owned.clear();
    for (const auto &[first, last] : grid.numbering().partitioner()->import_indices())
      for (unsigned int node = first; node < last; ++node)
        shared_owned.push_back(node);
  }


  template <int dim>
  void DelassusOperator<dim>::begin_step()
  {
    for (const Node &node : nodes)
      numbers[node.node] = numbers::invalid_unsigned_int;
    nodes.clear();
    contacts.clear();
    held.clear();
    nodes_of_segments.clear();
    first_of_segment.assign(cut_cells.segments().size(), numbers::invalid_unsigned_int);
    n_started = 0;
    for (const unsigned int node : shared_owned) // Other ranks' contacts may act on them.
      number_of(node);
  }


  template <int dim>
  void DelassusOperator<dim>::add(const unsigned int segment, const Phase phase)
  {
    const CutFacet<dim> &of_ground = cut_cells.segments()[segment];
    unsigned int &first            = first_of_segment[segment];
    if (first == numbers::invalid_unsigned_int)
      {
        first = nodes_of_segments.size();
        for (unsigned int i = 0; i < of_ground.shapes.size(); ++i)
          nodes_of_segments.push_back(number_of(grid.nodes(of_ground.cell)[i]));
      }
    contacts.push_back({ phase, first, of_ground.shapes.data() });
  }


  template <int dim>
  void DelassusOperator<dim>::start(const MixtureNodes<dim> &of_mixture, const TwoPhaseMomentum<dim> &step)
  {
    for (; n_started < nodes.size(); ++n_started)
      {
        Node &node    = nodes[n_started];
        node.mobility = drag_mobility(of_mixture.soil[node.node][NodalField<dim>::mass],
                                      of_mixture.water[node.node][NodalField<dim>::mass],
                                      of_mixture.pores[node.node][PoreField<dim>::drag]);
        if (!is_owned(node)) // Walls there are not known.
          continue;
        if (const DragBlock<dim> pair = step.drag_block_at(of_mixture, node.node); pair.is_held())
          {
            node.held = held.size();
            held.push_back(response_of(pair));
          }
      }
    if (!is_parallel)
      return;
    std::vector<unsigned int> ghosts;
    for (const Node &node : nodes)
      if (!is_owned(node))
        ghosts.push_back(node.node);
    messages.begin(ghosts);
  }


  template <int dim>
  void DelassusOperator<dim>::write_message(const unsigned int node, double *message) const
  {
    for (unsigned int phase = 0; phase < 2; ++phase)
      for (unsigned int c = 0; c < dim; ++c)
        message[phase * dim + c] = values[phase][numbers[node]][c];
  }


  template <int dim>
  template <int n>
  void DelassusOperator<dim>::add_shares(const std::vector<Tensor<1, dim>> &impulses)
  {
    for (unsigned int k = 0; k < contacts.size(); ++k)
      {
        const Contact &contact         = contacts[k];
        const unsigned int *of_segment = &nodes_of_segments[contact.first];
        NodeRow *of_phase              = values[unsigned(contact.phase)].data();
        const NodeRow impulse          = to_row(impulses[k]);
        for (unsigned int i = 0; i < CellBasis<dim, n>::n_nodes; ++i)
          of_phase[of_segment[i]] += contact.shapes[i] * impulse;
      }
  }


  template <int dim>
  void DelassusOperator<dim>::sum(const std::vector<Tensor<1, dim>> &impulses)
  {
    for (std::vector<NodeRow> &of_phase : values)
      of_phase.assign(nodes.size(), NodeRow{});
    if (grid.n_nodes_1d() == 2)
      add_shares<2>(impulses);
    else
      add_shares<3>(impulses);
    messages.to_owners(
        2 * dim,
        [&](const unsigned int node, double *message) { write_message(node, message); },
        [&](const unsigned int node, const double *message) {
          for (unsigned int phase = 0; phase < 2; ++phase)
            for (unsigned int c = 0; c < dim; ++c)
              values[phase][numbers[node]][c] += message[phase * dim + c];
        });
  }


  template <int dim>
  template <int n>
  NodeRow DelassusOperator<dim>::mean(const Contact &contact) const
  {
    // Several sums, as each addition would wait for the one before.
    const unsigned int *of_segment = &nodes_of_segments[contact.first];
    const NodeRow *of_phase        = values[unsigned(contact.phase)].data();
    NodeRow sums[n]                = {};
    for (unsigned int i = 0; i < CellBasis<dim, n>::n_nodes; i += n)
      for (unsigned int j = 0; j < n; ++j)
        sums[j] += contact.shapes[i + j] * of_phase[of_segment[i + j]];
    NodeRow result = sums[0];
    for (unsigned int j = 1; j < n; ++j)
      result += sums[j];
    return result;
  }


  template <int dim>
  Tensor<1, dim> DelassusOperator<dim>::mean_of(const Contact &contact) const
  {
    return to_vector<dim>(grid.n_nodes_1d() == 2 ? mean<2>(contact) : mean<3>(contact));
  }


  template <int dim>
  std::pair<NodeRow, NodeRow>
  DelassusOperator<dim>::motion_of(const Node &node, const NodeRow &soil, const NodeRow &water) const
  {
    if (!node.is_held())
      return { node.mobility.soil * soil + node.mobility.other * water,
               node.mobility.other * soil + node.mobility.water * water };
    const HeldResponse &response = held[node.held];
    std::pair<NodeRow, NodeRow> velocities{};
    for (unsigned int c = 0; c < dim; ++c)
      {
        velocities.first += soil[c] * response[c][0] + water[c] * response[dim + c][0];
        velocities.second += soil[c] * response[c][1] + water[c] * response[dim + c][1];
      }
    return velocities;
  }


  template <int dim>
  typename DelassusOperator<dim>::HeldResponse DelassusOperator<dim>::response_of(const DragBlock<dim> &pair)
  {
    HeldResponse response;
    for (unsigned int c = 0; c < dim; ++c)
      {
        Tensor<1, dim> impulse;
        impulse[c]          = 1.;
        const auto by_soil  = pair.solve({ impulse, Tensor<1, dim>() });
        const auto by_water = pair.solve({ Tensor<1, dim>(), impulse });
        response[c]         = { { to_row(by_soil.soil), to_row(by_soil.water) } };
        response[dim + c]   = { { to_row(by_water.soil), to_row(by_water.water) } };
      }
    return response;
  }


  template <int dim>
  void DelassusOperator<dim>::move_nodes(const std::vector<Tensor<1, dim>> &impulses)
  {
    sum(impulses);
    NodeRow *soil = values[0].data(), *water = values[1].data();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      std::tie(soil[i], water[i]) = motion_of(nodes[i], soil[i], water[i]);
    messages.from_owners(
        2 * dim,
        [&](const unsigned int node, double *message) { write_message(node, message); },
        [&](const unsigned int node, const double *message) {
          for (unsigned int phase = 0; phase < 2; ++phase)
            for (unsigned int c = 0; c < dim; ++c)
              values[phase][numbers[node]][c] = message[phase * dim + c];
        });
  }


  template <int dim>
  void DelassusOperator<dim>::apply(const std::vector<Tensor<1, dim>> &impulses,
                                    std::vector<Tensor<1, dim>> &velocities)
  {
    move_nodes(impulses);
    find_means(velocities);
  }


  template <int dim>
  void DelassusOperator<dim>::find_means(std::vector<Tensor<1, dim>> &velocities) const
  {
    velocities.resize(contacts.size());
    for (unsigned int k = 0; k < contacts.size(); ++k)
      velocities[k] = mean_of(contacts[k]);
  }


  template <int dim>
  void DelassusOperator<dim>::finish_changes(const std::vector<Tensor<1, dim>> &impulses,
                                             std::vector<Tensor<1, dim>> &velocities)
  {
    if (is_parallel)
      apply(impulses, velocities);
    else
      find_means(velocities); // The nodes have all of it.
  }


  template <int dim>
  double DelassusOperator<dim>::mobility_at(const unsigned int contact) const
  {
    const Contact &of_impulse = contacts[contact];
    const auto mobility_of    = of_impulse.phase == Phase::soil ? &DragMobility::soil : &DragMobility::water;
    double mobility           = 0.;
    for (unsigned int i = 0; i < grid.n_nodes_per_cell(); ++i)
      mobility += of_impulse.shapes[i] * of_impulse.shapes[i] *
                  (nodes[nodes_of_segments[of_impulse.first + i]].mobility.*mobility_of);
    return mobility;
  }


  template <int dim>
  Tensor<1, dim> DelassusOperator<dim>::velocity_at(const unsigned int contact) const
  {
    return mean_of(contacts[contact]);
  }


  template <int dim>
  void DelassusOperator<dim>::change(const unsigned int contact, const Tensor<1, dim> &impulse)
  {
    const Contact &of_impulse      = contacts[contact];
    const unsigned int *of_segment = &nodes_of_segments[of_impulse.first];
    const bool is_soil             = of_impulse.phase == Phase::soil;
    NodeRow *own = values[is_soil ? 0 : 1].data(), *other = values[is_soil ? 1 : 0].data();
    const NodeRow whole        = to_row(impulse), none{};
    const unsigned int n_nodes = grid.n_nodes_per_cell();
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        const unsigned int number = of_segment[i];
        const Node &node          = nodes[number];
        const NodeRow part        = of_impulse.shapes[i] * whole;
        if (node.is_held())
          {
            const auto motion = motion_of(node, is_soil ? part : none, is_soil ? none : part);
            values[0][number] += motion.first;
            values[1][number] += motion.second;
          }
        else
          {
            own[number] += (is_soil ? node.mobility.soil : node.mobility.water) * part;
            other[number] += node.mobility.other * part;
          }
      }
  }


  template <int dim>
  void DelassusOperator<dim>::take(const std::vector<Tensor<1, dim>> &impulses,
                                   const MixtureNodes<dim> &of_mixture,
                                   const TwoPhaseMomentum<dim> &step,
                                   Budget<dim> &balance)
  {
    sum(impulses);
    const auto vectors = [](const NodeRow &soil, const NodeRow &water) {
      return SoilAndWater<dim>{ -to_vector<dim>(soil), -to_vector<dim>(water) };
    };
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const Node &node   = nodes[i];
        const NodeRow soil = values[0][i], water = values[1][i];
        const bool is_pushed = scree::sum(soil * soil + water * water) > 0.;
        if (!is_owned(node) || !is_pushed || !has_mass(of_mixture, node.node))
          continue;
        if (node.is_held())
          step.push(of_mixture, node.node, vectors(soil, water), balance);
        else
          {
            const auto motion = motion_of(node, soil, water);
            step.add(of_mixture, node.node, vectors(motion.first, motion.second));
          }
      }
  }

  template class DelassusOperator<2>;
  template class DelassusOperator<3>;
} // namespace scree
