// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionNumbers_h
#define SubdivisionNumbers_h

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

/** The numbers of docs/scheme.md that both the reference and the filter are held to. */
namespace SubdivisionNumbers
{
using Values = std::vector<double>;

inline Values
Step()
{
  return { 0, 0, 0, 0, 0, 1, 1, 1, 1, 1 };
}

inline Values
Bar()
{
  return { 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0 };
}

/** Outputs times 1024, zero flux boundary, tension 2. */
inline Values
StepLinear()
{
  return { 0, 0, 0, 0, 0, 10, 14, -64, -112, 212, 812, 1136, 1088, 1010, 1014, 1024, 1024, 1024, 1024, 1024 };
}

inline Values
StepNonOscillatory()
{
  return { 0, 0, 0, 0, 0, 1, 11, 56, 176, 386, 638, 848, 968, 1013, 1023, 1024, 1024, 1024, 1024, 1024 };
}

inline Values
BarLinear()
{
  return { 0, 0, 0, 0, 0, 10, 14, -64, -112, 202, 798, 1200, 1200, 798, 202, -112, -64, 14, 10, 0, 0, 0, 0, 0 };
}

inline Values
BarNonOscillatory()
{
  return { 0, 0, 0, 0, 0, 1, 11, 56, 176, 385, 627, 792, 792, 627, 385, 176, 56, 11, 1, 0, 0, 0, 0, 0 };
}

/** The average of the sine over each of `cells` cells of one period. */
inline Values
SineAverages(int cells)
{
  const double width = 8.0 * std::atan(1.0) / cells;
  Values       averages;
  for (int i = 0; i < cells; ++i)
  {
    averages.push_back((std::cos(i * width) - std::cos((i + 1) * width)) / width);
  }
  return averages;
}

/** Cells of a period, and the largest error of the subdivided sine averages, of order 6. */
inline std::array<std::pair<int, double>, 4>
SineErrors()
{
  return { { { 16, 1.737e-5 }, { 32, 2.777e-7 }, { 64, 4.364e-9 }, { 128, 6.828e-11 } } };
}

inline double
LargestDifference(const Values & a, const Values & b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b.at(i)));
  }
  return largest;
}

/** What the linear scheme makes of the mean of a voxel's two children: f + 5/1024 times the sixth difference, the
 * values taken as periodic. */
inline double
MeanOfChildren(const Values & f, long j)
{
  const std::array<double, 7> sixthDifference{ 1, -6, 15, -20, 15, -6, 1 };
  const long                  n = static_cast<long>(f.size());
  double                      sum = 0.0;
  for (long i = 0; i < 7; ++i)
  {
    sum += sixthDifference[i] * f[((j + i - 3) % n + n) % n];
  }
  return f[j] + 5.0 / 1024.0 * sum;
}

} // namespace SubdivisionNumbers

#endif
