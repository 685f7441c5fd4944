// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/mixture/mixture.h>
#include <scree/particles/point_set.h>
#include <scree/tensor/matrix.h>
#include <scree/transfer/cell_sums.h>
#include <scree/transfer/transfer.h>
#include <scree/transfer/velocity_transfer.h>

#include <cmath>

namespace scree
{
  using namespace dealii;

  template <int dim>
  template <int n, bool is_affine, bool is_damped>
  void Transfer<dim>::add_points(const SoilBody<dim> &body, NodalField<dim> &field) const
  {
    const auto &layout = body.layout;
    // Without a name for the cells GCC writes the sums of each cell to memory before they are added to the nodes: 8 %
    // of the time from points to nodes in 2D.
    const auto &cells = body.points.cells();
    for (const auto &cell : cells)
      {
        const OpenKnots open = grid.open_knots(cell.cell);
        CellSums<dim, n> sums(grid.cell_size());
        for_each_record_with_shape<n>(
            cell, cell.stride, open, grid.cell_size(), [&](const auto &point, const auto &shape) {
              const double *properties = point.properties;
              const double *stress     = properties + layout.stress;
              [[maybe_unused]] std::array<double, n_symmetric_components<dim>> damped;
              if constexpr (is_damped)
                {
                  for (unsigned int c = 0; c < damped.size(); ++c)
                    damped[c] = stress[c] + properties[layout.damping + c];
                  stress = damped.data();
                }
              sums.template add<is_affine>(shape,
                                           properties[layout.mass],
                                           properties + layout.velocity,
                                           properties + layout.affine,
                                           properties[layout.volume],
                                           matrix_of_components<dim>(stress));
            });
        field.activate_cell(cell.cell);
        sums.scatter(grid.nodes(cell.cell), field);
      }
  }


  template <int dim>
  void Transfer<dim>::to_grid(const SoilBody<dim> &body, NodalField<dim> &field) const
  {
    const auto add = [&](auto n, auto is_affine) {
      return body.layout.has_damping ? add_points<n, is_affine, true>(body, field)
                                     : add_points<n, is_affine, false>(body, field);
    };
    with_nodes_1d(
        grid, [&](auto n) { return carries_affine(method) ? add(n, std::true_type()) : add(n, std::false_type()); });
  }


  template <int dim>
  Transfer<dim>::Transfer(const BackgroundGrid<dim> &grid,
                          const TransferParameters &transfer,
                          const StabilisationParameters &stabilisation)
      : grid(grid)
      , method(transfer.transfer_method())
      , pic_rate(transfer.pic_rate)
      , f_bar(stabilisation.f_bar_kind())
      , projection(f_bar == FBar::projected ? std::make_unique<VolumeProjection<dim>>(grid) : nullptr)
  {
  }


  template <int dim>
  template <int n, TransferMethod method>
  void Transfer<dim>::move_cell(const SoilBody<dim> &body,
                                const CellPoints<dim> &cell,
                                const NodalField<dim> &field,
                                const double time_step,
                                const double keep,
                                const unsigned int first,
                                LargestSquare &largest,
                                MotionSums<dim, Batch> &sums)
  {
    using Layout             = PropertyLayout<dim>;
    const OpenKnots open     = grid.open_knots(cell.cell);
    const double cell_volume = Utilities::fixed_power<dim>(grid.cell_size());
    const CellVelocity<dim, n> nodes(grid.nodes(cell.cell), field, grid.cell_size());

    for_each_batch(cell.n_points, [&](const BatchIndices &indices, const unsigned int n_used) {
      const BatchPointers<dim> points(cell, indices);
      for (const unsigned int p : indices)
        cell.prefetch_all_after(p);
      const BatchShape<dim, n> shape(points.places, open);
      const NodesAtPoints<dim> at_points = nodes.template at<method, true>(shape);

      static_assert(Layout::velocity == 0 && Layout::mass == dim && Layout::volume == dim + 1, "These lie in a row.");
      Batch own[dim + 2], affine[dim * dim], location[dim];
      simd::load_records<dim + 2>(as_constant(points.properties), own);
      simd::load_records<dim>(as_constant(points.locations), location);
      largest.include(at_points.template update<method>(own, affine, keep, time_step), n_used);
      if constexpr (method == TransferMethod::tpic) // AFLIP carries all of them.
        {
          const simd::Mask<Batch> is_loose = body.density * own[Layout::volume] > closures::loose * own[Layout::mass];
          if (simd::bits_of(is_loose) != 0)
            push_forward_gradient<dim>(affine, time_step, is_loose);
        }
      for (unsigned int c = 0; c < dim; ++c)
        location[c] += time_step * at_points.velocity[c];
      Batch increment[dim * dim];
#pragma GCC unroll 9 // else each one goes through memory
      for (unsigned int c = 0; c < dim * dim; ++c)
        increment[c] = time_step * at_points.gradient[c] + (c % (dim + 1) == 0 ? 1. : 0.);
      if (const auto is_large = own[Layout::volume] > simd::broadcast<Batch>(cell_volume); simd::bits_of(is_large) != 0)
        {
          hold_volume<dim>(increment, is_large);
          if constexpr (carries_affine(method))
            stop_growth<dim>(affine, is_large);
        }
      Batch affine_square = simd::broadcast<Batch>(0.), place[dim];
      if constexpr (method == TransferMethod::aflip)
        {
          for (unsigned int a = 0; a < dim; ++a)
            place[a] = shape.x[a] + time_step / grid.cell_size() * at_points.velocity[a];
          affine_square = square_of_affine<dim, n, Batch>(affine, place, open, grid.cell_size());
        }
      sums.add(simd::select<Batch>(simd::first_lanes(n_used), own[Layout::mass], simd::broadcast<Batch>(0.)),
               own,
               location,
               affine_square);
      simd::store_records<dim>(own, points.slots_at(Layout::velocity));
      simd::store_records<dim>(location, points.locations);
      if constexpr (carries_affine(method))
        simd::store_records<dim * dim>(affine, points.slots_at(body.layout.affine));

      const unsigned int p = first + indices[0];
      for (unsigned int c = 0; c < dim * dim; ++c)
        simd::store(increment[c], &motion.deformation_increment[c * motion.pitch + p]);
      simd::store(simd::broadcast<Batch>(1.), &motion.out_of_plane_stretch[p]);
      simd::store(determinant_of_rows<dim>(increment), &motion.volume_change[p]);
      simd::store(own[Layout::volume], &motion.volume[p]);
      simd::store(own[Layout::mass] / body.density, &motion.reference_volume[p]);
    });
  }


