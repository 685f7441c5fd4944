// SPDX-License-Identifier: LGPL-2.1-or-later
// A program that was compiled for another processor (-march=native) says so, in place of "Illegal instruction".
#ifdef __AVX__

#  include <unistd.h>

namespace
{
  bool is_missing = false;

  // Without the standard library, whose inline functions are compiled for that processor, too.
  [[gnu::target("arch=x86-64")]] void say(const char *text)
  {
    for (; *text != 0; ++text)
      if (write(STDERR_FILENO, text, 1) < 0)
        _exit(1);
  }


  // Names a part of the processor that is not there.
  [[gnu::target("arch=x86-64")]] void require(const bool is_there, const char *name)
  {
    if (is_there)
      return;
    say(is_missing ? ", " : "Scree was compiled for a processor with instructions that this one lacks: ");
    say(name);
    is_missing = true;
  }


  // The first of all constructors of the program; static members may already need the processor.
  [[gnu::constructor(101), gnu::target("arch=x86-64")]] void require_processor()
  {
    __builtin_cpu_init();
    require(__builtin_cpu_supports("avx"), "avx");
#  ifdef __AVX2__
    require(__builtin_cpu_supports("avx2"), "avx2");
#  endif
#  ifdef __FMA__
    require(__builtin_cpu_supports("fma"), "fma");
#  endif
#  ifdef __BMI2__
    require(__builtin_cpu_supports("bmi2"), "bmi2");
#  endif
#  ifdef __AVX512F__
    require(__builtin_cpu_supports("avx512f"), "avx512f");
#  endif
#  ifdef __AVX512VL__
    require(__builtin_cpu_supports("avx512vl"), "avx512vl");
#  endif
    if (is_missing)
      {
        say(".\nBuild it on this machine, or with -DSCREE_NATIVE=OFF for any processor.\n");
        _exit(1);
      }
  }
} // namespace

#endif
