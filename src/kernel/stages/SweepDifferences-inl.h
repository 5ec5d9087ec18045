// SPDX-License-Identifier: Apache-2.0

// Limited second differences along z and any axes of the plane (docs/scheme.md, section 3). No include guard: every
// target includes this file once, into its own namespace.

#include "kernel/stages/Rows-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief Stage: E_A of the subsets A that have z, of two planes at a time, row by row.
 *
 * G_A, H_A, K_A and E_A are as in InPlaneDifferences; subsets are named by their axes in the plane. The two newest
 * planes, n - 1 and n, complete the windows of planes n - 4 and n - 3, the earlier and the later one. */
template <typename T, bool VX, bool VY>
class SweepDifferences
{
public:
  void
  Allocate(Layout<T> & layout)
  {
    for (PlaneRows & plane : m_Planes)
    {
      plane.Allocate(layout);
    }
    for (int subset = 0; subset < SubsetsInPlane; ++subset)
    {
      if (Has(subset))
      {
        m_Windows[subset].Pair.AllocatePlanes(layout);
        m_Windows[subset].Later.AllocatePlanes(layout);
        m_PreviousParts[subset] = subset == NoAxis ? nullptr : layout.TakePlane();
      }
    }
  }

  /** Row r of E_A of the earlier (0) or the later plane (1). */
  SUBDIVISION_INLINE const T *
  GetRow(const int plane, const int subset, const std::ptrdiff_t r) const
  {
    return m_Planes[plane].Limited.Row(subset, r);
  }

  /** Takes row r of the six newest planes: first and second differences along z, and E of z alone. */
  template <typename TInput>
  SUBDIVISION_INLINE void
  AdvanceAlongZ(const Shape &        shape,
                const TInput &       input,
                const std::ptrdiff_t n,
                const std::ptrdiff_t r,
                const double         tension)
  {
    constexpr std::ptrdiff_t reach = ReachAlongX<VX>(VariationReach + 1);
    const std::ptrdiff_t     offset = r * shape.Pitch;
    // Copies, since stores of vectors might change what is in memory.
    T * const         earlierFirst = m_Planes[0].FirstDifference.Begin(r);
    T * const         laterFirst = m_Planes[1].FirstDifference.Begin(r);
    T * const         earlierSecond = m_Planes[0].SecondDifference.Begin(r);
    T * const         laterSecond = m_Planes[1].SecondDifference.Begin(r);
    T * const         earlierLimited = m_Planes[0].Limited.Row(NoAxis, r);
    T * const         laterLimited = m_Planes[1].Limited.Row(NoAxis, r);
    T * const * const planes = input.FromAny(n - 5);
    const T * const   input0 = planes[5] + offset;
    const T * const   input1 = planes[4] + offset;
    const T * const   input2 = planes[3] + offset;
    const T * const   input3 = planes[2] + offset;
    const T * const   input4 = planes[1] + offset;
    const T * const   input5 = planes[0] + offset;
    const auto        factor = Broadcast<T>(tension);
    const auto        two = Broadcast<T>(2);
    const WindowRow   window(m_Windows[NoAxis], n / 2, offset);
    for (std::ptrdiff_t x = FirstVector<T>(reach); x < shape.Width + reach; x += LaneCount<T>())
    {
      const auto value1 = KeepInRegister(Load(input1 + x));
      const auto value2 = KeepInRegister(Load(input2 + x));
      const auto value3 = KeepInRegister(Load(input3 + x));
      const auto value4 = KeepInRegister(Load(input4 + x));
      const auto first0 = Sub(Load(input0 + x), value1);
      const auto first1 = Sub(value1, value2);
      Store(first1, earlierFirst + x);
      Store(first0, laterFirst + x);

      auto earlier = ToOrderedBits(Add(Magnitude(first1), Magnitude(Sub(value2, value3))));
      auto later = ToOrderedBits(Add(Magnitude(first0), Magnitude(first1)));
      AdvanceWindow(window, x, earlier, later);

      const auto second4 = NegMulAdd(two, value4, Add(Load(input5 + x), value3));
      const auto second3 = NegMulAdd(two, value3, Add(value4, value2));
      Store(second4, earlierSecond + x);
      Store(second3, laterSecond + x);
      Store(Limit(second4, factor, earlier), earlierLimited + x);
      Store(Limit(second3, factor, later), laterLimited + x);
    }
  }

