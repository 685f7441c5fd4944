// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/element/element_command_line.h>

int main(int argc, char *argv[])
{
  return scree::run_element_command_line({ argv + 1, argv + argc });
}
