// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef scree_tests_unit_test_h
#define scree_tests_unit_test_h

#include <string>

/// A test of its folder's program, which runs it when called with its name: `const UnitTest registered("name", run);`.
/// MPI has been initialised. What the test prints on the first rank is compared with name.output; others print nothing.
class UnitTest
{
public:
  UnitTest(const std::string &name, void (*run)());
};

#endif
