// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionReference_h
#define SubdivisionReference_h

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

/** The oracle of the tests: the scheme of docs/scheme.md written down sum by sum, in double precision and in any
 * dimension. It shares no code with the filter or its kernel, knows nothing of ITK, and makes no attempt at speed. */
namespace SubdivisionReference
{

enum class Scheme
{
  NonOscillatory,
  Linear,
  BoundedLinear,
  BSpline,
  Restored
};

template <unsigned int D>
using Index = std::array<long, D>;

template <unsigned int D>
using Axes = std::array<bool, D>;

/** Calls `visit` with every index of a box, the first axis running fastest. */
template <unsigned int D, typename TVisitor>
void
ForEachIndex(const Index<D> & lower, const Index<D> & size, const TVisitor & visit)
{
  long count = 1;
  for (const long n : size)
  {
    count *= n;
  }
  for (long i = 0; i < count; ++i)
  {
    Index<D> index;
    long     rest = i;
    for (unsigned int w = 0; w < D; ++w)
    {
      index[w] = lower[w] + rest % size[w];
      rest /= size[w];
    }
    visit(index);
  }
}

/** Values on a box of integer points, the first axis running fastest. */
template <unsigned int D>
struct Grid
{
  Index<D>            lower{};
  Index<D>            size{};
  std::vector<double> values;

  Grid() = default;
  Grid(const Index<D> & lowerIndex, const Index<D> & gridSize)
    : lower(lowerIndex)
    , size(gridSize)
  {
    long count = 1;
    for (const long n : size)
    {
      count *= n;
    }
    values.resize(count);
  }

  double &
  operator()(const Index<D> & index)
  {
    return values.at(Position(index));
  }
  double
  operator()(const Index<D> & index) const
  {
    return values.at(Position(index));
  }

private:
  long
  Position(const Index<D> & index) const
  {
    long position = 0;
    for (unsigned int w = D; w-- > 0;)
    {
      position = position * size[w] + index[w] - lower[w];
    }
    return position;
  }
};

/** A grid filled with the values of a function of the index. */
template <unsigned int D, typename TFunction>
Grid<D>
MakeGrid(const Index<D> & lower, const Index<D> & size, const TFunction & function)
{
  Grid<D> grid(lower, size);
  ForEachIndex<D>(lower, size, [&](const Index<D> & index) { grid(index) = function(index); });
  return grid;
}

/** The value of an image at any index, also outside it. */
template <unsigned int D>
using Boundary = std::function<double(const Grid<D> & image, const Index<D> & index)>;

inline long
FloorModulo(long value, long divisor)
{
  return ((value % divisor) + divisor) % divisor;
}

/** A boundary that maps each coordinate, counted from the image's start, into [0, size). */
template <unsigned int D, typename TMap>
Boundary<D>
MappedBoundary(const TMap & map)
{
  return [map](const Grid<D> & image, Index<D> index) {
    for (unsigned int w = 0; w < D; ++w)
    {
      index[w] = image.lower[w] + map(index[w] - image.lower[w], image.size[w]);
    }
    return image(index);
  };
}

template <unsigned int D>
Boundary<D>
ZeroFlux()
{
  return MappedBoundary<D>([](long i, long n) { return std::min(std::max(i, 0L), n - 1); });
}

template <unsigned int D>
Boundary<D>
Periodic()
{
  return MappedBoundary<D>([](long i, long n) { return FloorModulo(i, n); });
}

/** Half-sample symmetric: ... 1 0 | 0 1 2 ... */
template <unsigned int D>
Boundary<D>
Mirror()
{
  return MappedBoundary<D>([](long i, long n) {
    const long j = FloorModulo(i, 2 * n);
    return j < n ? j : 2 * n - 1 - j;
  });
}

template <unsigned int D>
Boundary<D>
Constant(double value)
{
  return [value](const Grid<D> & image, const Index<D> & index) {
    for (unsigned int w = 0; w < D; ++w)
    {
      if (index[w] < image.lower[w] || index[w] >= image.lower[w] + image.size[w])
      {
        return value;
      }
    }
    return image(index);
  };
}

template <unsigned int D>
struct Settings
{
  Scheme      scheme = Scheme::NonOscillatory;
  double      tension = 2.0;
  Boundary<D> boundary = ZeroFlux<D>();
  Axes<D>     axes = AllAxes();

