// SPDX-License-Identifier: LGPL-2.1-or-later
// Not compiled: the test of named_files.py, which must find its entry and its file.
void add_parameters(ParameterHandler &prm)
{
  prm.add_parameter("Ground", ground, "File of heights, m.", Patterns::Anything());
}

std::string read(const std::string &file)
{
  std::ifstream in(file);
}
