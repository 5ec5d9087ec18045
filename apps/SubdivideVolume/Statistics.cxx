// SPDX-License-Identifier: Apache-2.0
#include "Statistics.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace
{
using itk::Subdivision::ElementType;
using itk::Subdivision::WithElementType;

// Loops of plain comparisons, each compiled for AVX2, too, where the compiler can choose when the program runs.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
  !defined(__SANITIZE_THREAD__)
#  define COUNTING_TARGETS __attribute__((target_clones("avx2", "default")))
#else
#  define COUNTING_TARGETS
#endif

/** So many elements are counted at once, in integers of their own width. */
constexpr std::uint64_t BlockSize = 1 << 12;

template <typename T>
COUNTING_TARGETS Statistics
CountBlock(const T * elements, const std::size_t count)
{
  T minimum = elements[0];
  T maximum = elements[0];
  for (std::size_t i = 0; i < count; ++i)
  {
    const T element = elements[i];
    minimum = element < minimum ? element : minimum;
    maximum = element > maximum ? element : maximum;
  }
  return { static_cast<double>(minimum), static_cast<double>(maximum), 0, 0 };
}

/** Real numbers are compared as integers, which compilers vectorise: in two's complement, with all bits but the sign
 * inverted where it is set, they are in the order of the numbers. */
template <typename TReal, typename TInteger>
COUNTING_TARGETS Statistics
CountRealBlock(const TReal * elements, const std::size_t count)
{
  constexpr TInteger magnitude = std::numeric_limits<TInteger>::max();
  constexpr TInteger least = std::numeric_limits<TInteger>::min();
  constexpr int      signBit = 8 * sizeof(TInteger) - 1;
  constexpr TInteger infinityBits = magnitude - ((TInteger{ 1 } << (std::numeric_limits<TReal>::digits - 1)) - 1);

  TInteger block[BlockSize];
  std::memcpy(block, elements, count * sizeof(TReal));
  TInteger minimum = magnitude;
  TInteger maximum = least;
  TInteger notANumber = 0;
  TInteger infinite = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const TInteger bits = block[i];
    const TInteger size = bits & magnitude;
    const TInteger ordered = bits ^ ((bits >> signBit) & magnitude);
    const TInteger isFinite = -static_cast<TInteger>(size < infinityBits); // all bits
    const TInteger lower = (ordered & isFinite) | (magnitude & ~isFinite);
    const TInteger upper = (ordered & isFinite) | (least & ~isFinite);
    notANumber += size > infinityBits;
    infinite += size == infinityBits;
    minimum = lower < minimum ? lower : minimum;
    maximum = upper > maximum ? upper : maximum;
  }
  const auto toReal = [](TInteger ordered) {
    const TInteger bits = ordered < 0 ? static_cast<TInteger>(ordered ^ magnitude) : ordered;
    TReal          real;
    std::memcpy(&real, &bits, sizeof(real));
    return static_cast<double>(real) + 0.0; // -0 becomes 0
  };
  Statistics statistics;
  if (static_cast<std::size_t>(notANumber + infinite) < count)
  {
    statistics.Minimum = toReal(minimum);
    statistics.Maximum = toReal(maximum);
  }
  statistics.NotANumber = static_cast<std::uint64_t>(notANumber);
  statistics.Infinite = static_cast<std::uint64_t>(infinite);
  return statistics;
}

Statistics
CountBlock(const float * elements, const std::size_t count)
{
  return CountRealBlock<float, std::int32_t>(elements, count);
}

Statistics
CountBlock(const double * elements, const std::size_t count)
{
  return CountRealBlock<double, std::int64_t>(elements, count);
}
} // namespace

void
Statistics::Include(const Statistics & other)
{
  Minimum = std::min(Minimum, other.Minimum);
  Maximum = std::max(Maximum, other.Maximum);
  NotANumber += other.NotANumber;
  Infinite += other.Infinite;
}

Statistics
Count(const ElementType type, const void * elements, const std::uint64_t count)
{
  return WithElementType(type, [=](auto tag) {
    const auto * const values = static_cast<const typename decltype(tag)::Type *>(elements);
    Statistics         statistics;
    for (std::uint64_t first = 0; first < count; first += BlockSize)
    {
      statistics.Include(CountBlock(values + first, std::min(BlockSize, count - first)));
    }
    return statistics;
  });
}
