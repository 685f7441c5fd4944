// SPDX-License-Identifier: LGPL-2.1-or-later
#ifdef __AVX2__
#  include <unistd.h>

namespace
{
  // In place of "Illegal instruction", before any other constructor of the program. Without the standard library, whose
  // inline functions are compiled for the other processor, too.
  [[gnu::constructor(101), gnu::target("arch=x86-64")]] void require_processor()
  {
    __builtin_cpu_init();
    const char *missing = nullptr;
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
      missing = "AVX2 and FMA";
#  ifdef __AVX512F__
    else if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512vl"))
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
} // namespace

#endif