  /** Takes row r and, with y, the one after it: E_A of row r without y, and of row r - 2 those of the subsets with y.
   */
  SUBDIVISION_INLINE void
  Advance(const Shape & shape, const std::ptrdiff_t n, const std::ptrdiff_t r, const double tension)
  {
    PlaneRows & earlier = m_Planes[0];
    PlaneRows & later = m_Planes[1];
    const auto  limit = [&](const int            subset,
                           const std::ptrdiff_t row,
                           const auto           earlierDifferences,
                           const auto           laterDifferences,
                           const auto           earlierVariation,
                           const auto           laterVariation) SUBDIVISION_ATTRIBUTE {
      this->LimitRows(
        shape, n, subset, row, tension, earlierDifferences, laterDifferences, earlierVariation, laterVariation);
    };
    if constexpr (VX || VY)
    {
      this->FindVariation(shape, r);
    }
    if (n < FirstVariation)
    {
      return;
    }
    if constexpr (VX)
    {
      if (HasRowWithoutY<VY>(shape, r))
      {
        limit(XAxis,
              r,
              SecondDifferencesAlongX<T>{ earlier.SecondDifference[r] },
              SecondDifferencesAlongX<T>{ later.SecondDifference[r] },
              AlongX<T>{ earlier.XVariation },
              AlongX<T>{ later.XVariation });
      }
    }
    if constexpr (VY)
    {
      if constexpr (VX)
      {
        for (PlaneRows & plane : m_Planes)
        {
          WindowMinimumRow(AlongX<T>{ plane.BothVariation }, ValueRadius, shape.Width, plane.BothMinima.Begin(r));
        }
      }
      const std::ptrdiff_t centre = r - WindowRadius;
      if (centre >= -SecondDifferenceRadius)
      {
        for (PlaneRows & plane : m_Planes)
        {
          SecondDifferenceRow(Around<1>(plane.SecondDifference, centre),
                              ReachAlongX<VX>(ValueRadius + 1),
                              shape.Width,
                              plane.YDifferences);
        }
        limit(YAxis,
              centre,
              RowValues<T>{ earlier.YDifferences },
              RowValues<T>{ later.YDifferences },
              Around<WindowRadius>(earlier.YVariation, centre),
              Around<WindowRadius>(later.YVariation, centre));
        if constexpr (VX)
        {
          limit(BothAxes,
                centre,
                SecondDifferencesAlongX<T>{ earlier.YDifferences },
                SecondDifferencesAlongX<T>{ later.YDifferences },
                Around<WindowRadius>(earlier.BothMinima, centre),
                Around<WindowRadius>(later.BothMinima, centre));
        }
      }
    }
  }

private:
  /** The first pair of planes only leaves parts of the variations that the next one completes. */
  static constexpr std::ptrdiff_t FirstVariation = 2;

  /** Of a subset, what windows of five planes need to know of the last four, pair k being planes n - 1 and n with k =
   * n / 2: the minima of either pair, and the later plane of either. */
  struct Window
  {
    Ring<T, 2> Pair;
    Ring<T, 2> Later;
  };

  /** A row of that. At the first planes of a tile, some of it was not written yet; nobody uses what is made of it. */
  struct WindowRow
  {
    const T * MiddlePair;
    T *       OldestPair;
    T *       OldestLater;

    SUBDIVISION_INLINE
    WindowRow(const Window & window, const std::ptrdiff_t pair, const std::ptrdiff_t offset)
      : MiddlePair(*window.Pair.FromAny(pair - 1) + offset)
      , OldestPair(*window.Pair.FromAny(pair - 2) + offset)
      , OldestLater(*window.Later.FromAny(pair - 2) + offset)
    {}
  };

  /** Rows that live while a plane is processed. */
  struct PlaneRows
  {
    LimitedRows<T>                Limited;
    Ring<T, 2>                    FirstDifference;
    Ring<T, 5>                    SecondDifference;
    Ring<T, 2 * WindowRadius + 1> YVariation;
    Ring<T, 2 * WindowRadius + 1> BothMinima;
    T *                           XVariation;
    T *                           BothVariation;
    T *                           PreviousYPart;
    T *                           PreviousBothPart;
    T *                           YDifferences;

    void
    Allocate(Layout<T> & layout)
    {
      Limited.Allocate(layout);
      FirstDifference.AllocateRows(layout);
      SecondDifference.AllocateRows(layout);
      YVariation.AllocateRows(layout);
      BothMinima.AllocateRows(layout);
      for (T ** const row : { &XVariation, &BothVariation, &PreviousYPart, &PreviousBothPart, &YDifferences })
      {
        *row = layout.TakeRows();
      }
    }
  };

  /** Whether there is such a subset. */
  static constexpr bool
  Has(const int subset)
  {
    return (VX || (subset & XAxis) == 0) && (VY || (subset & YAxis) == 0);
  }

  /** Of the minima in the plane of two more planes, makes those of the two windows of planes that they complete. */
  template <typename TVector>
  static SUBDIVISION_INLINE void
  AdvanceWindow(const WindowRow & window, const std::ptrdiff_t x, TVector & earlier, TVector & later)
  {
    T * const  oldestPair = window.OldestPair + x;
    T * const  oldestLater = window.OldestLater + x;
    const auto middlePair = Load(window.MiddlePair + x);
    const auto newestLater = later;
    const auto newestPair = MinNonNegative(earlier, later);
    earlier = MinNonNegative(MinNonNegative(middlePair, Load(oldestPair)), earlier);
    later = MinNonNegative(MinNonNegative(middlePair, Load(oldestLater)), newestPair);
    Store(newestPair, oldestPair);
    Store(newestLater, oldestLater);
  }

