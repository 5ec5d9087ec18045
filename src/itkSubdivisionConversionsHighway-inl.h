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

template <typename TPixel>
void
ConvertRow(const TPixel * in, std::size_t count, float * out)
{
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t       x = 0;
  for (; x + lanes <= count; x += lanes)
  {
    hn::StoreU(ConvertLanes(in + x), FloatTag(), out + x);
  }
  for (; x < count; ++x)
  {
    out[x] = static_cast<float>(in[x]);
  }
}

/** Lanes whose lowest bits are the pixel: rounded to nearest, ties to even, and saturated; NaN becomes 0. The bits
 * above are not specified. */
template <typename TPixel>
HWY_INLINE hn::Vec<IntegerTag>
           RoundLanes(hn::Vec<FloatTag> value)
{
  constexpr FloatTag d;
  if (std::is_signed<TPixel>::value)
  {
    value = hn::IfThenElseZero(hn::Eq(value, value), value);
  }
  // For unsigned pixels the lower bound turns NaN into 0.
  value = OrderedMax(value, hn::Set(d, static_cast<float>(hwy::LowestValue<TPixel>())));
  value = OrderedMin(value, hn::Set(d, static_cast<float>(hwy::HighestValue<TPixel>())));
  // Adding this moves the integer to the end of the mantissa.
  return hn::BitCast(IntegerTag(), hn::Add(value, hn::Set(d, 12582912.0f)));
}

/** Stores both children of one vector of voxels. */
template <typename TPixel>
HWY_INLINE void
StoreChildren(hn::Vec<FloatTag> lower, hn::Vec<FloatTag> upper, TPixel * out)
{
  // A pair of children fills half a lane or a whole one, the lower child first: Highway's targets are little-endian.
  constexpr int bits = 8 * sizeof(TPixel);
  const auto    lowerBits = hn::And(RoundLanes<TPixel>(lower), hn::Set(IntegerTag(), (1 << bits) - 1));
  const auto    pairs = hn::Or(lowerBits, hn::ShiftLeft<bits>(RoundLanes<TPixel>(upper)));
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

HWY_INLINE void
StoreChildren(hn::Vec<FloatTag> lower, hn::Vec<FloatTag> upper, float * out)
{
  hn::StoreInterleaved2(lower, upper, FloatTag(), out);
}

template <typename TPixel>
void
InterleaveChildren(const float * lower, const float * upper, std::size_t count, TPixel * out)
{
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t       x = 0;
  for (; x + lanes <= count; x += lanes)
  {
    StoreChildren(hn::LoadU(FloatTag(), lower + x), hn::LoadU(FloatTag(), upper + x), out + 2 * x);
  }
  if (x < count)
  {
    // Neither the rows nor the pixels need have room for a whole vector.
    constexpr std::size_t mostLanes = HWY_MAX_BYTES / sizeof(float);
    float                 lastLower[mostLanes] = {};
    float                 lastUpper[mostLanes] = {};
    TPixel                last[2 * mostLanes];
    std::memcpy(lastLower, lower + x, (count - x) * sizeof(float));
    std::memcpy(lastUpper, upper + x, (count - x) * sizeof(float));
    StoreChildren(hn::LoadU(FloatTag(), lastLower), hn::LoadU(FloatTag(), lastUpper), last);
    std::memcpy(out + 2 * x, last, 2 * (count - x) * sizeof(TPixel));
  }
}

} // namespace HWY_NAMESPACE
} // namespace itk
