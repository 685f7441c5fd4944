// SPDX-License-Identifier: LGPL-2.1-or-later
#ifdef __AVX__
#  include <unistd.h>

namespace
{
  // Without the standard library, whose inline functions are compiled for the other processor, too.
  [[gnu::target("arch=x86-64")]] void require_processor()
  {
    __builtin_cpu_init();
    const char *missing = nullptr;
    if (!__builtin_cpu_supports("avx"))
      missing = "AVX";
#  ifdef __AVX2__
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi2"))
      missing = "AVX2, FMA and BMI2";
#  endif
#  ifdef __AVX512F__
    if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl"))
      missing = "AVX-512";
#  endif
    if (missing == nullptr)
      return;
    const char *texts[] = { "Scree was compiled for a processor with ",
                            missing,
                            ", which this one lacks.\nBuild it here, or with -DSCREE_NATIVE=OFF for any processor.\n" };
    for (const char *text : texts)
      if (write(STDERR_FILENO, text, __builtin_strlen(text)) < 0)
        break;
    _exit(1);
  }

  // In place of "Illegal instruction", before the constructors of the libraries: these call inline functions of this
  // program where both have them.
  [[gnu::section(".preinit_array"), gnu::used]] void (*const before_all)() = require_processor;
} // namespace

#endif