  static Axes<D>
  AllAxes()
  {
    Axes<D> all;
    all.fill(true);
    return all;
  }
};

/** One summand of a weighted sum along an axis. */
struct Tap
{
  long   offset;
  double weight;
};
using Taps = std::vector<Tap>;

/** The sum of the tensor product of one list of taps per axis, applied to the field at `index`. */
template <unsigned int D>
double
TensorSum(const Grid<D> & field, const std::array<Taps, D> & taps, Index<D> index, unsigned int axis = D)
{
  if (axis == 0)
  {
    return field(index);
  }
  const unsigned int w = axis - 1;
  const long         centre = index[w];
  double             sum = 0.0;
  for (const Tap & tap : taps[w])
  {
    index[w] = centre + tap.offset;
    sum += tap.weight * TensorSum<D>(field, taps, index, w);
  }
  return sum;
}

/** The taps `inside` along the chosen axes, `outside` along the others. */
template <unsigned int D>
std::array<Taps, D>
TapsAlong(const Axes<D> & chosen, const Taps & inside, const Taps & outside = Taps{ { 0, 1.0 } })
{
  std::array<Taps, D> taps;
  for (unsigned int w = 0; w < D; ++w)
  {
    taps[w] = chosen[w] ? inside : outside;
  }
  return taps;
}

/** Every index of [first, last] along the chosen axes, and 0 along the others. */
template <unsigned int D>
std::vector<Index<D>>
OffsetsAlong(const Axes<D> & chosen, long first, long last)
{
  Index<D> lower;
  Index<D> size;
  for (unsigned int w = 0; w < D; ++w)
  {
    lower[w] = chosen[w] ? first : 0;
    size[w] = chosen[w] ? last - first + 1 : 1;
  }
  std::vector<Index<D>> offsets;
  ForEachIndex<D>(lower, size, [&](const Index<D> & offset) { offsets.push_back(offset); });
  return offsets;
}

template <unsigned int D>
Index<D>
Sum(Index<D> a, const Index<D> & b)
{
  for (unsigned int w = 0; w < D; ++w)
  {
    a[w] += b[w];
  }
  return a;
}

/** Adds (or takes away, where negative) `margin` points at both ends of the chosen axes of a grid's box. */
template <unsigned int D>
Grid<D>
Resized(const Grid<D> & grid, const Axes<D> & chosen, long margin)
{
  Index<D> lower = grid.lower;
  Index<D> size = grid.size;
  for (unsigned int w = 0; w < D; ++w)
  {
    lower[w] -= chosen[w] ? margin : 0;
    size[w] += chosen[w] ? 2 * margin : 0;
  }
  return Grid<D>(lower, size);
}

/** The field f(index) on a box changed by `margin` along the chosen axes. */
template <unsigned int D, typename TFunction>
Grid<D>
FieldOn(const Grid<D> & grid, const Axes<D> & chosen, long margin, const TFunction & function)
{
  const Grid<D> box = Resized<D>(grid, chosen, margin);
  return MakeGrid<D>(box.lower, box.size, function);
}

/** G_A, as a function of the sample: the product of the second differences along the axes of A. */
template <unsigned int D>
auto
SecondDifference(const Grid<D> & g, const Axes<D> & a)
{
  const auto taps = TapsAlong<D>(a, { { -1, 1.0 }, { 0, -2.0 }, { 1, 1.0 } });
  return [&g, taps](const Index<D> & j) { return TensorSum<D>(g, taps, j); };
}

/** H_A, as a function of the sample: the sum of the magnitudes of the first differences over the cells that touch it.
 */
template <unsigned int D>
auto
RoughnessAround(const Grid<D> & g, const Axes<D> & a)
{
  const auto difference = TapsAlong<D>(a, { { 0, -1.0 }, { 1, 1.0 } });
  return [&g, difference, cells = OffsetsAlong<D>(a, -1, 0)](const Index<D> & j) {
    double sum = 0.0;
    for (const Index<D> & cell : cells)
    {
      sum += std::abs(TensorSum<D>(g, difference, Sum<D>(j, cell)));
    }
    return sum;
  };
}

/** K_A without the tension, as a function of the sample: the smallest H_A of the window of five samples along each axis
 * of A. */
template <unsigned int D>
auto
SmallestAround(const Grid<D> & h, const Axes<D> & a)
{
  return [&h, window = OffsetsAlong<D>(a, -2, 2)](const Index<D> & j) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Index<D> & offset : window)
    {
      smallest = std::min(smallest, h(Sum<D>(j, offset)));
    }
    return smallest;
  };
}

/** E_A: the second differences along the axes of A, clamped to ±tension times the smallest roughness nearby.
 * E of no axis is g itself. */
