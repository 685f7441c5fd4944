// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/geometry/stl_file.h>
#include <scree/input/input_error.h>
#include <scree/input/number_table.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <sstream>

namespace scree
{
  using namespace dealii;

  namespace
  {
    // 80 bytes of any text, the number of triangles, and of each the normal, the corners and two bytes more.
    constexpr std::size_t size_of_head = 80 + sizeof(std::uint32_t), size_of_record = 12 * sizeof(float) + 2;

    bool is_binary(const std::string &content)
    {
      if (content.size() < size_of_head)
        return false;
      std::uint32_t n;
      std::memcpy(&n, content.data() + 80, sizeof(n));
      return content.size() == size_of_head + n * size_of_record;
    }


    std::vector<Triangle> read_binary(const std::string &content, const std::string &name)
    {
      std::vector<Triangle> triangles((content.size() - size_of_head) / size_of_record);
      for (std::size_t t = 0; t < triangles.size(); ++t)
        {
          float numbers[12];
          std::memcpy(numbers, content.data() + size_of_head + t * size_of_record, sizeof(numbers));
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int a = 0; a < 3; ++a)
              {
                triangles[t][i][a] = numbers[3 + 3 * i + a];
                if (!std::isfinite(triangles[t][i][a]))
                  throw EntryError(name + "triangle " + std::to_string(t + 1) +
                                   " has a corner that is no place. Export the surface anew.");
              }
        }
      return triangles;
    }


    std::vector<Triangle> read_ascii(const std::string &content, const std::string &name)
    {
      std::vector<Triangle> triangles;
      std::istringstream lines(content);
      unsigned int n_corners = 3; // of the last triangle
      bool is_whole          = false;
      std::string line;
      for (unsigned int number = 1; std::getline(lines, line); ++number)
        {
          std::istringstream words(line);
          std::string first;
          words >> first;
          first              = lower_case(first);
          const auto require = [&](const bool possible, const std::string &remedy) {
            if (!possible)
              throw EntryError(name + "line " + std::to_string(number) + ' ' + remedy +
                               " Write a complete STL file: \"facet\" with three lines \"vertex x y z\" for each "
                               "triangle, and \"endsolid\".");
          };
          is_whole = first == "endsolid" || (is_whole && first.empty());
          if (first == "facet" || first == "endfacet" || first == "endsolid")
            require(n_corners == 3,
                    "comes before the third corner of triangle " + std::to_string(triangles.size()) + '.');
          if (first == "facet")
            {
              triangles.emplace_back();
              n_corners = 0;
            }
          if (first != "vertex")
            continue;
          require(n_corners < 3, "has a corner that belongs to no triangle.");
          for (unsigned int a = 0; a < 3; ++a)
            {
              std::string word;
              words >> word;
              const double value = number_of(word);
              require(std::isfinite(value), "has no three numbers.");
              triangles.back()[n_corners][a] = value;
            }
          ++n_corners;
        }
      if (!is_whole)
        throw EntryError(name + "it does not end with \"endsolid\", but in triangle " +
                         std::to_string(triangles.size()) + ". Export the surface anew.");
      return triangles;
    }
  } // namespace


  std::vector<Triangle> read_stl(const std::string &file, const std::string &name)
  {
    std::ifstream in = open_file(file, name);
    const std::string content{ std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
    if (is_binary(content)) // first: its text may begin with "solid", too
      return read_binary(content, name);
    if (lower_case(content.substr(0, 5)) != "solid")
      throw EntryError(name +
                       "it is no STL file: it neither begins with \"solid\" nor is as long as a binary one with its "
                       "number of triangles. Export the surface as STL.");
    return read_ascii(content, name);
  }
} // namespace scree
