#include "formats/shadow/column_sums.h"

#include <immintrin.h>

namespace oriel {
namespace {

std::uint32_t sum_baseline(std::int16_t* change, std::size_t stride, std::uint32_t* word, int rows) {
  __m128i sum[4] = {};
  const __m128i zero = _mm_setzero_si128();
  std::uint32_t bits = 0;
  for (int row = 0; row < rows; ++row, change += stride) {
    auto* at = reinterpret_cast<__m128i*>(change);
    for (int k = 0; k < 4; ++k) {
      sum[k] = _mm_add_epi16(sum[k], _mm_loadu_si128(at + k));
      _mm_storeu_si128(at + k, zero);
    }
    const __m128i lower = _mm_packs_epi16(_mm_cmpeq_epi16(sum[0], zero), _mm_cmpeq_epi16(sum[1], zero));
    const __m128i upper = _mm_packs_epi16(_mm_cmpeq_epi16(sum[2], zero), _mm_cmpeq_epi16(sum[3], zero));
    bits = ~(static_cast<std::uint32_t>(_mm_movemask_epi8(lower)) | static_cast<std::uint32_t>(_mm_movemask_epi8(upper))
                                                                        << 16);
    word[row] |= bits;
  }
  return bits;
}

[[gnu::target("avx2")]] std::uint32_t sum_avx2(std::int16_t* change, std::size_t stride, std::uint32_t* word,
                                               int rows) {
  __m256i lower = _mm256_setzero_si256(), upper = lower;
  const __m256i zero = lower;
  std::uint32_t bits = 0;
  for (int row = 0; row < rows; ++row, change += stride) {
    auto* at = reinterpret_cast<__m256i*>(change);
    lower = _mm256_add_epi16(lower, _mm256_loadu_si256(at));
    upper = _mm256_add_epi16(upper, _mm256_loadu_si256(at + 1));
    _mm256_storeu_si256(at, zero), _mm256_storeu_si256(at + 1, zero);
    const __m256i none = _mm256_packs_epi16(_mm256_cmpeq_epi16(lower, zero), _mm256_cmpeq_epi16(upper, zero));
    bits = ~static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permute4x64_epi64(none, 0xd8)));
    word[row] |= bits;
  }
  return bits;
}

[[gnu::target("avx2,avx512f,avx512dq,avx512bw,avx512vl")]] std::uint32_t sum_avx512(std::int16_t* change,
                                                                                    std::size_t stride,
                                                                                    std::uint32_t* word, int rows) {
  __m512i sum = _mm512_setzero_si512();
  std::uint32_t bits = 0;
  for (int row = 0; row < rows; ++row, change += stride) {
    sum = _mm512_add_epi16(sum, _mm512_loadu_si512(change));
    _mm512_storeu_si512(change, _mm512_setzero_si512());
    bits = _mm512_test_epi16_mask(sum, sum);
    word[row] |= bits;
  }
  return bits;
}

}  // namespace

SumColumn column_sums(Simd simd) {
  return simd == Simd::kAvx512 ? sum_avx512 : simd == Simd::kAvx2 ? sum_avx2 : sum_baseline;
}

}  // namespace oriel
