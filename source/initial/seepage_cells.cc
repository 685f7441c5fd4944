// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/boundary/face_entries.h>
#include <scree/initial/seepage_cells.h>
#include <scree/input/input_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace scree
{
  using namespace dealii;

  namespace
  {
    constexpr double no_head = std::numeric_limits<double>::quiet_NaN();

    /// Coordinates of a number in a lattice of n^dim.
    template <int dim>
    std::array<unsigned int, dim> place_in_lattice(unsigned int number, const unsigned int n)
    {
      std::array<unsigned int, dim> place;
      for (unsigned int a = 0; a < dim; ++a, number /= n)
        place[a] = number % n;
      return place;
    }


    /// The head at each face of the box, m, in deal.II's numbering; NaN where none is given. Throws EntryError
    /// if there is no such face.
    std::vector<double> heads_at_faces(const SeepageStart &start, const unsigned int dim)
    {
      const std::vector<std::string> names = FaceEntries::names(dim);
      std::string list;
      for (const std::string &name : names)
        list += (list.empty() ? "" : ", ") + name;
      std::vector<double> heads(names.size(), no_head);
      for (const auto &[name, head] : start.heads())
        {
          const auto face = std::find(names.begin(), names.end(), name);
          require_entry(face != names.end() && std::isnan(heads[face - names.begin()]),
                        "Water",
                        "Heads at walls",
                        start.wall_heads,
                        "write each wall once. The walls are " + list + '.');
          heads[face - names.begin()] = head;
        }
      return heads;
    }
  } // namespace


  template <int dim>
  SeepageSurvey<dim>::SeepageSurvey(const BackgroundGrid<dim> &grid,
                                    const SeepageSoil &soil,
                                    const WaterParameters &water,
                                    const WaterBoundaryConditions<dim> &walls,
                                    const double unit_weight,
                                    const LevelSet<dim> *ground)
      : grid(grid)
      , walls(walls)
      , ground(ground)
      , unit_weight(unit_weight)
      , heads(heads_at_faces(water.seepage_start, dim))
      , conductivities(soil.conductivities)
      , reservoir_text(water.reservoir_level)
  {
    for (const SoilRegion &body : soil.bodies)
      regions.push_back(body.template places<dim>());
    if (!reservoir_text.empty())
      reservoir = parse_expression<dim>(entry_name("Water", "Reservoir level"), reservoir_text, 1);
  }


  template <int dim>
  double SeepageSurvey<dim>::level(const Point<dim> &x) const
  {
    return reservoir ? reservoir->value(x) : no_head;
  }


  template <int dim>
  int SeepageSurvey<dim>::kind(const Point<dim> &x) const
  {
    if (ground != nullptr && !ground->is_open(x))
      return closed;
    for (unsigned int i = 0; i < regions.size(); ++i)
      if (regions[i].contains(x))
        return conductivities[i] > 0. ? int(i) : closed;
    return air;
  }


  template <int dim>
  bool SeepageSurvey<dim>::is_beyond(const Point<dim> &x, const unsigned int face) const
  {
    const unsigned int a = face / 2;
    return face % 2 == 0 ? x[a] < grid.lower_corner()[a] : x[a] > grid.upper_corner()[a];
  }


  template <int dim>
  bool SeepageSurvey<dim>::look_at(const Point<dim> &corner, std::array<int, n_around> &kinds) const
  {
    const double width   = grid.cell_size() / Cell::n_1d;
    const auto centre_of = [&](const unsigned int part) {
      Point<dim> x = corner;
      for (unsigned int a = 0; a < dim; ++a)
        x[a] += width * (place_in_lattice<dim>(part, n_wide)[a] - 0.5);
      return x;
    };
    const auto kind_of = [&](const unsigned int part) {
      const Point<dim> x = centre_of(part);
      bool is_in_box     = true;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        is_in_box = is_in_box && !is_beyond(x, f);
      return is_in_box ? kind(x) : closed; // Walls are looked at apart.
    };
    // In space, where there are many parts, a cell with the same kind at its corners and in the middle is not
    // divided.
    if constexpr (dim == 3)
      {
        const int middle = kind_of(n_around / 2);
        bool is_one      = true;
        for (unsigned int v = 0; v < (1 << dim) && is_one; ++v)
          {
            unsigned int part = 0;
            for (unsigned int a = 0, step = 1; a < dim; ++a, step *= n_wide)
              part += (v >> a & 1) * (n_wide - 1) * step;
            is_one = kind_of(part) == middle;
          }
        if (is_one)
          {
            kinds.fill(middle);
            return middle >= 0;
          }
      }
    bool has_soil = false;
    for (unsigned int part = 0; part < n_around; ++part)
      {
        kinds[part]      = kind_of(part);
        const auto place = place_in_lattice<dim>(part, n_wide);
        has_soil         = has_soil || (kinds[part] >= 0 && std::all_of(place.begin(), place.end(), [](const auto i) {
                                  return i > 0 && i <= Cell::n_1d;
                                }));
      }
    return has_soil;
  }


  template <int dim>
  void SeepageSurvey<dim>::find(std::vector<SeepageCell<dim>> &cells, std::vector<SeepageFace<dim>> &faces) const
  {
    std::array<int, n_around> kinds;
    for (const auto &fine : grid.fine_cells().cells())
      {
        const Point<dim> corner = grid.fine_cells().box().corner(fine.place);
        if (!grid.fine_cells().is_owned(fine) || !look_at(corner, kinds))
          continue;
        Cell cell{ fine.index, corner, {} };
        for (unsigned int q = 0; q < Cell::n_parts; ++q)
          {
            unsigned int part = 0;
            for (unsigned int a = 0, step = 1; a < dim; ++a, step *= n_wide)
              part += (place_in_lattice<dim>(q, Cell::n_1d)[a] + 1) * step;
            cell.conductivity[q] = kinds[part] >= 0 ? conductivities[kinds[part]] : 0.;
          }
        add_free_faces(kinds, corner, cells.size(), faces);
        add_faces_at_walls(kinds, corner, cells.size(), faces);
        cells.push_back(cell);
      }
  }


  namespace
  {
    /// Calls visit(part, axis, side, neighbour) for the parts of a cell with soil and the parts beside them.
    template <int dim, typename Kinds, typename Visit>
    void for_sides_of_soil(const Kinds &kinds, const Visit &visit)
    {
      constexpr unsigned int n_1d = SeepageCell<dim>::n_1d, n_wide = n_1d + 2;
      for (unsigned int part = 0; part < kinds.size(); ++part)
        {
          const auto place   = place_in_lattice<dim>(part, n_wide);
          const bool is_cell = std::all_of(place.begin(), place.end(), [](const auto i) { return i > 0 && i <= n_1d; });
          if (!is_cell || kinds[part] < 0)
            continue;
          for (unsigned int a = 0, step = 1; a < dim; ++a, step *= n_wide)
            for (unsigned int side = 0; side < 2; ++side)
              visit(place, kinds[part], a, side, side == 0 ? part - step : part + step);
        }
    }

    template <int dim>
    Point<dim> place_in_cell(const Point<dim> &x, const Point<dim> &corner, const double width)
    {
      Point<dim> place;
      for (unsigned int a = 0; a < dim; ++a)
        place[a] = std::clamp((x[a] - corner[a]) / width, 0., 1.);
      return place;
    }

    /// Middle of a side of a part, m.
    template <int dim>
    Point<dim> side_of_part(const std::array<unsigned int, dim> &place,
                            const unsigned int axis,
                            const unsigned int side,
                            const Point<dim> &corner,
                            const double width)
    {
      Point<dim> x = corner;
      for (unsigned int a = 0; a < dim; ++a)
        x[a] += width * (place[a] - (a == axis ? 1. - side : 0.5));
      return x;
    }
  } // namespace


  template <int dim>
  void SeepageSurvey<dim>::add_free_faces(const std::array<int, n_around> &kinds,
                                          const Point<dim> &corner,
                                          const unsigned int cell,
                                          std::vector<SeepageFace<dim>> &faces) const
  {
    constexpr double least_flatness = 0.6; // area of the plane over that of the steps, of one plane at most sqrt(dim)
    struct Step
    {
      Point<dim> x;
      unsigned int axis;
      double conductivity;
    };
    const double width = grid.cell_size() / Cell::n_1d;
    std::vector<Step> steps;
    Tensor<1, dim> normal, sum;
    for_sides_of_soil<dim>(
        kinds,
        [&](const auto &place, const int body, const unsigned int a, const unsigned int side, const unsigned int next) {
          if (kinds[next] != air)
            return;
          steps.push_back({ side_of_part<dim>(place, a, side, corner, width), a, conductivities[body] });
          normal[a] += side == 0 ? -1. : 1.;
          sum += steps.back().x - corner;
        });
    if (steps.empty())
      return;
    // The steps of an oblique face lie around a plane: their faces go there.
    const bool is_plane = normal.norm() > least_flatness * steps.size();
    if (is_plane)
      normal /= normal.norm();
    const Point<dim> middle = corner + sum / double(steps.size());
    const double area = Utilities::fixed_power<dim - 1>(width), top = grid.upper_corner()[dim - 1];
    for (const Step &step : steps)
      {
        const double share = is_plane ? std::abs(normal[step.axis]) : 1.;
        const Point<dim> x = is_plane ? step.x - ((step.x - middle) * normal) * normal : step.x;
        const double water = level(x);
        if (water > top + 1e-6 * width)
          throw ValueError(entry_message("Water",
                                         "Reservoir level",
                                         reservoir_text,
                                         "it is above the box of subsection Mesh at " + number_text(x) +
                                             " m. Write a larger box, or a level up to " + number_text(top) + " m."));
        faces.push_back({ cell,
                          x,
                          place_in_cell(x, corner, grid.cell_size()),
                          area * share,
                          step.conductivity,
                          x[dim - 1] < water ? water : no_head });
      }
  }


  template <int dim>
  std::optional<double> SeepageSurvey<dim>::head_of_wall(const unsigned int face, const double height) const
  {
    const bool has_head = !std::isnan(heads[face]);
    if (has_head && height < heads[face])
      return heads[face];
    if (!walls.is_drained(face))
      return {};
    if (has_head)
      return no_head; // Above it water may leave.
    const double pressure = walls.pressure(1u << face);
    return pressure == 0. ? no_head : height + pressure / unit_weight;
  }


  template <int dim>
  void SeepageSurvey<dim>::add_faces_at_walls(const std::array<int, n_around> &kinds,
                                              const Point<dim> &corner,
                                              const unsigned int cell,
                                              std::vector<SeepageFace<dim>> &faces) const
  {
    const double width = grid.cell_size() / Cell::n_1d, area = Utilities::fixed_power<dim - 1>(width);
    for_sides_of_soil<dim>(
        kinds,
        [&](const auto &place, const int body, const unsigned int a, const unsigned int side, const unsigned int) {
          const Point<dim> x = side_of_part<dim>(place, a, side, corner, width);
          Point<dim> beyond  = x;
          beyond[a] += side == 0 ? -width / 2 : width / 2;
          if (!is_beyond(beyond, 2 * a + side))
            return;
          if (const auto head = head_of_wall(2 * a + side, x[dim - 1]))
            faces.push_back({ cell, x, place_in_cell(x, corner, grid.cell_size()), area, conductivities[body], *head });
        });
  }

  template class SeepageSurvey<2>;
  template class SeepageSurvey<3>;
} // namespace scree
