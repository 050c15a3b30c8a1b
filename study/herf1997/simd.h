// Kernels are compiled for three instruction sets and give the same bits on each.
#pragma once

namespace oriel::study {

enum class Simd { kBaseline, kAvx2, kAvx512 };

// The widest that this processor has.
inline Simd best_simd() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return Simd::kAvx512;
  return __builtin_cpu_supports("avx2") ? Simd::kAvx2 : Simd::kBaseline;
}

}  // namespace oriel::study
