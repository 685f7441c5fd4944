// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/io/check_result.h>

#include <cstdio>

namespace scree
{
  namespace
  {
    /// Puts texts behind each other, with a new line before one that would pass the margin.
    std::string in_lines(const std::string &label, const std::vector<std::string> &texts)
    {
      constexpr std::size_t margin = 100;
      const std::string indent(12, ' ');
      std::string lines, line = indent + label;
      for (std::size_t t = 0; t < texts.size(); ++t)
        {
          const std::string item = ' ' + texts[t] + (t + 1 < texts.size() ? ";" : "");
          if (line.size() + item.size() > margin)
            {
              lines += line + '\n';
              line = indent.substr(1);
            }
          line += item;
        }
      return lines + line;
    }
  } // namespace


  std::string short_text(const double value)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }


  std::string verdict(const std::vector<CheckResult> &results)
  {
    std::vector<std::string> exceeded, others;
    std::string places;
    for (const CheckResult &result : results)
      if (!result.is_exceeded)
        others.push_back(result.text);
      else
        {
          exceeded.push_back(result.text + " (bound " + result.bound + ')');
          if (!result.where.empty())
            places += "\n            worst: " + result.where;
        }
    std::string lines;
    if (!exceeded.empty())
      lines = in_lines("out of bounds:", exceeded) + places + (others.empty() ? "" : "\n");
    if (!others.empty())
      lines += in_lines("within bounds:", others);
    return "Checks" + lines.substr(6);
  }
} // namespace scree