  /** Of the parts in the two newest first differences, makes sums: with the part in the one before, and with each
   * other. */
  template <typename TVector>
  static SUBDIVISION_INLINE void
  AddAlongZ(TVector & earlier, TVector & later, T * const previous)
  {
    const auto before = Load(previous);
    Store(later, previous);
    later = Add(earlier, later);
    earlier = Add(before, earlier);
  }

  /** H_A of a row of both planes, of the subsets with an axis in the plane. */
  SUBDIVISION_INLINE void
  FindVariation(const Shape & shape, const std::ptrdiff_t r)
  {
    constexpr std::ptrdiff_t reach = ReachAlongX<VX>(VariationReach);
    const std::ptrdiff_t     offset = r * shape.Pitch;
    const T * const          earlierRow = m_Planes[0].FirstDifference[r];
    const T * const          laterRow = m_Planes[1].FirstDifference[r];
    const T * const          earlierNext = VY ? m_Planes[0].FirstDifference[r + 1] : nullptr;
    const T * const          laterNext = VY ? m_Planes[1].FirstDifference[r + 1] : nullptr;
    T * const                previousX = VX ? m_PreviousParts[XAxis] + offset : nullptr;
    T * const                previousY = VY ? m_PreviousParts[YAxis] + offset : nullptr;
    T * const                previousBoth = VX && VY ? m_PreviousParts[BothAxes] + offset : nullptr;
    // Copies, since stores of vectors might change what is in memory.
    const RowPointers earlierRows(m_Planes[0], r);
    const RowPointers laterRows(m_Planes[1], r);
    for (std::ptrdiff_t x = FirstVector<T>(reach); x < shape.Width + reach; x += LaneCount<T>())
    {
      Vector<T> earlierX;
      Vector<T> earlierY;
      Vector<T> earlierBoth;
      Vector<T> laterX;
      Vector<T> laterY;
      Vector<T> laterBoth;
      SumDifferences<VX, VY>(earlierRow, earlierNext, x, earlierX, earlierY, earlierBoth);
      SumDifferences<VX, VY>(laterRow, laterNext, x, laterX, laterY, laterBoth);
      if constexpr (VX)
      {
        AddAlongZ(earlierX, laterX, previousX + x);
        Store(ToOrderedBits(earlierX), earlierRows.X + x);
        Store(ToOrderedBits(laterX), laterRows.X + x);
      }
      if constexpr (VY)
      {
        AddAlongZ(earlierY, laterY, previousY + x);
        Store(ToOrderedBits(AddPrevious(earlierY, earlierRows.PreviousY + x)), earlierRows.Y + x);
        Store(ToOrderedBits(AddPrevious(laterY, laterRows.PreviousY + x)), laterRows.Y + x);
      }
      if constexpr (VX && VY)
      {
        AddAlongZ(earlierBoth, laterBoth, previousBoth + x);
        Store(ToOrderedBits(AddPrevious(earlierBoth, earlierRows.PreviousBoth + x)), earlierRows.Both + x);
        Store(ToOrderedBits(AddPrevious(laterBoth, laterRows.PreviousBoth + x)), laterRows.Both + x);
      }
    }
  }

  /** Where the variation of a plane's row goes. */
  struct RowPointers
  {
    T * X;
    T * Y;
    T * Both;
    T * PreviousY;
    T * PreviousBoth;

    SUBDIVISION_INLINE
    RowPointers(PlaneRows & plane, const std::ptrdiff_t r)
      : X(plane.XVariation)
      , Y(plane.YVariation.Begin(r))
      , Both(plane.BothVariation)
      , PreviousY(plane.PreviousYPart)
      , PreviousBoth(plane.PreviousBothPart)
    {}
  };

  /** E_A of a row of both planes. */
  template <typename TDifferences, typename TVariation>
  SUBDIVISION_INLINE void
  LimitRows(const Shape &        shape,
            const std::ptrdiff_t n,
            const int            subset,
            const std::ptrdiff_t r,
            const double         tension,
            const TDifferences   earlierDifferences,
            const TDifferences   laterDifferences,
            const TVariation     earlierVariation,
            const TVariation     laterVariation)
  {
    constexpr std::ptrdiff_t reach = ReachAlongX<VX>(ValueRadius);
    const WindowRow          window(m_Windows[subset], n / 2, r * shape.Pitch);
    T * const                earlierLimited = m_Planes[0].Limited.Row(subset, r);
    T * const                laterLimited = m_Planes[1].Limited.Row(subset, r);
    const auto               factor = Broadcast<T>(tension);
    for (std::ptrdiff_t x = FirstVector<T>(reach); x < shape.Width + reach; x += LaneCount<T>())
    {
      auto earlier = WindowMinimum(earlierVariation, x);
      auto later = WindowMinimum(laterVariation, x);
      AdvanceWindow(window, x, earlier, later);
      Store(Limit(earlierDifferences(x), factor, earlier), earlierLimited + x);
      Store(Limit(laterDifferences(x), factor, later), laterLimited + x);
    }
  }

  PlaneRows m_Planes[2];
  Window    m_Windows[SubsetsInPlane];
  T *       m_PreviousParts[SubsetsInPlane];
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
