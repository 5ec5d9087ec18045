// SPDX-License-Identifier: Apache-2.0
#ifndef VectorsPortable_h
#define VectorsPortable_h

// Vectors of a single lane: the compiler is left to vectorise the loops over rows.
// Highway's names, so that the sweep is written once.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#define SUBDIVISION_INLINE inline

// Before a loop whose stores never touch what it loads. Compilers vectorise it only if they are told, since they cannot
// check all its rows against each other.
#if defined(__GNUC__) && !defined(__clang__)
#  define SUBDIVISION_INDEPENDENT _Pragma("GCC ivdep")
#else
#  define SUBDIVISION_INDEPENDENT
#endif

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** Whether loops over rows take several vectors at a time, where that saves counting. Compilers do it by themselves
 * where they vectorise. */
constexpr bool AreLoopsUnrolled = false;

template <typename T>
using Vector = T;

template <typename T>
constexpr std::ptrdiff_t
LaneCount()
{
  return 1;
}

template <typename T>
inline T
Load(const T * p)
{
  return *p;
}

template <typename T>
inline T
KeepInRegister(T v)
{
  return v;
}

template <typename T>
inline void
Store(T v, T * p)
{
  *p = v;
}

/** The neighbours of a row's values, up to VReach voxels away. */
template <typename T, int VReach>
class Neighbours
{
public:
  explicit Neighbours(const T * p)
    : m_Values(p)
  {}

  template <int VOffset>
  T
  At() const
  {
    return m_Values[VOffset];
  }

private:
  const T * m_Values;
};

template <typename T>
inline T
Broadcast(double value)
{
  return static_cast<T>(value);
}

template <typename T>
inline T
Add(T a, T b)
{
  return a + b;
}

template <typename T>
inline T
Sub(T a, T b)
{
  return a - b;
}

template <typename T>
inline T
Mul(T a, T b)
{
  return a * b;
}

template <typename T>
inline T
Div(T a, T b)
{
  return a / b;
}

template <typename T>
inline T
MulAdd(T a, T b, T c)
{
  return a * b + c;
}

template <typename T>
inline T
MulSub(T a, T b, T c)
{
  return a * b - c;
}

template <typename T>
inline T
NegMulAdd(T a, T b, T c)
{
  return c - a * b;
}

template <typename T>
inline T
Neg(T a)
{
  return -a;
}

/** The absolute value. */
template <typename T>
inline T
Magnitude(T a)
{
  return std::abs(a);
}

/** The second value where either is NaN. */
template <typename T>
inline T
OrderedMin(T a, T b)
{
  return a < b ? a : b;
}

/** The second value where either is NaN. */
template <typename T>
inline T
OrderedMax(T a, T b)
{
  return a > b ? a : b;
}

/** Makes a sum of magnitudes ready for MinNonNegative and MaxNonNegative. */
template <typename T>
inline T
ToOrderedBits(T sum)
{
  return OrderedMin(sum, std::numeric_limits<T>::infinity());
}

/** The smaller one of two sums of magnitudes; NaN counts as infinite. */
template <typename T>
inline T
MinNonNegative(T a, T b)
{
  return OrderedMin(a, b);
}

/** The greater one of two sums of magnitudes; NaN counts as infinite. */
template <typename T>
inline T
MaxNonNegative(T a, T b)
{
  return OrderedMax(a, b);
}

/** \c v where \c divisor is finite and above 0, else 0. */
template <typename T>
inline T
ZeroUnlessDivisible(T v, T divisor)
{
  return divisor > 0 && divisor <= std::numeric_limits<T>::max() ? v : T(0);
}

/** The replacement where \c v is finite, else \c v. */
template <typename T>
inline T
IfFinite(T v, T replacement)
{
  return std::abs(v) <= std::numeric_limits<T>::max() ? replacement : v;
}

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk

#endif