  template <int dim>
  template <int n, TransferMethod method>
  void Transfer<dim>::move_points(const Bodies &bodies,
                                  const NodalField<dim> &field,
                                  const double time_step,
                                  const double damping_time,
                                  const Report &report)
  {
    const double keep     = kept_velocity(method, pic_rate, time_step);
    unsigned int n_points = 0;
    moved.clear();
    for (auto *body : bodies)
      {
        const auto &cells = body->points.cells();
        Block block{ cells.data(), cells.data() + cells.size(), n_points };
        block.n_points = body->points.n_points();
        n_points += block.n_points;
        moved.push_back({ block, {} });
      }
    if (projection) // The vertices need the motion of all points.
      {
        motion.resize(n_points);
        projection->clear(n_points, bodies.size() > 1);
      }
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        auto &[cells, motion_of_body] = moved[b];
        LargestSquare largest;
        MotionSums<dim, Batch> sums;
        for_each_block(cells, [&](Block block) {
          if (!projection)
            {
              block.first = 0;
              motion.resize(block.n_points);
            }
          block.for_each_cell([&](const CellPoints<dim> &cell, const unsigned int first) {
            move_cell<n, method>(*bodies[b], cell, field, time_step, keep, first, largest, sums);
            if (!projection)
              apply_f_bar(f_bar, first, bodies[b]->material_points(cell), motion);
          });
          if (projection)
            projection->add(*bodies[b], block, motion);
          else
            update_state(*bodies[b], block, time_step, damping_time, motion_of_body.material);
        });
        motion_of_body.largest_speed = largest.speed();
        motion_of_body.sums          = sums.of_lanes();
      }
    if (projection)
      projection->fit();
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        auto &[cells, motion_of_body] = moved[b];
        if (projection)
          {
            projection->fit_changes(cells, motion);
            for_each_block(cells, [&](const Block &block) {
              block.for_each_cell([&](const CellPoints<dim> &cell, const unsigned int first) {
                projection->apply(cell, first, motion);
              });
              update_state(*bodies[b], block, time_step, damping_time, motion_of_body.material);
            });
            motion_of_body.material.averaging_work += projection->take_kept_work();
          }
        report(*bodies[b], motion_of_body);
      }
  }


  template <int dim>
  template <typename Act>
  void Transfer<dim>::for_each_block(const Block &cells, const Act &act)
  {
    for (Block block{ cells.begin, cells.begin, cells.first }; block.begin != cells.end;
         block = { block.end, block.end, block.first + block.n_points })
      {
        while (block.end != cells.end &&
               (block.end == block.begin || block.n_points + block.end->n_points <= block_size))
          block.n_points += (block.end++)->n_points;
        act(block);
      }
  }


  template <int dim>
  void Transfer<dim>::update_state(const SoilBody<dim> &body,
                                   const Block &block,
                                   const double time_step,
                                   const double damping_time,
                                   UpdateReport &report)
  {
    // The slots of cells lie one behind the other.
    const CellPoints<dim> &cell = *block.begin;
    auto points                 = body.material_points(cell);
    points.n_points             = block.n_points;
    for_each_batch(block.n_points, [&](const BatchIndices &indices, const unsigned int n) {
      const unsigned int p = block.first + indices[0];
      const Batch volume   = simd::load(&motion.volume[p]) * simd::load(&motion.volume_change[p]);
      const Batch ratio    = volume / simd::load(&motion.reference_volume[p]);
      simd::store(ratio, &motion.volume_ratio[p]);
      for (unsigned int l = 0; l < n; ++l)
        cell.properties_of(indices[l])[body.layout.volume] = volume[l];
    });
    const auto of_block = motion.material_motion(block.first, time_step, body.grain_density);
    if (body.layout.has_damping)
      damping.begin(body, cell, block.n_points);
    try
      {
        body.material->update(points, of_block, report);
      }
    catch (PointFault &fault)
      {
        const auto id = body.points.handler().get_property_pool().get_id(cell.slots[fault.point]);
        fault.name =
            body.name + ", point " + std::to_string(id) + " at (" + number_text(cell.location_of(fault.point)) + ") m";
        throw;
      }
    if (body.layout.has_damping)
      damping.finish(body, cell, block.n_points, of_block, damping_time / time_step);
  }


  template <int dim>
  void Transfer<dim>::to_points(const Bodies &bodies,
                                const NodalField<dim> &field,
                                const double time_step,
                                const double damping_time,
                                const Report &report)
  {
    with_nodes_1d(grid, [&](auto n) {
      with_method(method,
                  [&](auto of_points) { move_points<n, of_points>(bodies, field, time_step, damping_time, report); });
    });
  }

  template class Transfer<2>;
  template class Transfer<3>;
} // namespace scree
