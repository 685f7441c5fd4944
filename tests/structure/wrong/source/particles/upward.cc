// SPDX-License-Identifier: LGPL-2.1-or-later
// Not compiled: modules.py must find its includes of a module that is higher and of one that nobody knows.
#include <scree/materials/law.h>
#include <scree/schemes/time_step.h>
#include <scree/weather/rain.h>