template <unsigned int D>
Grid<D>
ClampedDifference(const Grid<D> & g, const Axes<D> & a, double tension)
{
  if (a == Axes<D>{})
  {
    return g;
  }
  const Grid<D> h = FieldOn<D>(g, a, -1, RoughnessAround<D>(g, a));
  const auto    smallest = SmallestAround<D>(h, a);
  const auto    difference = SecondDifference<D>(g, a);
  return FieldOn<D>(g, a, -3, [&](const Index<D> & j) {
    const double threshold = tension * smallest(j);
    return std::min(std::max(difference(j), -threshold), threshold);
  });
}

/** A mask of child k = 0 over 1024, which begins at offset `first` from p; child 1 has the values reversed. */
inline Taps
MaskTaps(std::vector<double> mask, long first, long k)
{
  if (k == 1)
  {
    std::reverse(mask.begin(), mask.end());
  }
  Taps taps;
  for (const double value : mask)
  {
    taps.push_back({ first++, value / 1024.0 });
  }
  return taps;
}

inline Taps
MaskA(long k)
{
  return MaskTaps({ 14, -126, 924, 276, -74, 10 }, -2, k);
}

inline Taps
MaskB(long k)
{
  return MaskTaps({ 11, 165, 462, 330, 55, 1 }, -2, k);
}

inline Taps
MaskC(long k)
{
  return MaskTaps({ 3, -285, -111, 9 }, -1, k);
}

/** Where child m of the output reads the input: around p, with the masks of child k. Output indices are counted from
 * the doubled start, input indices from the start. */
struct Child
{
  explicit Child(long m)
    : k(m % 2 == 0 ? 1 : 0)
    , p(m % 2 == 0 ? m / 2 - 1 : (m - 1) / 2)
    , parent(m / 2)
  {}
  long k;
  long p;
  long parent;
};

/** Every subset of the subdivided axes. */
template <unsigned int D>
std::vector<Axes<D>>
SubsetsOf(const Axes<D> & axes)
{
  std::vector<Axes<D>> subsets{ Axes<D>{} };
  for (unsigned int w = 0; w < D; ++w)
  {
    const std::size_t count = axes[w] ? subsets.size() : 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      subsets.push_back(subsets[i]);
      subsets.back()[w] = true;
    }
  }
  return subsets;
}

/** The subdivision of one image. */
template <unsigned int D>
class Subdivision
{
public:
  /** The farthest sample that a child reads: p - 4 with p = -1. */
  static constexpr long Margin = 5;

  Subdivision(const Grid<D> & image, const Settings<D> & settings)
    : m_Settings(settings)
    , m_Image(image)
  {
    m_Padded =
      FieldOn<D>(image, settings.axes, Margin, [&](const Index<D> & index) { return settings.boundary(image, index); });
    if (settings.scheme == Scheme::NonOscillatory)
    {
      for (const Axes<D> & subset : SubsetsOf<D>(settings.axes))
      {
        m_Fields.push_back({ subset, ClampedDifference<D>(m_Padded, subset, settings.tension) });
      }
    }
    if (settings.scheme == Scheme::Restored)
    {
      Sharpen();
    }
  }

  /** The output value at an index counted from the doubled start. */
  double
  At(const Index<D> & output) const
  {
    switch (m_Settings.scheme)
    {
      case Scheme::NonOscillatory:
        return NonOscillatory(output);
      case Scheme::Linear:
        return TensorSum<D>(m_Padded, ChildTaps(output, MaskA), Base(output));
      case Scheme::BoundedLinear:
        return Bounded(output);
      case Scheme::Restored:
        return Restored(output);
      default:
        return TensorSum<D>(m_Padded, ChildTaps(output, MaskB), Base(output));
    }
  }

  /** The whole output, its first index at 0. */
  Grid<D>
  Whole() const
  {
    Index<D> size = m_Image.size;
    for (unsigned int w = 0; w < D; ++w)
    {
      size[w] *= m_Settings.axes[w] ? 2 : 1;
    }
    return MakeGrid<D>(Index<D>{}, size, [&](const Index<D> & output) { return At(output); });
  }

private:
  struct Field
  {
    Axes<D> subset;
    Grid<D> values;
  };

  /** The input index p of an output index; along the other axes, the index itself. */
  Index<D>
  Base(const Index<D> & output) const
  {
    Index<D> base = m_Image.lower;
    for (unsigned int w = 0; w < D; ++w)
    {
      base[w] += m_Settings.axes[w] ? Child(output[w]).p : output[w];
    }
    return base;
  }

