// SPDX-License-Identifier: Apache-2.0

// Conversions of rows of pixels from and to float. No include guard: every target includes this file once, into its own
// namespace.

namespace itk
{
namespace HWY_NAMESPACE
{

using FloatTag = hn::ScalableTag<float>;
using IntegerTag = hn::ScalableTag<std::int32_t>;

/** As many pixels as there are lanes of float. */
template <typename TPixel>
using PixelTag = hn::Rebind<TPixel, FloatTag>;

template <typename TPixel>
HWY_INLINE hn::Vec<FloatTag>
           ConvertLanes(const TPixel * in)
{
  return hn::ConvertTo(FloatTag(), hn::PromoteTo(IntegerTag(), hn::LoadU(PixelTag<TPixel>(), in)));
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

template <typename TPixel>
void
ConvertRow(const TPixel * in, std::size_t count, float * out)
{
  const auto convert = [=](std::size_t x) HWY_ATTR { hn::StoreU(ConvertLanes(in + x), FloatTag(), out + x); };
  if (!ForEachVector(count, convert))
  {
    std::copy_n(in, count, out);
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

/** Pixels: rounded to nearest, ties to even, and saturated; NaN becomes 0. */
template <typename TPixel>
HWY_INLINE hn::Vec<IntegerTag>
           RoundLanes(hn::Vec<FloatTag> value)
{
  constexpr FloatTag d;
  // The integer next to NaN is 0 or the smallest one, which suits unsigned pixels.
  if (std::is_signed<TPixel>::value)
  {
    value = hn::IfThenElseZero(hn::Eq(value, value), value);
  }
  const auto bounded = OrderedMin(hn::Set(d, static_cast<float>(hwy::HighestValue<TPixel>())), value);
  return hn::Max(NearestIntegers(bounded), hn::Set(IntegerTag(), hwy::LowestValue<TPixel>()));
}

/** Stores both children of one vector of voxels. */
template <typename TPixel, std::enable_if_t<std::is_integral<TPixel>::value, int> = 0>
HWY_INLINE void
StoreChildren(hn::Vec<FloatTag> lower, hn::Vec<FloatTag> upper, TPixel * out)
{
  // A pair of children fills half a lane or a whole one, the lower child first: Highway's targets are little-endian.
  constexpr int bits = 8 * sizeof(TPixel);
  auto          lowerBits = RoundLanes<TPixel>(lower);
  if (std::is_signed<TPixel>::value)
  {
    lowerBits = hn::And(lowerBits, hn::Set(IntegerTag(), (1 << bits) - 1));
  }
  const auto pairs = hn::Or(lowerBits, hn::ShiftLeft<bits>(RoundLanes<TPixel>(upper)));
  if constexpr (sizeof(TPixel) == 2)
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

/** Both children along the lanes of \c count voxels, as pixels in order, of a row of a vector of lower ones and a
 * vector of upper ones in turns. */
template <typename T, typename TPixel>
void
InterleaveChildren(const T * children, std::size_t count, TPixel * out)
{
  const std::size_t lanes = hn::Lanes(Tag<T>());
  std::size_t       x = 0;
  for (; x + lanes <= count; x += lanes)
  {
    StoreChildren(Load(children + 2 * x), Load(children + 2 * x + lanes), out + 2 * x);
  }
  if (x < count)
  {
    // There need not be room for the pixels of a whole vector.
    TPixel last[2 * HWY_MAX_BYTES / sizeof(T)];
    StoreChildren(Load(children + 2 * x), Load(children + 2 * x + lanes), last);
    std::memcpy(out + 2 * x, last, 2 * (count - x) * sizeof(TPixel));
  }
}

} // namespace HWY_NAMESPACE
} // namespace itk
