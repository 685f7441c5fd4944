// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/box_tree.h>

#include <numeric>

namespace scree
{
  using namespace dealii;

  namespace
  {
    void include(const Triangle &triangle, Box &box)
    {
      for (const Point<3> &corner : triangle)
        for (unsigned int a = 0; a < 3; ++a)
          {
            box.lower[a] = std::min(box.lower[a], corner[a]);
            box.upper[a] = std::max(box.upper[a], corner[a]);
          }
    }
  } // namespace


  Box box_around(const std::vector<Triangle> &triangles)
  {
    Box box{ triangles[0][0], triangles[0][0] };
    for (const Triangle &triangle : triangles)
      include(triangle, box);
    return box;
  }


  BoxTree::BoxTree(const std::vector<Triangle> &triangles)
      : numbers(triangles.size())
  {
    std::iota(numbers.begin(), numbers.end(), 0);
    add(triangles, 0, triangles.size());
  }


  void BoxTree::add(const std::vector<Triangle> &triangles, const unsigned int begin, const unsigned int end)
  {
    constexpr unsigned int most_of_leaf = 4;
    const Point<3> &first               = triangles[numbers[begin]][0];
    Node node{ { first, first }, begin, end };
    for (unsigned int i = begin; i < end; ++i)
      include(triangles[numbers[i]], node.box);
    const unsigned int number = nodes.size();
    nodes.push_back(node);
    if (end - begin <= most_of_leaf)
      return;
    const Tensor<1, 3> size = node.box.upper - node.box.lower;
    const unsigned int axis = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : (size[1] > size[2] ? 1 : 2);
    const unsigned int half = begin + (end - begin) / 2;
    const auto place        = [&](const unsigned int i) {
      return triangles[i][0][axis] + triangles[i][1][axis] + triangles[i][2][axis];
    };
    std::nth_element(numbers.begin() + begin,
                     numbers.begin() + half,
                     numbers.begin() + end,
                     [&](const unsigned int i, const unsigned int j) { return place(i) < place(j); });
    add(triangles, begin, half);
    nodes[number].right = nodes.size();
    add(triangles, half, end);
  }
} // namespace scree
