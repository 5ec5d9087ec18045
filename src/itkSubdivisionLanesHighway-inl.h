// SPDX-License-Identifier: Apache-2.0

// Vectors of the target that Highway is compiling for. No include guard: every target includes this file once, into its
// own namespace.

#define SUBDIVISION_INLINE HWY_INLINE

namespace itk
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

template <typename T>
using Tag = hn::ScalableTag<T>;

template <typename T>
using Vector = hn::Vec<Tag<T>>;

template <typename T>
HWY_INLINE std::ptrdiff_t
           LaneCount()
{
  return static_cast<std::ptrdiff_t>(hn::Lanes(Tag<T>()));
}

template <typename T>
HWY_INLINE Vector<T>
           Load(const T * p)
{
  return hn::LoadU(Tag<T>(), p);
}

/** A value that is used more than once. Without this, GCC loads it once more for every use, and loads are what the
 * filters along the lanes wait for. */
template <typename TVector>
HWY_INLINE TVector
Hold(TVector v)
{
#if HWY_COMPILER_GCC_ACTUAL && HWY_ARCH_X86
  asm("" : "+v"(v.raw));
#endif
  return v;
}

template <typename TVector, typename T>
HWY_INLINE void
Store(TVector v, T * p)
{
  hn::StoreU(v, Tag<T>(), p);
}

template <typename T>
HWY_INLINE Vector<T>
           Broadcast(double value)
{
  return hn::Set(Tag<T>(), static_cast<T>(value));
}

using hn::Abs;
using hn::Add;
using hn::Mul;
using hn::MulAdd;
using hn::MulSub;
using hn::Neg;
using hn::NegMulAdd;
using hn::Sub;

/** The second value where either is NaN, as x86 does by itself; other instruction sets differ. */
template <typename TVector>
HWY_INLINE TVector
OrderedMin(TVector a, TVector b)
{
#if HWY_ARCH_X86
  return hn::Min(a, b);
#else
  return hn::IfThenElse(hn::Lt(a, b), a, b);
#endif
}

/** The second value where either is NaN. */
template <typename TVector>
HWY_INLINE TVector
OrderedMax(TVector a, TVector b)
{
#if HWY_ARCH_X86
  return hn::Max(a, b);
#else
  return hn::IfThenElse(hn::Gt(a, b), a, b);
#endif
}

/** The replacement where \c v is finite, else \c v. */
template <typename TVector>
HWY_INLINE TVector
IfFinite(TVector v, TVector replacement)
{
  using D = hn::DFromV<TVector>;
  const auto largest = hn::Set(D(), hwy::HighestValue<hn::TFromD<D>>());
  return hn::IfThenElse(hn::Le(hn::Abs(v), largest), replacement, v);
}

} // namespace HWY_NAMESPACE
} // namespace itk