  /** The taps of a child: a mask along every subdivided axis. */
  template <typename TMask>
  std::array<Taps, D>
  ChildTaps(const Index<D> & output, const TMask & mask) const
  {
    std::array<Taps, D> taps;
    for (unsigned int w = 0; w < D; ++w)
    {
      taps[w] = m_Settings.axes[w] ? mask(Child(output[w]).k) : Taps{ { 0, 1.0 } };
    }
    return taps;
  }

  double
  NonOscillatory(const Index<D> & output) const
  {
    double sum = 0.0;
    for (const Field & field : m_Fields)
    {
      auto taps = ChildTaps(output, MaskB);
      for (unsigned int w = 0; w < D; ++w)
      {
        taps[w] = field.subset[w] ? MaskC(Child(output[w]).k) : taps[w];
      }
      sum += TensorSum<D>(field.values, taps, Base(output));
    }
    return sum;
  }

  /** The voxel that a child lies in. */
  Index<D>
  Parent(const Index<D> & output) const
  {
    Index<D> parent = m_Image.lower;
    for (unsigned int w = 0; w < D; ++w)
    {
      parent[w] += m_Settings.axes[w] ? Child(output[w]).parent : output[w];
    }
    return parent;
  }

  /** A value clamped to the range of the voxels around a child's parent. */
  double
  ClampToNeighbours(double value, const Index<D> & output) const
  {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Index<D> & offset : OffsetsAlong<D>(m_Settings.axes, -1, 1))
    {
      const double neighbour = m_Padded(Sum<D>(Parent(output), offset));
      low = std::min(low, neighbour);
      high = std::max(high, neighbour);
    }
    return std::min(std::max(value, low), high);
  }

  double
  Bounded(const Index<D> & output) const
  {
    return ClampToNeighbours(TensorSum<D>(m_Padded, ChildTaps(output, MaskA), Base(output)), output);
  }

  /** E + clamp(a - E, -T, T). */
  double
  Restored(const Index<D> & output) const
  {
    const double e = ClampToNeighbours(TensorSum<D>(m_Sharpened, ChildTaps(output, MaskB), Base(output)), output);
    const double a = TensorSum<D>(m_Padded, ChildTaps(output, MaskA), Base(output));
    double       least = std::numeric_limits<double>::infinity();
    double       greatest = 0.0;
    for (const Index<D> & offset : OffsetsAlong<D>(m_Settings.axes, -2, 2))
    {
      const double h = m_Variation(Sum<D>(Parent(output), offset));
      least = std::min(least, h);
      greatest = std::max(greatest, h);
    }
    const double t = greatest > 0 ? 4 * m_Settings.tension * least * least / greatest : 0.0;
    return e + std::min(std::max(a - e, -t), t);
  }

  /** The sum of a function of the sample along each subdivided axis. */
  template <typename TAlong>
  auto
  SumAlongAxes(const Grid<D> & g, const TAlong & along) const
  {
    std::vector<decltype(along(g, Axes<D>{}))> summands;
    for (unsigned int w = 0; w < D; ++w)
    {
      Axes<D> axis{};
      axis[w] = m_Settings.axes[w];
      if (axis[w])
      {
        summands.push_back(along(g, axis));
      }
    }
    return [summands](const Index<D> & j) {
      double sum = 0.0;
      for (const auto & summand : summands)
      {
        sum += summand(j);
      }
      return sum;
    };
  }

  /** P f, by L, the sum of the second differences along the subdivided axes; and H of the restored scheme, the
   * differences to both neighbours along each of them. */
  void
  Sharpen()
  {
    const Axes<D> & axes = m_Settings.axes;
    const Grid<D>   l = FieldOn<D>(m_Padded, axes, -1, SumAlongAxes(m_Padded, SecondDifference<D>));
    const auto      ll = SumAlongAxes(l, SecondDifference<D>);
    m_Sharpened = FieldOn<D>(
      m_Padded, axes, -2, [&](const Index<D> & j) { return m_Padded(j) - 15.0 / 16 * l(j) - 9.0 / 64 * ll(j); });
    m_Variation = FieldOn<D>(m_Padded, axes, -1, SumAlongAxes(m_Padded, RoughnessAround<D>));
  }

  Settings<D>        m_Settings;
  Grid<D>            m_Image;
  Grid<D>            m_Padded;
  std::vector<Field> m_Fields;
  Grid<D>            m_Sharpened;
  Grid<D>            m_Variation;
};

template <unsigned int D>
Grid<D>
Subdivide(const Grid<D> & image, const Settings<D> & settings)
{
  return Subdivision<D>(image, settings).Whole();
}

} // namespace SubdivisionReference

#endif
