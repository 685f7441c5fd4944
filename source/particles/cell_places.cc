// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/particles/cell_places.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace scree
{
  using namespace dealii;

  namespace
  {
    /// Puts dim - 1 zeros between the bits of a number below 2^20.
    template <int dim>
    std::uint64_t spread(std::uint64_t x)
    {
      if (dim == 2)
        {
          x = (x | x << 16) & 0x0000ffff0000ffff;
          x = (x | x << 8) & 0x00ff00ff00ff00ff;
          x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
          x = (x | x << 2) & 0x3333333333333333;
          return (x | x << 1) & 0x5555555555555555;
        }
      x = (x | x << 32) & 0x001f00000000ffff;
      x = (x | x << 16) & 0x001f0000ff0000ff;
      x = (x | x << 8) & 0x100f00f00f00f00f;
      x = (x | x << 4) & 0x10c30c30c30c30c3;
      return (x | x << 2) & 0x1249249249249249;
    }

    template <int dim>
    int gather(const std::uint64_t x)
    {
      int result = 0;
      for (unsigned int bit = 0; bit < 21; ++bit)
        result |= int(x >> (dim * bit) & 1) << bit;
      return result;
    }
  } // namespace


  template <int dim>
  std::uint64_t curve_number(const CellPlace<dim> &place)
  {
    std::uint64_t number = 0;
    for (unsigned int a = 0; a < dim; ++a)
      number |= spread<dim>(place[a]) << a;
    return number;
  }


  template <int dim>
  CellPlace<dim> curve_place(const std::uint64_t number)
  {
    CellPlace<dim> place;
    for (unsigned int a = 0; a < dim; ++a)
      place[a] = gather<dim>(number >> a);
    return place;
  }


  void make_unique(Blocks &blocks)
  {
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  }


  Blocks all_blocks(const Blocks &own, const MPI_Comm communicator)
  {
    Blocks all;
    for (const Blocks &of_rank : Utilities::MPI::all_gather(communicator, own))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    make_unique(all);
    return all;
  }


  template <int dim>
  Blocks with_margin(const Blocks &blocks, const unsigned int margin, const CellPlace<dim> &n)
  {
    std::vector<CellPlace<dim>> places;
    for (const std::uint64_t block : blocks)
      places.push_back(curve_place<dim>(block));
    for (unsigned int a = 0; a < dim; ++a)
      {
        std::vector<CellPlace<dim>> wider;
        for (CellPlace<dim> place : places)
          {
            const int first = std::max(0, place[a] - int(margin)), last = std::min(n[a] - 1, place[a] + int(margin));
            for (place[a] = first; place[a] <= last; ++place[a])
              wider.push_back(place);
          }
        std::sort(wider.begin(), wider.end());
        wider.erase(std::unique(wider.begin(), wider.end()), wider.end());
        places.swap(wider);
      }
    Blocks result;
    for (const CellPlace<dim> &place : places)
      result.push_back(curve_number<dim>(place));
    make_unique(result);
    return result;
  }


  bool has_any(const Blocks &blocks, const std::uint64_t first, const std::uint64_t n)
  {
    const auto found = std::lower_bound(blocks.begin(), blocks.end(), first);
    return found != blocks.end() && *found < first + n;
  }

  template std::uint64_t curve_number<2>(const CellPlace<2> &);
  template std::uint64_t curve_number<3>(const CellPlace<3> &);
  template CellPlace<2> curve_place<2>(const std::uint64_t);
  template CellPlace<3> curve_place<3>(const std::uint64_t);
  template decltype(with_margin<2>) with_margin<2>;
  template decltype(with_margin<3>) with_margin<3>;
} // namespace scree
