// SPDX-License-Identifier: Apache-2.0

// Conversions of rows of elements from and to real values: vector code for the types that images mostly have. No
// include guard: every target includes this file once, into its own namespace.

namespace itk
{
namespace Subdivision
{
namespace HWY_NAMESPACE
{

using FloatTag = hn::ScalableTag<float>;
using IntegerTag = hn::ScalableTag<std::int32_t>;

/** As many elements as there are lanes of float. */
template <typename TElement>
using ElementTag = hn::Rebind<TElement, FloatTag>;

template <typename TElement>
HWY_INLINE hn::Vec<FloatTag>
           ConvertLanes(const TElement * in)
{
  return hn::ConvertTo(FloatTag(), hn::PromoteTo(IntegerTag(), hn::LoadU(ElementTag<TElement>(), in)));
}

HWY_INLINE hn::Vec<FloatTag>
           ConvertLanes(const float * in)
{
  return hn::LoadU(FloatTag(), in);
}

/** Calls \c convert with the index of the first element of every vector of a row. The last vector begins where it ends
 * with the row, even if it repeats some of the one before. Returns whether the row is long enough for that. */
template <typename TConvert>
HWY_INLINE bool
ForEachVector(const std::size_t count, const TConvert & convert)
{
  const std::size_t lanes = hn::Lanes(FloatTag());
  if (count < lanes)
  {
    return false;
  }
  for (std::size_t x = 0; x < count - lanes; x += lanes)
  {
    convert(x);
  }
  convert(count - lanes);
  return true;
}

/** Whether there is vector code between elements and real values. */
template <typename TElement, typename T>
constexpr bool HasVectorCode =
  std::is_same<TElement, T>::value ||
  (std::is_same<T, float>::value && std::is_integral<TElement>::value && sizeof(TElement) <= 2);

template <typename TElement, typename T>
void
WidenElements(const TElement * in, std::size_t count, T * out)
{
  if constexpr (std::is_same<TElement, T>::value)
  {
    std::copy_n(in, count, out);
  }
  else
  {
    const auto convert = [=](std::size_t x) HWY_ATTR {
      if constexpr (HasVectorCode<TElement, T>)
      {
        hn::StoreU(ConvertLanes(in + x), FloatTag(), out + x);
      }
    };
    if (!HasVectorCode<TElement, T> || !ForEachVector(count, convert))
    {
      std::copy_n(in, count, out);
    }
  }
}

#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
// Highway's NearestInt saturates, which costs more than to round. Here only the largest values are at stake, and those
// are bounded before.
HWY_INLINE hn::Vec128<std::int32_t>
           NearestIntegers(hn::Vec128<float> v)
{
  return hn::Vec128<std::int32_t>{ _mm_cvtps_epi32(v.raw) };
}
#  if HWY_TARGET <= HWY_AVX2
HWY_INLINE hn::Vec256<std::int32_t>
           NearestIntegers(hn::Vec256<float> v)
{
  return hn::Vec256<std::int32_t>{ _mm256_cvtps_epi32(v.raw) };
}
#  endif
#  if HWY_TARGET <= HWY_AVX3
HWY_INLINE hn::Vec512<std::int32_t>
           NearestIntegers(hn::Vec512<float> v)
{
  return hn::Vec512<std::int32_t>{ _mm512_cvtps_epi32(v.raw) };
}
#  endif
#else
HWY_INLINE hn::Vec<IntegerTag>
           NearestIntegers(hn::Vec<FloatTag> v)
{
  return hn::NearestInt(v);
}
#endif

/** Elements: rounded to nearest, ties to even, and saturated; NaN becomes 0. */
template <typename TElement>
HWY_INLINE hn::Vec<IntegerTag>
           RoundLanes(hn::Vec<FloatTag> value)
{
  constexpr FloatTag d;
  // The integer next to NaN is 0 or the smallest one, which suits unsigned elements.
  if (std::is_signed<TElement>::value)
  {
    value = hn::IfThenElseZero(hn::Eq(value, value), value);
  }
  const auto bounded = OrderedMin(hn::Set(d, static_cast<float>(hwy::HighestValue<TElement>())), value);
  return hn::Max(NearestIntegers(bounded), hn::Set(IntegerTag(), hwy::LowestValue<TElement>()));
}

/** Stores both children of one vector of voxels. */
template <typename TElement, std::enable_if_t<std::is_integral<TElement>::value, int> = 0>
HWY_INLINE void
StoreChildren(hn::Vec<FloatTag> lower, hn::Vec<FloatTag> upper, TElement * out)
{
  // A pair of children fills half a lane or a whole one, the lower child first: Highway's targets are little-endian.
  constexpr int bits = 8 * sizeof(TElement);
  auto          lowerBits = RoundLanes<TElement>(lower);
  if (std::is_signed<TElement>::value)
  {
    lowerBits = hn::And(lowerBits, hn::Set(IntegerTag(), (1 << bits) - 1));
  }
  const auto pairs = hn::Or(lowerBits, hn::ShiftLeft<bits>(RoundLanes<TElement>(upper)));
  if constexpr (sizeof(TElement) == 2)
  {
    hn::StoreU(pairs, IntegerTag(), reinterpret_cast<std::int32_t *>(out));
  }
  else
  {
    constexpr hn::Rebind<std::int16_t, IntegerTag> half;
    // Sign-extend, so that narrowing does not saturate.
    const auto narrow = hn::DemoteTo(half, hn::ShiftRight<16>(hn::ShiftLeft<16>(pairs)));
    hn::StoreU(narrow, half, reinterpret_cast<std::int16_t *>(out));
  }
}

template <typename T, std::enable_if_t<std::is_floating_point<T>::value, int> = 0>
HWY_INLINE void
StoreChildren(Vector<T> lower, Vector<T> upper, T * out)
{
  hn::StoreInterleaved2(lower, upper, Tag<T>(), out);
}

/** Elements of values that are in order. */
template <typename T, typename TElement>
void
NarrowValues(const T * values, std::size_t count, TElement * out)
{
  if constexpr (std::is_same<TElement, T>::value)
  {
    std::copy_n(values, count, out);
  }
  else
  {
    const auto convert = [=](std::size_t x) HWY_ATTR {
      if constexpr (HasVectorCode<TElement, T>)
      {
        const auto rounded = RoundLanes<TElement>(Load(values + x));
        hn::StoreU(hn::DemoteTo(ElementTag<TElement>(), rounded), ElementTag<TElement>(), out + x);
      }
    };
    if (!HasVectorCode<TElement, T> || !ForEachVector(count, convert))
    {
      for (std::size_t x = 0; x < count; ++x)
      {
        out[x] = RoundToElement<TElement>(values[x]);
      }
    }
  }
}

/** Elements, in order, of both children of \c count voxels along x: a vector of lower ones and a vector of upper ones
 * in turns. */
template <typename T, typename TElement>
void
InterleaveChildren(const T * children, std::size_t count, TElement * out)
{
  const std::size_t lanes = hn::Lanes(Tag<T>());
  if constexpr (HasVectorCode<TElement, T>)
  {
    std::size_t x = 0;
    for (; x + lanes <= count; x += lanes)
    {
      StoreChildren(Load(children + 2 * x), Load(children + 2 * x + lanes), out + 2 * x);
    }
    if (x < count)
    {
      // There need not be room for the elements of a whole vector.
      TElement last[2 * HWY_MAX_BYTES / sizeof(T)];
      StoreChildren(Load(children + 2 * x), Load(children + 2 * x + lanes), last);
      std::memcpy(out + 2 * x, last, 2 * (count - x) * sizeof(TElement));
    }
  }
  else
  {
    for (std::size_t x = 0; x < count; ++x)
    {
      const T * const lower = children + x / lanes * 2 * lanes + x % lanes;
      out[2 * x] = RoundToElement<TElement>(lower[0]);
      out[2 * x + 1] = RoundToElement<TElement>(lower[lanes]);
    }
  }
}

} // namespace HWY_NAMESPACE
} // namespace Subdivision
} // namespace itk
