// SPDX-License-Identifier: Apache-2.0

// Vectors of the target that Highway is compiling for. No include guard: every target includes this file once, into its
// own namespace.

#define SUBDIVISION_INLINE HWY_INLINE
#define SUBDIVISION_INDEPENDENT

namespace itk
{
namespace Subdivision
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/** Whether loops over rows take several vectors at a time, where that saves counting. */
constexpr bool AreLoopsUnrolled = true;

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

/** A value, constant or not, that is used more than once. Without this, GCC loads it once more for every use, and loads
 * are what the loops over rows wait for. */
template <typename TVector>
HWY_INLINE TVector
KeepInRegister(TVector v)
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

/** The neighbours of a row's values, up to VReach voxels away. */
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE
template <typename T, int VReach>
class Neighbours
{
public:
  HWY_INLINE explicit Neighbours(const T * p)
    : m_Values(p)
  {}

  template <int VOffset>
  HWY_INLINE Vector<T>
             At() const
  {
    return Load(m_Values + VOffset);
  }

private:
  const T * m_Values;
};
#else
// Loads of every neighbour would cross cache lines, and loads are what the loops over rows wait for. Vectors that lie a
// block of 16 bytes apart hold, block by block, all that lies between them.
template <typename T, int VReach>
class Neighbours
{
public:
  HWY_INLINE explicit Neighbours(const T * p)
  {
    for (int i = 0; i < Loads; ++i)
    {
      m_Loaded[i] = KeepInRegister(Load(p - VReach + i * Block));
    }
  }

  template <int VOffset>
  HWY_INLINE Vector<T>
             At() const
  {
    constexpr int lane = VOffset + VReach;
    if constexpr (lane % Block == 0)
    {
      return m_Loaded[lane / Block];
    }
    else
    {
      return hn::CombineShiftRightLanes<lane % Block>(Tag<T>(), m_Loaded[lane / Block + 1], m_Loaded[lane / Block]);
    }
  }

private:
  static constexpr int Block = 16 / sizeof(T);
  static constexpr int Loads = (2 * VReach + Block - 1) / Block + 1;

  Vector<T> m_Loaded[Loads];
};
#endif

template <typename T>
HWY_INLINE Vector<T>
           Broadcast(double value)
{
  return hn::Set(Tag<T>(), static_cast<T>(value));
}

using hn::Add;
using hn::Div;
using hn::Mul;
using hn::MulAdd;
using hn::MulSub;
using hn::Neg;
using hn::NegMulAdd;
using hn::Sub;

/** The absolute value. */
template <typename TVector>
HWY_INLINE TVector
Magnitude(TVector v)
{
  using D = hn::DFromV<TVector>;
  constexpr hn::RebindToUnsigned<D> bits;
  const auto                        allButSign = hn::Set(bits, ~hwy::SignMask<hn::TFromD<D>>());
  return hn::And(v, KeepInRegister(hn::BitCast(D(), allButSign)));
}

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

/** Makes a sum of magnitudes ready for MinNonNegative and MaxNonNegative. */
template <typename TVector>
HWY_INLINE TVector
ToOrderedBits(TVector sum)
{
  using T = hn::TFromD<hn::DFromV<TVector>>;
  return sizeof(T) == sizeof(std::uint32_t) ? sum : OrderedMin(sum, Broadcast<T>(std::numeric_limits<T>::infinity()));
}

/** The smaller one of two sums of magnitudes; NaN counts as infinite. */
template <typename TVector>
HWY_INLINE TVector
MinNonNegative(TVector a, TVector b)
{
  using D = hn::DFromV<TVector>;
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(std::uint32_t))
  {
    // The bits of what is not negative have its order, NaN last. Processors have more units for integers, and all of
    // them have this minimum, which they do not for 64 bits.
    constexpr hn::RebindToUnsigned<D> bits;
    return hn::BitCast(D(), hn::Min(hn::BitCast(bits, a), hn::BitCast(bits, b)));
  }
  else
  {
    return OrderedMin(a, b);
  }
}

/** The greater one of two sums of magnitudes; NaN counts as infinite or more. */
template <typename TVector>
HWY_INLINE TVector
MaxNonNegative(TVector a, TVector b)
{
  using D = hn::DFromV<TVector>;
  if constexpr (sizeof(hn::TFromD<D>) == sizeof(std::uint32_t))
  {
    constexpr hn::RebindToUnsigned<D> bits;
    return hn::BitCast(D(), hn::Max(hn::BitCast(bits, a), hn::BitCast(bits, b)));
  }
  else
  {
    return OrderedMax(a, b);
  }
}

/** \c v where \c divisor is finite and above 0, else 0. */
template <typename TVector>
HWY_INLINE TVector
ZeroUnlessDivisible(TVector v, TVector divisor)
{
  using D = hn::DFromV<TVector>;
  const auto largest = hn::Set(D(), hwy::HighestValue<hn::TFromD<D>>());
  return hn::IfThenElseZero(hn::And(hn::Gt(divisor, hn::Zero(D())), hn::Le(divisor, largest)), v);
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
} // namespace Subdivision
} // namespace itk
